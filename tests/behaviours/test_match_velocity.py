"""Matching velocities as a program: it keeps the arm's limits, ends at the place at the disk's velocity, or says why not."""

from __future__ import annotations

from dataclasses import replace
from math import hypot, inf

import numpy as np
import pytest

from palmar.behaviours.match_velocity import ArmLimits, Matching, MatchVelocity
from palmar.behaviours.reflex import Drive
from palmar.models.motion import Command, Observation

DT = 0.02
REFLEX = MatchVelocity(Drive(1, 0.5), ArmLimits(0.4, 2.0, 1.5), (0.0, 0.12), 2.0)
Vector = tuple[float, float]


def flown(reflex: MatchVelocity, start: Vector, disk: Vector, late: float = 0.0) -> list[tuple[Observation, Command]]:
    """The reflex before a disk that flies straight and is never touched; fingers end after pi / rate."""
    arm, time, rows = (0.0, 0.0), 0.0, []
    state: Matching | None = None
    closed = 0.0
    while time < 60.0:
        then = time - late
        track = (start[0] + disk[0] * then, start[1] + disk[1] * then, *disk)
        seen = Observation(time, (closed,), (closed,), (), (closed >= 3.0,) * 2, (*arm, 0.0), track)
        state, command = reflex.step(reflex.begin(seen) if state is None else state, seen)
        rows.append((seen, command))
        if command.stop:
            return rows
        span = DT if command.longest is None else min(DT, command.longest)
        arm = arm[0] + command.velocity[0] * span, arm[1] + command.velocity[1] * span
        closed, time = min(closed + command.right[0] * span, 3.0), time + span
    raise AssertionError("it does not end")


@pytest.mark.parametrize(("acceleration", "late"), [(2.0, 0.0), (0.3, 0.0), (2.0, 0.1), (inf, 0.05)])
def test_the_disk_is_at_its_place_at_its_velocity_when_it_closes(acceleration: float, late: float) -> None:
    limits = ArmLimits(0.4, acceleration, 1.5)
    reflex, rng = replace(REFLEX, arm=limits, age=late, patience=20.0), np.random.default_rng(3)
    for _ in range(20):
        start, disk = rng.uniform(-0.3, 0.3, 2), rng.uniform(-0.1, 0.1, 2)
        rows = flown(reflex, tuple(start), tuple(disk), late)
        closing = [(seen, command) for seen, command in rows if command.moves_fingers]
        for k, (seen, command) in enumerate(closing):
            if seen.time > closing[0][0].time + REFLEX.hold - 1e-9:
                break
            off = start + disk * seen.time - seen.arm[:2] - np.array(REFLEX.place)
            assert hypot(*off) <= 2e-3 + 2.0 * min(acceleration, 2.0) * DT**2
            assert k < 2 or command.velocity == pytest.approx(tuple(disk), abs=1e-12)
        assert k == REFLEX.hold / DT
        assert rows[-1][1].why == "both fingers are held up"
        assert rows[-1][1].velocity == (0.0, 0.0)


def test_limits_are_kept_all_the_way() -> None:
    rng, ends = np.random.default_rng(5), set()
    for _ in range(60):
        start, disk = rng.uniform(-0.8, 0.8, 2), rng.uniform(-0.3, 0.3, 2)
        rows = flown(REFLEX, tuple(start), tuple(disk))
        velocities = np.array([command.velocity for _, command in rows])
        assert np.hypot(*velocities.T).max() <= 0.4 + 1e-12
        assert np.hypot(*np.diff(velocities, axis=0).T).max() <= 2.0 * DT + 1e-12
        assert max(hypot(*seen.arm[:2]) for seen, _ in rows) <= 1.5 + 1e-9
        ends.add(rows[-1][1].why)
    assert {"both fingers are held up", "the arm's reach of 1500 mm would be used up"} <= ends


@pytest.mark.parametrize(("change", "disk", "said"), [
    ({}, (0.3, 0.3), "424.3 mm/s are more than the arm's 400 mm/s"),
    ({"arm": ArmLimits(0.4, 2.0, 0.5)}, (0.25, 0.0), "reach of 500 mm"),
    ({"patience": 1.0}, (0.35, 0.0), "within 1 s"),
])  # fmt: skip
def test_what_cannot_be_done_is_not_begun(change: dict[str, object], disk: Vector, said: str) -> None:
    rows = flown(replace(REFLEX, **change), (0.1, 0.3), disk)
    assert len(rows) == 2
    assert said in rows[-1][1].why


def test_without_a_tracker_it_ends_and_says_so() -> None:
    seen = Observation(0.0, (0.0,), (0.0,))
    _, command = REFLEX.step(REFLEX.begin(seen), seen)
    assert command.stop and "no tracker" in command.why


def test_the_way_to_brake_is_part_of_the_reach() -> None:
    """With just the reach that its whole motion takes it is done, with 1 mm less it is not begun."""
    limits, disk = ArmLimits(0.4, 0.3, 9.0), (0.2, 0.0)
    rows = flown(replace(REFLEX, arm=limits), (0.0, 0.12), disk)
    taken = max(hypot(*seen.arm[:2]) for seen, _ in rows)
    last = next(seen.arm[0] for seen, command in rows if command.why == "shut: brake")
    assert taken - last == pytest.approx(0.2**2 / 0.6, abs=0.005)
    for room, begun in ((0.005, True), (-0.001, False)):
        again = flown(replace(REFLEX, arm=replace(limits, reach=taken + room)), (0.0, 0.12), disk)
        assert (len(again) > 2) is begun
