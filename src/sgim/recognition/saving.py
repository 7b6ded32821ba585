"""Recognisers in files: NumPy archives without pickles, with the version of their format."""

from __future__ import annotations

import json
import zipfile
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from sgim.errors import SgimError
from sgim.recognition.features import Eye
from sgim.recognition.recogniser import Recogniser, Settings

FORMAT = 1
"""Version of the format that this version of the library writes."""

_ARRAYS = ("points", "colours", "names", "rows", "columns", "counts", "labels")


class SavedRecogniserError(SgimError, ValueError):
    """A file is no recogniser that this version can load."""


def save(recogniser: Recogniser, path: str | Path) -> None:
    """Write all that a recogniser has learned to a file; one that exists is replaced.

    Args:
        recogniser: The recogniser.
        path: The file; ``.npz`` is usual, and not added.
    """
    views, eye = recogniser.views, recogniser.eye
    rows, columns = np.nonzero(views.counts)
    about = {
        "format": FORMAT,
        "settings": asdict(recogniser.settings),
        "eye": {"most_points": eye.most_points, "contrast": eye.contrast, "patch": eye.patch},
    }
    with Path(path).open("wb") as file:
        np.savez_compressed(
            file,
            about=np.frombuffer(json.dumps(about).encode(), np.uint8),
            points=recogniser.points.words,
            colours=recogniser.colours.words,
            names=views.names,
            rows=rows,
            columns=columns,
            counts=views.counts[rows, columns],
            labels=np.array(views.labels, np.str_),
        )


def load(path: str | Path) -> Recogniser:
    """Make a recogniser again from the file that `save` wrote.

    Raises:
        SavedRecogniserError: If it is no recogniser, is damaged, or is of a newer format.
        OSError: If it cannot be read.
    """
    try:
        with Path(path).open("rb") as file, np.load(file, allow_pickle=False) as kept:
            about: dict[str, Any] = json.loads(kept["about"].tobytes())
            _require_known(about, path)
            points, colours, names, rows, columns, counts, labels = (kept[n] for n in _ARRAYS)
            made = Recogniser(Settings(**about["settings"]), Eye(**about["eye"]))
    except (KeyError, ValueError, TypeError, EOFError, AttributeError, zipfile.BadZipFile) as error:
        if isinstance(error, SavedRecogniserError):
            raise
        raise SavedRecogniserError(
            f"{path} is no saved recogniser, or is damaged ({error}); expected a file that "
            "recogniser.save wrote"
        ) from error
    table = np.zeros((len(labels), len(names)), np.float32)
    table[rows, columns] = counts
    made.points.restore(points)
    made.colours.restore(colours)
    made.views.restore(labels.tolist(), names, table)
    return made


def _require_known(about: dict[str, Any], path: str | Path) -> None:
    if about["format"] > FORMAT:
        raise SavedRecogniserError(
            f"{path} has format {about['format']}, and this version of sgim knows formats up to "
            f"{FORMAT}: it was saved by a newer version; update sgim, or save it with this one"
        )
