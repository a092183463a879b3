"""Pinocchio's model of the tools' chain, without bodies."""

import pinocchio as pin


def chain_model(chain):
    model, parent = pin.Model(), 0
    model.gravity.linear = chain.gravity
    for joint in range(chain.dof):
        parent = model.addJoint(parent, pin.JointModelRZ(), pin.SE3(chain.rotation[joint], chain.offset[joint]), f"joint{joint + 1}")
    return model
