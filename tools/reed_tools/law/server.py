"""A law in Python, asked by tools/python_law once per cycle: `python3 -I server.py FILE.py`, question and answer through descriptor 0.

FILE.py has one function, step(input, state) -> torque: `input` has what reed/law.h names, as numpy arrays, Y with a row per joint;
`state` is an object that keeps whatever the law puts on it, and knows K_d and Lambda. torque: one number per joint, N·m.
`values = ("name", …)` in FILE.py names attributes of `state` that are recorded every cycle, numbers. FILE.py may set force_loop = False (v does not carry the force error) and deflection = False (theta_d as planned)."""

import os
import struct
import sys
import traceback
from types import SimpleNamespace
from typing import Callable, NamedTuple

import numpy as np

FORCE_LOOP, DEFLECTION = 1, 2  # reed/law.h
MOST_VALUES, LONGEST_NAME = 8, 40
PER_JOINT = ("theta", "theta_dot", "theta_d", "theta_d_dot", "theta_d_ddot", "v", "v_dot", "s", "f_known", "J_m", "Jt_F_d")


class Law(NamedTuple):
    step: Callable
    traits: int
    values: tuple[str, ...]  # recorded attributes of its state


class LawError(Exception):
    """What is wrong with the law, one line."""


def read(size: int) -> bytes:
    data = b""
    while len(data) < size:
        more = os.read(0, size - len(data))
        if not more:
            raise EOFError
        data += more
    return data


def numbers() -> np.ndarray:
    (count,) = struct.unpack("=i", read(4))
    return np.frombuffer(read(8 * count), dtype=np.float64)


def answer(torque: np.ndarray) -> None:
    os.write(0, struct.pack("=i", len(torque)) + torque.tobytes())


def refuse(line: str) -> None:
    text = " ".join(line.split()).encode()[:390]
    os.write(0, struct.pack("=i", -len(text)) + text)


def where(error: BaseException, file: str) -> str:
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == file]
    return f"{f'line {lines[-1]}: ' if lines else ''}{type(error).__name__}: {error}"


def value_names(wanted) -> tuple[str, ...]:
    names = (wanted,) if isinstance(wanted, str) else tuple(wanted)
    if len(names) > MOST_VALUES or len(set(names)) < len(names) or not all(
            isinstance(name, str) and name.isascii() and name.isidentifier() and name[0] != "_" and len(name) <= LONGEST_NAME for name in names):
        raise LawError(f"values = {names}; allowed: up to {MOST_VALUES} different names of up to {LONGEST_NAME} letters, digits and _, a letter first")
    return names


def load(file: str) -> Law:
    scope = {"__name__": "law", "__file__": file}
    with open(file, encoding="utf-8") as source:
        exec(compile(source.read(), file, "exec"), scope)  # the user's own law
    if not callable(scope.get("step")):
        raise LawError("there is no function step(input, state)")
    traits = scope.get("force_loop", True) * FORCE_LOOP + scope.get("deflection", True) * DEFLECTION
    return Law(scope["step"], traits, value_names(scope.get("values", ())))


def unpack(values: np.ndarray) -> SimpleNamespace:
    """One cycle's question, in the order in which python_law.cc sends it."""
    n, m = int(values[0]), int(values[1])
    out = SimpleNamespace(joints=n, parameters=m, period_s=values[2], time_s=values[3], adapt=bool(values[4]), source=int(values[5]),
                          f_n=values[6])
    at = 7
    for name in PER_JOINT:
        setattr(out, name, values[at:at + n])
        at += n
    out.p_0 = values[at:at + m]
    out.Y = values[at + m:at + m + n * m].reshape(m, n).T
    return out


def torque_of(law: Law, question: SimpleNamespace, state: SimpleNamespace) -> np.ndarray:
    torque = np.ascontiguousarray(law.step(question, state), dtype=np.float64)
    if torque.shape != (question.joints,):
        raise LawError(f"step returned an array of shape {torque.shape}; allowed: ({question.joints},), one torque per joint")
    return torque


def shown(law: Law, state: SimpleNamespace) -> np.ndarray:
    """The values to record."""
    for name in law.values:
        if not isinstance(getattr(state, name, None), (int, float, np.floating, np.integer)):
            raise LawError(f"values names {name}, and state.{name} is no number after step; allowed: a number")
    return np.array([getattr(state, name) for name in law.values], dtype=np.float64)


def start(file: str):
    """The law, called once on an arm at rest on its reference; with a new state for the run."""
    values = numbers()
    n, m = int(values[0]), int(values[1])
    at = 3 + np.arange(3) * n
    K_d, Lambda, J_m = (values[a:a + n] for a in at)
    law = load(file)
    zero = {name: np.zeros(n) for name in PER_JOINT}
    still = SimpleNamespace(joints=n, parameters=m, period_s=values[2], time_s=0.0, adapt=False, source=0, f_n=0.0,
                            p_0=values[3 + 3 * n:3 + 3 * n + m], Y=np.zeros((n, m)), **{**zero, "J_m": J_m})
    trial = SimpleNamespace(K_d=K_d, Lambda=Lambda)
    torque = torque_of(law, still, trial)
    shown(law, trial)
    answer(np.append(torque, law.traits))
    text = "\n".join(law.values).encode()
    os.write(0, struct.pack("=i", len(text)) + text)
    return law, SimpleNamespace(K_d=K_d, Lambda=Lambda)


def main(file: str) -> None:
    try:
        law, state = start(file)
        while True:
            torque = torque_of(law, unpack(numbers()), state)
            answer(np.append(torque, shown(law, state)))
    except (EOFError, BrokenPipeError):
        return
    except LawError as error:
        refuse(str(error))
    except Exception as error:  # noqa: BLE001: whatever the law raises
        refuse(where(error, file))


if __name__ == "__main__":
    main(sys.argv[1])
