"""Closing told tick by tick: in the planar world it is what the batch kernels say."""

from __future__ import annotations

import numpy as np
import pytest

from palmar.errors import NotCoveredError
from palmar.models.case_file import parse_case
from palmar.studies.simulate import simulate_start, simulate_starts
from palmar.studies.simulate_in_world import TICK, simulate_start_in, simulate_starts_in
from palmar.worlds.planar.feedback import feedback_world

TEXT = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\n[object]\nradius_mm = 38\n"
CASE = parse_case(TEXT)


def test_many_starts_end_as_in_the_batch() -> None:
    starts = np.random.default_rng(6).uniform([-0.25, 0.03], [0.25, 0.25], (10, 2))
    batch, told = simulate_starts(CASE, starts), simulate_starts_in(CASE, starts, feedback_world)
    assert told.codes.tolist() == batch.codes.tolist()
    assert told.poses == pytest.approx(batch.poses, abs=1e-5)
    assert told.fingers == pytest.approx(batch.fingers, abs=1e-5)


@pytest.mark.parametrize("start", [(0.1, 0.12), (0.24, 0.2)])
def test_one_start_has_the_events_of_the_kernel_to_a_tick(start: tuple[float, float]) -> None:
    kernel, told = simulate_start(CASE, start), simulate_start_in(CASE, start, feedback_world)
    assert told.outcome is kernel.outcome
    assert told.left == pytest.approx(kernel.left, abs=1e-5)

    def first_touches(events: object) -> list[tuple[float, str]]:
        return [(time, each.body.replace("_tip", "_link")) for time, each in events if each.kind in ("touch", "stall")]

    found, expected = first_touches(told.events), first_touches(kernel.events)
    for (time, body), (other, where) in zip(found[:1], expected[:1], strict=True):
        assert body == where
        assert 0.0 <= time - other + 1e-9 <= TICK + 1e-9
    assert told.events[-1][1].kind == "end"
    assert told.events[-1][1].body == kernel.outcome.value


def test_other_behaviours_than_closing_are_refused() -> None:
    with pytest.raises(NotCoveredError, match="scoop"):
        simulate_start_in(parse_case(TEXT + '[behaviour]\nname = "scoop"\n'), (0.0, 0.1), feedback_world)
