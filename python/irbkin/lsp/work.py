"""Programs with their arms, as an editor has them checked, and the results."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

from irbkin.lsp.names import Names
from irbkin.lsp.reading import Reading
from irbkin.lsp.text import Text

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin.rapid import Checked, CheckedMove, Program


class Place(Protocol):
    """A place that belongs to a finding, and the words for it."""

    @property
    def file(self) -> str: ...  # noqa: D102
    @property
    def line(self) -> int: ...  # noqa: D102
    @property
    def column(self) -> int: ...  # noqa: D102
    @property
    def message(self) -> str: ...  # noqa: D102


class Found(Place, Protocol):
    """Something wrong at a place of a file."""

    @property
    def code(self) -> str: ...  # noqa: D102
    @property
    def severity(self) -> str: ...  # noqa: D102
    @property
    def edits(self) -> Sequence[tuple[str, int, int, str]]: ...  # noqa: D102
    @property
    def related(self) -> Sequence[Place]: ...  # noqa: D102
    def span(self, line: str) -> tuple[int, int]: ...  # noqa: D102


class Task(Protocol):
    """A program, and the arm that it moves."""

    title: str
    """The task and the arm, or the folder."""
    robot: Robot | None
    paths: Sequence[str]
    """The files of its modules."""
    notes: Sequence[str]
    """Messages on undetermined things, for the user."""

    def check(self, program: Program) -> tuple[Checked | None, Sequence[Found]]:
        """Return what is wrong with the program; without an arm, with its text."""


class Desk(Protocol):
    """Gives files their tasks."""

    def tasks(self, path: str, options: Mapping[str, Any]) -> Sequence[Task]:
        """Return the tasks of a file, whose path or name is given."""

    def forget(self) -> None:
        """Read options and backups again."""

    def rule(self, code: str) -> tuple[str, str]:
        """Return the address and the words of the rule of a code."""


@dataclass(eq=False)
class Result:
    """A program, checked."""

    task: Task
    program: Program
    checked: Checked | None
    found: Sequence[Found]
    _texts: dict[int, Text] = field(default_factory=dict, repr=False)

    @cached_property
    def names(self) -> Names:
        """Where its names are declared."""
        return Names(self.program)

    @cached_property
    def modules(self) -> dict[str, int]:
        """The index of the module of each file."""
        return {file.path: index for index, file in enumerate(self.program.files)}

    def text(self, module: int) -> Text:
        """Return the text of a module."""
        if module not in self._texts:
            self._texts[module] = Text(self.program.modules[module].source)
        return self._texts[module]

    @cached_property
    def moves(self) -> dict[int, list[CheckedMove]]:
        """The moves of each module."""
        of: dict[int, list[CheckedMove]] = {}
        for move in self.checked.moves if self.checked else ():
            of.setdefault(move.module, []).append(move)
        return of

    @cached_property
    def found_in(self) -> dict[str, list[Found]]:
        """The findings in each file."""
        of: dict[str, list[Found]] = {}
        for it in self.found:
            of.setdefault(it.file, []).append(it)
        return of


@dataclass(eq=False)
class Session:
    """A task while its texts change."""

    task: Task
    reading: Reading
    result: Result | None = None
    """The last one; None before the first."""

    def check(self, texts: Mapping[str, str]) -> Result:
        """Read and check the program, with texts that take the place of files."""
        program = self.reading.program(texts)
        checked, found = self.task.check(program)
        return Result(self.task, program, checked, found)
