"""Checks of programs, and the selection among their findings."""

import os
import re
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

from irbkin import Cell, rapid
from irbkin._arm_options import frame
from irbkin._cell import read
from irbkin._core import Checked, check_codes
from irbkin.check.codes import NOT_CHECKED, REASONS, UNREAD, selected
from irbkin.check.findings import Finding, of_file
from irbkin.check.jobs import Job
from irbkin.check.settings import Settings
from irbkin.check.tools import tool_findings
from irbkin.errors import InvalidModelError, IrbkinError

NOQA = re.compile(r"!\s*noqa\b(?:\s*:\s*([A-Z0-9, ]+))?", re.IGNORECASE)


class Checker:
    """Checks programs, by options as in irbkin.toml, but with underscores, and by the codes that
    settings ignore in some files.
    """

    def __init__(self, options: Mapping[str, Any], settings: Settings) -> None:
        is_strict = bool(options.get("strict"))
        codes = selected(options.get("select"), options.get("ignore", ()), is_strict=is_strict)
        step = options.get("step", 5.0)
        if not 0.0 < step < float("inf"):
            raise IrbkinError(f"--step must be positive and finite [mm], got {step}")
        self.cell: Cell | None
        self.cell, self.shapes = read(options["cell"]) if "cell" in options else (None, {})
        self._cell = os.path.basename(options.get("cell", ""))
        tools = options.get("tool", {})
        self.tools = tools if isinstance(tools, Mapping) else {None: frame(tools, "--tool")}
        self._takes_saved = options.get("last_values", False)
        self._options = {"step": step / 1e3, "cell": self.cell, "tools": self.tools}
        self.codes, self._is_strict, self._settings = codes, is_strict, settings
        self._corrects_notes = options.get("select") is not None
        self._wanted: dict[str, set[str]] = {}
        known = {code: is_default for code, _, _, is_default in check_codes()}
        self.asked = {code for code in known if known[code] or code in REASONS or code in codes}

    def check(self, job: Job) -> tuple[rapid.Checked, list[Finding]]:
        """Check a program: return its moves, none if its arm is unknown, and the findings."""
        program = job.program
        found = [of_file(own) for own in program.findings if own.code in self.wanted(own.file)]
        if job.robot is None:
            return Checked((), ()), found
        is_unread = any(own.code == UNREAD for own in program.findings)
        for name, shapes in self.shapes.items():
            try:
                job.robot.with_attached(shapes)
            except InvalidModelError as error:
                raise InvalidModelError(f"{self._cell}: {name}: {error}") from None
        given = {
            "codes": self.asked,
            "units": job.units,
            "last_values": self._takes_saved or job.is_saved,
            "whole": False if is_unread else job.is_whole,
            "signals": [*job.signals] or None,
            "tasks": job.tasks,
        }
        checked = program.check(job.robot, **self._options, **given, carried=self.shapes)
        files = [file.path for file in program.files]
        is_silent = _silenced(program)
        of_tools = tool_findings(program, job.robot, self._cell, self.shapes)
        found += [
            self._of_move(own, job, files)
            for own in (*of_tools, *checked.findings)
            if own.code in self.wanted(files[own.module]) and not is_silent(own)
        ]
        return checked, found

    def _of_move(self, found: rapid.Finding, job: Job, files: Sequence[str]) -> Finding:
        """A finding of a program; a note has corrections only if codes are selected."""
        severity = "error" if self._is_strict and found.code in NOT_CHECKED else found.severity
        edits = tuple((files[module], *edit) for module, *edit in found.edits)
        is_corrected = found.severity != "note" or self._corrects_notes
        if not (is_corrected and all(job.is_given(files[module]) for module, *_ in found.edits)):
            edits = ()
        what = (found.code, found.name, severity, found.message, edits, found.routine)
        place = (files[found.module], found.line, found.column)
        numbers = (found.joint, found.value, found.bound)
        related = tuple((files[module], *others) for module, *others in found.related)
        return Finding(*place, *what, *numbers, related)  # type: ignore[arg-type]

    def wanted(self, file: str) -> set[str]:
        if file not in self._wanted:
            self._wanted[file] = self.codes - self._settings.ignored(file)
        return self._wanted[file]


def _silenced(program: rapid.Program) -> Callable[[rapid.Finding], bool]:
    """Return a predicate: whether a `noqa` comment of a program suppresses a finding."""
    sources = (module.source for module in program.modules)
    lines = [source.split("\n") if "noqa" in source.lower() else [] for source in sources]

    # One line may have very many findings.
    @cache
    def comment(module: int, line: int, begin: int) -> re.Match[str] | None:
        return NOQA.search(lines[module][line - 1][begin:].partition("\r")[0])

    def is_silent(finding: rapid.Finding) -> bool:
        own = lines[finding.module]
        # A carriage return alone ends a line, too.
        begin = own[finding.line - 1].rfind("\r", 0, finding.column) + 1 if own else 0
        match = comment(finding.module, finding.line, begin) if own else None
        if match is None:
            return False
        words = [word.strip().upper() for word in (match[1] or "").split(",")]
        return match[1] is None or any(word and finding.code.startswith(word) for word in words)

    return is_silent
