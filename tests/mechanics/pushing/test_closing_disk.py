"""The closing hand on a disk, event to event: known thresholds, areas and closed forms, and invariants."""

from math import acos, atan, degrees, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from palmar.mechanics.closure.disk_2_2 import frictional_radii, structural_radii
from palmar.mechanics.pushing.closing import close_disk
from palmar.mechanics.pushing.closing_steps import carry_all
from palmar.mechanics.pushing.closing_tables import TIP_NODES, ClosingHand, build_tables
from palmar.mechanics.pushing.hand_pose import hand_motion
from palmar.mechanics.pushing.limit_surface import disk_surface, ellipsoid_surface
from palmar.mechanics.pushing.polygon_contacts import disk_body
from palmar.models.outcome import Outcome

MU35 = tan(radians(35.0))
SURFACE = disk_surface(0.5)


def example(friction: float) -> ClosingHand:
    return ClosingHand(1.0, 2.0, 0.0, 0.5, friction, 0.0, pi)


def outcomes(hand, starts, surface=SURFACE):
    ends = close_disk(hand, surface, starts)
    return [Outcome.from_code(int(code)) for code in ends.codes], ends


def test_thresholds_on_the_palm_line():
    found, ends = outcomes(example(0.0), [(2.1754, 0.5), (2.1760, 0.5)])
    assert found == [Outcome.STRUCTURAL, Outcome.ESCAPED]
    assert ends.poses[0] == pytest.approx([0.0, 0.5, 0.0], abs=1e-9)
    found, _ = outcomes(example(MU35), [(2.2835, 0.5), (2.2841, 0.5)])
    assert found == [Outcome.FRICTIONAL, Outcome.ESCAPED]


def test_starts_that_the_published_region_promises_and_that_end_free():
    found, ends = outcomes(example(MU35), [(2.3, 0.5), (1.1, 2.0)])
    assert found == [Outcome.ESCAPED, Outcome.ESCAPED]
    assert ends.poses[:, :2] == pytest.approx(np.array([[0.0, 2.291], [0.0, 2.291]]), abs=5e-4)


@pytest.mark.parametrize(("friction", "expected"), [(0.0, 10.017), (MU35, 25.100)])
def test_the_tip_phase_lasts_as_long_as_known(friction, expected):
    hand = example(friction)
    tables = build_tables(hand, SURFACE)
    alpha = atan(friction)
    beta = pi / 2 - acos((1.0 - 0.5 * np.cos(alpha)) / 2.0) + alpha
    position = beta / (pi / 2) * (TIP_NODES - 1)
    assert degrees(np.interp(position, np.arange(TIP_NODES), tables.turn)) == pytest.approx(expected, abs=1e-3)


def test_without_friction_the_tip_table_is_the_closed_form():
    tables = build_tables(example(0.0), SURFACE)
    beta = np.linspace(0.0, pi / 2, TIP_NODES)
    assert tables.rate == pytest.approx(1.0 + 4.0 * np.sin(beta), rel=1e-9)
    k = 4.0
    root = sqrt(k * k - 1.0)
    near, far = np.tan(beta / 2) + k - root, np.tan(beta / 2) + k + root
    closed = np.log(near / far * (k + root) / (k - root)) / root
    assert tables.turn == pytest.approx(closed, abs=1e-10)
    assert np.abs(tables.spin).max() < 1e-9


@pytest.mark.parametrize(("friction", "expected"), [(0.0, 5.286), (MU35, 6.026)])
def test_the_area_of_caught_starts(friction, expected):
    rows, columns, width, height = 900, 1000, 2.4, 1.8
    x, y = (np.arange(columns) + 0.5) / columns * width, 0.5 + (np.arange(rows) + 0.5) / rows * height
    starts = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    codes = close_disk(example(friction), SURFACE, starts).codes
    caught = np.isin(codes, [Outcome.STRUCTURAL.code, Outcome.FRICTIONAL.code]).sum()
    assert 2.0 * caught * width / columns * height / rows == pytest.approx(expected, rel=1e-3)


hands = st.builds(
    lambda d, length, share, mu: ClosingHand(d, length, 0.0, share * d, mu, 0.0, pi),
    st.floats(0.1, 2.0), st.floats(0.3, 3.0), st.floats(0.05, 2.5), st.sampled_from([0.0, 0.1, 0.4, 0.9]),
)  # fmt: skip


