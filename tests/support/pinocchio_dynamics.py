"""What Pinocchio says of a model in one state, under the names that reed_inspect answers by."""

import numpy as np
import pinocchio as pin


def dynamics(model, frame, q, qd, qdd) -> tuple[pin.Data, dict]:
    """frame: of the tip, by its number; T in the model's own base."""
    data, world = model.createData(), pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    pin.forwardKinematics(model, data, q, qd, np.zeros(model.nv))
    pin.updateFramePlacements(model, data)
    out = {"T": data.oMf[frame].homogeneous, "Jdot_qd": pin.getFrameClassicalAcceleration(model, data, frame, world).vector.copy(),
           "J_world_lin_ang": pin.computeFrameJacobian(model, data, q, frame, world).copy()}
    M = pin.crba(model, data, q)
    out["M"] = np.triu(M) + np.triu(M, 1).T
    out["G"] = pin.computeGeneralizedGravity(model, data, q).copy()
    out["C_qd"] = pin.rnea(model, data, q, qd, np.zeros(model.nv)) - out["G"]
    out["tau"] = pin.rnea(model, data, q, qd, qdd).copy()
    return data, out
