"""Teachers: who can be asked to show how a goal is reached."""

from sgim.teachers.base import Teacher
from sgim.teachers.demonstration_files import load_demonstrations, save_demonstrations
from sgim.teachers.demonstration_set import DemonstrationSet
from sgim.teachers.scripted import CorrespondenceError, ScriptedTeacher

__all__ = [
    "CorrespondenceError",
    "DemonstrationSet",
    "ScriptedTeacher",
    "Teacher",
    "load_demonstrations",
    "save_demonstrations",
]
