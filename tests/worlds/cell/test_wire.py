"""Messages come back as they went; what no part of the cell can have said is refused."""

import json

import numpy as np
import pytest
from pydantic import ValidationError

from palmar.models.cell_messages import CellEnd, CellOrder, CellSeen, HandMode, HandOrder, Owner, Sighting
from palmar.models.salisbury_hand import CYLINDRIC
from palmar.worlds.cell.wire import Frame, Light, Reply, Request, Sightings

COSINE, SINE = np.cos(0.3), np.sin(0.3)
POSE = np.array([[COSINE, -SINE, 0, 0.5], [SINE, COSINE, 0, -0.1], [0, 0, 1, 0.2], [0, 0, 0, 1.0]])
HAND = HandOrder(HandMode.CLOSE, (-0.4, -0.3, -0.2), CYLINDRIC, 4.0, 0.5, True)
REPLY = Reply(number=7, order=CellOrder(POSE, HAND, "close", CellEnd.HOLDS), approaches=2, sightings=Sightings())


def test_a_reply_comes_back_to_the_last_bit():
    again = Reply.model_validate_json(REPLY.model_dump_json())
    assert np.array_equal(again.order.palm_pose, POSE)
    assert (again.number, again.order.hand, again.order.end, again.approaches) == (7, HAND, CellEnd.HOLDS, 2)


def test_a_request_and_a_frame_come_back():
    seen = CellSeen(1.5, POSE, (0.1,) * 3, (True, False, True), (False, True), True, False, Owner.PALM, "late", None)
    again = Request.model_validate_json(Request(number=1, seen=seen).model_dump_json()).seen
    assert np.array_equal(again.palm_pose, POSE)
    assert (again.time, again.touched, again.palm, again.owner, again.stopped) == (
        1.5, (True, False, True), (False, True), Owner.PALM, "late",
    )  # fmt: skip
    frame = Frame(number=3, sighting=Sighting(1.4, 0.5, 0.1, 0.03, 1e-3))
    assert Frame.model_validate_json(frame.model_dump_json()) == frame


def changed(path: str, value: object) -> str:
    """The reply with one thing in it put to another value, or added."""
    record = json.loads(REPLY.model_dump_json())
    *way, last = path.split(".")
    at = record
    for name in way:
        at = at[name]
    at[last] = value
    return json.dumps(record)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("number", -1),
        ("order.palm_pose", [[1.0, 0, 0, 0]] * 4),
        ("order.palm_pose", (2.0 * np.eye(4)).tolist()),
        ("order.palm_pose", np.diag([1.0, 1.0, -1.0, 1.0]).tolist()),
        ("order.palm_pose", np.eye(3).tolist()),
        ("order.palm_pose", [[1, 0, 0, float("nan")], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]),
        ("order.palm_pose", "here"),
        ("order.palm_pose", [[1, 0, 0, 1e3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]),
        ("order.hand.rate", float("nan")),
        ("order.hand.rate", 1e3),
        ("order.hand.rate", 0.0),
        ("order.hand.soft_rate", -1.0),
        ("order.hand.grip", -0.1),
        ("order.hand.target", [0.0, 0.0, 9.0]),
        ("order.hand.mode", "crush"),
        ("order.hand.also", 1),
        ("also", 1),
    ],
)
def test_what_no_behaviour_says_is_refused(path, value):
    Reply.model_validate_json(changed("number", 8))
    with pytest.raises(ValidationError):
        Reply.model_validate_json(changed(path, value))


@pytest.mark.parametrize(
    "seen", [(0.0, 99.0, 0.0, 0.03, 1e-3), (0.0, 0.5, 0.0, -0.03, 1e-3), (0.0, 0.5, 0.0, 0.03, -1.0)]
)
def test_what_no_camera_sees_is_refused(seen):
    with pytest.raises(ValidationError):
        Frame(number=0, sighting=Sighting(*seen))


def test_times_are_finite():
    frame = Frame(number=3, sighting=Sighting(1.5, 0.5, 0.1, 0.03, 1e-3)).model_dump_json()
    with pytest.raises(ValidationError, match="finite"):
        Frame.model_validate_json(frame.replace("1.5", "NaN"))


def test_light_has_a_whole_scene():
    with pytest.raises(ValidationError):
        Light(stamp_s=0.0, epoch_s=None, qpos=(0.0,) * 21)
