"""Unit of a structural parameter, from what one unit of it adds to the arm."""


def unit_of(arm: dict, name: str) -> str:
    shapes = [shape for shape in arm.get("param_shapes", []) if shape.get("param") == name]
    if any(shape.get("mass", 0.0) > 0.0 for shape in shapes):
        return "kg"
    if any(shape.get("viscous_weights") for shape in shapes):
        return "N·m·s/rad"
    if shapes:
        return "kg·m²"
    return "1" if arm.get("param_shapes") else "kg"  # without shapes one parameter scales each link
