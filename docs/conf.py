"""How the documentation is built: `sphinx-build -W docs docs/_build`."""

import re
import sys
from pathlib import Path
from typing import Any

import sgim

sys.path.insert(0, str(Path(__file__).parent))  # for the directive of claims

project = "sgim"
author = "The sgim authors"
copyright = "The sgim authors, Apache License 2.0"  # noqa: A001 - Sphinx names it so
version = release = sgim.__version__

extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon", "myst_parser", "claims_obtained"]
exclude_patterns = ["_build", "results"]
html_static_path = ["sounds"]
myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 3

# In docstrings, `Name` is a reference where there is something of that name, else plain code.
default_role = "py:obj"
napoleon_numpy_docstring = False
napoleon_use_ivar = True
autodoc_member_order = "bysource"
autodoc_type_aliases = {
    name: name
    for name in ("FloatArray", "Generators", "Outcome", "Event", "RecordedEvent", "ArrayLike")
}

html_theme = "furo"
html_title = f"sgim {release}"


def _keep_bars(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Keep sizes such as |A| in docstrings from being taken for substitutions."""
    lines[:] = [re.sub(r"\|(\w+)\|", r"\\|\1\\|", line) for line in lines]


def setup(app: Any) -> None:
    app.connect("autodoc-process-docstring", _keep_bars)
