"""Commands start fast because heavy libraries are imported only by what uses them."""

import subprocess
import sys


def modules_after(statement: str) -> set[str]:
    code = f"import sys; {statement}; print(*sys.modules)"
    return set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())


def test_the_closure_command_needs_neither_matplotlib_nor_shapely_pictures_nor_dxf():
    loaded = modules_after(
        "from palmar.faces.cli.main import app; app(['closure', 'testbed_table', '--json'], result_action='return_value')"
    )
    assert not loaded & {"matplotlib", "ezdxf", "scipy", "numba", "mujoco"}


def test_the_region_command_without_a_file_needs_no_matplotlib():
    loaded = modules_after(
        "from palmar.faces.cli.main import app; app(['region', 'testbed_table', '--json'], result_action='return_value')"
    )
    assert not loaded & {"matplotlib", "ezdxf"}
