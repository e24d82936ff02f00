"""Numbers with and without units."""

import os
import subprocess
import sys
from math import pi

import pytest
from pydantic import TypeAdapter, ValidationError

from cramp_cli.schema import units


def read(kind, value):
    return TypeAdapter(kind).validate_python(value)


def complaint(kind, value):
    with pytest.raises(ValidationError) as caught:
        read(kind, value)
    return caught.value.errors()[0]["msg"]


@pytest.mark.parametrize(
    ("kind", "text", "value"),
    [
        (units.Length, "2.4 mm", 0.0024),
        (units.Length, "1 in", 0.0254),
        (units.Length, "3 µm", 3e-6),
        (units.Length, "-.5m", -0.5),
        (units.Time, "0.05 ms", 5e-5),
        (units.Velocity, "20 mm/s", 0.02),
        (units.Acceleration, "9.81 m/s^2", 9.81),
        (units.Acceleration, "9.81 m s-2", 9.81),
        (units.AngularVelocity, "60 rpm", 2.0 * pi),
        (units.Angle, "0.5 rad", 90.0 / pi),
        (units.Angle, "30 deg", 30.0),
        (units.Angle, "30°", 30.0),
        (units.Frequency, "2 kHz", 2000.0),
        (units.Damping, "25 1/s", 25.0),
        (units.Damping, "25/s", 25.0),
        (units.Force, "3 kN", 3000.0),
        (units.Stress, "12 GPa", 12e9),
        (units.Stress, "1 N/mm^2", 1e6),
        (units.Density, "1500 kg/m^3", 1500.0),
        (units.Density, "1.19 g/cm³", 1190.0),
        (units.Density, "1.19 g/cm3", 1190.0),
        (units.EnergyToughness, "300 J/m^2", 300.0),
        (units.EnergyToughness, "0.3 N/mm", 300.0),
        (units.EnergyToughness, "0.3 kJ·m^-2", 300.0),
        (units.StressIntensity, "1.5 MPa*m^0.5", 1.5e6),
        (units.StressIntensity, "1.5 MPa*m**(1/2)", 1.5e6),
        (units.StressIntensity, "1.5 MPa*sqrt(m)", 1.5e6),
        (units.StressIntensity, "1.5 MPa√m", 1.5e6),
        (units.StressIntensity, "1.5 N/mm^(1.5)", 1.5e6 / 1000.0**0.5),
    ],
)
def test_text_with_a_unit(kind, text, value):
    assert read(kind, text) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(("text", "value"), [("2.4 mm", 0.0024), ("0.1 mm", 1e-4), ("7 um", 7e-6)])
def test_decimal_prefixes_are_exact(text, value):
    """Correctly rounded once: 2.4 mm is the float nearest to 0.0024."""
    assert read(units.Length, text) == value


@pytest.mark.parametrize("value", [0, 3, -2.5, 1e-30, 1e30])
def test_plain_numbers_are_taken_as_they_are(value):
    number = read(units.Length, value)
    assert number == value
    assert isinstance(number, float)


@pytest.mark.parametrize(
    ("kind", "value", "message"),
    [
        (units.Density, "1190 lb", "'1190 lb' is no density; give kg/m^3 or a unit of that kind"),
        (units.Angle, "3 m", "'3 m' is no angle; give deg or a unit of that kind"),
        (units.Frequency, "60 rpm", "'60 rpm' is no frequency; give Hz or a unit of that kind"),
        (units.Stress, "12 Mpa", "'12 Mpa' is no stress: unknown unit 'Mpa'; did you mean 'MPa'?"),
        (units.Stress, "12 qqq", "'12 qqq' is no stress: unknown unit 'qqq'"),
        (units.Length, "1,5 mm", "'1,5 mm' is no length: the decimal sign is a point"),
        (units.Length, "1_0 m", "'1_0 m' is no length: unknown unit '_'"),
        (units.Length, "3 m)", "'3 m)' is no length: unit ')' cannot be read"),
        (units.Length, "3 m^99^99", "'3 m^99^99' is no length: unit '^99' cannot be read"),
        (units.Length, "3 9**9 m", "'3 9**9 m' is no length: unit '9**9 m' cannot be read"),
        (units.Number, "3.5", "must be a plain number without quotes (got '3.5')"),
        (units.Number, "3.5 m", "must be a plain number without a unit (got '3.5 m')"),
        (units.Number, "much", "must be a number: a plain number (got 'much')"),
        (units.Length, float("nan"), "must be a finite number (got nan)"),
        (units.Length, float("-inf"), "must be a finite number (got -inf)"),
        (units.Length, "1e999 m", "must be a finite number (got '1e999 m')"),
        (units.Length, 10**400, "must be a finite number (got a number too large)"),
        (units.Length, "1 m^99", "'1 m^99' is no length; give m or a unit of that kind"),
        (units.Length, 1e31, "must be 0 or between 1e-30 and 1e+30 in size (SI) (got 1e+31)"),
    ],
)
def test_what_is_wrong(kind, value, message):
    assert complaint(kind, value) == message


@pytest.mark.parametrize("value", [True, None, [1], {}, "nan m", ".inf m", "", "m", "--3 m"])
def test_what_is_no_number_names_the_field_and_its_unit(value):
    start = "must be a length: a number in m or text with a unit such as '2.4 mm' (got "
    assert complaint(units.Length, value).startswith(start)


def test_a_number_in_quotes_without_a_unit():
    assert complaint(units.Stress, "3.5") == (
        "'3.5' has no unit; drop the quotes (a plain number is in Pa) or add a unit, as in '12 GPa'"
    )


@pytest.mark.parametrize("unit", ["N^40*lb^40", "in^99", "km**99*km**99*km**99*km**99"])
def test_huge_powers_are_refused_quickly(unit):
    assert complaint(units.Length, f"1e300 {unit}")


def imports_pint(text, folder):
    """Return whether a new process imports pint to read a length, and the length."""
    script = (
        "import sys; from pydantic import TypeAdapter; from cramp_cli.schema.units import Length;"
        f"print(TypeAdapter(Length).validate_python({text!r}), 'pint' in sys.modules)"
    )
    environment = os.environ | {"CRAMP_CACHE_DIR": str(folder)}
    command = [sys.executable, "-c", script]
    said = subprocess.run(command, check=True, env=environment, capture_output=True, text=True)
    length, imported = said.stdout.split()
    return imported == "True", float(length)


def test_pint_is_imported_only_for_units_that_it_has_not_told_before(tmp_path):
    assert imports_pint(1.0, tmp_path) == (False, 1.0)
    assert imports_pint("2.4 mm", tmp_path) == (True, 0.0024)
    assert imports_pint("2.5 mm", tmp_path) == (False, 0.0025)
    (store,) = tmp_path.glob("units-*.json")
    store.write_text("{")
    assert imports_pint("2.4 mm", tmp_path) == (True, 0.0024)


def test_the_example_of_every_quantity_can_be_read():
    """That of a specific heat could not: brackets are no part of a unit here."""
    kinds = [vars(units)[name] for name in dir(units)]
    told = [one for kind in kinds for one in getattr(kind, "__metadata__", ())]
    quantities = [one for one in told if isinstance(one, units.Quantity) and one.unit]
    assert len(quantities) > 15
    for quantity in quantities:
        assert isinstance(quantity.number(quantity.example), float)
