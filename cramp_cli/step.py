"""The way of one time step (Nairn 2003, section 3; Sulsky, Chen, Schreyer 1994).

Read from top to bottom; docs/theory/step.md has a paragraph for each title. What a line does, in
which rows, is in the module it comes from.
"""

from cramp_cli.boundary.absorbing import absorb_waves, book_absorbed
from cramp_cli.boundary.conditions import (
    add_loads,
    book_tractions,
    hold_after_contact,
    hold_forces,
    hold_momenta,
    meet_rows,
    reflect_forces,
    reflect_mass_and_momentum,
    reflect_sum,
    repeat_images,
)
from cramp_cli.contact.bodies import find_pairs, move_rigid_bodies, touch_bodies
from cramp_cli.cracks.cohesion import book_pressures, draw_faces
from cramp_cli.cracks.contact import FIRST, LAST, UPDATE
from cramp_cli.cracks.contact_books import AFTER, BEFORE, PUSHED
from cramp_cli.cracks.fields import (
    find_openings,
    find_rows,
    follow_behind_tips,
    list_cracks,
    move_paths,
    note_faces,
    touch_faces,
)
from cramp_cli.cracks.release import resist_opening
from cramp_cli.cracks.tip_filter import calm_running_tips, leave_to_tips, note_near_tips
from cramp_cli.cracks.wake import smooth_wakes
from cramp_cli.grid_velocity import find_strain_velocity, find_update_velocity
from cramp_cli.transfer import sums
from cramp_cli.transfer.on_grid import advance_momentum, find_acceleration, find_velocity


def step(model, state, scratch, watch) -> None:
    """Advance `state` by one time step; `watch(title)` times the paragraphs."""
    dt, conditions = model.dt, model.conditions

    with watch("1 where the particles are"):
        list_cracks(model, state, scratch)
        sums.locate_particles(model, state, scratch)

    with watch("2 in which body, on which side of the cracks"):
        find_rows(model, state, scratch)
        find_pairs(model, state, scratch)
        find_openings(model, state, scratch)
    grid, count = scratch.grid, scratch.row_count
    state.reactions[:] = 0.0

    with watch("3 mass and momentum to the grid"):
        sums.sum_mass_and_momentum(model, state, scratch)
        meet_rows(conditions, scratch, state, model.lattice.width)
        reflect_mass_and_momentum(conditions, scratch, state)
        note_faces(model, scratch, grid.momentum, BEFORE)
        follow_behind_tips(model, scratch, grid.momentum)
        grid.saved[:count] = grid.momentum[:count]
        touch_bodies(model, state, scratch, FIRST)
        touch_faces(model, state, scratch, FIRST)
        repeat_images(conditions, scratch, grid.momentum, grid.saved)

    with watch("4 strain before the forces"):  # all of the step in USF, half in USAVG, none in USL
        hold_momenta(conditions, scratch, state)
        book_tractions(model, scratch, state)
        if model.scheme.before:
            find_strain_velocity(model, state, scratch)
            sums.strain(model, state, scratch, model.scheme.before)
        grid.momentum[:count] = grid.saved[:count]

    with watch("5 forces"):
        sums.sum_internal_force(model, state, scratch)
        add_loads(model, scratch, state)
        draw_faces(model, state, scratch)
        reflect_forces(conditions, scratch, state)
        absorb_waves(model, scratch, state)
        note_faces(model, scratch, grid.force, PUSHED)
        follow_behind_tips(model, scratch, grid.force)

    with watch("6 equation of motion in every velocity field"):
        hold_forces(conditions, scratch, state, dt)
        advance_momentum(grid, count, model.strides, dt)
        touch_bodies(model, state, scratch, UPDATE)
        touch_faces(model, state, scratch, UPDATE)
        resist_opening(model, state, scratch)
        repeat_images(conditions, scratch, grid.momentum, grid.force)
        hold_after_contact(conditions, scratch, state, dt)
        find_acceleration(grid, count, model.strides)

    with watch("7 particles move"):
        find_update_velocity(model, state, scratch)
        near = note_near_tips(model, state, scratch)
        sums.move(model, state, scratch)
        leave_to_tips(model, state, near)
        move_rigid_bodies(model, state)

    with watch("8 cracks move"):
        if state.paths.crack_count:
            find_velocity(grid, count, model.strides)  # the first order, whatever moved particles
            move_paths(model, state, scratch)
            book_pressures(model, state, scratch)

    with watch("9 strain after the motion"):  # none of the step in USF, half in USAVG, all in USL
        if model.scheme.again:
            grid.momentum[:count] = grid.saved[:count]  # of the moved particles
            find_openings(model, state, scratch)
            reflect_sum(conditions, scratch, grid.momentum)
            note_faces(model, scratch, grid.momentum, AFTER)
            follow_behind_tips(model, scratch, grid.momentum)
            touch_bodies(model, state, scratch, LAST)
            touch_faces(model, state, scratch, LAST)
            repeat_images(conditions, scratch, grid.momentum)
            hold_momenta(conditions, scratch, state)
        book_tractions(model, scratch, state)
        book_absorbed(model, scratch, state)
        if model.scheme.after:
            find_strain_velocity(model, state, scratch)
            sums.strain(model, state, scratch, model.scheme.after)
        calm_running_tips(model, state, scratch, reflect_sum)
        smooth_wakes(model, state, scratch)

    state.time += dt
    state.step += 1
