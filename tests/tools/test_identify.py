"""tools/reed identify: against Pinocchio and numpy on the same data, against the truth of a simulated run, and its refusals."""

import json
import re
import tomllib

import numpy as np
import pinocchio as pin
import pytest
from built import reed
from pinocchio_chain import chain_model

from reed_tools.errors import UsageError
from reed_tools.identify import base, excite, feasible, filtering, least_squares, samples, write
from reed_tools.paths import ROOT
from reed_tools.robots import nominal, pseudo_inertia, regressor

SIGMAS = 3.0


def done(*argv):
    answer = reed(*argv)
    assert answer.returncode == 0, answer.stderr
    return answer.stdout


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Two motions of a5, recorded."""
    folder = tmp_path_factory.mktemp("identify")
    for seed in (1, 2):
        done("identify", "--excite", "a5", "--seed", seed, "--out", folder / f"{seed}.toml")
        done("run", folder / f"{seed}.toml", "--bus", "memory", "--out", folder / f"run{seed}")
    return folder


@pytest.fixture(scope="module")
def found(runs):
    return json.loads(done("identify", runs / "run1", "--check", runs / "run2", "--write", runs / "identified.toml", "--json"))


def pinocchio_regressor(arm, q, qd, qdd):
    model = chain_model(arm.chain)
    data = model.createData()
    return np.array([pin.computeJointTorqueRegressor(model, data, *state).copy() for state in zip(q, qd, qdd)])


@pytest.mark.parametrize("name", ["a5", "a6", "a7", "p2"])
def test_the_regressor_is_pinocchios(name):
    arm = nominal.load(name)
    states = np.random.default_rng(3).uniform(-3, 3, (3, 200, arm.dof))
    assert np.abs(regressor.inverse_dynamics(arm.chain, *states) - pinocchio_regressor(arm, *states)).max() < 1e-10


def test_pinocchio_and_numpy_find_the_same_on_the_same_data(runs, monkeypatch):
    stretches = samples.of_run(runs / "run1")
    arm = nominal.of_table(samples.arm_of_run(runs / "run1"), "run1")
    own = base.base_of(arm)
    friction = np.stack([arm.viscous @ arm.p, arm.coulomb])
    rows = least_squares.read_rows(stretches, arm, friction, 8.0, "run1")
    W, z = least_squares.weighted(rows, own, np.ones(arm.dof))
    ours = np.linalg.lstsq(W, z, rcond=None)[0]
    monkeypatch.setattr(filtering, "inverse_dynamics", lambda chain, *state: pinocchio_regressor(arm, *state))
    theirs = least_squares.read_rows(stretches, arm, friction, 8.0, "run1")
    used = theirs.used.reshape(-1)
    everything = np.linalg.pinv(theirs.Y.reshape(-1, theirs.Y.shape[2])[used], rcond=1e-9) @ theirs.torque.reshape(-1)[used]
    assert np.abs(own.B @ everything - ours).max() < 1e-6 * max(1.0, np.abs(ours).max())


def true_base(arm, own):
    truth = tomllib.loads((ROOT / "config" / "arms" / f"{arm.name}.toml").read_text())["truth"]
    bodies = [nominal.inertial(body["mass"], body["com"], body["inertia_about_com"]) for body in truth["bodies"]]
    return own.B @ np.concatenate([*bodies, arm.viscous @ np.array(truth["p"]), truth["coulomb"]])


def test_the_truth_of_a_bending_arm_is_within_three_sigma(found):
    arm = nominal.load("a5")
    true = true_base(arm, base.base_of(arm))
    off = {row["name"]: (row["unconstrained"] - value) / row["sigma"] for row, value in zip(found["parameters"], true)}
    assert max(map(abs, off.values())) < SIGMAS, off
    large = [(row["sigma"], value) for row, value in zip(found["parameters"], true) if abs(value) > 0.03]
    assert len(large) > 12 and all(sigma < 0.05 * abs(value) for sigma, value in large)  # and sigma says something


def test_what_came_out_predicts_a_run_that_was_not_used(found):
    assert found["condition"] < 20
    assert set(found["validation"]) == {f"joint{k}" for k in range(1, 6)}
    assert max(found["validation"].values()) < 3.0 and max(found["residual"].values()) < 3.0


def test_the_bodies_are_possible_and_have_the_base_parameters(found):
    arm = nominal.load("a5")
    own = base.base_of(arm)
    bodies = [nominal.inertial(body["mass"], body["com"], body["inertia_about_com"]) for body in found["bodies"]]
    assert all(pseudo_inertia.possible(body) for body in bodies)
    friction = [row["estimate"] for row in found["parameters"][-2 * arm.dof:]]
    assert min(friction) >= 0
    again = own.B @ np.concatenate([*bodies, friction])
    estimate, sigma = (np.array([row[key] for row in found["parameters"]]) for key in ("estimate", "sigma"))
    # Where the nearest bodies are less than a hundredth of a standard deviation away, the free estimate stands.
    assert (np.abs(again - estimate) <= 0.01 * sigma + 1e-12).all()


def test_an_estimate_that_no_body_has_gives_the_nearest_that_bodies_have():
    own = base.base_of(nominal.load("p2"))
    arm = nominal.load("p2")
    wanted = own.B @ np.concatenate([arm.inertial, np.zeros(4)])
    wanted[own.names.index("Izz2")] = -0.01
    everything, distance = feasible.nearest(own.B, wanted, np.eye(len(wanted)) * 1e4, arm.inertial, np.zeros(4))
    assert 0.01 < distance and all(pseudo_inertia.possible(body) for body in everything[:20].reshape(2, 10))
    assert (own.B @ everything)[own.names.index("Izz2")] > 0


def test_the_new_arm_file_has_the_parameters_and_keeps_the_rest(runs, found):
    arm, old = (nominal.read(path) for path in (runs / "identified.toml", ROOT / "config" / "arms" / "a5.toml"))
    assert np.allclose(arm["p_nom"], old["truth"]["p"], atol=0.03) and np.allclose(arm["coulomb_nominal"], old["truth"]["coulomb"], atol=0.01)
    assert [row["estimate"] for row in found["structural"]] == pytest.approx(arm["p_nom"], rel=1e-5)
    assert all(arm[key] == old[key] for key in ("dh", "param_names", "p_lo", "p_hi", "param_shapes", "sections", "truth", "torque_limit"))


def test_a_press_with_the_identified_arm_keeps_its_tip_on_the_path(runs, found):
    def first_second(arm, folder):
        done("run", "press_known", "--arm", arm, "--bus", "memory", "--out", folder)
        return json.loads((folder / "summary.json").read_text())["windows"][0]["tangential_tip_rms_mm"]

    assert first_second(runs / "identified.toml", runs / "after") < 0.5 * first_second("a5", runs / "before")


def test_frames_alone_give_the_same(runs, found):
    """A recording of the bus needs the arm's description; the frames carry the angles and torques that the controller saw."""
    answer = json.loads(done("identify", runs / "run1" / "bus.candump", "--arm", "a5", "--json"))
    for one, other in zip(answer["parameters"], found["parameters"]):
        assert abs(one["estimate"] - other["estimate"]) < 0.5 * other["sigma"], one["name"]