def random_starts(hand, count=300, seed=0):
    rng = np.random.default_rng(seed)
    wide, high = hand.half_palm + hand.length + hand.radius, hand.length + 2.0 * hand.radius
    return np.column_stack([rng.uniform(-wide, wide, count), rng.uniform(-0.2 * high, high, count)])


@given(hands)
@settings(deadline=None, max_examples=40)
def test_mirrored_starts_end_mirrored(hand):
    starts = random_starts(hand)
    surface = disk_surface(hand.radius)
    one, other = (close_disk(hand, surface, starts * [side, 1.0]) for side in (1.0, -1.0))
    assert np.array_equal(one.codes, other.codes)
    assert np.array_equal(one.poses, other.poses * [-1.0, 1.0, -1.0])
    assert np.array_equal(one.fingers, other.fingers[:, ::-1])


@given(hands)
@settings(deadline=None, max_examples=40)
def test_final_disks_do_not_overlap_the_hand_and_held_ones_touch_it(hand):
    ends = close_disk(hand, disk_surface(hand.radius), random_starts(hand))
    held = np.isin(ends.codes, [Outcome.STRUCTURAL.code, Outcome.FRICTIONAL.code])
    for column, side in ((0, 1.0), (1, -1.0)):
        psi = ends.fingers[:, column]
        px, py = side * ends.poses[:, 0] - hand.half_palm, ends.poses[:, 1]
        along = np.clip(px * np.cos(psi) + py * np.sin(psi), 0.0, hand.length)
        gap = np.hypot(px - along * np.cos(psi), py - along * np.sin(psi)) - hand.radius
        assert (gap[held] > -1e-7 * hand.length).all()
    assert (ends.poses[held, 1] >= hand.radius * (1.0 - 1e-9)).all()


@given(hands)
@settings(deadline=None, max_examples=40)
def test_only_disks_that_closure_allows_are_held(hand):
    ends = close_disk(hand, disk_surface(hand.radius), random_starts(hand))
    structural = structural_radii(hand.half_palm, hand.length).holds(hand.radius)
    frictional = frictional_radii(hand.half_palm, hand.length, atan(hand.friction)).holds(hand.radius)
    if not structural and hand.friction == 0.0:
        assert not (ends.codes == Outcome.STRUCTURAL.code).any()
    if not frictional:
        # One finger and the palm may still wedge a disk beside the axis; what closure excludes is the symmetric hold.
        held = ends.codes == Outcome.FRICTIONAL.code
        assert (np.abs(ends.poses[held, 0]) > 1e-6 * hand.length).all()


def test_without_friction_two_starts_never_spread_while_only_links_touch():
    hand = ClosingHand(1.0, 50.0, 0.0, 0.5, 0.0, 0.0, pi)
    rng = np.random.default_rng(3)
    first = np.column_stack([rng.uniform(-3, 3, 500), rng.uniform(0.5, 3, 500)])
    second = first + rng.normal(0.0, 0.05, first.shape)
    second[:, 1] = np.maximum(second[:, 1], 0.5)
    for last in (0.5, 1.0, 1.5, 2.0, 2.5):
        ends = [close_disk(hand._replace(last=last), SURFACE, each).poses[:, :2] for each in (first, second)]
        apart = np.linalg.norm(ends[0] - ends[1], axis=1)
        assert (apart <= np.linalg.norm(first - second, axis=1) + 1e-9).all()


def test_outcomes_do_not_depend_on_scale_or_on_the_unit_of_the_limit_surface():
    starts = random_starts(example(0.4))
    one = close_disk(example(0.4), SURFACE, starts)
    big = ClosingHand(1000.0, 2000.0, 0.0, 500.0, 0.4, 0.0, pi)
    many = close_disk(big, disk_surface(500.0), 1000.0 * starts)
    assert np.array_equal(one.codes, many.codes)
    assert many.poses[:, :2] == pytest.approx(1000.0 * one.poses[:, :2], abs=1e-5)


def test_the_limit_surface_matters_little_and_only_with_friction():
    starts = random_starts(example(0.4), 2000)
    exact, rough = (close_disk(example(0.4), each, starts).codes for each in (SURFACE, ellipsoid_surface(1.0 / 3.0)))
    assert (exact == rough).mean() > 0.99
    smooth = [close_disk(example(0.0), each, starts).codes for each in (SURFACE, ellipsoid_surface(1.0 / 3.0))]
    assert np.array_equal(*smooth)


