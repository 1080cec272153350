"""The source's numbers, computed anew: those it has right are met to its rounding, the others are what they must be."""

import pytest

from palmar.faces.plots.source_figures import FIGURES
from palmar.studies.source_numbers import source_numbers


def of(chapter):
    return {each.what: each for each in source_numbers(chapter)}


def test_the_example_of_chapter_2_is_met_to_its_rounding():
    found = of(2).values()
    assert [each.printed for each in found] == [(0.226,), (0.974,), (0.220,), (2.054,)]
    assert all(abs(each.difference[0]) < 5e-4 for each in found)


def test_the_frictional_region_of_chapter_3_promises_too_much_and_the_other_too_little():
    structural, frictional = of(3).values()
    assert (structural.printed[0], structural.found[0]) == pytest.approx((4.770, 5.286), abs=1e-3)
    assert (frictional.printed[0], frictional.found[0]) == pytest.approx((6.328, 6.026), abs=1e-3)


def test_the_wrong_sign_of_chapter_4_explains_its_numbers():
    for each, right in zip(of(4).values(), (5.2511, 14.1735, 54.02, 31.44, 9.71), strict=True):
        assert each.found[0] == pytest.approx(right, abs=6e-3)
        as_printed = float(each.why.rsplit(" ", 1)[1])
        assert as_printed == pytest.approx(each.printed[0], abs=0.05)


def test_chapter_5_has_one_maximum_where_the_source_sees_several():
    maxima = [each for each in source_numbers(5) if len(each.printed) == 2]
    assert {each.found for each in maxima if each.figure != "5.4"} == {(0.25, 0.5)}
    assert [each.why for each in maxima if each.printed == each.found] == ["", ""]
    (count,) = (each for each in source_numbers(5) if each.figure == "5.6")
    assert (count.printed, count.found) == ((4.0,), (1.0,))
    shares = [each.found[0] for each in source_numbers(5) if each.figure == "5.8"]
    assert shares == pytest.approx([0.7854, 0.9481], abs=5e-5)


def test_what_was_measured_in_chapter_6():
    table, free, *preshapes = source_numbers(6)
    assert table.found[0] == pytest.approx(6.5, abs=0.1)
    assert 30.0 < free.found[0] < 45.0
    assert [each.found[0] for each in preshapes] == pytest.approx([20.31, 26.00, 26.00], abs=0.01)


def test_every_number_names_a_figure_that_is_redone_and_chapters_without_numbers_have_none():
    named = {each.figure for chapter in (2, 3, 4, 5) for each in source_numbers(chapter)}
    assert named <= FIGURES.keys()
    assert source_numbers(7) == ()
