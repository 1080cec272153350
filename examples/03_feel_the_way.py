"""With one bit on each link and on the palm: from how large an uncertainty is one approach enough?"""

from shapely import Point

from palmar.behaviours.policy import approaches, is_guaranteed
from palmar.models.case_file import with_layout
from palmar.models.shipped import open_case
from palmar.studies.plan import plan

_, case = open_case("testbed_table")
felt = with_layout(case, "palm,right_1,right_2,left_1,left_2", "sensors")
for radius_mm in (300, 340, 380):
    found = plan(felt, Point(0.0, 0.0).buffer(1e-3 * radius_mm), (0.0, 1.0), 3).found.policy
    print(
        f"known within {radius_mm} mm: {approaches(found) if is_guaranteed(found) else 'no'} approaches are certain to do"
    )
