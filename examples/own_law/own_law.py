"""PD on the sliding error, the built-in law `pd`: tools/reed run --law examples/own_law/own_law.py --clock lockstep --set control.Lambda=5"""

force_loop = False  # v does not carry the force error
deflection = False  # theta_d as planned


def step(input, state):
    return 10.0 * input.s
