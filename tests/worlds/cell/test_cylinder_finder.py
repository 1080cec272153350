"""Painted pictures of cylinders: where they are found, how sure that is, and when nothing is."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

pytest.importorskip("cv2", reason="needs the extra palmar[mujoco]")

import cv2

from palmar.worlds.cell.calibration import Calibration
from palmar.worlds.cell.camera_model import looking
from palmar.worlds.cell.cylinder_finder import CylinderFinder
from palmar.worlds.cell.upright_outline import Upright, outline

CAMERA = looking(np.array([0.48, 0.60, 0.13]), np.array([0.48, 0.0, -0.235]), 22.0, (320, 240))
FINDER = CylinderFinder(CAMERA, -0.30, -0.17, (0.48, 0.0))
BODY = Upright(0.485, -0.01, 0.03, -0.30, -0.17)
ORANGE, TABLE, DARK, FINE = (190, 84, 0), (170, 158, 140), (70, 74, 82), 6


@dataclass
class Painter:
    """Paints six times finer than the camera sees."""

    picture: np.ndarray

    @classmethod
    def table(cls):
        return cls(np.full((240 * FINE, 320 * FINE, 3), TABLE, np.uint8))

    def polygon(self, pixels, colour):
        corners = ((pixels + 0.5) * FINE - 0.5) * 16
        cv2.fillPoly(self.picture, [corners.round().astype(np.int32)], colour, shift=4)
        return self

    def cylinder(self, body, colour=ORANGE):
        line = outline(CAMERA, body, 0.5)
        return self.polygon(line.pixels - 0.5 / FINE * line.out, colour)  # fillPoly paints the rim's pixels too

    def box(self, left, top, right, bottom, colour=DARK):
        return self.polygon(np.array([(left, top), (right, top), (right, bottom), (left, bottom)], float), colour)

    def seen(self, random, grain=3.0):
        picture = cv2.resize(self.picture, (320, 240), interpolation=cv2.INTER_AREA)
        return np.clip(picture + grain * random.standard_normal(picture.shape), 0, 255).round().astype(np.uint8)


def far_off(found, body):
    return float(np.hypot(found.body.x - body.x, found.body.y - body.y))


def test_errors_over_random_poses_keep_to_what_is_claimed():
    random = np.random.default_rng(5)
    off, sigma, radius = [], [], []
    for _ in range(40):
        x, y, r = random.uniform((0.45, -0.03, 0.02), (0.51, 0.03, 0.04))
        body = replace(BODY, x=x, y=y, radius=r)
        found = FINDER.find(Painter.table().cylinder(body).seen(random))
        assert found is not None
        off.append(far_off(found, body))
        sigma.append(found.sigma)
        radius.append((found.body.radius - r) / found.covariance[2, 2] ** 0.5)
    assert (np.array(off) < 2.0 * np.array(sigma)).mean() >= 0.95
    assert (np.abs(radius) < 2.0).mean() >= 0.9
    assert np.sqrt(np.mean(np.square(off))) < 4e-5 < np.mean(sigma) < 1e-4


def test_more_noise_is_less_sure():
    picture = Painter.table().cylinder(BODY)
    quiet, loud = (FINDER.find(picture.seen(np.random.default_rng(1), grain)) for grain in (1.0, 12.0))
    assert loud.sigma > 1.1 * quiet.sigma
    assert loud.left > 2.0 * quiet.left
    assert far_off(loud, BODY) < 2.0 * loud.sigma


def test_what_hides_a_part_of_it_is_left_out_and_makes_it_less_sure():
    random, middle = np.random.default_rng(3), CAMERA.pixels(np.array([BODY.x, BODY.y, -0.235]))
    whole = FINDER.find(Painter.table().cylinder(BODY).seen(random))
    top = Painter.table().cylinder(BODY).box(middle[0] - 60, 0, middle[0] + 60, middle[1] - 30)
    across = Painter.table().cylinder(BODY).box(middle[0] - 60, middle[1] - 8, middle[0] + 60, middle[1] + 8)
    for picture, more in ((top, 1.2), (across, 0.99)):
        found = FINDER.find(picture.seen(random))
        assert found.seen < 0.95 * whole.seen
        assert more * whole.sigma < found.sigma < 5e-4
        assert far_off(found, BODY) < 2.0 * found.sigma


def test_however_much_a_finger_along_a_side_hides_the_answer_is_right_or_none():
    random, middle = np.random.default_rng(3), CAMERA.pixels(np.array([BODY.x, BODY.y, -0.235]))
    fingers = [Painter.table().cylinder(BODY).box(middle[0] - 60, 0, middle[0] + k, 240) for k in range(-24, 13, 3)]
    told = [FINDER.find(each.seen(random)) for each in fingers]
    found = [each for each in told if each is not None]
    assert told[0] is not None and told[-1] is None
    assert 4 <= len(found) <= 9
    assert all(far_off(each, BODY) < 3.0 * each.sigma < 6e-4 for each in found)
    assert found[-1].sigma > 1.5 * found[0].sigma


def test_of_a_cylinder_nearly_all_hidden_nothing_is_said():
    random, middle = np.random.default_rng(3), CAMERA.pixels(np.array([BODY.x, BODY.y, -0.235]))
    half = Painter.table().cylinder(BODY).box(middle[0] - 8, 0, middle[0] + 60, 240)
    assert FINDER.find(half.seen(random)) is None
    foot = Painter.table().cylinder(BODY).box(middle[0] - 60, 0, middle[0] + 60, middle[1] + 30)
    assert FINDER.find(foot.seen(random)) is None
    assert FINDER.find(Painter.table().box(100, 20, 200, 220).seen(random)) is None
    assert FINDER.find(np.zeros((240, 320, 3), np.uint8)) is None


def test_other_things_of_its_colour_are_told_from_it():
    random = np.random.default_rng(4)
    larger = Painter.table().cylinder(BODY).box(230, 20, 315, 220, ORANGE)
    assert far_off(FINDER.find(larger.seen(random)), BODY) < 2e-4
    alone = Painter.table().box(120, 60, 220, 160, ORANGE)
    assert FINDER.find(alone.seen(random)) is None


@pytest.mark.parametrize("rim", [{"low": BODY.low - 0.05}, {"high": BODY.high - 0.05}], ids=["longer", "shorter"])
def test_a_cylinder_of_another_height_is_not_it(rim):
    """Sides and one rim fit; but its colour goes on beyond the outline, or the table is seen within it."""
    assert FINDER.find(Painter.table().cylinder(replace(BODY, **rim)).seen(np.random.default_rng(7))) is None


def test_another_edge_close_by_is_not_taken_for_the_cylinder_s():
    line = outline(CAMERA, BODY, 0.5)
    side = line.pieces == 1
    strip = np.concatenate([line.pixels[side], (line.pixels + 1.5 * line.out)[side][::-1]])
    picture = Painter.table().polygon(strip, DARK).cylinder(BODY)
    found = FINDER.find(picture.seen(np.random.default_rng(8)))
    assert found.seen < 0.95
    assert far_off(found, BODY) < 2.0 * found.sigma


def test_a_lifted_cylinder_is_out_of_reach():
    lifted = replace(BODY, low=BODY.low + 0.1, high=BODY.high + 0.1)
    assert FINDER.find(Painter.table().cylinder(lifted).seen(np.random.default_rng(1))) is None


def test_a_cylinder_that_bobs_is_known_less_well():
    picture = Painter.table().cylinder(replace(BODY, low=BODY.low + 1e-3, high=BODY.high + 1e-3))
    found = replace(FINDER, bob=1e-3).find(picture.seen(np.random.default_rng(2)))
    assert 0.9 < far_off(found, BODY) / found.sigma < 1.1  # raised by just one standard deviation


@pytest.mark.parametrize("stated", [Calibration(2e-4, 0, 0), Calibration(0, 2e-4, 0), Calibration(0, 0, 1e-3)])
def test_a_wrong_calibration_errs_as_foretold(stated):
    """Each of its seven ways to be wrong, one by one: their squares add up."""
    picture = Painter.table().cylinder(BODY).seen(np.random.default_rng(6), 1.0)
    right, off = FINDER.find(picture).body, []
    for way in np.eye(7):
        wrong = replace(FINDER, camera=stated.wrong(CAMERA, way)).find(picture).body
        off.append((wrong.x - right.x, wrong.y - right.y, wrong.radius - right.radius))
    found, told = np.sqrt(np.square(off).sum(axis=0)), np.sqrt(np.diag(stated.spread(CAMERA, BODY)))
    assert found == pytest.approx(told, rel=0.05, abs=5e-6)
