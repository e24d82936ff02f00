"""Force and mouth opening of a plate pulled beside its notch, by crack length: pulled_plate.csv.

The plate of test_pulled_plate.py, upper half; each line is the state in which G at the tip is 1.
Both scale with sqrt(G). `python pulled_plate.py > pulled_plate.csv`
"""

import numpy as np
from finite_elements import Grid, hooke
from scipy.interpolate import CubicSpline

E, NU = 3.2e9, 0.35
LEFT, RIGHT, TOP, GRIP = -0.012, 0.048, 0.029, 0.003
TIPS = np.arange(0.014, 0.0441, 0.002)


def stiffness(h):
    """Return force at the grip (N/m^2) and opening of the mouth, over what the grip has moved."""
    grid = Grid(np.arange(LEFT, RIGHT + 0.5 * h, h), np.arange(0.0, TOP + 0.5 * h, h))
    K, found = grid.stiffness(hooke(E, NU), np.ones(len(grid.i))), []
    x = LEFT + 0.5 * h * np.arange(grid.nx)
    grip = np.flatnonzero(abs(x) < GRIP + 1e-9) + (grid.ny - 1) * grid.nx
    for tip in TIPS:
        held = {2 * (grid.nx - 1): 0.0} | {2 * int(n) + 1: 1.0 for n in grip}
        held |= {2 * int(i) + 1: 0.0 for i in np.flatnonzero(x > tip - 1e-9)}
        u = grid.solve(K, held)
        found.append(((K @ u)[2 * grip + 1].sum(), 2 * u[1]))
    return np.array(found)


if __name__ == "__main__":
    coarse, fine = stiffness(1e-3), stiffness(5e-4)
    k, mouth = (2 * fine - coarse).T  # the error at a tip falls with the element
    log_k = CubicSpline(TIPS, np.log(k))
    print("tip,force,opening")
    for tip, opening in zip(TIPS, mouth, strict=True):
        pulled = np.sqrt(-1.0 / (np.exp(log_k(tip)) * log_k(tip, 1)))
        print(f"{tip:.3f},{np.exp(log_k(tip)) * pulled:.6g},{opening * pulled:.6g}")
