"""What an arm file says of an arm that one may know: kinematics, drives, limits, and the nominal inertial parameters."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.paths import ARMS
from reed_tools.robots import rigid_arm
from reed_tools.robots.chain import Chain, chain_of
from reed_tools.robots.regressor import CELLS, PER_LINK


@dataclass(frozen=True)
class NominalArm:
    name: str
    chain: Chain
    rotor_inertia: np.ndarray  # kg·m²
    stiffness: np.ndarray      # N·m/rad; inf: rigid
    torque_limit: np.ndarray   # N·m
    position_min: np.ndarray   # rad
    position_max: np.ndarray
    speed_limit: np.ndarray    # rad/s
    known: np.ndarray          # [10 dof], without the parameters p
    names: list[str]           # of p
    p: np.ndarray              # nominal
    p_lo: np.ndarray
    p_hi: np.ndarray
    shapes: np.ndarray         # [10 dof, P]: inertial parameters per unit of p
    viscous: np.ndarray        # [dof, P], N·m·s/rad per unit of p
    coulomb: np.ndarray        # N·m, nominal
    coulomb_declared: np.ndarray  # N·m, of the data sheet
    bends: bool                # its links do, too

    @property
    def dof(self) -> int:
        return self.chain.dof

    @property
    def inertial(self) -> np.ndarray:
        """[10 dof], nominal."""
        return self.known + self.shapes @ self.p


def load(name_or_path: str) -> NominalArm:
    path = path_of(name_or_path)
    return of_table(read(path), str(path))


def is_path(name_or_path: str) -> bool:
    return "/" in name_or_path or name_or_path.endswith(".toml")


def for_file(name_or_path: str) -> str:
    """As a scenario names it, wherever that lies."""
    return str(path_of(name_or_path).resolve()) if is_path(name_or_path) else name_or_path


def path_of(name_or_path: str) -> Path:
    path = Path(name_or_path) if is_path(name_or_path) else ARMS / f"{name_or_path}.toml"
    if not path.is_file():
        known = ", ".join(sorted(file.stem for file in ARMS.glob("*.toml")))
        raise UsageError(f"--arm {name_or_path}: no such arm; allowed: a path, or one of {known}")
    return path


def read(path: Path) -> dict:
    try:
        return parsed(path.read_text(encoding="utf-8"), str(path))
    except UnicodeDecodeError as error:
        raise UsageError(f"{path}: {error}") from None


def parsed(text: str, where: str) -> dict:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise UsageError(f"{where}: {error}") from None


def of_table(arm: dict, where: str) -> NominalArm:
    if "dh" not in arm and "joint" not in arm:
        raise UsageError(f"{where}: is no arm file: neither joint nor dh")
    chain = chain_of(arm)
    names, p, p_lo, p_hi, shapes, viscous = parameters(arm, chain.dof)
    per_joint = {key: per_joint_numbers(arm, key, chain.dof, default) for key, default in DEFAULTS.items()}
    return NominalArm(arm.get("name", "arm"), chain, *per_joint.values(), known=known(arm, shapes, names, chain.dof), names=names, p=p,
                      p_lo=p_lo, p_hi=p_hi, shapes=shapes, viscous=viscous,
                      coulomb=per_joint_numbers(arm, "coulomb_nominal", chain.dof, 0.0), coulomb_declared=per_joint_numbers(arm, "coulomb_declared", chain.dof, 0.0),
                      bends=bool(arm.get("sections") or arm.get("member")))


DEFAULTS = {"rotor_inertia_reflected": 0.0, "joint_stiffness": np.inf, "torque_limit": np.inf, "position_min": -2.9,
            "position_max": 2.9, "speed_limit": 3.0}  # in the order of NominalArm


def per_joint_numbers(arm: dict, key: str, dof: int, default: float) -> np.ndarray:
    return np.broadcast_to(np.array(arm.get(key, default), dtype=float), dof).copy()


def parameters(arm: dict, dof: int):
    """Names, nominal values and box of p, and what one unit of each adds. Without names every link's mass is one."""
    if not arm.get("param_names"):
        bodies = nominal_bodies(arm, dof)
        heavy = [link for link in range(dof) if bodies[PER_LINK * link] > 0]
        masses = bodies[[PER_LINK * link for link in heavy]]
        shapes = np.zeros((PER_LINK * dof, len(heavy)))
        for column, (link, mass) in enumerate(zip(heavy, masses)):
            shapes[PER_LINK * link:PER_LINK * (link + 1), column] = bodies[PER_LINK * link:PER_LINK * (link + 1)] / mass
        return [f"m{link + 1}" for link in heavy], masses, 0 * masses, 2 * masses, shapes, np.zeros((dof, len(heavy)))
    names = list(arm["param_names"])
    p = np.array(arm.get("p_nom", true_values(arm, names)), dtype=float)
    shapes, viscous = np.zeros((PER_LINK * dof, len(names))), np.zeros((dof, len(names)))
    for shape in arm.get("param_shapes", []):
        column = names.index(shape["param"])
        if "body" in shape:
            link = shape["body"] - 1
            shapes[PER_LINK * link:PER_LINK * (link + 1), column] += inertial(shape["mass"], shape.get("com"), shape.get("inertia_com"))
        else:
            viscous[:, column] += shape["viscous_weights"]
    if "param_shapes" not in arm:
        shapes = parameters({**arm, "param_names": []}, dof)[4]
    return (names, p, np.array(arm.get("p_lo", np.zeros(len(p))), dtype=float),
            np.array(arm.get("p_hi", 2 * p), dtype=float), shapes, viscous)


def true_values(arm: dict, names: list[str]) -> list[float]:
    """Of files that say no nominal ones."""
    return arm.get("truth", {}).get("p", arm.get("p_true", [0.0] * len(names)))


def nominal_bodies(arm: dict, dof: int) -> np.ndarray:
    bodies = arm.get("bodies", arm.get("truth", {}).get("bodies", []))
    return np.concatenate([inertial(body["mass"], body.get("com"), body.get("inertia_about_com")) for body in bodies]) if bodies else np.zeros(PER_LINK * dof)


def known(arm: dict, shapes: np.ndarray, names: list[str], dof: int) -> np.ndarray:
    """[10 dof] of the links without p: `known_bodies`, or what p leaves of the bodies that the file has."""
    if "known_bodies" in arm:
        return np.concatenate([of_moments(body["mass"], np.array(body.get("first_moment", [0.0] * 3)), np.array(body.get("second_moment", np.zeros((3, 3)))))
                               for body in arm["known_bodies"]])
    if not arm.get("param_names"):
        return np.zeros(PER_LINK * dof)
    beside_nominal = "bodies" in arm and "p_nom" in arm and "p_true" not in arm
    return nominal_bodies(arm, dof) - shapes @ np.array(arm["p_nom"] if beside_nominal else true_values(arm, names), dtype=float)


def inertial(mass: float, com=None, inertia_about_com=None) -> np.ndarray:
    """The ten parameters of one body."""
    m, first, about_origin = rigid_arm.moments(mass, np.zeros(3) if com is None else com, np.zeros((3, 3)) if inertia_about_com is None else inertia_about_com)
    return np.array([m, *first, *(about_origin[cell] for cell in CELLS)])


def of_moments(mass: float, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """From ∫ dm, ∫ r dm, ∫ r rᵀ dm."""
    about_origin = np.trace(second) * np.eye(3) - second
    return np.array([mass, *first, *(about_origin[cell] for cell in CELLS)])
