"""Programs of open documents, each with its arm, and the results of their checks."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from operator import is_

from irbkin.check.checker import Checker
from irbkin.check.findings import Finding
from irbkin.check.jobs import Job
from irbkin.lsp.code import before, calls_at, occurrences, own_names
from irbkin.lsp.names import PARAMETER, Declared, Names
from irbkin.lsp.reading import Reading
from irbkin.lsp.text import Text
from irbkin.rapid import CheckedMove, Module, Program


@dataclass(eq=False)
class Result:
    """A checked program."""

    job: Job
    moves: Mapping[int, Sequence[CheckedMove]]
    found_in: Mapping[str, Sequence[Finding]]
    names: Names
    _texts: dict[int, Text] = field(default_factory=dict, repr=False)

    @cached_property
    def modules(self) -> dict[str, int]:
        return {file.path: index for index, file in enumerate(self.job.program.files)}

    def text(self, module: int) -> Text:
        if module not in self._texts:
            self._texts[module] = Text(self.job.program.modules[module].source)
        return self._texts[module]

    def declared(self, module: int, offset: int) -> Declared | None:
        text = self.text(module)
        begin, end = text.word(offset)
        ahead = before(text.source, begin) if begin < end else None
        if ahead in (None, "."):
            return None
        routine = self.names.routine_at(module, text.place(begin)[0])
        name = text.source[begin:end]
        if ahead == "\\":
            of = self.names.find(module, routine, calls_at(text.source, end)[-1].name)
            return self.names.parameters(of).get(name.lower())
        inner = own_names(text.source, (it for it in text.blocks if it[0] <= begin < it[1]))
        if found := [it for it in inner if it[2].lower() == name.lower()]:
            first, _, own = found[-1]
            place = (routine, True, *text.place(first))
            is_counter = text.source[first] in "Ff"
            return Declared(module, own, "num", f"FOR {own}", *place) if is_counter else None
        return self.names.find(module, routine, name)

    def references(self, declared: Declared) -> Iterator[tuple[int, int]]:
        # Calls in other modules name the parameters of a routine.
        is_far = declared.kind == PARAMETER
        for module in range(len(self.job.program.modules)) if is_far else self.scope(declared):
            for at in occurrences(self.text(module).source, declared.name):
                if self.declared(module, at) == declared:
                    yield module, at

    def counterpart(self, other: "Result", declared: Declared) -> Declared | None:
        """Return what something declared is in the program of another task: a PERS by its name and
        type, else what is in the same place of the same file.
        """
        same = other.names.shared.get(declared.name.lower())
        words = declared.words.upper()
        if words.startswith("PERS ") and same is not None and same.words.upper() == words:
            return same
        paths = ((self.job.program.files[it].path, at) for it, at in self.references(declared))
        there = (other.declared(other.modules[it], at) for it, at in paths if it in other.modules)
        return next(filter(None, there), None)

    def scope(self, declared: Declared) -> Iterable[int]:
        """Return the modules whose statements see something declared."""
        is_inner = declared.is_local or declared.routine is not None
        return [declared.module] if is_inner else range(len(self.job.program.modules))


Part = tuple[Sequence[Module], Mapping[int, Sequence[CheckedMove]], Sequence[Finding]]
"""Modules of a program that have names in common, checked: the moves by the place of their module
among these, and the findings.
"""


@dataclass(eq=False)
class Session:
    """A program under edit."""

    job: Job
    """The arm; the program is read for each check."""
    paths: Sequence[str]
    checker: Checker
    notes: Sequence[str] = ()
    result: Result | None = None
    """The last result; None before the first check."""
    _parts: dict[tuple[int, ...], Part] = field(default_factory=dict, repr=False)
    _declared: dict[int, tuple[Module, list[Declared]]] = field(default_factory=dict, repr=False)

    @cached_property
    def _reading(self) -> Reading:
        return Reading(self.paths)

    def check(self, texts: Mapping[str, Text]) -> Result:
        """Read and check the program, with texts that take the place of files.

        A group of modules that have no name in common with others is checked if one of them is not
        as before.
        """
        job = replace(self.job, program=self._reading.program(texts))
        _, found = self.checker.check(replace(job, robot=None))
        parts: dict[tuple[int, ...], Part] = {}
        moves: dict[int, Sequence[CheckedMove]] = {}
        for group in map(tuple, self._reading.groups if job.robot else ()):
            part = parts[group] = self._part(job, group)
            moves |= {group[index]: own for index, own in part[1].items()}
            found += part[2]
        self._parts = parts
        found_in: dict[str, list[Finding]] = {}
        for finding in found:
            found_in.setdefault(finding.file, []).append(finding)
        return Result(job, moves, found_in, Names(job.program, self._declared))

    def _part(self, job: Job, group: tuple[int, ...]) -> Part:
        """A group of modules, checked if it is not as before."""
        modules = tuple(job.program.modules[index] for index in group)
        old = self._parts.get(group)
        if old and all(map(is_, old[0], modules)):
            return old
        program = Program(modules, tuple(job.program.files[index] for index in group))
        checked, found = self.checker.check(replace(job, program=program))
        moves: dict[int, list[CheckedMove]] = {}
        for move in checked.moves:
            moves.setdefault(move.module, []).append(move)
        return modules, moves, found
