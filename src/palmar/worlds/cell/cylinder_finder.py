"""Finds an upright cylinder of known height in a colour picture: axis, radius, and how sure that is.

Blobs of the cylinder's colour give a first guess; then the edge is looked for along normals of the outline that the guess
foretells, to a fraction of a pixel, and the outline is fitted to it by Gauss and Newton. Where hand or arm hide the edge
it is not found, and what is left of it tells less: the covariance comes from the points that were used.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import hypot

import numpy as np
from numpy.typing import NDArray

from palmar.worlds.cell.camera_model import PinholeCamera
from palmar.worlds.cell.opencv import cv2
from palmar.worlds.cell.upright_outline import Upright, off_outline, outline

Floats = NDArray[np.float64]
Counts = NDArray[np.int_]
Flags = NDArray[np.bool_]
Bytes = NDArray[np.uint8]
Picture = NDArray[np.uint8]
LEAST_RED, LEAST_SHARE = 50, 0.42
"""A pixel of the cylinder's colour: red (of 255), and by which share of it green is less."""
LEAST_BLUE = 40
"""Of what lies beyond the cylinder's edge (of 255)."""
BLUR, UNCLEAN = 1.6, 0.20
"""Width (px) of a clean edge; by which share of its step a profile may differ from one: more, and another edge is near."""
LEAST_AREA, MOST_BLOBS = 60.0, 3
"""Of a blob (px); how many, the largest first, are tried one by one."""
EDGE = 0.02
"""By how much (px, standard deviation) all edges of one side or rim together may be seen too far out or in."""
LIFT = 1e-4
"""By which the body is raised to see what that does (m)."""
SPACING, LEAST_SEEN, MOST_OFF = 2.0, 0.40, 0.6
"""Between points of the outline (px); the share of them that must be seen; by how much (px, rms) they may miss it."""
RADII = (0.010, 0.060)
"""Other radii (m) are not what is looked for."""
REACH = 0.08
"""It is looked for so near (m) to where it is expected: lifted by the hand it seems nearer to the camera and larger."""
BEYOND, MOST_STRAY = 4.0, 0.02
"""So far (px) beyond the outline nothing has the cylinder's colour, but for so small a share."""
BRIGHT = 0.7
"""What lies beyond the cylinder is, in blue, nearly as bright all around: less, and it is a hand in front of the edge."""
GUESSES, WIDTHS = 12, (6, 4, 4)
"""Steps toward a guess, at most; half widths (px) of the searches for the edge."""


@dataclass(frozen=True, eq=False)
class Found:
    """``body``; covariance (3, 3) of x, y, radius (m²); share of the outline that was seen; rms of what is left (px)."""

    body: Upright
    covariance: Floats
    seen: float
    left: float

    @property
    def sigma(self) -> float:
        """Root mean square error (m) of the axis' place."""
        return float(np.sqrt(self.covariance[0, 0] + self.covariance[1, 1]))


@dataclass(frozen=True, eq=False)
class _Edges:
    """At points of the outline: how they move out (n, 3) with x, y, radius (px/m); how far out (n,) the edge is (px);
    trust (n,) in it; the piece (n,) it is on; how far out (n,) it goes if all is lifted (px/m); at which share of all
    points an edge was found; and at which share something of the cylinder's colour lies beyond.
    """

    moves: Floats
    off: Floats
    trust: Floats
    pieces: Counts
    rise: Floats
    seen: float
    stray: float


@dataclass(frozen=True, eq=False)
class CylinderFinder:
    """``camera`` as its calibration says it is; ``low``, ``high``: known heights (m) of the cylinder's rims.

    ``bob`` (m): standard deviation of how much higher or lower it is; ``near``: where it is looked for, within REACH.
    """

    camera: PinholeCamera
    low: float
    high: float
    near: tuple[float, float]
    bob: float = 0.0

    def find(self, picture: Picture) -> Found | None:
        """In a picture (height, width, 3) RGB; None where there is no cylinder, or too little of it to tell."""
        blue, mask = np.ascontiguousarray(picture[..., 2]), _of_its_colour(picture)
        guesses = [self._guess(points) for points in _rims(mask)]
        found = [self._fit(blue, mask, guess) for guess in guesses if guess is not None]
        good = [each for each in found if each is not None]
        return max(good, key=lambda each: each.seen, default=None)

    def _guess(self, points: Floats) -> Upright | None:
        """From pixels (n, 2) on the rim of a blob."""
        ray = self.camera.rays(points.mean(axis=0))
        x, y, _ = self.camera.place + ray * (0.5 * (self.low + self.high) - self.camera.place[2]) / ray[2]
        body: Upright | None = Upright(x, y, 0.5 * sum(RADII), self.low, self.high)
        for _ in range(GUESSES):
            assert body is not None
            off, slopes = off_outline(self.camera, body, points)
            before, body = body, _stepped(body, slopes, -off, _trust(off, 1e-3))
            if body is None or hypot(body.x - before.x, body.y - before.y, body.radius - before.radius) < 1e-4:
                return body
        return body

    def _fit(self, blue: Bytes, mask: Bytes, body: Upright) -> Found | None:
        found = None
        for width in WIDTHS:
            edges = self._edges(blue, mask, body, width)
            stepped = None if edges is None else _stepped(body, edges.moves, edges.off, edges.trust)
            if edges is None or stepped is None:
                return None
            step = np.array([stepped.x - body.x, stepped.y - body.y, stepped.radius - body.radius])
            found, body = self._told(stepped, replace(edges, off=edges.off - edges.moves @ step)), stepped
        return found

    def _edges(self, blue: Bytes, mask: Bytes, body: Upright, width: int) -> _Edges | None:
        """Where edges are beside the outline of ``body``; None where too few are."""
        line = outline(self.camera, body, SPACING)
        off, good = _edge(blue, line.pixels, line.out, width)
        if good.mean() < LEAST_SEEN:
            return None
        off, points = off[good], line.points[good]
        raised = self.camera.pixels(points + np.array([0.0, 0.0, LIFT])) - line.pixels[good]
        rise = (raised * line.out[good]).sum(axis=1) / LIFT
        trust = _trust(off - np.median(off), 0.05)
        stray = _levels(mask, (line.pixels + BEYOND * line.out)[None]).mean()
        return _Edges(line.moves[good], off, trust, line.pieces[good], rise, float(good.mean()), float(stray))

    def _told(self, body: Upright, edges: _Edges) -> Found | None:
        trust = edges.trust
        left = float(np.sqrt((trust * edges.off**2).sum() / max(trust.sum() - 3.0, 1.0)))
        seen = edges.seen * float((trust > 0.0).mean())
        away = hypot(body.x - self.near[0], body.y - self.near[1])
        if left > MOST_OFF or seen < LEAST_SEEN or away > REACH or edges.stray > MOST_STRAY:
            return None
        weighted = edges.moves * trust[:, None]
        inverse = np.linalg.inv(weighted.T @ edges.moves)
        common = np.stack([weighted[edges.pieces == piece].sum(axis=0) for piece in range(4)])
        spread = common.T @ common * EDGE**2 + left**2 * weighted.T @ weighted
        lifted = self.bob * weighted.T @ edges.rise
        spread += np.outer(lifted, lifted)
        return Found(body, inverse @ spread @ inverse, seen, left)


