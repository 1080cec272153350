"""What all behaviours of the cell share: they end once, hold still when stopped, and doubt a palm that stays on."""

from dataclasses import replace

import numpy as np
import pytest

from palmar.behaviours.cell.arm_path import ArmPath
from palmar.behaviours.cell.phased import PATIENCE, TIRED
from palmar.behaviours.cell.sightings import OLDEST
from palmar.behaviours.cell.table_pick import DRAWN_BACK, Phase, Picking, TablePick
from palmar.behaviours.cell.tasks import programme_for
from palmar.models.cell_messages import CellEnd, CellSeen, Owner, Sighting
from palmar.models.cell_task import FLOATING_TASK, TABLE_TASK
from palmar.models.salisbury_hand import SalisburyHand

HAND = SalisburyHand()
POSE = np.diag([1.0, -1.0, -1.0, 1.0])
SEEN = CellSeen(0.0, POSE, (-0.4,) * 3, (False,) * 3, (False, False), False, False, Owner.BEHAVIOUR, None, None)


@pytest.mark.parametrize("task", [TABLE_TASK, FLOATING_TASK], ids=lambda task: task.kind.value)
def test_once_stopped_the_arm_stays_and_the_end_is_told_again_and_again(task):
    programme = programme_for(HAND, task, 0.005, POSE)
    assert programme.step(SEEN).end is None
    for k in range(3):
        order = programme.step(replace(SEEN, time=0.1 * k, stopped="late" if k == 0 else None))
        assert (order.end, order.guided) == (CellEnd.STOPPED, False)
        assert order.palm_pose == pytest.approx(POSE)


@pytest.mark.parametrize("task", [TABLE_TASK, FLOATING_TASK], ids=lambda task: task.kind.value)
def test_without_fresh_sightings_the_arm_stands_and_then_gives_up(task):
    programme = programme_for(HAND, task, 0.005, POSE)
    time, moved, ended = 0.0, [], None
    while ended is None and time < 10.0:
        sighting = Sighting(time, 0.5 + 1e-6 * time, 0.0, 0.03, 1e-3) if time < 1.2 else None
        before = programme.state.path.place
        order = programme.step(replace(SEEN, time=time, sighting=sighting))
        standing = time > 1.2 + OLDEST
        assert not standing or programme.state.path.speed == 0.0
        moved.append((time, float(np.abs(order.palm_pose[:3, 3] - before).max()) > 0.0))
        time, ended = time + 0.028, order.end
    assert ended is CellEnd.NO_FRESH_SIGHTING
    assert 1.2 + PATIENCE - 0.03 < time < 1.2 + PATIENCE + 0.06
    assert any(did for when, did in moved if 1.0 < when < 1.2)
    assert not any(did for when, did in moved if when > 1.2 + OLDEST)


def test_sightings_that_are_hardly_ever_fresh_end_it_at_last():
    """Each is 0.19 s old when it comes and stale a moment later: the arm moves a little, and stops, again and again."""
    programme = programme_for(HAND, TABLE_TASK, 0.005, POSE)
    time, ended, moved, sighting = 0.0, None, 0, None
    while ended is None and time < 40.0:
        if round(time / 0.028) % 12 == 0 or time < 1.0:
            sighting = Sighting(time - (0.03 if time < 1.0 else 0.19), 0.5 + 1e-6 * time, 0.0, 0.03, 1e-3)
        before = programme.state.path.place
        order = programme.step(replace(SEEN, time=time, sighting=sighting))
        moved += float(np.abs(order.palm_pose[:3, 3] - before).max()) > 0.0
        time, ended = time + 0.028, order.end
    assert ended is CellEnd.NO_FRESH_SIGHTING
    assert TIRED < time < TIRED + 2.0
    assert moved > 20


def closing(since: float) -> Picking:
    return Picking(Phase.CLOSE, since, ArmPath(POSE), approaches=1)


@pytest.mark.parametrize(
    ("waited", "palm", "touched", "end"),
    [
        (DRAWN_BACK + 0.01, (True, False), (False,) * 3, CellEnd.SENSOR_FAULT),
        (DRAWN_BACK - 0.01, (True, False), (False,) * 3, None),
        (DRAWN_BACK + 0.01, (False, False), (False,) * 3, None),
        (DRAWN_BACK + 0.01, (True, False), (True, False, False), None),
    ],
)
def test_a_palm_that_feels_something_after_it_has_drawn_back_is_stuck(waited, palm, touched, end):
    pick = TablePick(HAND, TABLE_TASK.cylinder, 0.0, 0.005)
    _, order = pick.step(closing(0.0), replace(SEEN, time=waited, palm=palm, touched=touched))
    assert order.end is end
