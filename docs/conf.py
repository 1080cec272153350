"""Sphinx configuration: MyST pages, the furo theme, nothing fetched from the network."""

from __future__ import annotations

import sys
from importlib.metadata import version as installed_version
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "palmar"
author = "The palmar developers"
project_copyright = "The palmar developers"
release = version = installed_version("palmar")

extensions = ["myst_parser", "mathtext"]
myst_enable_extensions = ["amsmath", "deflist", "dollarmath"]
myst_heading_anchors = 3
exclude_patterns = ["_ext", "Thumbs.db", ".DS_Store"]

html_theme = "furo"
html_title = f"palmar {release}"
html_math_renderer = "mathtext"
html_static_path = ["_static"]
html_css_files = ["palmar.css"]
html_copy_source = False
html_show_sphinx = False
