"""How the error that matching velocities tolerates shrinks with the disk's speed: the linear account beside runs.

    python3 dev.py validate velocity_matching [RUNS]

The case is zero_g_example; the disk starts at the place in the hand, flying along the palm. For each speed: the error
still tolerated and the chance by the linear account (studies/velocity_matching.py), the chance by the capture kernel from
drawn errors without the arm's limits, and RUNS runs of the behaviour (200) with the 95 % interval of Clopper and Pearson.
First the tracker's age is made up for, then it is not, then the arm reaches as far as it needs. Seeds are fixed.
"""

from __future__ import annotations

import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

from palmar.behaviours.build import reflex_of
from palmar.behaviours.match_velocity import MatchVelocity
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.case import Case, Start
from palmar.models.closure import Closure
from palmar.models.shipped import open_case
from palmar.regions.captured import captured_region
from palmar.studies.matched_capture import drawn_capture, matched_capture
from palmar.studies.velocity_matching import Carriage, Tracking, closing_time, velocity_matching
from palmar.worlds.planar.tracker import Tracker

SPEEDS = (0.0, 0.05, 0.1, 0.15, 0.17, 0.2, 0.25)
"""Of the disk (m/s)."""
AGE, POSITION, VELOCITY = 0.3, 0.025, 0.01
"""Of the tracker: s, m, m/s."""
REACH, ACCELERATION, SPEED = 0.6, 2.0, 0.3
"""Of the arm: m, m/s^2, m/s."""
DRAWS = 50_000


def matched_case(case: Case, speed: float, place: tuple[float, float], age: float, reach: float) -> Case:
    """The case with a disk at the place that flies along the palm, and the behaviour that makes up for ``age``."""
    does = Behaviour(
        name=BehaviourName.MATCH_VELOCITY, speed=SPEED, acceleration=ACCELERATION, reach=reach,
        place=place, delay=age,
    )  # fmt: skip
    return case.model_copy(update={"behaviour": does, "start": Start(at=place, velocity=(speed, 0.0))})


def tell(runs: int, reach: float, *, extrapolates: bool) -> None:
    """Print one table."""
    _, case = open_case("zero_g_example")
    region = captured_region(case, Closure.FRICTIONAL, None)
    circle = region.allowed_error
    assert circle is not None
    arm = Carriage(reach, ACCELERATION, SPEED)
    tracking = Tracking(POSITION, VELOCITY, AGE, extrapolates)
    linear = velocity_matching(case, region, tracking, arm, SPEEDS, 0.9)
    print(
        f"circle {1e3 * circle.radius:.2f} mm about ({1e3 * circle.centre[0]:.2f}, {1e3 * circle.centre[1]:.2f}) mm;",
        end="",
    )
    print(f" T {closing_time(case):.3f} s; pace {1e3 * arm.matched_speed(closing_time(case)):.1f} mm/s;", end="")
    print(f" reach {1e3 * reach:.0f} mm; spread {1e3 * linear.spread:.2f} mm;", end="")
    print(f" the age is {'' if extrapolates else 'not '}made up for", flush=True)
    print("| speed mm/s | tolerated mm | chance, linear | drawn | runs caught | 95 % interval | last words |")
    print("|---|---|---|---|---|---|---|")
    pool = ProcessPoolExecutor(2, mp_context=get_context("spawn"))
    with pool:
        for k, speed in enumerate(SPEEDS):
            here = matched_case(case, speed, circle.centre, AGE if extrapolates else 0.0, reach)
            tracker, reflex = Tracker(AGE, POSITION, VELOCITY, 10_000 * k), reflex_of(here)
            assert isinstance(reflex, MatchVelocity)
            drawn = drawn_capture(here, reflex, tracker, DRAWS)
            found = matched_capture(here, tracker, runs, pool)
            ends = "; ".join(f"{count} {why}" for why, count in found.ends[:2])
            print(
                f"| {1e3 * speed:.0f} | {1e3 * linear.tolerated[k]:.1f} | {linear.chance[k]:.3f} | {drawn:.3f}"
                f" | {found.caught} of {found.runs} | {found.low:.3f} to {found.high:.3f} | {ends} |",
                flush=True,
            )


if __name__ == "__main__":
    amount = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    for far, made_up_for in ((REACH, True), (REACH, False), (5.0 * REACH, False)):
        tell(amount, far, extrapolates=made_up_for)
