"""Three real processes: whatever dies, the cell stops safely, says so, and nobody is left behind.

How a run ends must not depend on how busy the machine is: a reply that is late for that reason stops it in the same way.
"""

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")
pytest.importorskip("zenoh", reason="needs the extra palmar[realtime]")

from palmar.models.cell_messages import CellEnd, CellOrder, HandMode, Owner, Sighting
from palmar.models.cell_task import TABLE_TASK
from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.cell.exchange import Answer
from palmar.worlds.cell.faults import Fault, FaultKind
from palmar.worlds.cell.wire import Frame, Reply, Sightings
from palmar.worlds.mujoco.cell import plant as plant_module
from palmar.worlds.mujoco.cell import real_time
from palmar.worlds.mujoco.cell.plant import AFTERWARDS, Plant
from palmar.worlds.mujoco.cell.real_time import run_in_real_time
from palmar.worlds.mujoco.cell.settings import CellSettings

HAND = SalisburyHand()
WATCHER = """
import sys
from palmar.models.cell_task import TABLE_TASK
from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.mujoco.cell.real_time import Crew, pose_sight
from palmar.worlds.mujoco.cell.settings import CellSettings
if __name__ == "__main__":
    settings = CellSettings()
    crew = Crew(SalisburyHand(), TABLE_TASK, settings, 0.0, pose_sight(TABLE_TASK, settings))
    try:
        crew.start()
        print(crew.hear(60.0), flush=True)
        crew.hear(60.0)
    finally:
        crew.bury()
"""


@pytest.mark.parametrize("kind", [FaultKind.CONTROLLER_KILLED, FaultKind.CONTROLLER_HUNG])
def test_a_controller_that_is_gone_leaves_an_arm_that_holds_and_a_cell_at_rest(kind):
    trial = run_in_real_time(HAND, TABLE_TASK, CellSettings(fault=Fault(kind, 0.6)))
    result, timing = trial.result, trial.timing
    assert (result.outcome, result.end, result.unsafe, result.missed) == ("stopped", "stopped", (), 1)
    assert result.trace[-1][1] == "safe stop"
    assert timing is not None
    assert timing.at_rest is not None
    assert result.seconds < 0.6 + 0.1 + AFTERWARDS
    assert timing.asked == len(timing.replies) + 1
    assert multiprocessing.active_children() == []


def test_vision_that_does_not_start_is_reported_at_once_and_nothing_moves():
    began = time.monotonic()
    trial = run_in_real_time(HAND, TABLE_TASK, CellSettings(), make_sight=partial(int, "no camera"))
    assert (trial.result.outcome, trial.result.unsafe, trial.timing) == ("never started", (), None)
    assert time.monotonic() - began < 20.0
    assert multiprocessing.active_children() == []


def test_a_plant_that_dies_is_unsafe_and_reported(monkeypatch):
    """Then nobody can say how arm and hand were left."""
    monkeypatch.setattr(real_time, "STRUCK", {FaultKind.CONTROLLER_HUNG: ("plant", signal.SIGKILL)})
    trial = run_in_real_time(HAND, TABLE_TASK, CellSettings(fault=Fault(FaultKind.CONTROLLER_HUNG, 0.1)))
    assert (trial.result.outcome, trial.timing) == ("the plant's process died", None)
    assert trial.result.unsafe == ("the plant's process died",)
    assert multiprocessing.active_children() == []


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_when_the_supervisor_goes_everyone_goes(how, tmp_path):
    """Its processes share its standard output, which closes when the last of them has ended. Ctrl-C goes to all of them."""
    script = tmp_path / "watcher.py"
    script.write_text(WATCHER)
    words, pipe = [sys.executable, str(script)], subprocess.PIPE
    # A shell's background jobs ignore Ctrl-C, and so would what the test starts.
    heard = partial(signal.signal, signal.SIGINT, signal.default_int_handler)
    with subprocess.Popen(words, stdout=pipe, stderr=pipe, start_new_session=True, preexec_fn=heard) as watcher:
        assert watcher.stdout is not None
        assert float(watcher.stdout.readline()) > 0.0
        time.sleep(0.2)
        os.kill(watcher.pid, how) if how is signal.SIGKILL else os.killpg(watcher.pid, how)
        sent = time.monotonic()
        _, said = watcher.communicate(timeout=40.0)
    assert time.monotonic() - sent < 20.0
    assert said.count(b"Traceback") == (how is signal.SIGINT), "only the supervisor heard it"


