"""Penalty contacts of the slow reference: a disk or a convex polygon against the links of a hand.

A hand is a list of segments ("bodies"): the palm, then the links of the right and of the left finger, each with
the velocities of its two ends. A contact pushes along its normal n (from the body into the object) with
N = k max(0, -gap) and drags along the tangent with -mu N u / sqrt(u^2 + eps^2), u = sliding velocity of the object.
Gaps are taken at the end of a step, directions and arms at some moment within it ("mid"), see slow_closing.

A polygon is given by its core, its edges moved inwards by a small distance, and every body is as much thicker: the
contacts are those of the polygon with its corners rounded to that radius, and their forces depend continuously on
the pose as long as nothing gets deeper than it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit


class Thing(NamedTuple):
    """The object, its support points and its contact law; lengths in finger lengths, forces in table frictions."""

    radius: float  # of a disk
    vertices: np.ndarray  # (m, 2) of a polygon's core, anticlockwise; empty for a disk
    rounding: float  # of a polygon's corners; 0 for a disk
    points: np.ndarray  # (p, 2) support
    weights: np.ndarray  # (p,), sum 1
    size: float  # turns angles into lengths
    stiffness: float
    friction: float
    eps: float  # speed below which friction fades
    viscous: float  # table drag proportional to speed, bounds the speed of snaps
    damping: float  # more of it in the shortest steps, divided by the step: makes them solvable


class Links(NamedTuple):
    """The bodies of the hand during one step."""

    ends: np.ndarray  # (b, 4) segments (x0, y0, x1, y1) at the end of the step
    mid: np.ndarray  # (b, 4) segments within the step
    rates: np.ndarray  # (b, 4) velocities of the two ends within the step
    thickness: np.ndarray  # (b,) half thickness, for a polygon plus its rounding


class Sum(NamedTuple):
    """What the contacts add up to."""

    wrench: np.ndarray  # (3,) about the object's pose
    slope: np.ndarray  # (3, 3) its derivative by the twist, with frictions that
    fading: np.ndarray  # (1,) follow their law (1) or stay in proportion to the sliding speed (0)
    forces: np.ndarray  # (b,) normal forces


@njit(error_model="numpy")
def nearest_on_segment(segment, x, y):
    """Fraction along the segment (x0, y0, x1, y1) of its point nearest to (x, y)."""
    along_x, along_y = segment[2] - segment[0], segment[3] - segment[1]
    fraction = ((x - segment[0]) * along_x + (y - segment[1]) * along_y) / (along_x**2 + along_y**2)
    return min(1.0, max(0.0, fraction))


@njit(error_model="numpy")
def add_contact(thing, links, body, depth, normal_x, normal_y, x, y, pose, twist, out):
    """Add one contact at (x, y), where object and body are compared: there both move as rigid bodies do."""
    normal_force = thing.stiffness * depth
    arm_x, arm_y = x - pose[0], y - pose[1]
    segment, rates = links.mid[body], links.rates[body]
    along_x, along_y = segment[2] - segment[0], segment[3] - segment[1]
    turn = along_x * (rates[3] - rates[1]) - along_y * (rates[2] - rates[0])
    turn /= along_x**2 + along_y**2
    body_x = rates[0] - turn * (y - segment[1])
    body_y = rates[1] + turn * (x - segment[0])
    lever = arm_x * normal_x + arm_y * normal_y  # moment of a unit force along the tangent (-n_y, n_x)
    slide = -normal_y * (twist[0] - body_x) + normal_x * (twist[1] - body_y) + lever * twist[2]
    speed = math.sqrt(slide**2 + thing.eps**2)
    drag = -thing.friction * normal_force * slide / speed
    out.wrench[0] += normal_force * normal_x - drag * normal_y
    out.wrench[1] += normal_force * normal_y + drag * normal_x
    out.wrench[2] += normal_force * (arm_x * normal_y - arm_y * normal_x) + drag * lever
    out.forces[body] += normal_force
    rate = -thing.friction * normal_force / speed * (1.0 - out.fading[0] * (slide / speed) ** 2)
    out.slope[0, 0] += rate * normal_y * normal_y
    out.slope[0, 1] -= rate * normal_y * normal_x
    out.slope[1, 0] -= rate * normal_y * normal_x
    out.slope[1, 1] += rate * normal_x * normal_x
    out.slope[0, 2] -= rate * normal_y * lever
    out.slope[2, 0] -= rate * normal_y * lever
    out.slope[1, 2] += rate * normal_x * lever
    out.slope[2, 1] += rate * normal_x * lever
    out.slope[2, 2] += rate * lever * lever


@njit(error_model="numpy")
def disk_gap(segment, thickness, radius, x, y):
    """Distance of a disk around (x, y) from a thick segment."""
    share = nearest_on_segment(segment, x, y)
    away_x = x - segment[0] - share * (segment[2] - segment[0])
    away_y = y - segment[1] - share * (segment[3] - segment[1])
    return math.sqrt(away_x**2 + away_y**2) - radius - thickness


@njit(error_model="numpy")
def add_disk_contacts(thing, links, pose_end, pose, twist, out):
    """All contacts of a disk, one for each body, towards the body's nearest point; returns the smallest gap."""
    nearest = 1e300
    for body in range(len(links.thickness)):
        half = links.thickness[body]
        gap = disk_gap(links.ends[body], half, thing.radius, pose_end[0], pose_end[1])
        nearest = min(nearest, gap)
        if gap >= 0.0:
            continue
        segment = links.mid[body]
        share = nearest_on_segment(segment, pose[0], pose[1])
        foot_x = segment[0] + share * (segment[2] - segment[0])
        foot_y = segment[1] + share * (segment[3] - segment[1])
        length = math.sqrt((pose[0] - foot_x) ** 2 + (pose[1] - foot_y) ** 2)
        n_x, n_y = (pose[0] - foot_x) / length, (pose[1] - foot_y) / length
        add_contact(thing, links, body, -gap, n_x, n_y, foot_x + half * n_x, foot_y + half * n_y, pose, twist, out)
    return nearest