def test_a_comment_and_other_keys_stay_when_a_line_changes():
    text = 'name = "x"\nparam_names = ["a", "b"]\np_nom = [0.1, 0.2]   # the start\n\n[[param_shapes]]\nparam = "a"\n'
    assert write.with_nominal(text, np.array([1.0, 2.5]), np.array([0.1, 0.0]), "x.toml") == \
        'name = "x"\nparam_names = ["a", "b"]\np_nom = [1, 2.5]   # the start\ncoulomb_nominal = [0.1, 0]   # identified\n\n[[param_shapes]]\nparam = "a"\n'


def test_a_new_line_comes_before_the_first_table_and_not_into_rows_of_numbers():
    text = nominal.path_of("a5").read_text()
    written = tomllib.loads(write.with_nominal(text, np.array([0.7, 0.1, 0.1, 0.5, 0.4, 0.5]), np.full(5, 0.2), "a5"))
    assert written == {**tomllib.loads(text), "p_nom": [0.7, 0.1, 0.1, 0.5, 0.4, 0.5], "coulomb_nominal": [0.2] * 5}


def still(count, dof=2):
    return samples.Stretch(1e-3, np.zeros((count, dof)) + 0.3, np.ones((count, dof)))


@pytest.mark.parametrize("count", [3, 200, 20000])
def test_what_is_too_short_or_too_still_names_the_condition_number(count):
    arm = nominal.load("p2")
    with pytest.raises(UsageError, match="too short.* condition number"):
        least_squares.solve([still(count)], arm, base.base_of(arm), 8.0, "run")


def test_holes_are_bridged_or_cut():
    cycle = np.array([1, 2, 3, 5, 6, 20, 21, 22])
    parts = samples.stretches(cycle, cycle[:, None] * 1.0, cycle[:, None] * 1.0, 1e-3)
    assert [len(part.angle) for part in parts] == [5, 2]
    assert np.allclose(parts[0].angle[:, 0], range(1, 6)) and np.allclose(parts[0].torque[:, 0], np.arange(1, 6) + 0.5)


