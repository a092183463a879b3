"""A telemetry scalar is declared once: a line more in a copy of control_t.lcm, and the number is in the loop's snapshot, in the
encoded message, in the columns of exports, in summary.json and on the page, with its unit."""

import shutil
import subprocess
import sys

import numpy as np
import pytest

from reed_tools.export.columns import flatten
from reed_tools.figures import report_page, scalars
from reed_tools.paths import BUILD, ROOT
from reed_tools.record import message_layout
from reed_tools.record.telemetry_log import TABLES, Recording

LINE = "  double tip_speed;  // m/s, of the planned tool point <- controller.time_s() + 1.25"
ROOMS = BUILD / "rooms"
PROGRAM = r"""
#include <cstdio>
#include <memory>
#include "reed/firmware/record/encode.h"
#include "reed/lcmtypes/fields/field.h"
struct Vector { double size_ = 0; int size() const { return 2; } double operator[](int i) const { return 0.5 + i; } };
struct Part { Vector theta_d, theta_d_dot, e, v, v_dot, D, torque, F, n; double f_d = 0, e_f = 0, z = 0, e_f_integral = 0; };
struct Decision { Part plan, desired, aux, normal, force, felt; Vector s, tau_law, tip_plan; int source = 0; double f = 0; };
struct Strategy {
  Vector normal() const { return {}; }
  Vector observed() const { return {}; }
  Part force_state() const { return {}; }
  double wall_stiffness() const { return 7; }
};
struct Controller {
  double time_s() const { return 3; }
  int mode() const { return 2; }
  Part command() const { return {}; }
  int limits() const { return 0; }
};
int main() {
  const Controller controller;
  const Decision decision;
  const Strategy strategy;
  auto snapshot = std::make_unique<reed::telemetry::Snapshot>();
  snapshot->dof = 2;
  reed::telemetry::Control& out = snapshot->control;
  REED_CONTROL_T(REED_SET)
  reed::telemetry::MessageEncoder encoder;
  const auto bytes = encoder.Control(*snapshot, 42);
  return std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() ? 0 : 1;
}
"""


@pytest.fixture(scope="module")
def declared(tmp_path_factory):
    """A copy of lcmtypes/ with one line more, and all that the build makes of it."""
    folder = tmp_path_factory.mktemp("declared")
    shutil.copytree(ROOT / "lcmtypes", folder / "lcmtypes")
    control = folder / "lcmtypes" / "control_t.lcm"
    text = control.read_text()
    control.write_text(text.replace("  int32_t limits;", LINE + "\n  int32_t limits;"))
    assert control.read_text() != text
    generated = folder / "include" / "reed" / "lcmtypes" / "generated"
    generated.mkdir(parents=True)
    run(sys.executable, "-B", ROOT / "lcmtypes" / "generate_fields.py", folder / "lcmtypes", generated / "fields.h")
    files = sorted((folder / "lcmtypes").glob("*.lcm"))
    run("lcm-gen", "--cpp", "--cpp-std=c++11", f"--cpp-hpath={folder / 'include'}", *files)
    run("lcm-gen", "--python", f"--ppath={folder / 'python'}", *files)
    return folder


def run(*command) -> bytes:
    done = subprocess.run(list(map(str, command)), capture_output=True)
    assert done.returncode == 0, done.stderr.decode()
    return done.stdout


@pytest.fixture(scope="module")
def encoded(declared) -> bytes:
    """REED_CONTROL as the firmware's own snapshot and encoder make it: neither of them names a field."""
    source, program = declared / "program.cc", declared / "program"
    source.write_text(PROGRAM)
    roots = [f"-I{declared / 'include'}", *(f"-I{ROOMS / name}" for name in
             ("reed_message_fields", "reed_snapshot", "reed_record", "reed_frame", "reed_rt", "reed_sizes", "reed_telemetry"))]
    run("g++", "-std=c++20", "-O0", *roots, source, ROOT / "firmware" / "record" / "encode.cc", "-o", program)
    return run(program)


def test_the_new_scalar_is_in_the_message(declared, encoded):
    sys.path.insert(0, str(declared / "python"))
    known = {name: sys.modules.pop(name) for name in list(sys.modules) if name == "reed" or name.startswith("reed.")}
    try:
        import reed
        message = reed.control_t.decode(encoded)
    finally:
        sys.path.remove(str(declared / "python"))
        for name in [name for name in sys.modules if name == "reed" or name.startswith("reed.")]:
            del sys.modules[name]
        sys.modules.update(known)
    assert (message.tip_speed, message.k_hat_e, message.theta_d, message.utime) == (4.25, 7.0, (0.5, 1.5), 42)


def test_it_is_a_column_with_its_unit_a_figure_and_a_line_of_the_page(declared, monkeypatch):
    monkeypatch.setattr(message_layout, "ROOT", declared)
    tables = {channel: table(TABLES[channel]) for channel in TABLES}
    tables["REED_CONTROL"]["mode"][:] = 2
    tables["REED_CONTROL"]["tip_speed"] = np.array([0.25, 0.5, 0.125])
    column = next(column for column in flatten("control_t", tables["REED_CONTROL"], []) if column.name == "tip_speed")
    assert (column.unit, column.comment) == ("m/s", "m/s, of the planned tool point")
    found = scalars.of_run(Recording(tables=tables))
    assert found["control.tip_speed"] == {"unit": "m/s", "meaning": "m/s, of the planned tool point", "min": 0.125, "max": 0.5,
                                          "mean": pytest.approx(0.875 / 3), "last": 0.125}
    page = report_page.scalars({"scalars": found})
    assert "control.tip_speed" in page and "m/s, of the planned tool point" in page


def table(type_name: str) -> dict[str, np.ndarray]:
    """Three messages of an arm with two joints, all 0."""
    sizes = {None: (3,), "dof": (3, 2), "num": (3, 2), "3": (3, 3)}
    made = {field.name: np.zeros(sizes[field.length]) for field in message_layout.fields(type_name)}
    return made | {"cycle": np.arange(3)}


@pytest.mark.parametrize("line, complaint", [("  string note;  // <- nothing", "note: a field is one of"), ("  double x[5];  // <- nothing", "x: a field is one of")])
def test_what_no_snapshot_can_hold_is_refused_where_it_is_declared(tmp_path, line, complaint):
    shutil.copytree(ROOT / "lcmtypes", tmp_path / "lcmtypes")
    path = tmp_path / "lcmtypes" / "bus_t.lcm"
    path.write_text(path.read_text().replace("  int64_t lost;", line + "\n  int64_t lost;"))
    done = subprocess.run([sys.executable, "-B", str(ROOT / "lcmtypes" / "generate_fields.py"), str(tmp_path / "lcmtypes"), str(tmp_path / "out.h")],
                          capture_output=True, text=True)
    assert done.returncode == 1 and complaint in done.stderr and "bus_t.lcm" in done.stderr


def test_every_number_of_the_loop_says_where_it_comes_from():
    """Times are the exception: they are known when the snapshot is already filled."""
    for name in ("measured_t", "control_t", "adaptation_t", "bus_t", "plant_t"):
        missing = [field.name for field in message_layout.fields(name) if not field.source and field.name not in ("utime", "cycle", "dof", "num")]
        assert not missing, f"lcmtypes/{name}.lcm: {missing}: no `<- source`"
