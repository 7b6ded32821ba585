"""MuJoCo, imported when it is used."""

from __future__ import annotations

import importlib
from typing import Any

from sgim.errors import SgimError


def mujoco(what: str) -> Any:
    """The module ``mujoco``.

    Args:
        what: What is simulated by it, for the message, such as ``"the fishing rod is simulated"``.

    Raises:
        SgimError: If it is not installed.
    """
    try:
        return importlib.import_module("mujoco")
    except ImportError as error:
        raise SgimError(
            f"{what} by MuJoCo, which is not installed; install it with: pip install 'sgim[mujoco]'"
        ) from error
