"""The errors that sgim raises: each says what was expected, what came, and what to do."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class SgimError(Exception):
    """Base of every error that sgim raises on purpose."""


class SpaceError(SgimError, ValueError):
    """A space is ill defined, or a value does not belong to its space."""


class PlanError(SgimError, ValueError):
    """A plan is told twice, after it ended, or to a learner that did not make it."""


class TeacherError(SgimError, ValueError):
    """A teacher gave something that is not a usable demonstration."""


class UnknownNameError(SgimError, ValueError):
    """A name is not one of those known; the message names the nearest."""


class SettingError(SgimError, ValueError):
    """A setting has a value that it cannot have."""


class JournalError(SgimError):
    """A journal cannot be read, written, or continued."""


class UnwrittenError(JournalError):
    """An event could not be written yet; the journal keeps it and tries again."""


class MismatchError(JournalError):
    """A decision recomputed on resume differs from the one recorded."""


def unknown(what: str, name: object, known: Iterable[str]) -> UnknownNameError:
    """Make the error for an unknown name, with the nearest known one.

    Args:
        what: What the name stands for, such as ``"learner"``.
        name: The name that came.
        known: The names that exist.

    Returns:
        The error, to be raised by the caller.
    """
    names = sorted(known)
    near = difflib.get_close_matches(str(name), names, n=1, cutoff=0.5)
    hint = f" Did you mean {near[0]!r}?" if near else ""
    return UnknownNameError(f"unknown {what} {name!r}.{hint} Known: {', '.join(names)}")
