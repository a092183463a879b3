"""How well the arm follows: joints and tip."""

from reed_tools.figures import metrics
from reed_tools.figures.run_data import RunData


def tangential_joint_rms_mrad_last_second(run: RunData):
    """rms of planned minus motor angle without the part along D, over joints and the last second"""
    return 1e3 * metrics.rms(run.signals.tangential_joint[run.last_second()])


def tangential_joint_peak_mrad_last_second(run: RunData):
    """largest of the same"""
    return 1e3 * metrics.peak(run.signals.tangential_joint[run.last_second()])


def joint_rms_mrad_last_second(run: RunData):
    """rms of planned minus motor angle over joints and the last second"""
    return 1e3 * metrics.rms(run.signals.joint_error[run.last_second()])


def joint_peak_mrad_last_second(run: RunData):
    """largest of the same"""
    return 1e3 * metrics.peak(run.signals.joint_error[run.last_second()])


def joint_rms_mrad(run: RunData):
    """rms of planned minus motor angle over joints and the whole run"""
    return 1e3 * metrics.rms(run.signals.joint_error)


def joint_peak_mrad(run: RunData):
    """largest of the same"""
    return 1e3 * metrics.peak(run.signals.joint_error)


def tip_rms_mm_last_second(run: RunData):
    """rms distance of the true bent tip from the planned tip over the last second"""
    return 1e3 * metrics.rms_of_norm(run.signals.tip_error[run.last_second()])


def tangential_tip_rms_mm_last_second(run: RunData):
    """the same within the plane of the wall"""
    return 1e3 * metrics.rms_of_norm(run.signals.tangential_tip[run.last_second()])


def tip_rms_mm(run: RunData):
    """rms distance of the true bent tip from the planned tip over the whole run"""
    return 1e3 * metrics.rms_of_norm(run.signals.tip_error)


FIGURES = (tangential_joint_rms_mrad_last_second, tangential_joint_peak_mrad_last_second, joint_rms_mrad_last_second,
           joint_peak_mrad_last_second, joint_rms_mrad, joint_peak_mrad, tip_rms_mm_last_second, tangential_tip_rms_mm_last_second,
           tip_rms_mm)
