"""A scenario of a5 with rigid links and joints and without friction: the loop of a joint has a closed form."""


def scenario(duration_s: float, K_d: str, motion: str = "", more: str = "") -> str:
    return f"""arm = "a5"
[scenario]
duration_s = {duration_s}
[reference]
start_rad = [0.0, 1.057362, -1.764384, -2.43457, 0.0]
{motion}[control]
law = "pd_tuned"
K_d = {K_d}
Lambda = 15.0
[plant]
flexible_links = false
stiffness_scale = 1e6
friction_scale = 0.0
p_true = [0.4, 0.05, 0.05, 0.3, 0.2, 0.0]
[sensors]
encoder_bits = 26
{more}"""
