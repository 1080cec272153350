"""The plant's process: physics, servos, the reflex layer and the arm's controller, kept to the wall clock.

Servos and reflexes run at every millisecond. The arm's controller asks for a set-point every 28 ms and waits 15 ms of wall
time for it; without one the arm holds and the hand stops, whatever became of the process that should have replied. Physics
stands still when this process is kept from running, so a late tick is a measurement and no danger.
"""

from __future__ import annotations

import signal
from contextlib import suppress
from dataclasses import replace
from math import inf
from multiprocessing.connection import Connection
from time import monotonic, sleep

import numpy as np
from numpy.typing import NDArray

from palmar.models.cell_messages import CellEnd
from palmar.models.cell_task import CellTask
from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.cell.exchange import Answer, Exchange
from palmar.worlds.cell.pace import Pace
from palmar.worlds.cell.process import PLANT_RANK, orphaned, settle
from palmar.worlds.cell.sighting_box import SightingBox
from palmar.worlds.cell.timing import Timing
from palmar.worlds.cell.transport import Key, Mailbox, Ports, Sender, open_session
from palmar.worlds.cell.wire import Light, Ready, Reply, Request, Sightings
from palmar.worlds.mujoco.cell.cell import Cell
from palmar.worlds.mujoco.cell.judge import CREEP, Judge
from palmar.worlds.mujoco.cell.scene import STEP
from palmar.worlds.mujoco.cell.settings import CellSettings
from palmar.worlds.mujoco.cell.trial import LONGEST, TICKS, TrialResult, check_sight, result_of, start_pose

Floats = NDArray[np.float64]
LIGHT_TICKS = 16
"""Servo ticks between two messages to vision."""
ASSEMBLY = 60.0
"""So long (s) the plant waits for the other processes to be ready."""
TO_REST, AFTERWARDS = 0.3, 0.6
"""After its end the cell has so long (s) to come to rest, and is watched so long."""


