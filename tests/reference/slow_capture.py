"""A free disk and a moving hand, slowly: the gap is the distance to the segments at closely spaced times, nothing else.

Shares no formula with the kernels: links from joint angles, distances by projection on segments, wall velocities by
central differences, contacts by a change of sign between samples, refined by sampling again.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.ndimage import label


@dataclass
class SlowHand:
    """``joints`` (2, n) at time 0, turning by ``programme``: (duration, rates (2, n)) one after the other, then at rest."""

    half_palm: float
    lengths: list
    radius: float
    half_thickness: float
    joints: np.ndarray
    programme: list

    def angles(self, times):
        """Joint angles (T, 2, n)."""
        times = np.asarray(times, float)
        found, begin = np.broadcast_to(np.asarray(self.joints, float), (len(times), 2, len(self.lengths))).copy(), 0.0
        for duration, rates in self.programme:
            found += np.clip(times - begin, 0.0, duration)[:, None, None] * np.asarray(rates, float)
            begin += duration
        return found

    def segments(self, times):
        """Ends (T, 1 + 2n, 2, 2) of palm, right and left links."""
        absolute = np.cumsum(self.angles(times), axis=2)
        steps = np.stack([np.cos(absolute), np.sin(absolute)], axis=3) * np.asarray(self.lengths)[None, None, :, None]
        corners = np.concatenate([np.zeros_like(steps[:, :, :1]), np.cumsum(steps, axis=2)], axis=2)
        corners[..., 0] += self.half_palm
        corners[:, 1, :, 0] *= -1.0
        links = np.stack([corners[:, :, :-1], corners[:, :, 1:]], axis=3)
        palm = np.tile([[[-self.half_palm, 0.0], [self.half_palm, 0.0]]], (len(absolute), 1, 1, 1))
        return np.concatenate([palm, links[:, 0], links[:, 1]], axis=1)

    def nearest(self, times, places):
        """(gaps (T, 1 + 2n), nearest points (T, 1 + 2n, 2)) of disks at places (T, 2)."""
        ends = self.segments(times)
        a, along = ends[:, :, 0], ends[:, :, 1] - ends[:, :, 0]
        off = places[:, None] - a
        part = np.clip((off * along).sum(2) / (along * along).sum(2), 0.0, 1.0)
        points = a + part[..., None] * along
        thick = np.full(ends.shape[1], self.half_thickness)
        thick[0] = 0.0
        return np.linalg.norm(places[:, None] - points, axis=2) - self.radius - thick, points

    def wall(self, time, body, place):
        """(normal, velocity of the wall) where the disk at ``place`` touches ``body``."""
        _, points = self.nearest(np.array([time]), place[None])
        point = points[0, body]
        normal = (place - point) / np.linalg.norm(place - point)
        thick = 0.0 if body == 0 else self.half_thickness
        surface, h = point + thick * normal, 1e-6
        ends = self.segments(np.array([time - h, time, time + h]))[:, body]
        frames = [np.stack([u, [-u[1], u[0]]]) for u in (e[1] - e[0] for e in ends)]
        local = np.linalg.solve(frames[1].T, surface - ends[1, 0])
        moved = [ends[k, 0] + frames[k].T @ local for k in (0, 2)]
        return normal, (moved[1] - moved[0]) / (2.0 * h)


@dataclass
class SlowRun:
    impacts: list = field(default_factory=list)
    time: float = 0.0
    place: np.ndarray = None
    velocity: np.ndarray = None


def fly(hand, place, velocity, begin, end, samples=20_000):
    """First (time, body) in (begin, end) at which a gap turns negative, or None."""
    low, high = begin, end
    fresh = True
    for _ in range(9):
        grid = np.linspace(low, high, samples)
        if fresh:
            grid = np.union1d(grid, begin + np.geomspace(1e-7, 1.0, 400) * (end - begin))[1:]
        gaps, _ = hand.nearest(grid, place + velocity * (grid - begin)[:, None])
        least = gaps.min(axis=1)
        below = np.flatnonzero(least < 0.0)
        if len(below) == 0:
            return None if fresh else (high, int(np.argmin(gaps[-1])))
        k = int(below[0])
        if k == 0:
            return grid[0], int(np.argmin(gaps[0]))
        low, high, fresh, samples = grid[k - 1], grid[k], False, 200
        body = int(np.argmin(gaps[k]))
        if high - low < 1e-15:
            break
    return high, body


def simulate(hand, place, velocity, restitution, end, most=50, samples=20_000):
    """Impacts (time, body, place, velocity after) until ``end``, none of which comes sooner than 1e-7 of the rest."""
    run = SlowRun(place=np.array(place, float), velocity=np.array(velocity, float))
    gaps, _ = hand.nearest(np.zeros(1), run.place[None])
    for body in np.flatnonzero(gaps[0] < 1e-12):
        normal, wall = hand.wall(0.0, body, run.place)
        approach = (wall - run.velocity) @ normal
        if approach > 1e-9:
            run.velocity = run.velocity + (1.0 + restitution) * approach * normal
            run.impacts.append((0.0, int(body), run.place, run.velocity))
    while len(run.impacts) < most:
        hit = fly(hand, run.place, run.velocity, run.time, end, samples)
        if hit is None:
            run.place, run.time = run.place + run.velocity * (end - run.time), end
            return run
        time, body = hit
        run.place, run.time = run.place + run.velocity * (time - run.time), time
        normal, wall = hand.wall(time, body, run.place)
        run.velocity = run.velocity + (1.0 + restitution) * ((wall - run.velocity) @ normal) * normal
        run.impacts.append((time, body, run.place, run.velocity))
    return run


def drag_along(hand, place, velocity, end, step=2e-4):
    """Moreau's time stepping for restitution 0: (place, velocity) at ``end``, with an error of the order of the step."""
    place, velocity, time = np.array(place, float), np.array(velocity, float), 0.0
    while time < end:
        h = min(step, end - time)
        time += h
        place = place + velocity * h
        for _ in range(50):
            gaps, points = hand.nearest(np.array([time]), place[None])
            body = int(np.argmin(gaps[0]))
            if gaps[0, body] >= -1e-12:
                break
            normal = (place - points[0, body]) / np.linalg.norm(place - points[0, body])
            place = place - gaps[0, body] * normal
            velocity = velocity - gaps[0, body] / h * normal
    return place, velocity


def flood(hand, time, spacing):
    """(coordinates along x and y, parts of the free places on that grid, the number of the outer one; 0 is not free)."""
    far = hand.half_palm + sum(hand.lengths) + 3.0 * (hand.radius + hand.half_thickness)
    axis = np.arange(-far, far + spacing, spacing)
    x, y = np.meshgrid(axis, axis, indexing="ij")
    free = np.ones(x.shape, bool)
    for body, (a, b) in enumerate(hand.segments(np.array([time]))[0]):
        along = b - a
        part = np.clip(((x - a[0]) * along[0] + (y - a[1]) * along[1]) / (along @ along), 0.0, 1.0)
        off = hand.radius + (hand.half_thickness if body else 0.0)
        free &= np.hypot(x - a[0] - part * along[0], y - a[1] - part * along[1]) >= off
    parts, _ = label(free)
    return axis, parts, parts[0, 0]
