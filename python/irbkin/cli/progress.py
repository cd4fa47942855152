"""A progress bar on stderr for work that takes long, where stderr is a terminal."""

from __future__ import annotations

import contextlib
import sys
import threading
import time
from collections.abc import Iterable, Iterator
from typing import TypeVar

T = TypeVar("T")
AFTER = 1.0
"""How long work must take before it is shown [s]."""
EVERY = 0.1
WIDTH = 30


class Progress:
    """Shows how much is done; as a context manager it leaves an empty line."""

    def __init__(self, what: str, total: int | None = None) -> None:
        self.what, self.total = what, total
        self._done = 0
        self._next = time.monotonic() + AFTER
        self._is_shown = False
        self._is_terminal = sys.stderr.isatty()

    def __enter__(self) -> Progress:
        return self

    def __exit__(self, *_: object) -> None:
        if self._is_shown:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)

    def each(self, things: Iterable[T]) -> Iterator[T]:
        """Yield things, each of which is done when the next one is wanted."""
        for thing in things:
            yield thing
            self.add(1)

    def add(self, count: int) -> None:
        """So many more are done."""
        self._done += count
        if not self._is_terminal or time.monotonic() < self._next:
            return
        self._next = time.monotonic() + EVERY
        self._is_shown = True
        line = f"{self._done:,} {self.what}"
        if self.total:
            part = min(self._done / self.total, 1.0)
            line = f"[{'#' * round(WIDTH * part):{WIDTH}}] {part:4.0%}  {line}"
        print(f"\r\x1b[K{line}", end="", file=sys.stderr, flush=True)


@contextlib.contextmanager
def waiting(what: str) -> Iterator[None]:
    """Show how long one call takes, where stderr is a terminal; leave an empty line."""
    if not sys.stderr.isatty():
        yield
        return
    is_done, began = threading.Event(), time.monotonic()

    def show() -> None:
        while not is_done.wait(EVERY):
            if (seconds := time.monotonic() - began) >= AFTER:
                print(f"\r\x1b[K{what}, {seconds:.0f} s", end="", file=sys.stderr, flush=True)

    thread = threading.Thread(target=show, daemon=True)
    thread.start()
    try:
        yield
    finally:
        is_done.set()
        thread.join()
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)