class Plant:
    """One run: ``begin`` when all others are ready, then ``run`` to the end."""

    def __init__(self, hand: SalisburyHand, task: CellTask, settings: CellSettings) -> None:
        self.eye = SightingBox()
        self.cell = Cell(hand, task, settings, start_pose(hand, task, settings.turn), self.eye)
        self.judge = Judge(self.cell)
        self.replies, self.ready = Mailbox(Reply), Mailbox(Ready)
        self.exchange = Exchange()
        self.asked_tick = self.asked_s = 0.0
        self.before = self.cell.pose
        self.end: CellEnd | None = None
        self.ended_at = 0.0
        self.at_rest: float | None = None
        self.fingers = self.cell.reflex.set_points
        self.approaches, self.sightings = 0, Sightings()
        self.phases: list[tuple[float, str]] = []
        self.delays: list[float] = []
        self.told_to_stop = False
        self.ranked = False
        self.epoch = 0.0
        self.pace = Pace(STEP, 0.0)

    def assemble(self, light: Sender[Light]) -> bool:
        """Shine until vision and the controller say that they are ready; whether they did."""
        until, missing = monotonic() + ASSEMBLY, {"vision", "controller"}
        while missing and monotonic() < until and not orphaned() and not self.told_to_stop:
            light.send(Light(stamp_s=0.0, epoch_s=None, qpos=self._qpos()))
            sleep(LIGHT_TICKS * STEP)
            missing -= {each.who for _, each in self.ready.take()}
        return not missing

    def run(self, light: Sender[Light], requests: Sender[Request]) -> None:
        """Until the cell has been watched at rest, or for ``LONGEST`` seconds."""
        pace, tick = self.pace, 0
        while not self._over(pace.wait() - self.epoch):
            now = monotonic() - self.epoch
            if tick % TICKS == 0:
                self.look(now)
                if self.end is None:
                    self.ask(requests, now)
            if tick % LIGHT_TICKS == 0:
                light.send(Light(stamp_s=now, epoch_s=self.epoch, qpos=self._qpos()))
            answer = self.exchange.settle(self.replies.take(), monotonic())
            if answer is not None and self.end is None:
                self.obey(answer, now)
            self.cell.tick()
            self.judge.feel()
            if self.cell.stopped is not None and self.end is None:
                self._finish(CellEnd.STOPPED, now)
            tick += 1

    def begin(self, epoch: float) -> None:
        """The trial's zero on the monotonic clock (s)."""
        self.epoch, self.pace = epoch, Pace(STEP, epoch)

    def _over(self, now: float) -> bool:
        return now > LONGEST or (self.end is not None and now - self.ended_at > AFTERWARDS)

    def _qpos(self) -> tuple[float, ...]:
        return tuple(self.cell.data.qpos.tolist())

    def ask(self, requests: Sender[Request], now: float) -> None:
        """For a set-point, unless nobody is there any more to stop the cell, or it is to stop."""
        if orphaned() or self.told_to_stop:
            self.cell.hold("told to stop" if self.told_to_stop else "nobody is watching")
            self._finish(CellEnd.STOPPED, now)
            return
        seen = self.cell.seen()
        self.asked_tick, self.asked_s = self.cell.time, now
        number = self.exchange.ask(monotonic())
        requests.send(Request(number=number, seen=replace(seen, time=now, sighting=None)))

    def obey(self, answer: Answer, now: float) -> None:
        """Move by a reply; without one the arm holds for good."""
        if answer.delay < inf:
            self.delays.append(answer.delay)
        if answer.reply is None:
            self.cell.answer(self.asked_tick, answer.delay, None)
            self._finish(CellEnd.STOPPED, now)
            return
        order, self.approaches = answer.reply.order, answer.reply.approaches
        self.sightings = answer.reply.sightings
        check_sight(self.judge, order, self.before, self.eye.look(now), self.asked_s)
        self.before, self.cell.order = order.palm_pose, order.hand
        if not self.phases or order.why != self.phases[-1][1]:
            self.phases.append((now, order.why))
        reachable = self.cell.answer(self.asked_tick, answer.delay, order.palm_pose)
        if order.end is not None or not reachable:
            self._finish(order.end or CellEnd.OUT_OF_REACH, now)

    def _finish(self, end: CellEnd, now: float) -> None:
        """Arm and hand stay as they are, unless the hand is to go on holding."""
        self.end, self.ended_at = end, now
        if end is not CellEnd.HOLDS:
            self.cell.hold(end.value)

    def look(self, now: float) -> None:
        """Judge; after the end nothing may move any more, but a swinging cylinder may push a finger that is told to stay."""
        self.judge.look()
        if self.end is None:
            return
        fingers, self.fingers = self.fingers, self.cell.reflex.set_points
        if self.judge.speed <= CREEP and self.fingers == fingers:
            self.at_rest = self.at_rest or now
        elif now - self.ended_at > TO_REST:
            self.judge.faults.add("moved after its end")
        else:
            self.at_rest = None

    def result(self) -> tuple[TrialResult, Timing]:
        """What came of it."""
        wall, cell = monotonic() - self.epoch, self.cell
        result = result_of(cell, self.judge, self.end, self.approaches, self.phases, wall)
        timing = Timing(
            simulated=cell.time,
            wall=wall,
            late=np.array(self.pace.late),
            replies=np.array(self.delays),
            slipped=self.pace.slipped,
            asked=cell.link.asked,
            missed=cell.link.missed,
            malformed=self.replies.malformed,
            outdated=self.exchange.outdated,
            ranked=self.ranked,
            sightings=self.sightings,
            ended=self.ended_at,
            at_rest=self.at_rest,
        )
        return result, timing


def run_plant(
    hand: SalisburyHand, task: CellTask, settings: CellSettings, ports: Ports, supervisor: Connection
) -> None:
    """The process: it tells its supervisor when the trial begins (monotonic, s; None: never), then what came of it."""
    plant = Plant(hand, task, settings)
    plant.ranked = settle(PLANT_RANK)
    signal.signal(signal.SIGTERM, lambda *_: setattr(plant, "told_to_stop", True))
    with open_session(ports.plant) as session:
        plant.eye.box.listen(session, Key.FRAME)
        plant.replies.listen(session, Key.REPLY)
        plant.ready.listen(session, Key.READY)
        light, requests = Sender[Light](session, Key.LIGHT), Sender[Request](session, Key.REQUEST)
        if not plant.assemble(light):
            tell(supervisor, None)
            return
        plant.begin(monotonic())
        tell(supervisor, plant.epoch)
        plant.run(light, requests)
        tell(supervisor, plant.result())


def tell(supervisor: Connection, what: object) -> None:
    """If it is still there."""
    with suppress(BrokenPipeError):
        supervisor.send(what)
