"""Arguments of Python functions that are no arrays: robots, numbers, names, who watches."""

import operator
from collections.abc import Callable, Iterable
from importlib import import_module
from typing import Any, Protocol

from irbkin._core import Robot
from irbkin.errors import IrbkinError

Report = Callable[[int, int], object]


class Bar(Protocol):
    """A bar of progress, as of tqdm."""

    n: Any
    total: Any

    def update(self, n: Any, /) -> object:
        """So much more is done."""


def reporter(progress: Report | Bar | None) -> Report:
    """Return the function that is called with how much is done and with the whole, of a callable or
    of a bar as of tqdm.
    """
    if progress is None:
        return lambda done, total: None
    if callable(progress):
        return progress
    if not hasattr(progress, "update"):
        raise TypeError(
            f"progress must be a callable f(done, total) or a bar such as tqdm(), got {progress!r}"
        )
    bar: Bar = progress

    def report(done: int, total: int) -> None:
        bar.total = total
        bar.update(done - bar.n)

    return report


def check_robot(robot: object) -> None:
    if not isinstance(robot, Robot):
        remedy = f": give Robot({robot!r})" if isinstance(robot, str) else ""
        raise TypeError(f"robot must be a Robot, got {type(robot).__name__}{remedy}")


def count(value: object, name: str, error: type[IrbkinError]) -> int:
    """A whole number of at least 1; `error` is raised for anything else."""
    try:
        number = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise error(f"{name} is {value!r}, it must be a whole number of at least 1") from None
    if number < 1:
        raise error(f"{name} is {number}, it must be at least 1")
    return number


def check_extra(function: str, extra: str, *packages: str) -> None:
    for name in packages:
        try:
            import_module(name)
        except ImportError as missing:
            words = f"{function} needs {name}: pip install 'irbkin[{extra}]'"
            raise ImportError(words, name=name) from missing


def close(name: str, known: Iterable[str]) -> str:
    import difflib

    names = sorted(known)
    near = difflib.get_close_matches(name, names, 3, 0.5)
    if near:
        return f"did you mean {' or '.join(near)}?"
    return f"known: {', '.join(names[:12])}" if names else "there are none"
