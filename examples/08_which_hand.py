"""Which hand is the smallest that catches a disk of radius 40 mm that may be 30 mm off, if no friction can be relied on?"""

from palmar.models.design_brief_file import parse_brief
from palmar.studies.design.design import design

brief = parse_brief("""
[targets]
radii_mm = 40
error_mm = 30
[limits]
links = [1]
margin = 0
""")
found = design(brief, cases=2000)
assert found.chosen is not None and found.chosen.hand is not None and found.verification is not None
hand = found.chosen.hand
palm, finger = 1e3 * hand.palm_width, 1e3 * hand.finger_length
print(f"palm {palm:.1f}, fingers {finger:.1f} mm: {palm + 2.0 * finger:.1f} mm in all, 4 (R + e) = {4 * (40 + 30):.1f}")
print(f"{found.verification.violations} of {found.verification.cases} random cases lost; {', '.join(found.binds)} bind")
