"""Can the test-bed hand hold its disk, and from where does closing catch it?"""

from palmar.models.shipped import open_case
from palmar.regions.build import published_region
from palmar.studies.closure import closure_answer

name, case = open_case("testbed_table")
answer = closure_answer(case)
print(f"{name}: {answer.object.reason}")

region = published_region(case)
radius_mm = 1e3 * region.allowed_error.radius
print(f"the disk may be {radius_mm:.1f} mm off, by the {region.model.value} region ({region.guarantee.meaning})")