@pytest.mark.parametrize("friction", [0.0, 0.3, 0.7])
def test_stopping_earlier_shows_the_way_there(friction):
    """Stopped at each of many angles, the disk is found on one continuous path, clear of the fingers."""
    hand = example(friction)
    tables = build_tables(hand, SURFACE)
    starts = np.concatenate([random_starts(hand, 40, 5), [(-2.2841, 0.5), (2.2835, 0.5), (0.4, 1.9)]])
    angles = np.linspace(0.0, pi, 4001)
    poses = np.stack([close_disk(hand._replace(last=each), SURFACE, starts, tables).poses for each in angles])
    steps = np.linalg.norm(np.diff(poses[:, :, :2], axis=0), axis=2)
    assert steps.max() < 0.05
    for side in (1.0, -1.0):
        c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
        px, py = side * poses[:, :, 0] - 1.0, poses[:, :, 1]
        along = np.clip(px * c + py * s, 0.0, 2.0)
        gap = np.hypot(px - along * c, py - along * s) - 0.5
        codes = close_disk(hand, SURFACE, starts, tables).codes
        free = np.isin(codes, [Outcome.ESCAPED.code])
        assert gap[:, free].min() > -1e-9


@pytest.mark.parametrize(("half_palm", "radius", "friction"), [(0.6, 0.09, 0.3), (1.0, 0.25, 0.5), (0.5, 0.2, 0.9)])
def test_a_disk_turns_up_to_the_wedge_between_finger_and_palm(half_palm, radius, friction):
    hand = ClosingHand(half_palm, 1.0, 0.0, radius, friction, 0.0, np.pi)
    surface, motion = disk_surface(radius), hand_motion(half_palm, [1.0])
    starts = np.column_stack([np.linspace(0.05, half_palm + 0.3, 60), np.full(60, radius + 0.05)])
    ends = close_disk(hand, surface, starts)
    wedged = (ends.codes <= Outcome.FRICTIONAL.code) & (np.abs(ends.poses[:, 1] - radius) < 1e-9)
    wedged &= np.abs(ends.poses[:, 0]) > 1e-6
    assert wedged.sum() >= 3
    _, rival, _ = carry_all(motion, disk_body(radius, friction), starts[wedged], 1e-9)
    assert np.abs(ends.poses[wedged] - rival[:, :3]).max() < 1e-6


def test_odd_starts():
    found, _ = outcomes(example(0.4), [(0.0, 0.4), (2.0, 0.2), (5.0, 5.0), (0.0, -3.0), (0.0, 0.5)])
    assert found[:4] == [Outcome.INVALID, Outcome.INVALID, Outcome.MISSED, Outcome.MISSED]
    assert found[4].caught


def test_thick_fingers_drag_the_disk_inwards():
    thick = ClosingHand(1.0, 2.0, 0.1, 0.5, 0.4, 0.0, pi - sin(0.05))
    plain, rough = (outcomes(thick._replace(friction=mu, last=1.2), [(2.0, 0.8)])[1].poses[0] for mu in (0.0, 0.4))
    assert rough[0] < plain[0] - 1e-3
    assert plain[2] == 0.0 and rough[2] < -1e-2
    assert outcomes(thick._replace(friction=0.0), [(0.5, 1.0)])[0] == [Outcome.STRUCTURAL]


def test_more_friction_catches_every_start_that_less_catches():
    rng = np.random.default_rng(5)
    for _ in range(25):
        d, radius, h = rng.uniform(0.15, 1.6), rng.uniform(0.03, 1.0), rng.choice([0.0, rng.uniform(0.0, 0.2)])
        hand = ClosingHand(d, 1.0, h, radius * min(d, 1.2), 0.0, rng.choice([0.0, 0.7]), pi - np.arcsin(h))
        starts = random_starts(hand, 2000, int(rng.integers(1000)))
        before = np.zeros(len(starts), bool)
        for friction in np.sort(rng.uniform(0.0, 1.2, 4)):
            now = close_disk(hand._replace(friction=friction), disk_surface(hand.radius), starts).codes <= 2
            assert not (before & ~now).any()
            before = now
