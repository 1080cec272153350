"""How should two joints a finger close? A quick search, and one start that only the best strategy catches."""

from math import degrees

from palmar.models.shipped import open_case
from palmar.studies.simulate import simulate_start
from palmar.studies.strategies import QUICK, strategies, winner

_, case = open_case("testbed_free_thick")
found = strategies(case, effort=QUICK)
straight, best = found[0], winner(found)
for each in found:
    print(f"{each.name:10} {1e4 * each.region.area:6.1f} cm2")
gain = 100.0 * (best.region.area / straight.region.area - 1.0)
print(f"{best.name}, curled by {degrees(best.behaviour.preshape):.0f} deg: {gain:.0f} % more")

start = (0.12, 0.15)
for each in (straight, best):
    moved = case.model_copy(update={"behaviour": each.behaviour})
    told = simulate_start(moved, start)
    print(
        f"a disk at {tuple(1e3 * x for x in start)} mm, {each.name}: {told.outcome.value} after {told.events[-1][0]:.2f} s"
    )
