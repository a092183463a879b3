"""The stability bookkeeping of recorded runs: its rigid model against independent cases, V and V̇ against a closed form."""

import json
from dataclasses import replace

import numpy as np
import pytest
from synthetic_signals import ARM, constant, run

from reed_tools.figures import lyapunov
from reed_tools.paths import ROOT
from reed_tools.robots import chain, rigid_arm

CASES = ROOT / "tests" / "data" / "cases"


def cases(name):
    return json.loads((CASES / f"{name}.json").read_text())["cases"]


def test_mass_matrix_is_that_of_the_reference_cases():
    for case in cases("dyn_A5"):
        M = rigid_arm.mass_matrix(ARM, np.array([case["q"]]))[0]
        np.testing.assert_allclose(M, case["M"], atol=1e-10)


def test_tip_and_its_jacobian_are_those_of_the_reference_cases():
    for case in cases("fk_A5"):
        q = np.array([case["q"]])
        np.testing.assert_allclose(rigid_arm.tip(ARM, q)[0], np.array(case["T"])[:3, 3], atol=1e-10)
        np.testing.assert_allclose(rigid_arm.tip_jacobian(ARM, q)[0], np.array(case["J_world_lin_ang"])[:3], atol=1e-10)


def test_many_poses_at_once_are_each_pose_alone():
    q = np.random.default_rng(3).uniform(-1, 1, (4, 5))
    together = rigid_arm.mass_matrix(ARM, q)
    for k in range(4):
        np.testing.assert_allclose(together[k], rigid_arm.mass_matrix(ARM, q[k:k + 1])[0], atol=1e-14)


def test_another_truth_moves_bodies_and_friction():
    """a5's links are nothing but their parameters: scaled together, all of M and F_v scale; one alone adds a mass at its place."""
    q = np.array([[0.1, 0.6, -1.0, -0.7, 0.2]])
    half = rigid_arm.true_arm({"arm": ARM, "plant": {"p_true": [0.5 * p for p in ARM["p_true"]]}})
    np.testing.assert_allclose(rigid_arm.mass_matrix(half, q), 0.5 * rigid_arm.mass_matrix(ARM, q), atol=1e-12)
    np.testing.assert_allclose(rigid_arm.viscous_friction(half), 0.5 * rigid_arm.viscous_friction(ARM))
    heavier = rigid_arm.true_arm({"arm": ARM, "plant": {"p_true": [*ARM["p_true"][:5], 0.8]}})
    J_v, J_w = chain.jacobians(rigid_arm.poses(ARM, q), 4, [0.0, 0.0, 0.0])
    hand = 0.3 * (np.swapaxes(J_v, 1, 2) @ J_v + 0.00064 * np.swapaxes(J_w, 1, 2) @ J_w)
    np.testing.assert_allclose(rigid_arm.mass_matrix(heavier, q) - rigid_arm.mass_matrix(ARM, q), hand, atol=1e-12)
    assert rigid_arm.true_arm({"arm": ARM, "plant": {}}) is ARM


def test_kinetic_part_is_that_of_the_true_arm_with_its_rotors():
    s = constant([0.1, -0.2, 0.3, 0.05, -0.1], 50)
    signals, effective = run("known", "separated", s=s)
    book = lyapunov.of_run(signals, effective)
    M = rigid_arm.mass_matrix(ARM, signals.position[:1])[0] + np.diag(ARM["rotor_inertia_reflected"])
    assert book.V[0] == pytest.approx(0.5 * s[0] @ M @ s[0])
    F_v = 0.12 * np.array([1.0, 1.0, 0.8, 0.5, 0.3])
    assert book.predicted[0] == pytest.approx(-np.sum((np.array(effective["control"]["K_d"]) + F_v) * s[0] ** 2))
    np.testing.assert_allclose(book.seen[5:-5], 0.0, atol=1e-12)


def test_parts_of_parameters_and_force_are_those_of_42():
    p_hat = constant(ARM["p_true"], 50)
    p_hat[:, 0] -= 0.3
    signals, effective = run("known", "separated", p_hat=p_hat, force_desired=np.full(50, 8.0), force_true=np.full(50, 7.5),
                             force_integral=np.full(50, 0.2))
    book = lyapunov.of_run(signals, effective)
    assert book.V[0] == pytest.approx(0.5 * 0.09 / 5.0 + 0.25 / (2 * 1e4) + 0.5 * 30e-3 * 0.04)
    assert book.predicted[0] == pytest.approx(-4e-3 * 0.25)


def test_a_run_of_a_few_cycles_has_as_many_differences():
    signals, effective = run("known", "separated")
    cut = {name: value[:6] for name, value in vars(signals).items() if isinstance(value, np.ndarray)}
    book = lyapunov.of_run(replace(signals, **cut), effective)
    assert book.seen.shape == book.t.shape == (6,)


def test_the_papers_law_is_weighed_with_the_papers_gains():
    p_hat = constant(ARM["p_true"], 50)
    p_hat[:, 0] -= 0.3
    signals, effective = run("known", "paper_corrected", p_hat=p_hat)
    assert lyapunov.of_run(signals, effective).V[0] == pytest.approx(0.5 * 0.09 / 0.05)


def test_the_bound_of_46_is_never_positive_and_holds_for_any_s_and_e():
    bounds = lyapunov.Bounds(d_0=9.0, Lambda=np.full(5, 5.0))
    draw = np.random.default_rng(11)
    derivative = bounds.derivative(draw.normal(size=(500, 5)), draw.normal(size=(500, 5)))
    assert derivative.max() <= 1e-12
    assert bounds.sigma_1 == 9.0


def test_unknown_force_counts_what_the_push_left_over():
    """10 N along z with a lever of J: d₀ is the torque of the push, less what the observer takes where it is subtracted."""
    force = constant([0.0, 0.0, 10.0], 50)
    signals, effective = run("unknown", "separated", contact_force=force)
    J = rigid_arm.tip_jacobian(ARM, signals.position[:1])[0]
    d_0 = np.linalg.norm(J.T @ force[0])
    sigma_0 = 1.0 / 80.0
    book = lyapunov.of_run(signals, effective)
    assert book.V[0] == pytest.approx(0.5 * sigma_0**2 / 1.0 + 0.5 * d_0**2 / 5.0)
    signals, effective = run("unknown", "separated", contact_force=force, observer=np.tile(J.T @ force[0], (50, 1)))
    effective["control"]["observer"] = True
    assert lyapunov.of_run(signals, effective).V[0] == pytest.approx(0.5 * sigma_0**2)


def test_a_law_that_learns_nothing_has_no_V():
    for law in ("pd", "pd_tuned", "computed_torque", "fixed_nominal", "paper_printed"):
        assert lyapunov.of_run(*run("known", law)) is None
    assert lyapunov.of_run(None, {"control": {"law": "separated"}}) is None


def test_stiffness_of_the_contact_is_the_slope_of_force_over_motion():
    n = 400
    q = constant([0.0, 1.057362, -1.764384, -2.43457, 0.0], n)
    q[:, 1] += np.linspace(0.0, 4e-3, n)
    x = rigid_arm.tip(ARM, q)[:, 2]
    signals, effective = run("known", "separated")
    signals.position, signals.force_true = q, 5.0 - 6000.0 * (x - x[0])
    assert lyapunov.contact_stiffness(signals, effective) == pytest.approx(6000.0, rel=1e-6)
    signals.force_true = np.zeros(n)
    assert lyapunov.contact_stiffness(signals, effective) == 1e4
