"""OpenCV, imported when it is used."""

from __future__ import annotations

import importlib
from typing import Any

from sgim.errors import SgimError


def opencv() -> Any:
    """The module ``cv2``.

    Raises:
        SgimError: If it is not installed.
    """
    try:
        return importlib.import_module("cv2")
    except ImportError as error:
        raise SgimError(
            "pictures are looked at with OpenCV, which is not installed; "
            "install it with: pip install 'sgim[vision]'"
        ) from error