def test_a_reply_that_never_came_holds_the_arm_at_once():
    plant = Plant(HAND, TABLE_TASK, CellSettings())
    plant.begin(0.0)
    before = plant.cell.link.now.copy()
    plant.obey(Answer(float("inf"), None), 0.020)
    for _ in range(60):
        plant.cell.tick()
    assert (plant.end, plant.cell.link.missed) == (CellEnd.STOPPED, 1)
    assert plant.cell.link.now == pytest.approx(before, abs=1e-12)


class Nobody:
    """Who hears no request."""

    def send(self, message: object) -> None:
        raise AssertionError("asked although nobody is watching")


def test_a_plant_that_nobody_watches_stops_by_itself(monkeypatch):
    monkeypatch.setattr(plant_module, "orphaned", lambda: True)
    plant = Plant(HAND, TABLE_TASK, CellSettings())
    plant.begin(0.0)
    plant.ask(Nobody(), 0.028)
    assert (plant.end, plant.cell.stopped) == (CellEnd.STOPPED, "nobody is watching")


@pytest.mark.parametrize("what", ["arm", "hand"])
def test_what_moves_after_the_end_is_unsafe(what):
    plant = Plant(HAND, TABLE_TASK, CellSettings())
    plant.begin(0.0)
    plant.end, plant.ended_at = CellEnd.HOLDS, 0.0
    plant.look(1.0)
    assert plant.judge.faults == set()
    if what == "hand":
        plant.cell.order = replace(plant.cell.order, target=(1.0,) * 3)
    else:
        plant.cell.link.goal, plant.cell.link.until, plant.cell.link.rate = plant.cell.link.now, 1.0, np.full(6, 0.1)
    for _ in range(28):
        plant.cell.tick()
    plant.look(1.028)
    assert plant.judge.faults == {"moved after its end"}


def test_a_hand_that_still_closes_stops_when_the_behaviour_gives_up():
    plant = Plant(HAND, TABLE_TASK, CellSettings())
    plant.begin(0.0)
    hand = replace(plant.cell.order, mode=HandMode.CLOSE)
    order = CellOrder(plant.cell.pose, hand, "close", CellEnd.NOTHING_GRIPPED)
    plant.obey(Answer(0.002, Reply(number=1, order=order, approaches=1, sightings=Sightings())), 0.003)
    curls = plant.cell.reflex.set_points
    for _ in range(28):
        plant.cell.tick()
    assert (plant.end, plant.cell.reflex.set_points) == (CellEnd.NOTHING_GRIPPED, curls)
    assert plant.cell.reflex.owner is Owner.SAFE_STOP


@pytest.mark.parametrize(
    ("age", "unsafe"), [(0.1, set()), (0.3, {"moved by a stale sighting"}), (None, {"moved by a stale sighting"})]
)
def test_the_judge_sees_for_itself_whether_the_arm_moves_by_a_fresh_sighting(age, unsafe):
    plant = Plant(HAND, TABLE_TASK, CellSettings())
    plant.begin(0.0)
    plant.asked_s = 1.0
    if age is not None:
        plant.eye.box.put(
            Frame(number=1, sighting=Sighting(1.0 - age, 0.5, 0.0, 0.03, 1e-3)).model_dump_json().encode()
        )
    pose = plant.cell.pose.copy()
    pose[2, 3] -= 1e-3
    order = CellOrder(pose, plant.cell.order, "lower the open hand", guided=True)
    plant.obey(Answer(0.002, Reply(number=1, order=order, approaches=1, sightings=Sightings())), 1.003)
    assert plant.end is None
    assert plant.judge.faults == ({"moved by a stale sighting"} if unsafe else set())
