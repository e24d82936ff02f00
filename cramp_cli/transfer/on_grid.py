"""The equation of motion in every row."""

from cramp_cli.numerics.kernel import kernel


@kernel
def advance_momentum(grid, count, dt):
    """Set p+ = p + f dt."""
    mass, momentum, force = grid.mass, grid.momentum, grid.force
    for row in range(count):
        if mass[row] > 0.0:
            for d in range(momentum.shape[1]):
                momentum[row, d] += force[row, d] * dt


@kernel
def find_velocity(grid, count):
    """Set v = p/m; a row without mass stays at rest."""
    mass, momentum, velocity = grid.mass, grid.momentum, grid.velocity
    for row in range(count):
        over = 1.0 / mass[row] if mass[row] > 0.0 else 0.0
        for d in range(momentum.shape[1]):
            velocity[row, d] = momentum[row, d] * over


@kernel
def find_acceleration(grid, count):
    """Set a = f/m; a row without mass has none."""
    mass, force, acceleration = grid.mass, grid.force, grid.acceleration
    for row in range(count):
        over = 1.0 / mass[row] if mass[row] > 0.0 else 0.0
        for d in range(force.shape[1]):
            acceleration[row, d] = force[row, d] * over


@kernel
def add_gravity(grid, count, gravity):
    """Add f = m g (gravity: tuple, m/s^2)."""
    mass, force = grid.mass, grid.force
    for row in range(count):
        for d in range(len(gravity)):
            force[row, d] += mass[row] * gravity[d]


@kernel
def divide_by_mass(field, mass, count):
    """Set field = field / m in rows with mass."""
    for row in range(count):
        if mass[row] > 0.0:
            for d in range(field.shape[1]):
                field[row, d] /= mass[row]
