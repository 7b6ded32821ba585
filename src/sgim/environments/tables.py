"""Small tables of numbers that come with the package, each saying how it was made."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from sgim.errors import SgimError
from sgim.spaces import FloatArray


def read_table(name: str) -> FloatArray:
    """Read ``name`` from the package's data folder.

    Returns:
        The numbers, shape ``(rows, columns)``.

    Raises:
        SgimError: If the package has no such table, or a cell is not a finite number.
    """
    resource = files("sgim.environments") / "data" / name
    if not resource.is_file():
        raise SgimError(f"the package has no table {name!r} in sgim/environments/data")
    lines = [line for line in resource.read_text("utf-8").splitlines() if not line.startswith("#")]
    try:
        rows = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
    except ValueError as error:
        raise SgimError(f"table {name!r} is damaged: {error}") from None
    if rows.ndim != 2 or not np.isfinite(rows).all():
        raise SgimError(f"table {name!r} is damaged: expected rows of finite numbers")
    return rows


def write_table(
    path: Path, comment: str, columns: Sequence[str], rows: ArrayLike, decimals: int | None = None
) -> None:
    """Write a table: ``#`` and a comment, the columns' names, one line a row.

    Args:
        path: Where to; an existing file is replaced.
        comment: How the numbers were made: the command, and what they are.
        columns: The columns' names.
        rows: The numbers, shape ``(rows, columns)``.
        decimals: Digits after the point; None to keep every number exactly.
    """
    numbers = np.asarray(rows, dtype=np.float64)
    texts = [
        ",".join(repr(x) if decimals is None else f"{x:.{decimals}f}" for x in row)
        for row in numbers.tolist()
    ]
    head = [f"# {line}" for line in comment.splitlines()]
    path.write_text("\n".join([*head, ",".join(columns), *texts]) + "\n", encoding="utf-8")
