"""The elementary functions beside mpmath with 200 bits: dense, random and hard arguments; what is no number and the ends of the range."""

import ctypes
import math
import subprocess

import numpy as np
import pytest

from reed_tools.paths import BUILD, ROOT

mpmath = pytest.importorskip("mpmath")
mpmath.mp.prec = 200
COUNT = 600
LARGEST_ANGLE = 2.0**20
WORST_ULP = {"Sin": 0.85, "Cos": 0.85, "Exp": 0.85, "ExpM1": 1.0, "Log": 0.85, "Tanh": 0.85, "Atan2": 0.7, "Length": 0.55}


@pytest.fixture(scope="module")
def call(tmp_path_factory):
    """call(name, x[, y]) -> values."""
    library = tmp_path_factory.mktemp("math") / "elementary.so"
    subprocess.run(["g++", "-std=c++20", "-O2", "-ffp-contract=off", "-shared", "-fPIC", f"-I{BUILD / 'rooms' / 'reed_math'}",
                    str(ROOT / "tests" / "elementary" / "elementary.cc"), "-o", str(library)], check=True)
    functions = ctypes.CDLL(str(library))
    array = np.ctypeslib.ndpointer(np.float64, flags="C")

    def call_it(name, x, y=None):
        x = np.ascontiguousarray(x, dtype=np.float64)
        out = np.empty_like(x)
        function = getattr(functions, name)
        function.argtypes = [array, array, array, ctypes.c_long]
        function.restype = None
        function(x, x if y is None else np.ascontiguousarray(y, dtype=np.float64), out, x.size)
        return out

    return call_it


def ulps(got, exact) -> float:
    """|got - exact| in units of the last place of `exact`."""
    if exact == 0:
        return 0.0 if got == 0.0 else math.inf
    return float(abs(mpmath.mpf(float(got)) - exact) / mpmath.ldexp(1, mpmath.frexp(abs(exact))[1] - 53))


def worst(call, name, function, x, y=None) -> float:
    rows = [(value,) for value in x] if y is None else list(zip(x, y, strict=True))
    return max(ulps(got, function(*(mpmath.mpf(float(value)) for value in row)))
               for got, row in zip(call(name, x, y), rows, strict=True))


def angles():
    random = np.random.default_rng(1)
    near = [float(mpmath.pi / 2 * int(k)) for k in (*range(1, COUNT), *random.integers(1, 600_000, COUNT))]  # cancel most digits
    return np.concatenate([np.linspace(-7.0, 7.0, COUNT), random.uniform(-0.8, 0.8, COUNT),
                           random.uniform(-LARGEST_ANGLE, LARGEST_ANGLE, COUNT), 10.0 ** random.uniform(-12, 0, COUNT), near])


def exponents():
    random = np.random.default_rng(2)
    return np.concatenate([np.linspace(-2.0, 2.0, COUNT), random.uniform(-0.36, 0.36, COUNT), random.uniform(0.34, 0.38, COUNT),
                           random.uniform(-700.0, 700.0, COUNT), -(10.0 ** random.uniform(-12, 0, COUNT))])


def positives():
    random = np.random.default_rng(3)
    return np.concatenate([np.linspace(0.01, 3.0, COUNT), 1.0 + random.uniform(-1e-3, 1e-3, COUNT), random.uniform(0.7, 1.42, COUNT),
                           10.0 ** random.uniform(-300, 300, COUNT), 2.0**-53 * np.arange(1, COUNT)])


def speeds():
    random = np.random.default_rng(4)
    return np.concatenate([np.linspace(-3.0, 3.0, COUNT), random.uniform(0.5, 0.65, COUNT), random.uniform(-25.0, 25.0, COUNT),
                           10.0 ** random.uniform(-9, 0, COUNT)])


