"""The same starts on processors and on a CUDA device: a simulated one, a compiler's without a device, a real one."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import find_spec

import numpy as np
import pytest
from numba import cuda

from palmar.errors import NotCoveredError
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.models.device import Device
from palmar.models.outcome import Outcome
from palmar.models.shipped import open_case
from palmar.studies.simulate import simulate_starts
from palmar.worlds.planar import on_gpu
from palmar.worlds.planar.free import free_world
from palmar.worlds.planar.table import table_world

TEMPLATE = """
[hand]
palm_width_mm = 120
finger_links_mm = [137, 107]
{hand}
[object]
radius_mm = {radius}
[contact]
friction = {friction}
restitution = {restitution}
[support]
kind = "{support}"
[behaviour]
{behaviour}
"""
PLAIN = {"hand": "", "radius": 38, "friction": 0.7, "restitution": 0.5, "support": "table", "behaviour": ""}
TABLE = [
    PLAIN,
    PLAIN | {"radius": 20, "friction": 1},
    PLAIN | {"hand": "open_deg = 40", "friction": 0},
    PLAIN | {"hand": "finger_thickness_mm = 20", "friction": 0.3},
    PLAIN | {"hand": "joint_limits_deg = [[0, 100], [0, 90]]", "radius": 80, "friction": 0},
]
FREE = [
    PLAIN | {"support": "free", "friction": 0},
    PLAIN | {"support": "free", "hand": "finger_thickness_mm = 20", "restitution": 0},
    PLAIN | {"support": "free", "hand": "finger_mass_kg = 0.5\nfinger_torque_N_m = 1", "friction": 0, "restitution": 1},
    PLAIN | {"support": "free", "behaviour": 'name = "close_coupled"\nratio = 0.5'},
]
SPECIAL = [(0.2, 0.01), (0.048, 0.0264), (-0.0565, 0.0267), (0.0306, 0.0267)]
"""Behind a finger that is not quite open; nearly on the palm, where a disk of 20 mm is wedged by one finger."""
CLOSE, MOST_APART = 1e-9, 0.02
"""m and rad; the part of the starts whose end a change of the last bit of the start may move farther than that."""


def case_of(words: dict[str, object]) -> Case:
    return parse_case(TEMPLATE.format(**words), "case")


def compare(number: int) -> set[str]:
    """Carry so many starts a case both ways and assert that they end alike.

    Returns the outcomes that were met, and "uneven_table", "uneven_free" where fingers ended at different angles.
    """
    random, met = np.random.default_rng(7), set()
    for words in TABLE + FREE:
        case, places = case_of(words), random.uniform([-0.3, -0.05], [0.3, 0.35], (number, 2))
        places[:4] = SPECIAL
        if words["support"] == "table":
            here, there = table_world(case).ends(places), on_gpu.table_ends(table_world(case), places)
        else:
            starts = np.column_stack([places, np.full(number, 0.3), random.normal(0.0, 0.02, (number, 2))])
            here, there = free_world(case).ends(starts), on_gpu.free_ends(free_world(case), starts)
        assert np.mean(here.codes != there.codes) <= 1e-4, words
        apart = np.abs(np.column_stack([here.poses - there.poses, here.fingers - there.fingers])).max(axis=1)
        assert np.sum(apart > CLOSE) <= max(1, MOST_APART * number), words
        assert np.any(apart > 0.0), "the device's own arithmetic differs in the last bits"
        met |= {Outcome.from_code(int(code)).value for code in here.codes}
        if np.sum(np.ptp(here.fingers, axis=1) > 1e-3) > 1:
            met.add(f"uneven_{words['support']}")
    return met


def python(code: str, **settings: str) -> subprocess.CompletedProcess[str]:
    paths = os.pathsep.join(each for each in sys.path if each)
    known = os.environ | {"PYTHONPATH": paths} | settings
    return subprocess.run([sys.executable, "-c", code], env=known, capture_output=True, text=True, check=False)


SIMULATED = """
from dataclasses import replace
import numpy as np
from worlds.test_on_gpu import compare
from palmar.models.device import Device
from palmar.models.sweep_file import open_sweep
from palmar.studies.sweep.answers import answers
from palmar.studies.sweep.values import values
from palmar.worlds.planar import on_gpu

