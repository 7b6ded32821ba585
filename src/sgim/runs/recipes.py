"""Recorded recipes of learners."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from sgim.configurations import configuration_of
from sgim.errors import SgimError
from sgim.runs.rows import to_json


def completed(recipe: Any) -> Any:
    """A recorded recipe, with the settings that came since as they were before they came."""
    if not isinstance(recipe, Mapping) or not isinstance(recipe.get("configuration"), Mapping):
        return recipe
    try:
        configuration = configuration_of(recipe["configuration"]).describe()
    except (SgimError, TypeError, KeyError):  # not one of this library's, or of a later version
        return recipe
    return {**recipe, "configuration": json.loads(to_json(configuration))}
