"""Names of the events that both programs report, by their fixed number: firmware's reason.h, the plant's records.h."""

from reed_tools.record.signals import MODES, SOURCES

FIRST_TRIP, FIRST_LIMIT = 32, 96  # codes between them stop the arm
NAMES = {
    0: "none", 1: "mode_change", 2: "force_source_change", 3: "contact", 4: "drive_state", 5: "phase_budget", 6: "cycles_missed", 7: "collision",
    8: "force_zero", 9: "stretch_held", 10: "command_cut",
    32: "joint_position", 33: "joint_speed", 34: "contact_force", 35: "not_finite", 36: "stale_measurement", 37: "drive_fault",
    38: "foreign_controller", 39: "missed_cycles", 40: "bus_lost", 41: "operator", 42: "unexpected_joint", 43: "stale_wrench",
    44: "phase_budget_in_row", 45: "wrench_range", 46: "stretched", 47: "torque_not_delivered",
    48: "speed_contradicts", 49: "joint_does_not_follow", 50: "frozen_wrench", 51: "tip_speed", 52: "power", 53: "not_at_standstill", 54: "torque_unexplained", 55: "following_error", 56: "energy",
    96: "torque", 97: "torque_rate", 98: "normal_speed", 99: "held_measurement", 100: "ramp_down", 101: "stretch",
    200: "controller_present", 201: "controller_restarted", 202: "drive_state", 203: "brakes_released", 204: "brakes_closed",
    205: "enable_refused", 206: "contact_made", 207: "contact_lost", 208: "diverged", 209: "too_slow", 210: "wrench_lost",
    211: "wrench_back", 212: "host_pause", 213: "another_arm", 214: "fault_begins",
    215: "fault_ends",
}


def name_of(code: int) -> str:
    """An unknown one keeps its number: logs outlive versions."""
    return NAMES.get(code, f"code_{code}")


def stops_the_arm(code: int) -> bool:
    return FIRST_TRIP <= code < FIRST_LIMIT


def in_text(message) -> str:
    """Of an event_t. What became of it is said where the event only says that something changed."""
    became = {"mode_change": f": {MODES[message.mode]}", "force_source_change": f": {SOURCES[message.force_source]}"}.get(name_of(message.code), "")
    return message.text + became
