"""Progress of work that takes long, on stderr where it is a terminal."""

from __future__ import annotations

import contextlib
import sys
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress as Bar

AFTER = 1.0
"""How long work must take before it is shown [s]."""


class Progress(contextlib.ExitStack):
    def __init__(self, what: str, total: int | None = None) -> None:
        super().__init__()
        self.what, self.total, self.done = what, total, 0
        self.began = time.monotonic() if sys.stderr and sys.stderr.isatty() else float("inf")
        self.bar: Bar | None = None

    def add(self, count: int, total: int | None = None) -> None:
        self.done += count
        self.total = total or self.total
        if self.bar is None and time.monotonic() - self.began >= AFTER:
            from rich import console, progress

            self.bar = progress.Progress(
                progress.TextColumn("{task.description}"),
                progress.BarColumn(),
                progress.TimeElapsedColumn(),
                progress.MofNCompleteColumn(),
                "{task.fields[rate]}/s",
                progress.TimeRemainingColumn(),
                console=console.Console(stderr=True),
                # It leaves nothing behind.
                transient=True,
            )
            self.enter_context(self.bar).add_task(self.what, total=self.total, rate="")
        if self.bar:
            rate = f"{self.done / (time.monotonic() - self.began):,.0f}"
            (task,) = self.bar.task_ids
            self.bar.update(task, completed=self.done, total=self.total, rate=rate)
