"""The case file: what is written is read back, and whatever is wrong is told in one line."""

import math
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from palmar.errors import InputError
from palmar.models.case import Behaviour, Case, Range, Start
from palmar.models.case_file import dump_case, parse_case, read_case
from palmar.models.contact import Contact
from palmar.models.hand import Fingers, Hand
from palmar.models.objects import ConvexPolygon, Disk
from palmar.models.sensors import SensorLayout, Sensors
from palmar.models.shipped import description, open_case, shipped_names, shipped_text
from palmar.models.support import Pressure, Support, SupportKind
from palmar.models.text_file import FEW_LINES

SMALLEST = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137.0, 107]\n[object]\nradius_mm = 38\n"

lengths = st.floats(1e-4, 10.0)
coordinates = st.floats(-10.0, 10.0)


@st.composite
def hands(draw):
    links = tuple(draw(st.lists(lengths, min_size=1, max_size=3)))
    limited = draw(st.booleans())
    return Hand(
        palm_width=draw(lengths),
        finger_links=links,
        finger_thickness=draw(st.floats(0.0, 1.99)) * sum(links),
        fingers=draw(st.sampled_from(Fingers)),
        open=draw(st.floats(0.0, 1.5)),
        finger_rate=draw(st.floats(0.01, 10.0)),
        finger_mass=draw(st.none() | st.floats(0.01, 100.0)),
        joint_limits=((0.0, 3.0), *((-1.0, 1.0) for _ in links[1:])) if limited else None,
    )


@st.composite
def polygons(draw):
    angles = sorted(draw(st.sets(st.integers(0, 359), min_size=4, max_size=12)))
    size = draw(st.floats(0.01, 1.0))
    corners = tuple((size * math.cos(math.radians(a)), size * math.sin(math.radians(a))) for a in angles)
    return ConvexPolygon(shape="polygon", vertices=corners, mass=draw(st.floats(0.1, 9.0)))


@st.composite
def cases(draw):
    disks = st.builds(Disk, radius=lengths, mass=st.floats(0.1, 9.0))
    contact = draw(st.builds(Contact, friction=st.floats(0.0, 5.0), restitution=st.floats(0.0, 1.0)))
    points = st.tuples(coordinates, coordinates)
    ranges = ()
    if draw(st.booleans()):
        low, high = sorted(draw(st.tuples(st.floats(0.0, 5.0), st.floats(0.0, 5.0))))
        ranges = (Range(place=("contact", "friction"), low=low, high=high),)
        contact = Contact(friction=0.5 * (low + high), restitution=contact.restitution)
    return Case(
        hand=draw(hands()),
        object=draw(disks | polygons()),
        contact=contact,
        support=Support(
            kind=draw(st.sampled_from(SupportKind)),
            friction=draw(st.floats(0.0, 5.0)),
            pressure=draw(st.sampled_from(Pressure)),
            pressure_centre=draw(points),
        ),
        start=Start(at=draw(points), theta=draw(st.floats(-7.0, 7.0)), velocity=draw(points)),
        sensors=Sensors(layout=draw(st.sampled_from(SensorLayout)), displacement=draw(st.floats(0.0, 0.1))),
        behaviour=Behaviour(),
        ranges=ranges,
    )


def numbers(value):
    """All numbers of a nested dump, in order, and everything else."""
    if isinstance(value, dict):
        return [each for item in value.values() for each in numbers(item)]
    if isinstance(value, list | tuple):
        return [each for item in value for each in numbers(item)]
    return [value]


@given(cases())
@settings(max_examples=200, deadline=None)
def test_a_case_survives_the_file(case):
    again = parse_case(dump_case(case))
    for was, now in zip(numbers(case.model_dump()), numbers(again.model_dump()), strict=True):
        assert now == pytest.approx(was, rel=1e-15, abs=0.0) if isinstance(was, float) else now == was


def test_round_decimals_are_written_as_they_were_read():
    text = dump_case(parse_case(SMALLEST + "[start]\nat_mm = [0.1, -23.7]\ntheta_deg = 33.3\n"))
    for expected in (
        "palm_width_mm = 120.0",
        "[137.0, 107.0]",
        "at_mm = [0.1, -23.7]",
        "theta_deg = 33.3",
        "deg_s = 30.0",
    ):
        assert expected in text


def test_the_smallest_case_has_the_documented_defaults():
    case = parse_case(SMALLEST)
    assert case.hand.half_palm == 0.06
    assert case.hand.finger_length == pytest.approx(0.244)
    assert (case.hand.finger_thickness, case.hand.fingers, case.hand.open) == (0.0, Fingers.CROSSING, 0.0)
    assert math.degrees(case.hand.finger_rate) == pytest.approx(30.0)
    assert (case.contact.friction, case.contact.restitution, case.object.mass) == (0.7, 1.0, 1.0)
    assert (case.support.kind, case.support.friction) == (SupportKind.TABLE, 0.3)
    assert case.start.at == (0.0, 0.12)