on_gpu.ROWS_PER_LAUNCH, on_gpu.THREADS_PER_BLOCK = 30, 8
print(*compare(40))
asked = open_sweep("sweep_table")
given = values(asked, 0, 20)
(here, _), (there, _) = answers(asked, given), answers(replace(asked, device=Device.GPU), given)
assert all(np.allclose(here[name], there[name], atol=1e-9, equal_nan=True) for name in here), there
assert any((here[name] != there[name]).any() for name in here), "not carried by the device"
"""


def test_a_simulated_device_runs_the_kernels_to_the_same_ends():
    done = python(SIMULATED, NUMBA_ENABLE_CUDASIM="1")
    assert done.returncode == 0, done.stderr
    wanted = {each.value for each in Outcome if each is not Outcome.JAMMED} | {"uneven_table", "uneven_free"}
    assert set(done.stdout.split()) >= wanted


COMPILED = """
import numba, sys
import numpy as np
from numba import cuda
from numba.cuda import dispatcher
from cuda.pathfinder import DynamicLibNotFoundError, load_nvidia_dynamic_lib
from palmar.worlds.planar import on_gpu
from worlds.test_on_gpu import FREE, TABLE, case_of, free_world, table_world

try:
    load_nvidia_dynamic_lib("nvvm"), load_nvidia_dynamic_lib("nvrtc")
except DynamicLibNotFoundError as error:
    sys.exit(f"no compiler: {error}")


class Absent:
    compute_capability = (int(sys.argv[1]), 0)


dispatcher.get_current_device = lambda: Absent  # functions that kernels call ask it for what they are compiled
kernel, world = getattr(on_gpu, sys.argv[2]), None


def noted(_, starts, *world):
    codes, ends = np.empty(len(starts), np.int8), np.empty((len(starts), 5))
    types = tuple(numba.typeof(each) for each in (*world, starts, codes, ends))
    print(cuda.compile_ptx(kernel, types, cc=Absent.compute_capability)[0])


on_gpu._ends = noted
if sys.argv[2] == "_close_one":
    on_gpu.table_ends(table_world(case_of(TABLE[0])), np.zeros((1, 2)))
else:
    on_gpu.free_ends(free_world(case_of(FREE[0])), np.zeros((1, 5)))
"""


@pytest.mark.parametrize(("kernel", "major"), [("_close_one", 8), ("_close_one", 9), ("_capture_one", 9)])
def test_it_compiles_for_devices_that_are_not_here(kernel, major):
    pytest.importorskip("numba_cuda", reason="needs the extra palmar[gpu]")
    code = COMPILED.replace("sys.argv[1]", repr(str(major))).replace("sys.argv[2]", repr(kernel))
    done = python(code)
    if done.stderr.startswith("no compiler"):
        pytest.skip("needs NVIDIA's NVVM and NVRTC: the extra palmar[gpu] brings them")
    assert done.returncode == 0, done.stderr
    assert f".target sm_{major}0" in done.stdout
    assert ".visible .entry" in done.stdout
    assert "div.rn.f64" in done.stdout


def test_a_real_device_carries_them_to_the_same_ends():
    if find_spec("numba_cuda") is None or not cuda.is_available():
        pytest.skip("needs a CUDA device and the extra palmar[gpu]")
    compare(5000)


def test_without_the_extra_or_a_device_it_is_said_in_one_line(monkeypatch):
    case = open_case("testbed_table")[1]
    monkeypatch.setattr(on_gpu, "find_spec", lambda name: None)
    with pytest.raises(NotCoveredError, match=r'needs the extra, pip install "palmar\[gpu\]"'):
        simulate_starts(case, [(0.0, 0.1)], Device.GPU)
    monkeypatch.setattr(on_gpu, "find_spec", lambda name: name)
    monkeypatch.setattr(cuda, "is_available", lambda: False)
    with pytest.raises(NotCoveredError, match="no CUDA device"):
        simulate_starts(case, [(0.0, 0.1)], Device.GPU)


def test_what_only_processors_carry_is_refused_before_a_device_is_asked_for():
    plain, coupled = case_of(PLAIN), case_of(PLAIN | {"behaviour": 'name = "close_coupled"\nratio = 0.5'})
    support = plain.support.model_copy(update={"pressure_centre": (0.005, 0.0)})
    uneven = plain.model_copy(update={"support": support})
    for case in (coupled, uneven):
        with pytest.raises(NotCoveredError, match='device "gpu": on a table only straight fingers'):
            simulate_starts(case, [(0.0, 0.1)], Device.GPU)
