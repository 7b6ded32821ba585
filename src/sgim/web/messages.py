"""Messages from JSON and to JSON, checked against their types and limits."""

from __future__ import annotations

import json
import types
from dataclasses import fields
from typing import Annotated, Any, Literal, NoReturn, Union, get_args, get_origin, get_type_hints

from sgim.errors import SgimError
from sgim.web.protocol import FromPage, FromServer, Most

_PLAIN = Most(1000)


class MessageError(SgimError, ValueError):
    """A message is malformed."""


def name_of(message: type[Any]) -> str:
    """The field ``what`` of a class of messages."""
    return message.__name__.lower()


_KNOWN: dict[str, Any] = {name_of(message): message for message in get_args(FromPage)}


def parse(text: str | bytes) -> FromPage:
    """A message of the page.

    Raises:
        MessageError: If it is not one.
    """
    try:
        value = json.loads(text, parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        raise MessageError(f"a message is not JSON: {error!s:.100}") from None
    if not isinstance(value, dict) or not _is_known(value.get("what")):
        raise MessageError("a message has no known 'what'")
    known = _KNOWN[value.pop("what")]
    message: FromPage = _record(value, known, name_of(known))
    return message


def _is_known(what: Any) -> bool:
    return isinstance(what, str) and what in _KNOWN


def text_of(message: FromServer) -> str:
    """A message of the server, as JSON."""
    value = {"what": name_of(type(message)), **vars(message)}
    return json.dumps(
        value, ensure_ascii=False, separators=(",", ":"), allow_nan=False, default=vars
    )


_HINTS: dict[type[Any], dict[str, Any]] = {}


def hints(message: type[Any]) -> dict[str, Any]:
    """Field → type with limits, of a class of this protocol."""
    if message not in _HINTS:
        found = get_type_hints(message, include_extras=True)
        _HINTS[message] = {f.name: found[f.name] for f in fields(message)}
    return _HINTS[message]


def _record(value: Any, expected: type[Any], where: str) -> Any:
    if not isinstance(value, dict):
        _wrong(where, "an object")
    types_ = hints(expected)
    if value.keys() != types_.keys():
        _wrong(where, f"the fields {', '.join(types_)}")
    return expected(**{k: _value(value[k], t, f"{where}.{k}") for k, t in types_.items()})


def _value(value: Any, expected: Any, where: str, most: Most = _PLAIN) -> Any:
    """A value as one of the expected type, or `MessageError`."""
    origin = get_origin(expected)
    if origin is Annotated:
        inner, limit = get_args(expected)
        return _value(value, inner, where, limit)
    if origin in (Union, types.UnionType):
        inner, none = get_args(expected)
        assert none is type(None)
        return None if value is None else _value(value, inner, where, most)
    if origin is Literal:
        choices = get_args(expected)
        if not isinstance(value, str) or value not in choices:
            _wrong(where, f"one of {', '.join(choices)}")
        return value
    if origin is list:
        if not isinstance(value, list) or len(value) > most.value:
            _wrong(where, f"a list of at most {most.value:g}")
        (inner,) = get_args(expected)
        return [_value(one, inner, where) for one in value]
    if expected is bool:
        if not isinstance(value, bool):
            _wrong(where, "true or false")
        return value
    if expected is str:
        if not isinstance(value, str) or len(value) > most.value:
            _wrong(where, f"a text of at most {most.value:g} characters")
        return value
    if expected is float or expected is int:
        limit = most.value if most is not _PLAIN else 1e9
        number = isinstance(value, int | float) and not isinstance(value, bool)
        if not number or not abs(value) <= limit or (expected is int and value != int(value)):
            _wrong(where, "a finite number" if expected is float else "a whole number")
        return expected(value)
    return _record(value, expected, where)


def _wrong(where: str, expected: str) -> NoReturn:
    raise MessageError(f"{where}: expected {expected}")


def _refuse(name: str) -> NoReturn:
    raise MessageError(f"{name} is not a finite number")