def test_a_range_holds_its_middle_and_its_corners_are_the_ends():
    case = parse_case(SMALLEST.replace("= 38", '= "30 .. 40"') + '[contact]\nfriction = "0.2..0.8"\n')
    assert case.object.radius == pytest.approx(0.035)
    found = {(corner.object.radius, corner.contact.friction) for corner in case.corners()}
    assert found == {(0.03, 0.2), (0.03, 0.8), (0.04, 0.2), (0.04, 0.8)}
    assert all(corner.ranges == () for corner in case.corners())


def test_a_range_inside_a_list_is_found():
    case = parse_case(SMALLEST.replace("107", '"100..110"'))
    assert sorted(corner.hand.finger_links[1] for corner in case.corners()) == [0.1, 0.11]


WRONG = {
    "": "[hand]: is missing",
    "[hand]\n": "hand.palm_width_mm: is missing",
    "hand = 3": "hand = 3: must be a table",
    SMALLEST.replace("120", "-5"): "hand.palm_width_mm = -5: must be at least 1e-06 mm",
    SMALLEST.replace("120", "2e6"): "hand.palm_width_mm = 2000000.0: must be at most 1e+06 mm",
    SMALLEST.replace("120", '"a"'): 'hand.palm_width_mm = "a": must be a number in mm',
    SMALLEST.replace("38", "nan"): "object.radius_mm = NaN: must be a finite number",
    SMALLEST.replace("38", "inf"): "object.radius_mm = Infinity: must be a finite number",
    SMALLEST.replace("38", "9" * 400): "must be a finite number",
    SMALLEST.replace("107", "true"): "hand.finger_links_mm[1] = true: must be a number in mm",
    SMALLEST.replace("[137.0, 107]", "[]"): "hand.finger_links_mm = []: needs at least 1 entries, has 0",
    SMALLEST.replace("radius_mm = 38", ""): "object.radius_mm: is missing",
    SMALLEST.replace("radius_mm", "radius"): "object.radius: unknown key, did you mean radius_mm?",
    SMALLEST.replace("radius_mm = 38", 'shape = "star"'): 'object.shape = "star": must be "disk" or "polygon"',
    SMALLEST + "[moon]\n": "unknown section",
    SMALLEST + '[support]\nkind = "moon"\n': "must be one of 'table' or 'free'",
    SMALLEST + '[contact]\nfriction = "0.8..0.2"\n': "the lower end of a range comes first",
    SMALLEST + '[contact]\nfriction = "0..1e400"\n': "both ends of a range must be finite",
    SMALLEST + '[contact]\nfriction = "-0.8..0.2"\n': "must be at least 0",
    SMALLEST + "[contact]\nrestitution = 1.5\n": "contact.restitution = 1.5: must be at most 1",
    SMALLEST + "[start]\nat_mm = [1, 2, 3]\n": "start.at_mm = [1, 2, 3]: needs at most 2 entries, has 3",
    SMALLEST + "[start]\nat_mm = 1979-05-27\n": "must be a list of numbers in mm",
    SMALLEST.replace("120", "120\nfinger_thickness_mm = 1000"): "less than twice the finger's length",
    SMALLEST.replace("120", "120\njoint_limits_deg = [[0, 90]]"): "needs 2 pairs",
    SMALLEST.replace("120", "120\njoint_limits_deg = [[90, 0], [0, 1]]"): "lowest below highest",
    "a = ": "is not valid TOML",
    "a = " + "[" * 5000: "is not valid TOML",
}


@pytest.mark.parametrize(("text", "expected"), WRONG.items())
def test_wrong_input_is_told_in_one_line_with_file_field_value_and_what_is_allowed(text, expected):
    with pytest.raises(InputError) as caught:
        parse_case(text, "my.toml")
    message = str(caught.value)
    assert message.startswith("my.toml")
    assert expected in message
    assert len(message) < 250


POLYGONS = {
    "[[0, 0], [1, 0], [0.1, 0.1], [0, 1]]": "corner 3 is not",
    "[[0, 0], [1, 0]]": "needs at least 3 entries",
    "[[0, 0], [1, 0], [2, 0], [3, 0]]": "three corners that are not on one line",
    "[[0, 0], [1, 0], [0, 1], [1, 1]]": "must be the outline of a convex polygon",
    "[[0, 10], [6, -8], [-9.5, 3], [9.5, 3], [-6, -8]]": "must be the outline of a convex polygon",
    "[[0, 0], [1, 0], [nan, 1]]": "must be a finite number",
    "5": "must be a list of numbers in mm",
}


@pytest.mark.parametrize(("vertices", "expected"), POLYGONS.items())
def test_wrong_polygons_are_refused(vertices, expected):
    text = SMALLEST.replace("radius_mm = 38", f'shape = "polygon"\nvertices_mm = {vertices}')
    with pytest.raises(InputError, match=r"object\.vertices_mm") as caught:
        parse_case(text, "my.toml")
    assert expected in str(caught.value)


