"""Functions of time."""

from math import pi, sin

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError

from cramp_cli.schema.curve import Curve
from cramp_cli.schema.explain import explain

ADAPTER = TypeAdapter(Curve)


def curve(data):
    return ADAPTER.validate_python(data)


def mistakes(data):
    with pytest.raises(ValidationError) as caught:
        curve(data)
    return [(path, message) for path, message, _ in explain(caught.value, data)]


@pytest.mark.parametrize("data", ["constant", "step", {"type": "constant"}, {"type": "step"}])
def test_constant_and_step_are_full_from_the_start(data):
    assert [curve(data).value(t) for t in (0.0, 1e-9, 5.0)] == [1.0, 1.0, 1.0]


def test_ramp_rises_and_holds():
    ramp = curve({"type": "ramp", "start": 1.0, "until": "3000 ms"})
    assert [ramp.value(t) for t in (0.0, 1.0, 1.5, 3.0, 9.0)] == [0.0, 0.0, 0.25, 1.0, 1.0]


def test_table_is_straight_between_points_and_held_at_the_ends():
    table = curve({"type": "table", "time": [1, 2, 4], "value": [5, 7, 3]})
    assert [table.value(t) for t in (0, 1, 1.5, 2, 3, 4, 9)] == [5, 5, 6, 7, 5, 3, 3]


def test_sine_has_phase_start_and_an_end():
    wave = curve({"type": "sine", "frequency": 2, "phase": 90, "start": 1, "cycles": 1.5})
    assert wave.value(0.99) == 0.0
    assert wave.value(1.0) == pytest.approx(1.0)
    assert wave.value(1.3) == pytest.approx(sin(2 * pi * 0.6 + pi / 2))
    assert wave.value(1.76) == 0.0


@pytest.mark.parametrize(
    ("shape", "quarter", "middle"),
    [("square", 1.0, 1.0), ("half_sine", 0.5**0.5, 1.0), ("triangle", 0.5, 1.0)],
)
def test_pulse(shape, quarter, middle):
    pulse = curve({"type": "pulse", "start": 1, "duration": 2, "shape": shape})
    assert [pulse.value(t) for t in (0.5, 3.0, 4.0)] == [0.0, 0.0, 0.0]
    assert pulse.value(1.5) == pytest.approx(quarter)
    assert pulse.value(2.0) == pytest.approx(middle)


@pytest.mark.parametrize(
    ("data", "found"),
    [
        (
            "stepp",
            [
                (
                    (),
                    "unknown curve 'stepp'; did you mean 'step'? "
                    "(known: constant, step, ramp, table, sine, pulse)",
                )
            ],
        ),
        ("ramp", [((), "'ramp' needs more keys: write {type: ramp, ...}")]),
        ({"type": "ramp"}, [(("until",), "is missing")]),
        (
            {"type": "ramp", "until": 1, "start": 1},
            [(("until",), "must be later than start (got 1 s, 1 s)")],
        ),
        (
            {"type": "table", "time": [0, 1, 1, 0], "value": [1]},
            [
                (("value",), "must have one value for each time (got 1 values, 4 times)"),
                (("time", 2), "times must increase (got 1 s after 1 s)"),
                (("time", 3), "times must increase (got 0 s after 1 s)"),
            ],
        ),
        (
            {"type": "table", "time": [], "value": []},
            [
                (("time",), "must have at least 1 entry (got 0)"),
                (("value",), "must have at least 1 entry (got 0)"),
            ],
        ),
        (
            {"type": "sine", "frequency": 0, "cycles": -1, "phse": 3},
            [
                (("phse",), "unknown key; did you mean 'phase'?"),
                (("frequency",), "must be above 0 (got 0)"),
                (("cycles",), "must be above 0 (got -1)"),
            ],
        ),
        (
            {"type": "pulse", "duration": "1 m", "shape": "sqare"},
            [
                (("duration",), "'1 m' is no time; give s or a unit of that kind"),
                (
                    ("shape",),
                    "must be one of square, half_sine, triangle (got 'sqare'); "
                    "did you mean 'square'?",
                ),
            ],
        ),
        (
            {"until": 3},
            [(("type",), "is missing; give one of constant, step, ramp, table, sine, pulse")],
        ),
        (
            {"type": 3},
            [(("type",), "must be one of constant, step, ramp, table, sine, pulse (got 3)")],
        ),
        (3, [((), "must be a section such as {type: constant, ...} (got 3)")]),
    ],
)
def test_mistakes(data, found):
    assert mistakes(data) == found


def test_a_curve_reads_back_from_its_plain_data():
    for data in (
        {"type": "table", "time": [1.0, 2.0], "value": [5.0, 7.0]},
        {"type": "sine", "frequency": 2.0, "phase": 30.0, "start": 0.0},
    ):
        assert (
            ADAPTER.dump_python(curve(data), mode="json", by_alias=True, exclude_none=True) == data
        )


KINDS = [
    "constant",
    {"type": "ramp", "start": 1, "until": 3},
    {"type": "ramp", "start": -1, "until": 3},
    {"type": "table", "time": [1, 2, 4], "value": [5, 7, 3]},
    {"type": "table", "time": [-1, 0.5], "value": [1, 2]},
    {"type": "sine", "frequency": 2, "phase": 90, "start": 1, "cycles": 1.3},
    {"type": "sine", "frequency": 0.3, "start": -1},
    {"type": "pulse", "start": 1, "duration": 2},
    {"type": "pulse", "start": 1, "duration": 2, "shape": "half_sine"},
    {"type": "pulse", "start": -1, "duration": 4, "shape": "triangle"},
]


@pytest.mark.parametrize("data", KINDS)
@pytest.mark.parametrize("end", [0.0, 1.3, 1.7, 2.2, 5.0])
def test_the_integral_is_that_of_the_value(data, end):
    """Midpoint sums of 20000 steps: at a jump they are off by one step at most."""
    one, step = curve(data), end / 20000
    middles = (np.arange(20000) + 0.5) * step
    summed = step * sum(one.value(t) for t in middles)
    assert one.integral(end) == pytest.approx(summed, abs=1.1 * step + 1e-12)