@njit(error_model="numpy")
def placed(vertices, pose):
    """Vertices (m, 2) of a polygon in the hand's frame."""
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    world = np.empty_like(vertices)
    for i in range(len(vertices)):
        world[i, 0] = pose[0] + cos * vertices[i, 0] - sin * vertices[i, 1]
        world[i, 1] = pose[1] + sin * vertices[i, 0] + cos * vertices[i, 1]
    return world


@njit(error_model="numpy")
def end_to_edge(world, x, y):
    """(distance, edge) of a point outside the polygon from the edge its foot lies on; edge -1: a vertex is nearest."""
    count, best, edge = len(world), -1e300, -1
    for i in range(count):
        after = (i + 1) % count
        along_x, along_y = world[after, 0] - world[i, 0], world[after, 1] - world[i, 1]
        length = math.sqrt(along_x**2 + along_y**2)
        away_x, away_y = x - world[i, 0], y - world[i, 1]
        height = (away_x * along_y - away_y * along_x) / length
        if height > best:
            position = (away_x * along_x + away_y * along_y) / length
            best, edge = height, i if 0.0 <= position <= length else -1
    return best, edge


@njit(error_model="numpy")
def add_polygon_contacts(thing, links, pose_end, pose, twist, out):
    """All contacts of a polygon: its vertices on links, ends of links on its edges; returns the smallest gap.

    Where the end of a link faces an edge, the vertices beyond that end do not count: one contact passes
    continuously into the other.
    """
    nearest = 1e300
    world_end, world = placed(thing.vertices, pose_end), placed(thing.vertices, pose)
    count = len(world)
    for body in range(len(links.thickness)):
        half, at_end, segment = links.thickness[body], links.ends[body], links.mid[body]
        faces_edge = (False, False)
        for which in range(2):
            distance, edge = end_to_edge(world_end, at_end[2 * which], at_end[2 * which + 1])
            if edge < 0:
                continue
            faces_edge = (True, faces_edge[1]) if which == 0 else (faces_edge[0], True)
            nearest = min(nearest, distance - half)
            if distance < half:
                after = (edge + 1) % count
                n_x, n_y = world[edge, 1] - world[after, 1], world[after, 0] - world[edge, 0]
                length = math.sqrt(n_x**2 + n_y**2)
                n_x, n_y = n_x / length, n_y / length
                x, y = segment[2 * which] + half * n_x, segment[2 * which + 1] + half * n_y
                add_contact(thing, links, body, half - distance, n_x, n_y, x, y, pose, twist, out)
        for i in range(count):
            share = nearest_on_segment(at_end, world_end[i, 0], world_end[i, 1])
            if (share <= 0.0 and faces_edge[0]) or (share >= 1.0 and faces_edge[1]):
                continue
            gap = disk_gap(at_end, half, 0.0, world_end[i, 0], world_end[i, 1])
            nearest = min(nearest, gap)
            if gap < 0.0:
                x, y = world[i, 0], world[i, 1]
                share = nearest_on_segment(segment, x, y)
                n_x = x - segment[0] - share * (segment[2] - segment[0])
                n_y = y - segment[1] - share * (segment[3] - segment[1])
                length = math.sqrt(n_x**2 + n_y**2)
                add_contact(thing, links, body, -gap, n_x / length, n_y / length, x, y, pose, twist, out)
    return nearest
