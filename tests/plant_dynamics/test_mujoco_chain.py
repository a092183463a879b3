"""The chain that the plant's speed is compared with: as many coordinates as it says, as stiff as the arm, and held."""

import mujoco
import numpy as np
import pytest

from reed_tools.robots.mujoco_chain import POSE, Chain, at_pose


@pytest.mark.parametrize("cuts, coordinates", [(1, 16), (2, 22), (4, 34)])
def test_cuts_make_coordinates(arm, cuts, coordinates):
    assert Chain(arm, cuts, "RK4").model(1e-4, None).nv == coordinates


@pytest.mark.parametrize("cuts", [1, 4])
def test_every_elastic_hinge_has_the_stiffness_of_its_piece(arm, cuts):
    model = Chain(arm, cuts, "RK4").model(1e-4, None)
    assert sorted(model.tendon_stiffness) == sorted(arm["joint_stiffness"])
    hinges = model.jnt_stiffness[model.jnt_stiffness > 0]
    assert len(hinges) == 3 * 2 * cuts
    expected = [s["EI"] * (cuts + 1) / s["length"] for s in arm["sections"][1:] for _ in range(2 * cuts)]
    assert np.allclose(sorted(hinges), sorted(expected), rtol=1e-12)


def test_the_servos_hold_the_pose_on_the_floor(arm):
    chain = Chain(arm, 1, "implicitfast")
    floor = float(at_pose(chain.model(1e-5, None)).site("tip").xpos[2]) - 0.0015
    model = chain.model(1e-4, floor)
    data = at_pose(model)
    mujoco.mj_step(model, data, nstep=2000)
    motors = [data.qpos[model.joint(f"rotor{i}").qposadr[0]] for i in range(5)]
    assert np.abs(np.array(motors) - POSE).max() < 0.1
    assert data.ncon == 1
