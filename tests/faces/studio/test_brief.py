"""A brief put to the studio: the command line's hand, its bound at once, its front, files, limits, and bad input."""

import asyncio
import json
import sys

import pytest

from palmar.errors import InputError
from palmar.faces.records import finite
from palmar.faces.studio import kinds, pool, seat
from palmar.faces.studio.answering import answered
from palmar.faces.studio.kinds import STEPS, Kind, Lane, Step
from palmar.faces.studio.pool import Pool
from palmar.models.case_file import build_case
from palmar.models.design_brief_file import parse_brief, shipped_brief_text, shipped_briefs

OCTAGON, SHORT = shipped_brief_text("source_half_octagon"), shipped_brief_text("too_short")
FLOATING = {"targets": {"radii_mm": 30, "support": "free", "error_mm": 5}}
ROOMY = {"targets": {"radii_mm": 40, "error_mm": 30}, "limits": {"links": [1], "margin": 0}}


def parts(kind, parameters, steps=None):
    """Of all steps: (name, stage, value) in the order in which they come."""
    return [
        (each.name, each.stage, json.loads(json.dumps(finite(each.value), allow_nan=False)))
        for step in (range(len(STEPS[kind])) if steps is None else steps)
        for each in answered(kind, step, None, parameters)
    ]


def test_a_brief_is_answered_as_on_the_command_line(palmar):
    bound, found, tried = parts(Kind.BRIEF, {"brief": OCTAGON, "cases": 300})
    told = palmar("design", "source_half_octagon", "--cases", 300, "--json").record
    assert bound[:2] == ("bound", "quick")
    assert bound[2]["least_m"] == told["size_at_least_m"]
    assert found[:2] == ("design", "quick")
    assert found[2]["record"] == told | {"verification": None}
    assert tried[:2] == ("design", "settled")
    assert tried[2]["record"] == told
    said = palmar("design", "source_half_octagon", "--cases", 300).out
    assert all(words in said for row in tried[2]["rows"] for words in row)


def test_the_hand_found_is_a_case_before_the_largest_object():
    hand = parts(Kind.BRIEF, {"brief": ROOMY, "cases": 300})[-1][2]["hand"]
    case = build_case(hand["case"])
    assert case.object.radius == 0.04
    assert 2.0 * (case.hand.half_palm + case.hand.finger_length) == pytest.approx(4.0 * 0.07, rel=2e-3)
    assert [1e3 * each for each in case.start.at] == pytest.approx(hand["place_mm"])
    assert hand["error_mm"] == pytest.approx(30.0, rel=5e-3)


def test_impossible_is_an_answer_and_comes_at_once(palmar):
    bound, answer = parts(Kind.BRIEF, {"brief": SHORT})
    said = palmar("design", "too_short").out
    assert bound[2]["impossible"] == answer[2]["impossible"]
    assert bound[2]["impossible"] in said
    assert answer[2]["record"] == palmar("design", "too_short", "--json").record
    assert answer[2]["hand"] is None


def test_with_an_error_one_link_is_bound_by_more_than_several():
    for links, least in (([1], 4.0 * 0.07), ([1, 2], 2.0 * 0.1)):
        brief = {"targets": ROOMY["targets"], "limits": {"links": links}}
        ((_, _, value),) = parts(Kind.BRIEF, {"brief": brief}, [0])
        assert value["least_m"] == pytest.approx(least * 1.01)


def test_a_search_that_takes_long_is_only_begun_if_asked_for(monkeypatch):
    searched = []
    monkeypatch.setattr("palmar.faces.studio.answers.brief.stages", lambda *given: iter(searched.append(given) or ()))
    ((_, _, value),) = parts(Kind.BRIEF, {"brief": FLOATING})
    assert not value["soon"]
    assert searched == []
    parts(Kind.BRIEF, {"brief": FLOATING, "search": True})
    assert len(searched) == 1


def test_the_front_grows_point_by_point_to_the_command_lines(palmar, tmp_path):
    brief = tmp_path / "roomy.toml"
    brief.write_text("[targets]\nradii_mm = 40\nerror_mm = 30\n[limits]\nlinks = [1]\nmargin = 0\n")
    values = [value for _, _, value in parts(Kind.BRIEF_FRONT, {"brief": ROOMY, "front": 2})]
    fronts, ends = ([each[name] for each in values] for name in ("points", "least_m"))
    told = palmar("design", brief, "--front", 2, "--cases", 10, "--json").record["front"]
    assert [len(each) for each in fronts] == [1, 2]
    assert ends[0] == ends[1] == pytest.approx([4.0 * 0.085, 0.045])
    assert [[each["size_m"], each["error_m"]] for each in fronts[-1]] == told
    assert build_case(fronts[-1][1]["case"]).hand.finger_length > 0.04


def test_no_points_are_no_front():
    assert parts(Kind.BRIEF_FRONT, {"brief": ROOMY, "front": 0}) == []
    with pytest.raises(InputError, match="there is none: no hand meets the brief"):
        parts(Kind.BRIEF_FRONT, {"brief": SHORT, "front": 1})


