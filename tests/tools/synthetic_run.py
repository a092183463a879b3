"""A run that never happened: logs of both programs whose figures are known in closed form, so that what the tools
compute from a log can be checked without the programs.

    joint error of joint j   a_j sin(2 pi f t) + b D_j       rms of the tangential part: a |e_tangential| / sqrt(2)
    force                    f_d = 8 N from 0.5 s on, the true force is f_d - 0.2 N, touching at 0.4 s with a peak of 9 N
    parameters               straight lines from 0 to the truth
"""

import math
import os
from pathlib import Path

import lcm

from reed_tools.paths import use_message_types

DOF = 2
D = (3.0, 4.0)
NORMAL = (0.0, 0.0, 1.0)
RATE_HZ = 1000.0
LEAD_CYCLES = 100        # before the arm is active
SHAPE_CYCLES = 17
SWITCH_S = 2.25          # known -> unknown
AMPLITUDE = (4e-3, -3e-3)  # rad, orthogonal to D
ALONG_D = 1e-3           # rad per unit of D
FORCE_ERROR_N = 0.2
FORCE_DESIRED_N = 8.0
IMPACT_N = 9.0
TORQUE_STEP = 0.5

EFFECTIVE = """
[scenario]
name = "synthetic"
duration_s = 3.0
seed = 7
[arm]
name = "two"
dh = [[0.0, 0.0, 0.0], [0.0, 0.5, 0.0]]
param_names = ["m1", "m2"]
p_true = [1.0, 0.5]
p_nom = [0.0, 0.0]
p_lo = [0.0, 0.0]
p_hi = [2.0, 1.0]
torque_limit = [40.0, 20.0]
rotor_inertia_reflected = [0.2, 0.1]
param_shapes = [{param = "m1", body = 1, mass = 1.0}, {param = "m2", viscous_weights = [1.0, 0.5]}]
bodies = [{mass = 1.0, com = [0.2, 0.0, 0.0], inertia_about_com = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.01]]},
          {mass = 0.5, com = [0.1, 0.0, 0.0], inertia_about_com = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.01]]}]
[control]
law = "separated"
K_d = [10.0, 5.0]
Lambda = [20.0, 20.0]
Gamma_known = 5.0
k_p = 0.004
k_i = 0.03
estimate_wall_stiffness = false
force_bandwidth_radps = 30.0
observer = false
sigma0_gain = 1.0
sigma0_max = 3.0
sigma1_max = 0.4
sigma1_gain = 5.0
[wall]
stiffness_Npm = 10000.0
normal = [0.0, 0.0, 1.0]
[timing]
rate_hz = 1000.0
"""


def force_true(t: float) -> float:
    if t < 0.4:
        return 0.0
    return IMPACT_N if t < 0.45 else 8.0 - FORCE_ERROR_N


def messages(cycles: int, clock: str, fault_at_s: float | None):
    """(program, channel, message) of every cycle."""
    use_message_types()
    import reed

    def stamp(message, cycle):
        message.utime, message.cycle = cycle * 1000, cycle
        return message

    for cycle in range(cycles):
        t = max(0.0, (cycle - LEAD_CYCLES) / RATE_HZ)
        mode = 1 if cycle < LEAD_CYCLES else 3 if fault_at_s is not None and t >= fault_at_s else 2
        wave = math.sin(2 * math.pi * 5.0 * t)
        plan = [0.1, 0.2]
        measured = stamp(reed.measured_t(), cycle)
        measured.dof = DOF
        measured.position = [plan[j] - AMPLITUDE[j] * wave - ALONG_D * D[j] for j in range(DOF)]
        measured.velocity = measured.torque = [0.0] * DOF
        measured.age = measured.drive_state = [0] * DOF
        yield "firmware", "REED_MEASURED", measured

        control = stamp(reed.control_t(), cycle)
        control.t_s, control.mode, control.dof = t, mode, DOF
        control.force_source = 0 if mode == 1 else 1 if t < SWITCH_S else 2
        for name in ("theta_d", "theta_d_dot", "e", "s", "v", "v_dot", "tau_law", "observer"):
            setattr(control, name, [0.0] * DOF)
        control.theta_plan, control.D, control.normal = plan, list(D), list(NORMAL)
        control.tau = [10.0 + (TORQUE_STEP if t >= SWITCH_S else 0.0), -5.0]
        control.f_d = FORCE_DESIRED_N if t >= 0.5 else 0.0
        control.f = force_true(t) + 0.05
        control.tip_plan = [0.4, 0.0, 0.3]
        yield "firmware", "REED_CONTROL", control

        adaptation = stamp(reed.adaptation_t(), cycle)
        adaptation.num = 2
        adaptation.p_hat = [1.0 * cycle / (cycles - 1), 0.5 * cycle / (cycles - 1)]
        adaptation.eta_hat = [0.0, 0.0]
        yield "firmware", "REED_ADAPTATION", adaptation

        timing = stamp(reed.timing_t(), cycle)
        timing.wake_ns, timing.rx_ns, timing.compute_ns, timing.tx_ns = 20_000 + cycle, 150_000, 30_000, 8_000
        timing.cycle_ns = 200_000
        timing.missed = 0 if cycle < 1000 else 3
        timing.overruns = 0 if cycle < 1000 else 1
        timing.missed_host_paused = 0 if cycle < 1000 else 2
        yield "firmware", "REED_TIMING", timing

        plant = stamp(reed.plant_t(), cycle)
        plant.t_s, plant.dof = t, DOF
        plant.motor_angle = plant.motor_speed = plant.joint_angle = plant.torque = [0.0] * DOF
        plant.tip = [0.4 + 3e-3, 0.0, 0.3 - 4e-3]
        plant.normal_force = force_true(t)
        plant.gap = -1e-4
        plant.stalls, plant.stood_s = (0, 0.0) if cycle < 1001 else (1, 0.0031)
        yield "plant", "REED_PLANT", plant

        if cycle % SHAPE_CYCLES == 0:
            shape = stamp(reed.shape_t(), cycle)
            shape.num = 3
            shape.x, shape.y, shape.z = [0.0, 0.25, plant.tip[0]], [0.0] * 3, [0.0, 0.5, plant.tip[2]]
            shape.rigid_x, shape.rigid_y, shape.rigid_z = [0.0, 0.25, 0.4], [0.0] * 3, [0.0, 0.5, 0.3]
            yield "plant", "REED_SHAPE", shape