def _of_its_colour(picture: Picture) -> Bytes:
    """1 where a pixel (height, width) has the cylinder's colour, however it is lit."""
    red = picture[..., 0]
    redder = cv2.subtract(red, picture[..., 1])
    return ((red >= LEAST_RED) & (redder > LEAST_SHARE * red)).astype(np.uint8)


def _rims(mask: Bytes) -> list[Floats]:
    """Pixels (n, 2) on the rims of the largest blobs, one by one and all together; not those on the picture's border."""
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    large = sorted(
        (each for each in contours if cv2.contourArea(each) >= LEAST_AREA), key=cv2.contourArea, reverse=True
    )
    height, width = mask.shape
    rims = []
    for each in large[:MOST_BLOBS]:
        points = each[:, 0, :].astype(float)
        inside = ((points > 0) & (points < (width - 1, height - 1))).all(axis=1)
        if inside.sum() > 20:
            rims.append(points[inside])
    return [*rims, np.concatenate(rims)] if len(rims) > 1 else rims


def _edge(blue: Bytes, pixels: Floats, out: Floats, width: int) -> tuple[Floats, Flags]:
    """How far (n,) along ``out`` (n, 2) from pixels (n, 2) the cylinder ends, and whether it does there.

    The cylinder is not blue at all, however it is lit, and what lies beyond is: the share of blue in a pixel is that of
    what lies beyond. The step between the levels at both ends of a profile that has its area is the edge.
    """
    along = np.arange(-width, width + 1.0)
    places = pixels[:, None] + along[:, None] * out[:, None]
    profile = _levels(blue, places)
    end = width // 2 + 1
    inner, outer = profile[:, :end].mean(axis=1), profile[:, -end:].mean(axis=1)
    height, breadth = blue.shape
    inside = ((places >= 0) & (places <= (breadth - 1, height - 1))).all(axis=(1, 2))
    good = inside & (outer > LEAST_BLUE) & (inner < 0.35 * outer)
    good &= outer > BRIGHT * np.median(outer[good]) if good.any() else False
    share = (profile - inner[:, None]) / np.where(good, outer - inner, 1.0)[:, None]
    off = 0.5 * len(along) - share.sum(axis=1)
    clean = np.clip((along - off[:, None]) / BLUR + 0.5, 0.0, 1.0)
    return off, good & (np.abs(share - clean).max(axis=1) < UNCLEAN)


def _levels(channel: Bytes, pixels: Floats) -> Floats:
    """Of one channel at pixels (m, n, 2), between them too; 0 beyond the picture."""
    places = pixels.astype(np.float32)
    levels: Floats = cv2.remap(channel, places[..., 0], places[..., 1], cv2.INTER_LINEAR).astype(float)
    return levels


def _trust(off: Floats, least: float) -> Floats:
    """Tukey's weights (n,); the scale is that of the median, ``least`` at least."""
    scale = 4.7 * max(1.48 * float(np.median(np.abs(off))), least)
    weights: Floats = np.maximum(1.0 - (off / scale) ** 2, 0.0) ** 2
    return weights


def _stepped(body: Upright, slopes: Floats, off: Floats, trust: Floats) -> Upright | None:
    """One step of Gauss and Newton; None where it leads nowhere."""
    weighted = slopes * trust[:, None]
    normal = weighted.T @ slopes
    if np.linalg.cond(normal) > 1e8:
        return None
    dx, dy, dr = np.linalg.solve(normal, weighted.T @ off)
    radius = body.radius + dr
    if not RADII[0] <= radius <= RADII[1]:
        return None
    return replace(body, x=body.x + dx, y=body.y + dy, radius=radius)
