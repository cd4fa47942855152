"""Equality of records that hold arrays."""

from typing import Any, TypeVar

_Record = TypeVar("_Record", bound=type)


def same(first: Any, second: Any) -> bool:
    """Whether two fields have one value: arrays by shape and elements, NaN being equal to NaN."""
    import numpy as np

    if isinstance(first, np.ndarray) or isinstance(second, np.ndarray):
        first, second = np.asarray(first), np.asarray(second)
        is_real = all(array.dtype.kind == "f" for array in (first, second))
        return np.array_equal(first, second, equal_nan=is_real)
    if isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(map(same, first, second))
    # A number is equal to itself, NaN is not.
    return bool(first == second or (first != first and second != second))


def by_value(record: _Record) -> _Record:
    """Compare a record that holds arrays by value, not by the truth of an array."""

    def is_equal(self: tuple[object, ...], other: object) -> bool:
        return same(self, other) if isinstance(other, tuple) else NotImplemented

    for name, method in (("__eq__", is_equal), ("__ne__", object.__ne__), ("__hash__", None)):
        setattr(record, name, method)
    return record
