"""The equation of motion in every row; strides tell the dimension."""

from cramp_cli.numerics.kernel import kernel
from cramp_cli.numerics.vector import (
    plus,
    store,
    times,
    vector,
)


@kernel
def inverse(mass, row):
    """Return 1/m of a row, zero without mass."""
    return 1.0 / mass[row] if mass[row] > 0.0 else 0.0


@kernel
def advance_momentum(grid, count, strides, dt):
    """Set p+ = p + f dt."""
    mass, momentum, force = grid.mass, grid.momentum, grid.force
    for row in range(count):
        if mass[row] > 0.0:
            p, f = vector(strides, momentum, row), vector(strides, force, row)
            store(plus(p, dt, f), momentum, row, 0)


@kernel
def find_velocity(grid, count, strides):
    """Set v = p/m; a row without mass stays at rest."""
    mass, momentum, velocity = grid.mass, grid.momentum, grid.velocity
    for row in range(count):
        store(times(vector(strides, momentum, row), inverse(mass, row)), velocity, row, 0)


@kernel
def find_acceleration(grid, count, strides):
    """Set a = f/m; a row without mass has none."""
    mass, force, acceleration = grid.mass, grid.force, grid.acceleration
    for row in range(count):
        store(times(vector(strides, force, row), inverse(mass, row)), acceleration, row, 0)


@kernel
def add_gravity(grid, count, gravity):
    """Add f = m g (gravity: tuple, m/s^2)."""
    mass, force = grid.mass, grid.force
    for row in range(count):
        store(plus(vector(gravity, force, row), mass[row], gravity), force, row, 0)


@kernel
def divide_by_mass(field, mass, count, strides):
    """Set field = field / m in rows with mass."""
    for row in range(count):
        if mass[row] > 0.0:
            store(times(vector(strides, field, row), 1.0 / mass[row]), field, row, 0)
