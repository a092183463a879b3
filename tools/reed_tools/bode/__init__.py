"""The loop of one joint, measured: a multisine on its torque, in a pose, free or in contact."""
