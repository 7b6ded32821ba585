"""Who is told how a run goes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from sgim.events import Evaluated

if TYPE_CHECKING:
    from sgim.runs.run import Run


class Observer(Protocol):
    """Is told how a run goes, to show it."""

    def started(self, run: Run, target: int) -> None:
        """The run goes on until ``target`` movements."""
        ...

    def moved(self, run: Run) -> None:
        """Some movements were made."""
        ...

    def evaluated(self, run: Run, evaluation: Evaluated) -> None:
        """The repertoire was measured."""
        ...

    def ended(self, run: Run) -> None:
        """The run stopped, finished or not."""
        ...
