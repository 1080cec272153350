"""Each row's numbers: the count through the grids, and draws that any stretch of rows makes alike."""

import itertools

import numpy as np
from scipy.stats import kstest

from palmar.models.sweep_file import parse_sweep
from palmar.studies.sweep.values import uniform, values

SWEEP = parse_sweep("""
[sweep]
case = "testbed_table"
samples = 4
seed = 9
[vary]
"object.radius_mm" = [20.0, 30.0, 40.0]
"start.at_mm.1" = { normal = [120.0, 5.0] }
"contact.friction" = [0.1, 0.5]
"object.mass_kg" = { log_uniform = [0.1, 10.0] }
""")


def test_grids_are_counted_like_nested_loops_the_last_fastest():
    found = values(SWEEP, 0, SWEEP.rows)
    expected = [each for each in itertools.product([20.0, 30.0, 40.0], [0.1, 0.5]) for _ in range(4)]
    assert list(zip(found["object.radius_mm"], found["contact.friction"], strict=True)) == expected


def test_a_stretch_of_rows_is_the_same_alone():
    whole = values(SWEEP, 0, SWEEP.rows)
    for first, last in ((0, 1), (5, 17), (23, 24)):
        part = values(SWEEP, first, last)
        assert all(np.array_equal(part[key], whole[key][first:last]) for key in whole)


def test_the_generator_is_splitmix64():
    """The published sequence from state 0: its first outputs (Vigna's reference)."""
    import hashlib

    start = int.from_bytes(hashlib.sha256(b"key").digest()[:8], "little")

    def next_of(state):
        mask = 2**64 - 1
        z = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9 & mask
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB & mask
        return z ^ (z >> 31)

    assert next_of(0x9E3779B97F4A7C15) == 0xE220A8397B1DCDAF
    expected = [((next_of((start + (i + 1) * 0x9E3779B97F4A7C15) % 2**64) >> 12) + 0.5) / 2**52 for i in range(6)]
    assert uniform("key", np.arange(6)).tolist() == expected


def test_draws_have_their_distributions_and_columns_are_not_alike():
    rows = np.arange(40_000)
    one, other = uniform("1:a", rows), uniform("1:b", rows)
    assert kstest(one, "uniform").pvalue > 1e-3
    assert abs(np.corrcoef(one, other)[0, 1]) < 0.02
    many = parse_sweep(f"""
[sweep]
case = "testbed_table"
samples = {len(rows)}
[vary]
"start.at_mm.1" = {{ normal = [120.0, 5.0] }}
"object.mass_kg" = {{ log_uniform = [0.1, 10.0] }}
""")
    found = values(many, 0, len(rows))
    assert kstest((found["start.at_mm.1"] - 120.0) / 5.0, "norm").pvalue > 1e-3
    assert kstest(0.5 * (1.0 + np.log10(found["object.mass_kg"])), "uniform").pvalue > 1e-3
