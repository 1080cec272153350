"""Soft contacts in zero gravity: how hard does the first finger strike, and what do three ways to close make of that?"""

from palmar.models.behaviour import BehaviourName
from palmar.models.shipped import open_case
from palmar.studies.run_behaviour import Circumstances, run_behaviour
from palmar.worlds.planar.soft import soft_world

_, case = open_case("soft_fingers")
circumstances = Circumstances(tick=0.001, make=soft_world)
for name in (BehaviourName.CLOSE, BehaviourName.LET_GO, BehaviourName.TOUCH_DOWN):
    given = case.model_copy(update={"behaviour": case.behaviour.model_copy(update={"name": name})})
    trace = run_behaviour(given, (*case.start.at, 0.0), circumstances).trace
    forces = [(row.seen.time, max(row.seen.forces or (0.0,))) for row in trace.rows]
    touch = next(time for time, force in forces if force > 0.0)
    first = max(force for time, force in forces if time < touch + 0.05)
    print(f"{name.value}: {first:.1f} N at the first touch, {trace.outcome.value} after {forces[-1][0]:.1f} s")
