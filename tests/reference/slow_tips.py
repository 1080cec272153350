"""Round tips close on a disk without friction in small steps: a rival of the closed forms that knows nothing of cages.

Each overlap is removed by the shortest way, tip after tip, until none is left. The tips may move in any directions and, if
these are no unit vectors, at different rates.
"""

import numpy as np

DIRECTIONS = np.array([[np.cos(a), np.sin(a)] for a in np.radians([90.0, 210.0, 330.0])])
SWEEPS = 60


def frictionless_ends(rho, opened, closed, centres, steps=4000, directions=DIRECTIONS):
    """Whether the disk is between the tips in the end (N,), and where its centre is (N, 2)."""
    c = np.array(centres, dtype=float)
    for s in np.linspace(opened, max(closed, rho * (1.0 + 1e-3)), steps):
        for _ in range(SWEEPS):
            moved = False
            for u in directions:
                off = c - s * u
                distance = np.hypot(off[:, 0], off[:, 1])
                short = np.maximum(rho - distance, 0.0)
                if (short > 1e-9 * rho).any():
                    moved = True
                    c += (short / distance)[:, None] * off
            if not moved:
                break
    inside = np.ones(len(c), dtype=bool)
    for k in range(3):
        a, b = directions[k] * s, directions[(k + 1) % 3] * s
        inside &= (b[0] - a[0]) * (c[:, 1] - a[1]) > (b[1] - a[1]) * (c[:, 0] - a[0])
    return inside, c
