"""The specification of a sweep: what is read, and what is refused in one line."""

from dataclasses import replace

import pytest

from palmar.errors import InputError
from palmar.models.device import Device
from palmar.models.sweep_file import open_sweep, parse_sweep, shipped_sweeps

GOOD = """
[sweep]
case = "testbed_table"
samples = 5
[vary]
"object.radius_mm" = { from = 20.0, to = 40.0, steps = 3 }
"contact.friction" = [0.0, 0.5]
"start.at_mm.0" = { uniform = [-100.0, 100.0] }
"""


def test_rows_are_every_combination_of_the_grids_times_the_draws():
    sweep = parse_sweep(GOOD)
    assert (sweep.rows, [each.key for each in sweep.grids]) == (30, ["object.radius_mm", "contact.friction"])
    assert sweep.axes[0].numbers == (20.0, 30.0, 40.0)


def test_numbers_are_put_in_at_their_keys_in_the_units_of_the_file():
    case = parse_sweep(GOOD).case_at({"object.radius_mm": 31.0, "start.at_mm.0": -7.0})
    assert case.object.radius == pytest.approx(0.031)
    assert case.start.at == pytest.approx((-0.007, 0.12))


def test_the_digest_knows_the_case_and_the_draws_but_not_the_name():
    one = parse_sweep(GOOD, "one")
    assert one.digest == parse_sweep(GOOD, "other").digest
    changes = (
        ("samples = 5", "samples = 6"),
        ("testbed_table", "testbed_table_thick"),
        ("-100.0", "-99.0"),
        ("0.5", "0.4"),
    )
    for old, new in changes:
        assert parse_sweep(GOOD.replace(old, new)).digest != one.digest
    assert replace(one, device=Device.GPU).digest != one.digest


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('"testbed_table"', '"testbed_tabel"', "did you mean testbed_table"),
        ("samples = 5", "samples = 0", "samples = 0: must be a whole number, 1 to"),
        ("samples = 5", 'command = "dance"', 'command = "dance": must be one of closure, region'),
        ("samples = 5", "sample = 5", "did you mean samples?"),
        ('"object.radius_mm"', '"object.radius"', "vary.object.radius = 20: .*did you mean radius_mm?"),
        ('"start.at_mm.0"', '"start.at_mm.2"', "names no number"),
        ("[0.0, 0.5]", "[0.0, -0.5]", "vary.contact.friction = -0.5: "),
        ("[0.0, 0.5]", "[]", "must be a list of 1 to"),
        ("uniform = [-100.0, 100.0]", "uniform = [100.0, -100.0]", "must be lower and upper end"),
        ("uniform = [-100.0, 100.0]", "normal = [100.0]", "must be mean and standard deviation"),
        ("uniform = [-100.0, 100.0]", "log_uniform = [0.0, 1.0]", "must be lower and upper end"),
        ("uniform = [-100.0, 100.0]", "values = [nan]", "must be a finite number"),
        ("uniform = [-100.0, 100.0]", "evenly = [1.0]", "or one of values, uniform"),
        ("{ uniform = [-100.0, 100.0] }", "[1.0]", "nothing is drawn, every row would be the same"),
        ("[vary]", "[vari]", "did you mean vary?"),
    ],
)
def test_what_is_not_allowed_is_refused_in_one_line(old, new, told):
    assert old in GOOD
    with pytest.raises(InputError, match=told) as refused:
        parse_sweep(GOOD.replace(old, new))
    assert "\n" not in str(refused.value)


def test_every_shipped_sweep_is_read_and_an_unknown_one_is_not():
    assert [open_sweep(name).rows for name in shipped_sweeps()] == [1_000_000]
    with pytest.raises(InputError, match="shipped are sweep_table"):
        open_sweep("sweep_tabel")
