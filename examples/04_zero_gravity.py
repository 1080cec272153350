"""A disk afloat before an open hand: how far from where it is thought to be may it be, and how fast may it drift?"""

from palmar.models.case_file import parse_case
from palmar.models.shipped import shipped_text
from palmar.regions.build import build_region
from palmar.studies.velocity_tolerance import velocity_tolerance

text = shipped_text("zero_g_example")
for restitution in ("1.0", "0.4"):
    case = parse_case(text.replace("restitution = 1.0", f"restitution = {restitution}"), "zero_g_example")
    circle = build_region(case).allowed_error
    assert circle is not None
    speed = velocity_tolerance(case, circle.centre).radius
    print(f"restitution {restitution}: {1e3 * circle.radius:.0f} mm at rest, or {1e3 * speed:.0f} mm/s in the middle")