def run_message(clock: str, finished: bool):
    import reed

    run = reed.run_t()
    run.scenario, run.arm, run.law, run.clock, run.dof, run.num_parameters = "synthetic", "two", "separated", clock, DOF, 2
    run.rate_hz, run.seed, run.bus_kind, run.bus_interface = RATE_HZ, 7, "udp", "239.74.163.2:43113"
    run.wire_load_percent, run.scheduler, run.memory_locked, run.cpu = 61.5, "fifo:80", True, -1
    run.finished, run.wall_s = finished, 3.1
    return run


def bus_message(cycles: int):
    import reed

    bus = reed.bus_t()
    bus.cycle, bus.utime = cycles - 1, (cycles - 1) * 1000
    bus.frames_rx, bus.frames_tx, bus.lost, bus.crc_errors = 3 * cycles, 2 * cycles, 2, 1
    return bus


def event_message(t: float, code: int, joint: int, value: float):
    import reed

    event = reed.event_t()
    event.cycle = LEAD_CYCLES + round(t * RATE_HZ)
    event.utime, event.mode, event.force_source = event.cycle * 1000, 3, 1
    event.code, event.joint, event.value, event.text = code, joint, value, f"event {code}"
    return event


def liblcms_log(path: Path) -> lcm.EventLog:
    """Through its descriptor's name: liblcm takes names in UTF-8 only."""
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
    try:
        return lcm.EventLog(f"/proc/self/fd/{descriptor}", "w", overwrite=True)
    finally:
        os.close(descriptor)


def write(folder: Path, checks: list[tuple[str, float]], duration_s: float = 3.0, clock: str = "lockstep",
          fault_at_s: float | None = None, extra_plant_cycles: int = 0, lost=lambda program, t: False, events=()) -> Path:
    """firmware.lcmlog, plant.lcmlog and effective.toml in `folder`, as the two programs would leave them. `lost` says which
    program's messages are missing at t (s since active); `events`: (program, t, code, joint, value)."""
    use_message_types()
    folder.mkdir(parents=True, exist_ok=True)
    logs = {name: liblcms_log(folder / f"{name}.lcmlog") for name in ("firmware", "plant")}
    cycles = LEAD_CYCLES + round(duration_s * RATE_HZ)
    logs["firmware"].write_event(0, "REED_RUN", run_message(clock, finished=False).encode())
    for program, channel, message in messages(cycles + extra_plant_cycles, clock, fault_at_s):
        if (message.cycle < cycles or program == "plant") and not lost(program, (message.cycle - LEAD_CYCLES) / RATE_HZ):
            logs[program].write_event(message.utime, channel, message.encode())
    for program, t, code, joint, value in events:
        event = event_message(t, code, joint, value)
        logs[program].write_event(event.utime, "REED_EVENT" if program == "firmware" else "REED_PLANT_EVENT", event.encode())
    end_us = cycles * 1000
    for channel, message in (("REED_BUS", bus_message(cycles)), ("REED_RUN", run_message(clock, finished=True))):
        message.utime = end_us
        logs["firmware"].write_event(end_us, channel, message.encode())
    for log in logs.values():
        log.close()
    tables = "".join(f'[[checks]]\nname = "{name}"\nlimit = {limit}\n' for name, limit in checks)
    (folder / "effective.toml").write_text(("checks = []\n" if not checks else "")
                                          + EFFECTIVE.replace("duration_s = 3.0", f"duration_s = {duration_s}") + tables)
    return folder
