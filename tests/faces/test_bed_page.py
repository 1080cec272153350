"""The page of the test bed: every row, each limit with its distance from the theory, and no request that leaves it."""

from palmar.faces.pages.bed_page import bed_page, effects_table, limits_table, preshapes_table
from palmar.studies.bed_report import ANGLES, FREE_ANGLES, BedReport, Effect, Meaning, Preshape, Row, Turn

THEORY = Row("published theory", "construction", (0.2, 0.25, None, 0.3, 0.3))
FOUND = Row("line fingers", "kernels", (0.19, None, 0.2, 0.3, 0.33))


def test_limits_stand_beside_the_theory():
    heads, rows = limits_table((THEORY, FOUND), ANGLES)
    assert len(heads) == 2 + len(ANGLES)
    assert rows[0][2:5] == ("200.0 mm", "250.0 mm", "-")
    assert rows[1][2:] == ("190.0 mm (-5.0 %)", "-", "200.0 mm", "300.0 mm", "330.0 mm (+10.0 %)")


def test_the_page_has_all_of_it():
    free = Row("corrected theory", "construction", (0.1,) * len(FREE_ANGLES))
    turns = (Turn("thick <fingers>", 0.1, 0.5),)
    shapes = Preshape("line fingers", 0.35, 0.36), Preshape("stiction", None, 0.4)
    effects = (Effect("puck tilt", "tilt takes 0.2", "MuJoCo", -0.0012, 0.0345, 1e-3),)
    meanings = (Meaning("of the centre", "line fingers", -0.05, 0.01),)
    report = BedReport((THEORY, FOUND), turns, (free,), effects, meanings, shapes)
    page = bed_page(report)
    for words in ("190.0 mm (-5.0 %)", "thick &lt;fingers&gt;", "20.63 deg", "20.05 deg", "100.0 mm", "image/svg+xml"):
        assert words in page
    for words in ("puck tilt", "+34.5 mm", "-1.2 mm", "1 mm", "-5.0 %", "19.5 deg, theory", "35 deg measured"):
        assert words in page
    assert effects_table(report)[1] == [("puck tilt", "tilt takes 0.2", "MuJoCo", "-1.2 mm", "+34.5 mm", "1 mm")]
    assert preshapes_table(report)[1][1] == ("stiction", "-", "22.92 deg", "-")
    assert "http" not in page.replace("http://www.w3.org", "")
