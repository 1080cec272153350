"""What a controller makes of sightings: stale ones and frozen ones are refused, fresh ones are averaged."""

from __future__ import annotations

from dataclasses import dataclass, replace

from palmar.models.cell_messages import Sighting

OLDEST = 0.20
"""Age (s) beyond which a sighting is stale."""
ALIKE = 4
"""So many sightings in a row that agree to the last bit are one frozen frame: real ones are noisy."""
KEPT = 12
"""Sightings averaged."""


@dataclass(frozen=True)
class Seen:
    """Fresh sightings so far, the latest last; how many in a row were the same."""

    kept: tuple[Sighting, ...] = ()
    same: int = 0

    def take(self, sighting: Sighting | None, now: float) -> Seen:
        """With the sighting that is there at time ``now`` (s), if it is a new one and not stale."""
        if sighting is None or now - sighting.stamp_s > OLDEST:
            return self
        if self.kept and sighting.stamp_s <= self.kept[-1].stamp_s:
            return self
        last = self.kept[-1] if self.kept else None
        same = last is not None and (last.x_m, last.y_m, last.radius_m) == (
            sighting.x_m,
            sighting.y_m,
            sighting.radius_m,
        )
        return replace(self, kept=(*self.kept[1 - KEPT :], sighting), same=self.same + 1 if same else 0)

    def fresh(self, now: float) -> bool:
        """Whether the arm may move by it at time ``now`` (s)."""
        return bool(self.kept) and now - self.kept[-1].stamp_s <= OLDEST and self.same < ALIKE

    @property
    def place(self) -> tuple[float, float]:
        """Mean of the axis (m)."""
        number = len(self.kept)
        return sum(each.x_m for each in self.kept) / number, sum(each.y_m for each in self.kept) / number

    @property
    def radius(self) -> float:
        """Mean (m)."""
        return sum(each.radius_m for each in self.kept) / len(self.kept)

    @property
    def sigma(self) -> float:
        """Of one sighting (m), the largest told."""
        return max(each.sigma_m for each in self.kept)
