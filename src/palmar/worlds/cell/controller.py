"""The controller's process: the behaviours' pure steps, one at each request of the arm, over the transport."""

from __future__ import annotations

from dataclasses import replace
from time import sleep

import numpy as np
from numpy.typing import NDArray

from palmar.behaviours.cell.tasks import programme_for
from palmar.models.cell_task import CellTask
from palmar.models.salisbury_hand import SalisburyHand
from palmar.worlds.cell.faults import Fault, FaultKind
from palmar.worlds.cell.process import CONTROLLER_RANK, orphaned, settle
from palmar.worlds.cell.sighting_box import SightingBox
from palmar.worlds.cell.transport import Key, Mailbox, Ports, Sender, open_session
from palmar.worlds.cell.wire import Ready, Reply, Request

Floats = NDArray[np.float64]
WAIT, SILENCE = 0.05, 2.0
"""How long (s) at a time it waits for a request; after so long a silence it ends."""
LATE = 0.020
"""With the fault of late replies: how long (s) it sleeps before each."""


def control(hand: SalisburyHand, task: CellTask, error: float, pose: Floats, fault: Fault, ports: Ports) -> None:
    """From a pose of the hand frame (4, 4) until nobody asks any more; ``error`` (m) bounds vision's systematic error."""
    programme = programme_for(hand, task, error, pose)
    settle(CONTROLLER_RANK)
    with open_session(ports.controller, [ports.plant]) as session:
        eye = SightingBox()
        eye.box.listen(session, Key.FRAME)
        vision = Mailbox(Ready).listen(session, Key.READY)
        requests = Mailbox(Request).listen(session, Key.REQUEST)
        replies, ready = Sender[Reply](session, Key.REPLY), Sender[Ready](session, Key.READY)
        quiet, started, sees = 0.0, False, False
        while not orphaned() and quiet < SILENCE:
            request = requests.wait(WAIT)
            if request is None:
                quiet += WAIT if started else 0.0
                sees = sees or bool(vision.take())
                if sees and not started:
                    ready.send(Ready(who="controller"))
                continue
            quiet, started = 0.0, True
            seen = request.seen
            if fault.now(FaultKind.LATE_REPLY, seen.time):
                sleep(LATE)
            order = programme.step(replace(seen, sighting=eye.look(seen.time)))
            approaches = programme.state.approaches
            replies.send(Reply(number=request.number, order=order, approaches=approaches, sightings=eye.counts))
