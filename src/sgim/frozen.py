"""A decorator for the records and events that are made several times a movement."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any, TypeVar, dataclass_transform

Class = TypeVar("Class")

_assign_class = object.__dict__["__class__"].__set__


@dataclass_transform(eq_default=False, frozen_default=True, field_specifiers=(field,))
def frozen(cls: type[Class]) -> type[Class]:
    """Make a class an immutable record with slots, compared by identity.

    It is ``dataclass(frozen=True, slots=True, eq=False)``, made faster: a frozen dataclass fills
    each field by a call past its own ``__setattr__``, which with many fields takes longer than
    all else. Here a new object is for a moment of a twin class, with the same slots, that
    allows plain assignment.

    Args:
        cls: A class whose annotations are the fields, without ``__post_init__`` or factories
            of defaults. Nothing can derive from the record made of it.
    """
    made: Any = dataclass(frozen=True, slots=True, eq=False)(cls)
    names = [f.name for f in fields(made)]
    scope = {
        "assign_class": _assign_class,
        "made": made,
        "twin": type(made.__name__, (), {"__slots__": made.__slots__}),
    }
    lines = [
        f"def __init__(self, {', '.join(names)}):",
        "    assign_class(self, twin)",
        *(f"    self.{name} = {name}" for name in names),
        "    self.__class__ = made",
    ]
    exec("\n".join(lines), scope)
    slow, fast = made.__init__, scope["__init__"]
    fast.__defaults__, fast.__annotations__ = slow.__defaults__, slow.__annotations__
    fast.__qualname__, fast.__module__ = slow.__qualname__, made.__module__
    made.__init__ = fast
    made.__init_subclass__ = classmethod(_refuse_to_derive)
    result: type[Class] = made
    return result


def _refuse_to_derive(cls: type[Any], /, **options: Any) -> None:
    raise TypeError(f"{cls.__name__} derives from a record; let it hold one instead")