def vectors():
    random = np.random.default_rng(5)
    angle, size = random.uniform(-math.pi, math.pi, 3 * COUNT), 10.0 ** random.uniform(-9, 9, 3 * COUNT)
    x = np.concatenate([size * np.cos(angle), random.normal(size=COUNT), np.ones(COUNT)])
    y = np.concatenate([size * np.sin(angle), 1e-6 * random.normal(size=COUNT), random.uniform(-1.1, 1.1, COUNT)])
    return x, y


@pytest.mark.parametrize("name, function, arguments", [
    ("Sin", mpmath.sin, angles), ("Cos", mpmath.cos, angles), ("Exp", mpmath.exp, exponents), ("ExpM1", mpmath.expm1, exponents),
    ("Log", mpmath.log, positives), ("Tanh", mpmath.tanh, speeds)])
def test_of_one_number(call, name, function, arguments):
    assert worst(call, name, function, arguments()) <= WORST_ULP[name]


@pytest.mark.parametrize("name, function", [("Atan2", lambda x, y: mpmath.atan2(y, x)), ("Length", mpmath.hypot)])
def test_of_a_vector(call, name, function):
    assert worst(call, name, function, *vectors()) <= WORST_ULP[name]


def test_beyond_2_to_20_rad_the_period_is_the_nearest_double_to_two_pi(call):
    x = np.array([2.0**20 + 1.0, -3e6, 1e9, 1e300])
    reduced = np.array([math.remainder(value, 2.0 * math.pi) for value in x])
    assert np.array_equal(call("Sin", x), call("Sin", reduced)) and np.array_equal(call("Cos", x), call("Cos", reduced))


@pytest.mark.parametrize("name", ["Sin", "Cos"])
def test_of_two_angles_at_once_has_the_bits_of_each_alone(call, name):
    x = np.concatenate([angles(), [0.0, -0.0, 2.0**20 + 1.0, 1e300, math.inf, math.nan, 1.0]])
    y = np.random.default_rng(6).permutation(x)
    for place, of in (("First", x), ("Second", y)):
        at_once, alone = call(name + place, x, y), call(name, of)
        assert np.array_equal(at_once, alone, equal_nan=True) and np.array_equal(np.signbit(at_once), np.signbit(alone))


@pytest.mark.parametrize("name, x, wanted", [
    ("Sin", [0.0], [0.0]), ("Cos", [0.0], [1.0]),
    ("Sin", [math.inf, -math.inf, math.nan], [math.nan] * 3), ("Cos", [math.inf, math.nan], [math.nan] * 2),
    ("Exp", [0.0, math.inf, -math.inf, 710.0, -746.0, math.nan], [1.0, math.inf, 0.0, math.inf, 0.0, math.nan]),
    ("ExpM1", [0.0, math.inf, -math.inf, -50.0, math.nan], [0.0, math.inf, -1.0, -1.0, math.nan]),
    ("Log", [1.0, 0.0, math.inf, -1.0, math.nan], [0.0, -math.inf, math.inf, math.nan, math.nan]),
    ("Tanh", [0.0, math.inf, -math.inf, 30.0, math.nan], [0.0, 1.0, -1.0, 1.0, math.nan])])
def test_ends_of_the_range_and_what_is_no_number(call, name, x, wanted):
    assert np.array_equal(call(name, x), wanted, equal_nan=True)


def test_large_exponents(call):
    x = np.array([709.7, -708.0, -740.0])
    assert np.allclose(call("Exp", x), np.exp(x), rtol=1e-12) and np.allclose(call("ExpM1", x), np.expm1(x), rtol=1e-12)


def test_angles_of_the_axes(call):
    x, y = [1.0, 0.0, -1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, -1.0, 0.0, 1.0]
    assert np.array_equal(call("Atan2", x, y), [0.0, math.pi / 2, math.pi, -math.pi / 2, 0.0, math.pi / 4])
    assert np.array_equal(call("Length", [0.0, 3.0], [0.0, 4.0]), [0.0, 5.0])
