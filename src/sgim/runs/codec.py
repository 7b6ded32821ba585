"""Rows from events, and events from rows, for one task."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, cast

from sgim.errors import JournalError
from sgim.events import Answered, Demonstrated, Event, Observed, Told
from sgim.records import Outcome
from sgim.runs.decoders import Decoders, Stored
from sgim.runs.encoders import Encoders
from sgim.runs.rows import ALSO, RecordedEvent, Row
from sgim.task import Task


class Codec:
    """Translates between the events of one task and rows of its journal.

    Args:
        task: The task whose spaces pack and unpack policies, outcomes, goals and contexts.

    Attributes:
        names: The names of events in rows, such as ``"told"``.
    """

    def __init__(self, task: Task) -> None:
        self._decoders = Decoders(task)
        self._encode = Encoders(task).by_type
        self._decode = self._decoders.by_name
        self.names = frozenset(self._decode)

    def encode(self, event: Event) -> list[Row]:
        """The rows of an event: one, and one more for each further kind of its outcome.

        Raises:
            JournalError: If it is not an event, or a part of it does not fit the task or JSON.
        """
        encode = self._encode.get(type(event))
        if encode is None:
            names = ", ".join(known.__name__ for known in self._encode)
            raise JournalError(f"{event!r:.80} is not an event; expected one of {names}")
        try:
            return encode(event)
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise JournalError(
                f"event {type(event).__name__} does not fit this task and cannot be recorded: "
                f"{error}; check its parts with the task's check_policy, check_outcome, …"
            ) from error

    def decode(self, rows: Iterable[Stored]) -> Iterator[tuple[int, RecordedEvent]]:
        """The events that rows hold, in order.

        Args:
            rows: Rows in the order of ``seq``, each ``(seq, *columns)``. An ``also`` that does
                not continue the row before it belongs to an event left out, and is passed over.

        Yields:
            The ``seq`` of the event's last row, and the event.

        Raises:
            JournalError: If a row is not one that this version writes for this task.
        """
        decode = self._decode
        event: RecordedEvent | None = None
        last = 0
        for row in rows:
            seq, name = row[0], row[1]
            if name == ALSO:
                if event is not None and seq == last + 1:
                    self._extend(event, row)
                    last = seq
                continue
            if event is not None:
                yield last, event
            try:
                event = decode[name](row)
            except (AttributeError, KeyError, TypeError, ValueError) as error:
                raise unreadable(row, error) from error
            last = seq
        if event is not None:
            yield last, event

    def _extend(self, event: RecordedEvent, row: Stored) -> None:
        try:
            outcome = cast(dict[str, Any], _outcome(event))
            outcome.update(self._decoders.outcome(row[5], row[6]))
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise unreadable(row, error) from error


def _outcome(event: RecordedEvent) -> Outcome:
    match event:
        case Told():
            return event.outcome
        case Observed():
            return event.trial.outcome
        case Answered() | Demonstrated() if event.demonstration is not None:
            return event.demonstration.outcome
    raise ValueError(f"it follows {type(event).__name__}, which has no outcome")


def unreadable(row: Stored, error: Exception) -> JournalError:
    """The error for a row that is not one that this version writes."""
    return JournalError(
        f"row {row[0]} of the journal, {row[1]!r}, cannot be read ({type(error).__name__}: "
        f"{error}); it was changed by hand, damaged, or written by another version of sgim"
    )
