"""The page of the test bed: every row, each limit with its distance from the theory, and no request that leaves it."""

from palmar.faces.pages.bed_page import bed_page, limits_table
from palmar.studies.bed_report import ANGLES, FREE_ANGLES, BedReport, Preshape, Row, Turn

THEORY = Row("published theory", "construction", (0.2, 0.25, None, 0.3, 0.3))
FOUND = Row("line fingers", "kernels", (0.19, None, 0.2, 0.3, 0.33))


def test_limits_stand_beside_the_theory():
    heads, rows = limits_table((THEORY, FOUND), ANGLES)
    assert len(heads) == 2 + len(ANGLES)
    assert rows[0][2:5] == ("200.0 mm", "250.0 mm", "-")
    assert rows[1][2:] == ("190.0 mm (-5.0 %)", "-", "200.0 mm", "300.0 mm", "330.0 mm (+10.0 %)")


def test_the_page_has_all_of_it():
    free = Row("corrected theory", "construction", (0.1,) * len(FREE_ANGLES))
    turns, shapes = (Turn("thick <fingers>", 0.1, 0.5),), (Preshape("lines", 0.35, 0.36),)
    page = bed_page(BedReport((THEORY, FOUND), turns, (free,), shapes))
    for words in ("190.0 mm (-5.0 %)", "thick &lt;fingers&gt;", "20.63 deg", "20.05 deg", "100.0 mm", "image/svg+xml"):
        assert words in page
    assert "http" not in page.replace("http://www.w3.org", "")
