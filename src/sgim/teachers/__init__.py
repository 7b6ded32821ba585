"""Teachers: who can be asked to show how a goal is reached."""

from sgim.teachers.base import Teacher, WatchingTeacher, let_observe
from sgim.teachers.demonstration_files import (
    load_demonstrations,
    read_demonstrations,
    save_demonstrations,
    write_demonstrations,
)
from sgim.teachers.demonstration_set import DemonstrationSet
from sgim.teachers.least_explored import LeastExplored
from sgim.teachers.remote import RemoteTeacher
from sgim.teachers.scripted import CorrespondenceError, ScriptedTeacher

__all__ = [
    "CorrespondenceError",
    "DemonstrationSet",
    "LeastExplored",
    "RemoteTeacher",
    "ScriptedTeacher",
    "Teacher",
    "WatchingTeacher",
    "let_observe",
    "load_demonstrations",
    "read_demonstrations",
    "save_demonstrations",
    "write_demonstrations",
]
