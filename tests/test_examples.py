"""The examples run and print the numbers they promise."""

import runpy
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"
PRINTED = {
    "01_first_answer.py": "97.5 mm off",
    "02_which_finger.py": "at least 60.21 mm",
    "03_feel_the_way.py": "380 mm: 2",
    "04_zero_gravity.py": "restitution 1.0: 102 mm at rest, or 32 mm/s",
    "05_four_joints.py": "radii up to 177.5 mm",
    "06_how_to_close.py": "curl first, curled by 50 deg: 35 % more",
    "07_how_softly.py": "touch_down: 0.6 N at the first touch, caged",
    "08_which_hand.py": "palm 80.1, fingers 100.2 mm: 280.4 mm in all, 4 (R + e) = 280.0",
}


def test_every_example_is_pinned():
    assert sorted(path.name for path in EXAMPLES.glob("[0-9]*.py")) == sorted(PRINTED)


@pytest.mark.parametrize("name", PRINTED)
def test_example(name, capsys):
    runpy.run_path(str(EXAMPLES / name))
    assert PRINTED[name] in capsys.readouterr().out