@pytest.mark.parametrize("argv, said", [
    ([], "a run folder or a candump file is needed"),
    (["{runs}/run1", "--cutoff", "0"], "--cutoff 0: allowed: 1 ... 50 Hz"),
    (["{runs}/run1", "--write", "{runs}/1.toml"], "is there already; nothing was overwritten"),
    (["{runs}/run1/bus.candump"], "--arm NAME|FILE"),
    (["{runs}/run1", "--arm", "a6"], "has 5 joints, a6 has 6"),
    (["{runs}/none"], "is no run folder and no candump file"),
    (["--excite", "nobody"], "no such arm"),
    (["--excite", "a5", "--out", "{runs}/1.toml"], "is there already"),
    (["{runs}/before"], "condition number"),
])
def test_wrong_input_is_one_line(runs, argv, said):
    if "{runs}/before" in argv and not (runs / "before").exists():
        done("run", "press_known", "--bus", "memory", "--out", runs / "before")
    answer = reed("identify", *(word.format(runs=runs) for word in argv))
    assert answer.returncode == 2 and answer.stdout == "" and len(answer.stderr.splitlines()) == 1, answer.stderr
    assert said in answer.stderr


def test_a_motion_is_a_fourier_series_at_rest_at_its_ends_and_keeps_the_limits(runs):
    """Of what the file says: the series by its formula, speeds and accelerations by differences."""
    arm = nominal.load("a5")
    scenario = tomllib.loads((runs / "1.toml").read_text())
    leg, = scenario["reference"]["legs"]
    sine, cosine = np.array(leg["sine_rad"]), np.array(leg["cosine_rad"])
    assert leg["kind"] == "fourier" and sine.shape == cosine.shape == (excite.HARMONICS, 5)
    t = np.linspace(0, leg["duration_s"], 20001)
    turn = 2 * np.pi * leg["frequency_hz"] * np.outer(t, np.arange(1, excite.HARMONICS + 1))
    q = np.array(scenario["reference"]["start_rad"]) + np.sin(turn) @ sine + (np.cos(turn) - 1) @ cosine
    qd = np.gradient(q, t, axis=0)
    qdd = np.gradient(qd, t, axis=0)
    assert np.abs(q[[0, -1]] - scenario["reference"]["start_rad"]).max() < 1e-9 and np.abs(qd[[0, -1]]).max() < 2e-3
    assert (q > arm.position_min + 0.05).all() and (q < arm.position_max - 0.05).all()
    torque = regressor.inverse_dynamics(arm.chain, q, qd, qdd) @ arm.inertial + arm.rotor_inertia * qdd
    assert (np.abs(qd) < 0.65 * arm.speed_limit).all() and (np.abs(torque) < 0.75 * arm.torque_limit).all()
    assert np.abs(qd).max() > 0.5  # and is no standstill


def test_smoothing_keeps_cubics_and_its_derivatives_belong_to_it():
    """One that bends an angle by its acceleration makes gravity's torque wrong by 1e-4, more than sigma says."""
    for sigma in (1.5, 7.3):
        value, first, second = filtering.smoothing(sigma)
        k = np.arange(len(value)) - len(value) // 2
        for cubic in ([0.3, -0.2, 0.5, 0.7], [0, 0, 1, 0], [0, 0, 0, 1]):
            x = np.polynomial.polynomial.polyval(k / 10, cubic)
            assert np.allclose([value @ x, first @ x, second @ x], [cubic[0], cubic[1] / 10, 2 * cubic[2] / 100], atol=3e-4)
        w = 0.4 / sigma
        gain = value @ np.cos(w * k)
        assert abs(gain - 1) < w**4 * sigma**4 and abs(first @ np.sin(w * k) - w * gain) < 2e-3 * w and abs(second @ np.cos(w * k) + w * w * gain) < 0.02 * w * w


def test_the_truth_is_not_read(runs):
    """The controller's half of the configuration has none, and it is what is read."""
    assert "truth" not in samples.arm_of_run(runs / "run1") and "p_true" not in samples.arm_of_run(runs / "run1")


def test_a_motion_of_an_arm_without_sections_runs_with_rigid_links(tmp_path):
    """The plant refuses to bend what has no sections."""
    old = (ROOT / "config" / "arms" / "p2.toml").read_text()
    bare = re.sub(r"\[\[sections\]\].*?(?=\n# The simulated)", "", old, flags=re.S)
    assert "sections" not in bare
    (tmp_path / "bare.toml").write_text(bare)
    done("identify", "--excite", tmp_path / "bare.toml", "--out", tmp_path / "motion.toml")
    assert tomllib.loads((tmp_path / "motion.toml").read_text())["plant"] == {"flexible_links": False}
