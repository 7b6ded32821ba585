"""Makes the page's types from `sgim.web.protocol`: ``python -m sgim.web.typescript PATH``."""

from __future__ import annotations

import sys
import types
from dataclasses import is_dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from sgim.web import protocol
from sgim.web.messages import hints, name_of
from sgim.web.protocol import FromPage, FromServer

_SIMPLE = {str: "string", float: "number", int: "number", bool: "boolean", Any: "unknown"}


def typescript() -> str:
    """The text of the file."""
    parts = [
        "// Made by: python -m sgim.web.typescript web/src/protocol.ts. Do not edit.",
        f"export const VERSION = {protocol.VERSION};",
    ]
    messages = {*get_args(FromPage), *get_args(FromServer)}
    records = [value for value in vars(protocol).values() if isinstance(value, type)]
    parts += [
        _interface(record, record in messages)
        for record in records
        if is_dataclass(record) and record is not protocol.Most
    ]
    for union, name in ((FromPage, "FromPage"), (FromServer, "FromServer")):
        members = " | ".join(message.__name__ for message in get_args(union))
        parts.append(f"export type {name} = {members};")
    return "\n\n".join(parts) + "\n"


def _interface(record: type[Any], is_message: bool) -> str:
    lines = [f"export interface {record.__name__} {{"]
    if is_message:
        lines.append(f'  what: "{name_of(record)}";')
    lines += [f"  {name}: {_type(hint)};" for name, hint in hints(record).items()]
    return "\n".join([*lines, "}"])


def _type(hint: Any) -> str:
    origin, arguments = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return _type(arguments[0])
    if origin is Literal:
        return " | ".join(f'"{choice}"' for choice in arguments)
    if origin in (Union, types.UnionType):
        return " | ".join("null" if one is type(None) else _type(one) for one in arguments)
    if origin is list:
        return f"{_type(arguments[0])}[]"
    if origin is dict:
        return f"Record<string, {_type(arguments[1])}>"
    return _SIMPLE[hint] if hint in _SIMPLE else str(hint.__name__)


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(typescript(), encoding="utf-8")
