"""Tables of runs as Parquet files."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from sgim.errors import SgimError
from sgim.runs.journal import Journal
from sgim.runs.journal_reading import header_of
from sgim.runs.tables import Table, tables


def write_parquet(paths: Iterable[Path], folder: Path) -> list[Path]:
    """Write the trials, episodes and evaluations of runs, three files an experiment.

    Runs are read and written one after the other, so that one fits into memory at a time. Units
    are in the metadata of the columns.

    Args:
        paths: The journals.
        folder: Where to; files of the same name are replaced.

    Returns:
        The files.

    Raises:
        SgimError: If pyarrow is not installed, runs of one experiment have different tasks, or
            a file cannot be written.
        JournalError: If a journal cannot be read.
    """
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError as error:
        raise SgimError("Parquet needs the extra parquet: pip install 'sgim[parquet]'") from error
    groups: dict[str, list[Path]] = {}
    for path in paths:
        groups.setdefault(header_of(path).get("experiment") or "runs", []).append(path)
    files: dict[Path, Any] = {}
    with ExitStack() as stack:
        try:
            folder.mkdir(parents=True, exist_ok=True)
            for name, members in groups.items():
                for path in members:
                    with Journal.open(path, append=False) as journal:
                        found = tables(journal, path.stem)
                    for title, table in found.items():
                        file = folder / f"{name}-{title}.parquet"
                        made = _arrow(pa, table)
                        if file not in files:
                            files[file] = stack.enter_context(pq.ParquetWriter(file, made.schema))
                        elif files[file].schema != made.schema:
                            raise SgimError(
                                f"{path} is of another task than {members[0]}, so they do not fit "
                                "into one table; export them to two folders"
                            )
                        files[file].write_table(made)
        except OSError as error:
            raise SgimError(
                f"{folder} cannot be written ({error.strerror}); choose another --parquet"
            ) from error
    return [*files]


def _arrow(pa: Any, table: Table) -> Any:
    sorts = {"text": pa.string(), "integer": pa.int64(), "number": pa.float64()}
    schema = pa.schema(
        [
            pa.field(name, sorts[c.sort], metadata={"unit": c.unit} if c.unit else None)
            for name, c in table.items()
        ]
    )
    return pa.table({name: column.values for name, column in table.items()}, schema=schema)
