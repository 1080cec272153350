"""What can be asked, in which steps it is answered, and how long each may take."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Lane(Enum):
    """Long steps never take the last worker, so that quick ones need not wait for them."""

    QUICK = "quick"
    LONG = "long"


@dataclass(frozen=True)
class Step:
    """One call of a worker: its lane, its limit, and for how long (s) nothing newer may come before it is worth its time."""

    lane: Lane
    seconds: float
    rest: float = 0.0


class Kind(Enum):
    """What a message asks for."""

    LOOK = "look"
    SIMULATE = "simulate"
    BEHAVIOUR_REGION = "behaviour_region"
    PAINT = "paint"
    PLAN = "plan"
    TESTBED = "testbed"
    CLOSURE_MAP = "closure_map"
    MAP_HAND = "map_hand"
    DESIGN = "design"
    BRIEF = "brief"
    BRIEF_FRONT = "brief_front"
    BRIEFS = "briefs"
    EXPERIMENTS = "experiments"
    CASES = "cases"
    READ_TOML = "read_toml"
    WRITE_TOML = "write_toml"
    EXPORT = "export"
    """Comes by POST, not over the socket."""


MOMENT, PAUSE = 0.05, 0.15
"""The command line's numbers, and those of them that are slow, wait until nothing has been changed for so long."""
LONG_PAUSE = 0.4
"""So do searches that take seconds."""

_QUICK, _LONG = Step(Lane.QUICK, 3.0), Step(Lane.LONG, 60.0)

STEPS: dict[Kind, tuple[Step, ...]] = {
    Kind.LOOK: (_QUICK, Step(Lane.LONG, 10.0), Step(Lane.LONG, 10.0, MOMENT), Step(Lane.LONG, 120.0, PAUSE)),
    Kind.SIMULATE: (Step(Lane.LONG, 20.0),),
    Kind.BEHAVIOUR_REGION: (_LONG, Step(Lane.LONG, 300.0)),
    Kind.PAINT: (Step(Lane.LONG, 10.0), Step(Lane.LONG, 60.0, PAUSE)),
    Kind.PLAN: (Step(Lane.LONG, 120.0),),
    Kind.TESTBED: (Step(Lane.LONG, 20.0), _LONG),
    Kind.CLOSURE_MAP: (_LONG,),
    Kind.MAP_HAND: (Step(Lane.LONG, 20.0),),
    Kind.DESIGN: (Step(Lane.LONG, 300.0),),
    Kind.BRIEF: (_QUICK, Step(Lane.LONG, 300.0, LONG_PAUSE)),
    Kind.BRIEF_FRONT: (Step(Lane.LONG, 300.0, LONG_PAUSE),),
    Kind.BRIEFS: (_QUICK,),
    Kind.EXPERIMENTS: (Step(Lane.LONG, 120.0),),
    Kind.CASES: (_QUICK,),
    Kind.READ_TOML: (_QUICK,),
    Kind.WRITE_TOML: (_QUICK,),
    Kind.EXPORT: (Step(Lane.LONG, 300.0),),
}

DRAWN = ("svg", "pdf", "png")
EXPORTS: dict[str, tuple[str, ...]] = {
    "region": (*DRAWN, "dxf", "geojson", "csv", "json"),
    "comparison": DRAWN,
    "solid": ("stl", "ply", "glb"),
    "film": ("gif", "html", "mp4"),
    "trace": ("json", "csv", "gif", *DRAWN),
    "simulation": ("json",),
    "plan": (*DRAWN, "gif", "json"),
    "map": (*DRAWN, "json"),
    "closure": ("json",),
    "report": ("html",),
    "figure": DRAWN,
    "case": ("toml",),
    "design": (*DRAWN, "json"),
    "brief": ("toml",),
}
"""What is written as a file, and as which."""