def test_shipped_briefs_are_listed_opened_and_written_back():
    ((_, _, known),) = parts(Kind.BRIEFS, {})
    assert [each["name"] for each in known["briefs"]] == shipped_briefs()
    assert known["briefs"][0]["description"].startswith("Sensors on palm")
    ((_, _, one),) = parts(Kind.BRIEFS, {"name": "table_parts"})
    ((_, _, same),) = parts(Kind.BRIEFS, {"brief": one["brief"]})
    assert same == one
    assert parse_brief(one["toml"]) == parse_brief(shipped_brief_text("table_parts"))


@pytest.mark.parametrize(("what", "ending"), [("design", "json"), ("design", "svg"), ("brief", "toml")])
def test_an_exported_file_is_the_command_lines(palmar, tmp_path, what, ending):
    wish = {"what": what, "format": ending, "parameters": {"brief": OCTAGON, "cases": 300}}
    (file,) = answered(Kind.EXPORT, 0, None, wish)
    words = ("design", "source_half_octagon", "--cases", 300)
    if ending == "json":
        assert json.loads(file.data) == palmar(*words, "--json").record
    elif ending == "svg":
        palmar(*words, "--out", tmp_path / file.name)
        assert file.data == (tmp_path / file.name).read_bytes()
    else:
        assert parse_brief(file.data.decode()) == parse_brief(OCTAGON)


@pytest.mark.parametrize(
    ("kind", "parameters", "words"),
    [
        (Kind.BRIEF, {}, "parameters.brief: is missing"),
        (Kind.BRIEF, {"brief": 3}, "parameters.brief"),
        (Kind.BRIEF, {"brief": "[targets"}, "brief: is not valid TOML"),
        (Kind.BRIEF, {"brief": {"targets": {"radii_mm": "45..25"}}}, "targets.radii_mm"),
        (Kind.BRIEF, {"brief": {"targets": {"radii_mm": 1e308}}}, "targets.radii_mm"),
        (Kind.BRIEF, {"brief": {"targets": {"radii_mm": 10**400}}}, "targets.radii_mm"),
        (Kind.BRIEF, {"brief": {"targets": {"radii_mm": []}}}, "must be a list of numbers"),
        (Kind.BRIEF, {"brief": {"targets": {"vertices_mm": [[0, 0]] * 90_000}}}, "targets.vertices_mm"),
        (Kind.BRIEF, {"brief": {"targets": []}}, "must be a table"),
        (Kind.BRIEF, {"brief": {"x" * 300: {}}}, "unknown section"),
        (Kind.BRIEF, {"brief": SHORT, "cases": 10**9}, "parameters.cases"),
        (Kind.BRIEF, {"brief": SHORT, "cases": True}, "parameters.cases"),
        (Kind.BRIEF, {"brief": SHORT, "out": "/tmp/x"}, "parameters.out: unknown"),
        (Kind.BRIEF_FRONT, {"brief": SHORT, "front": 51}, "parameters.front"),
        (Kind.BRIEFS, {"name": "../secret"}, "no shipped brief"),
        (Kind.EXPORT, {"what": "design", "format": "svg", "parameters": {"brief": SHORT}}, "there is no hand to draw"),
        (Kind.EXPORT, {"what": "brief", "format": "toml", "parameters": {}}, "parameters.brief: is missing"),
    ],
)
def test_bad_input_is_one_clear_line(kind, parameters, words):
    with pytest.raises(InputError) as refused:
        for step in range(len(STEPS[kind])):
            list(answered(kind, step, None, parameters))
    told = str(refused.value)
    assert words in told
    assert len(told) < 500
    assert "\n" not in told


def test_a_hand_of_no_palm_is_built_as_narrow_as_can_be():
    slim = {"targets": {"radii_mm": 61.3, "friction": 45}, "limits": {"links": [1], "finger_length_mm": "61.3..82.7"}}
    assert parts(Kind.BRIEF, {"brief": slim, "cases": 10})[-1][2]["record"]["possible"]


class Asker:
    """A client that waits for the end."""

    reads = True

    def __init__(self):
        self.end = asyncio.get_running_loop().create_future()

    def part(self, job, slot, frame):
        """Not looked at."""

    def ended(self, job, error):
        self.end.set_result(error)


def test_a_search_over_its_limit_is_stopped_and_says_so(monkeypatch):
    busy = "import sys, time; sys.stdout.buffer.write(bytes([0, 0, 0, 1]) + b'r'); sys.stdout.flush(); time.sleep(60)"
    monkeypatch.setattr(seat, "COMMAND", (sys.executable, "-c", busy))
    monkeypatch.setattr(pool, "CHECKED_EVERY", 0.02)
    assert [each.seconds for each in STEPS[Kind.BRIEF]] == [3.0, 300.0]
    monkeypatch.setitem(kinds.STEPS, Kind.BRIEF, (Step(Lane.LONG, 0.2),))

    async def ask():
        from palmar.faces.studio.job import Job

        running, client = Pool(2), Asker()
        await running.start()
        running.submit(Job(client, Kind.BRIEF, {}, None, {}))
        try:
            return await asyncio.wait_for(client.end, 10.0)
        finally:
            await running.stop()

    assert asyncio.run(ask()) == "took longer than 0.2 s and was stopped; the command line has no such limit"