def test_a_polygon_is_kept_counter_clockwise_without_repeated_and_straight_points():
    text = SMALLEST.replace(
        "radius_mm = 38", 'shape = "polygon"\nvertices_mm = [[0, 0], [0, 10], [0, 20], [20, 20], [20, 20], [20, 0]]'
    )
    corners = parse_case(text).object.vertices
    assert set(corners) == {(0.0, 0.0), (0.02, 0.0), (0.02, 0.02), (0.0, 0.02)}
    assert len(corners) == 4
    area = sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1], strict=True))
    assert area > 0.0


values = st.one_of(
    st.floats(), st.integers(), st.booleans(), st.text(max_size=8), st.lists(st.floats(), max_size=4),
    st.lists(st.lists(st.floats(-5, 5), min_size=2, max_size=2), max_size=6),
)  # fmt: skip
KEYS = [line.split(" = ")[0] for line in dump_case(parse_case(SMALLEST)).splitlines() if " = " in line]


def toml(value) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, str):
        return (
            '"'
            + "".join(f"\\u{ord(c):04X}" if ord(c) < 0x10000 else "?" for c in value if not 0xD800 <= ord(c) < 0xE000)
            + '"'
        )
    if isinstance(value, list):
        return f"[{', '.join(map(toml, value))}]"
    return str(value)


@given(
    st.dictionaries(st.sampled_from(KEYS), values, max_size=3),
    st.sampled_from(["hand", "object", "contact", "support", "start"]),
)
@settings(max_examples=400, deadline=None)
def test_any_values_give_a_case_or_one_line(changes, section):
    lines = {"hand": ["palm_width_mm = 120", "finger_links_mm = [137.0]"], "object": ["radius_mm = 38"]}
    kept = {name: [line for line in rows if line.split(" = ")[0] not in changes] for name, rows in lines.items()}
    kept.setdefault(section, []).extend(f"{key} = {toml(value)}" for key, value in changes.items())
    text = "\n".join(f"[{name}]\n" + "\n".join(rows) for name, rows in kept.items())
    try:
        assert isinstance(parse_case(text, "my.toml"), Case)
    except InputError as error:
        assert str(error).startswith("my.toml")


@given(st.text(max_size=200))
@settings(max_examples=200, deadline=None)
def test_any_text_gives_a_case_or_one_line(text):
    with pytest.raises(InputError):
        parse_case(text, "my.toml")


def test_files_that_cannot_be_read(tmp_path: Path):
    with pytest.raises(InputError, match="cannot be read: No such file"):
        read_case(tmp_path / "missing.toml")
    with pytest.raises(InputError, match="cannot be read: Is a directory"):
        read_case(tmp_path)
    binary = tmp_path / "binary.toml"
    binary.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="is not text in UTF-8"):
        read_case(binary)
    huge = tmp_path / "huge.toml"
    with huge.open("wb") as file:
        file.truncate(1_000_000_000)
    with pytest.raises(InputError, match=f"is larger than {FEW_LINES} bytes"):
        read_case(huge)


def test_shipped_cases_are_listed_described_and_read():
    names = shipped_names()
    assert {"testbed_table", "testbed_free", "chapter2_example", "chapter3_example", "zero_g_example"} <= set(names)
    for name in names:
        title, case = open_case(name)
        assert title == name
        assert description(name) not in ("", shipped_text(name))
        assert parse_case(dump_case(case)) == case
    with pytest.raises(InputError, match="did you mean testbed_table"):
        open_case("testbed_tabel")


def test_a_file_wins_over_a_shipped_name(tmp_path: Path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("testbed_table").write_text(SMALLEST.replace("38", "17"))
    assert open_case("testbed_table")[1].object.radius == 0.017


def test_a_wall_is_no_nearer_than_the_open_fingers_reach() -> None:
    hand = "[hand]\npalm_width_mm = 120\nopen_deg = 90\nfinger_links_mm = [137, 107]\n"
    text = f"{hand}[object]\nradius_mm = 38\n[support]\n"
    assert parse_case(text + "wall_mm = 244", "x").support.wall == pytest.approx(0.244)
    with pytest.raises(InputError, match="wall_mm must be at least 244, as far as the open fingers reach"):
        parse_case(text + "wall_mm = 243", "x")
    with pytest.raises(InputError, match="wall_mm"):
        parse_case(text + "wall_mm = -1", "x")


def test_a_bend_beyond_the_distal_joint_s_limits_is_refused():
    text = """
        [hand]
        palm_width_mm = 60
        finger_links_mm = [50, 40]
        joint_limits_deg = [[0, 120], [-5, 90]]
        [object]
        radius_mm = 20
        [behaviour]
        name = "close_coupled"
        ratio = -1
        bend_deg = 41
    """
    case = parse_case(text)
    assert case.behaviour.ratio == -1.0 and case.open_joints == (0.0, pytest.approx(math.radians(41.0)))
    assert parse_case(dump_case(case)) == case
    with pytest.raises(InputError, match="bend_deg must lie within the distal joint's limits, -5 to 90"):
        parse_case(text.replace("bend_deg = 41", "bend_deg = -6"))
    straight = parse_case(text.replace("close_coupled", "curl_and_close").replace("bend_deg = 41", "bend_deg = 100"))
    assert straight.open_joints == (0.0, 0.0)
