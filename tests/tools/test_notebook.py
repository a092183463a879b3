"""`import reed_tools` as a notebook uses it: a run, its signals with units, a sweep, a picture."""

import subprocess
import sys

import numpy as np
import pytest

import reed_tools
from reed_tools.paths import ROOT
from reed_tools.record import telemetry_log


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return reed_tools.run_scenario("press_known", seed=7, duration=1.2, set={"wall.stiffness_Npm": 2e4}, out=tmp_path_factory.mktemp("run") / "one")


def test_a_run_is_what_the_command_line_makes(run):
    assert run.summary["seed"] == 7 and run.summary["clock"] == "lockstep" and run.config["wall"]["stiffness_Npm"] == 2e4
    assert run.figures["faults"] == 0 and (run.folder / "report.html").exists() and "press_known on a5" in repr(run)
    assert run.summary["command"] == ("tools/reed run press_known --duration 1.2 --seed 7 --bus memory --clock lockstep "
                                      "--set wall.stiffness_Npm=20000.0")


def test_signals_have_names_units_and_times(run):
    log = telemetry_log.load(run.folder / "telemetry.lcmlog")
    control = log.tables["REED_CONTROL"]
    assert np.array_equal(run["control.tau"], control["tau"]) and np.array_equal(run["control.tau_j3"], control["tau"][:, 2])
    assert run.columns("control.tau") == [f"control.tau_j{j}" for j in range(1, 6)]
    assert run.unit("control.tau") == run.unit("control.tau_j3") == "N·m" and run.meaning("control.f_d").startswith("N, desired")
    t = run.time("control.f_d")
    assert t[0] < 0 and len(t) == len(run["control.f_d"]) and np.allclose(np.diff(t), 1e-3)
    active = control["mode"] == 2
    assert np.allclose(t[active], control["t_s"][active], atol=1e-9)
    assert "adaptation.p_hat" in run.names("p_hat") and "adaptation.p_hat_m2" in run.columns("adaptation.p_hat")


def test_a_folder_is_loaded_again(run):
    again = reed_tools.load(str(run.folder))
    assert np.array_equal(again["plant.tip"], run["plant.tip"]) and again.passed == run.passed


def test_what_is_wrong_is_said(run, tmp_path):
    with pytest.raises(reed_tools.UsageError, match="did you mean `control.tau`"):
        run["control.tao"]
    with pytest.raises(reed_tools.UsageError, match="is not a run folder"):
        reed_tools.load(tmp_path)
    with pytest.raises(reed_tools.UsageError, match="stiffness_Npm"):
        reed_tools.run_scenario(set={"wall.stifness_Npm": 1.0}, out=tmp_path / "never")
    with pytest.raises(reed_tools.UsageError, match="one value or more"):
        reed_tools.sweep("press_known", {"wall.stiffness_Npm": []})
    with pytest.raises(AttributeError):
        reed_tools.nothing_of_that_name


def test_a_sweep_takes_every_combination_and_repeats_to_the_bit():
    values = {"wall.stiffness_Npm": [5e3, 2e4], "scenario.seed": [1, 2]}
    points = reed_tools.sweep("press_known", values, set={"scenario.duration_s": 1.2})
    assert [tuple(point.values.values()) for point in points] == [(5e3, 1), (5e3, 2), (2e4, 1), (2e4, 2)]
    assert len({point.digest for point in points}) == 4 and all(point.figures["faults"] == 0 for point in points)
    assert reed_tools.sweep("press_known", {key: chosen[-1:] for key, chosen in values.items()}, set={"scenario.duration_s": 1.2}) == points[-1:]


def test_a_picture_has_a_panel_per_signal_with_its_unit(run, tmp_path):
    figure = reed_tools.plot(run, "control.f_d", "control.tau", file=tmp_path / "seen.png")
    assert [axis.get_ylabel() for axis in figure.axes] == ["control.f_d [N]", "control.tau [N·m]"] and len(figure.axes[1].lines) == 5
    assert (tmp_path / "seen.png").read_bytes().startswith(b"\x89PNG")


def test_importing_it_loads_no_package():
    script = f"import sys; sys.path.insert(0, {str(ROOT / 'tools')!r}); import reed_tools; print('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-I", "-c", script], capture_output=True, text=True, check=True).stdout == "False\n"


def test_the_stub_names_what_there_is():
    """For editors: the names that __init__.py loads late."""
    stub = (ROOT / "tools" / "reed_tools" / "__init__.pyi").read_text()
    assert all(f"{name} as {name}" in stub and getattr(reed_tools, name) for name in reed_tools.__all__)
