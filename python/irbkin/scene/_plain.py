"""Frozen dataclasses as plain data and back: numbers, texts, tuples as lists, fields as keys."""

import sys
import types
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from typing import Any, Union, get_args, get_origin, get_type_hints

from irbkin.errors import IrbkinError


def plain(value: Any) -> Any:
    """Return a value as plain data; fields with their defaults are left out."""
    if is_dataclass(value):
        own = {field: getattr(value, field.name) for field in fields(value)}
        return {
            field.name: plain(it)
            for field, it in own.items()
            if field.default is MISSING or it != field.default
        }
    if isinstance(value, tuple | list):
        return [plain(it) for it in value]
    if isinstance(value, dict):
        return {key: plain(it) for key, it in value.items()}
    return value


@cache
def _hints(of: type) -> dict[str, Any]:
    return get_type_hints(of)


def read(of: Any, data: Any, place: str) -> Any:
    """Make a value of a type from plain data; an IrbkinError begins with the place."""
    if is_dataclass(of):
        return _read_fields(of, data, place)
    origin = get_origin(of)
    if origin in (Union, types.UnionType):
        if data is None:
            return None
        (only,) = (it for it in get_args(of) if it is not type(None))
        return read(only, data, place)
    if origin is tuple:
        if not isinstance(data, list):
            raise _wrong(place, data, "a list")
        (each, *_) = get_args(of)
        return tuple(read(each, it, f"{place}[{index}]") for index, it in enumerate(data))
    if of is float:
        is_number = isinstance(data, int | float) and not isinstance(data, bool)
        # A whole number may be larger than any float.
        if not (is_number and abs(data) <= sys.float_info.max):
            raise _wrong(place, data, "a finite number")
        return float(data)
    kind = origin or of
    if (of is int and isinstance(data, bool)) or not isinstance(data, kind):
        names = {str: "a text", int: "a whole number", bool: "true or false", dict: "an object"}
        raise _wrong(place, data, names[kind])
    return data


def _read_fields(of: Any, data: Any, place: str) -> Any:
    if not isinstance(data, dict):
        raise _wrong(place, data, "an object")
    own = {field.name: field for field in fields(of)}
    for key in data:
        if key not in own:
            raise IrbkinError(f"{place}: has no field {key!r}, its fields are {', '.join(own)}")
    hints = _hints(of)
    values = {}
    for name, field in own.items():
        if name in data:
            values[name] = read(hints[name], data[name], f"{place}.{name}")
        elif field.default is MISSING:
            raise IrbkinError(f"{place}: lacks the field {name!r}")
    return of(**values)


def _wrong(place: str, data: Any, wanted: str) -> IrbkinError:
    text = repr(data)
    return IrbkinError(f"{place} is {text[:60]}{'..' * (len(text) > 60)}, it must be {wanted}")
