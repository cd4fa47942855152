"""Programs checked and corrected."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from irbkin.cli.codes import NOT_CHECKED
from irbkin.cli.errors import complain
from irbkin.cli.files import shown
from irbkin.cli.findings import REASONS, Found
from irbkin.cli.jobs import Job

if TYPE_CHECKING:
    from irbkin import Cell
    from irbkin.rapid import Checked, Finding, ModuleFile, Program

NOQA = re.compile(r"!\s*noqa\b(?:\s*:\s*([A-Z0-9, ]+))?", re.IGNORECASE)
PASSES = 10
"""How often corrections are looked for after corrections."""


class Checker:
    """Checks programs."""

    def __init__(
        self,
        codes: Collection[str],
        step: float,
        cell: Cell | None = None,
        *,
        is_strict: bool = False,
        takes_last: bool = False,
    ) -> None:
        from irbkin._core import check_codes

        self.codes, self.step, self.cell = set(codes), step, cell
        self.is_strict, self.takes_last = is_strict, takes_last
        self.ignored: dict[str, set[str]] = {}
        """Codes that are not wanted of a file."""
        known = {code: is_default for code, _, _, is_default in check_codes()}
        self.asked = {it for it in known if known[it] or it in REASONS or it in codes}

    def checked(self, job: Job, program: Program | None = None) -> Checked:
        """Return what is found in the program of a job, or in a corrected one."""
        return (program or job.program).check(
            job.robot,
            codes=self.asked,
            step=self.step,
            cell=self.cell,
            units=job.units,
            last_values=self.takes_last,
        )

    def found(self, job: Job, checked: Checked, program: Program | None = None) -> list[Found]:
        """Return the findings that are wanted."""
        program = program or job.program
        silencer = _Silencer(program)
        files = [shown(file.path) for file in program.files]
        return [
            self._found(files, it)
            for it in checked.findings
            if it.code in self.codes - self.ignored.get(program.files[it.module].path, set())
            and not silencer.silences(it)
        ]

    def _found(self, files: Sequence[str], it: Finding) -> Found:
        is_error = self.is_strict and it.code in NOT_CHECKED
        severity = "error" if is_error else it.severity
        edits = tuple((files[module], *edit) for module, *edit in it.edits)
        words = (it.code, it.name, severity, it.message, edits)
        place = (files[it.module], it.line, it.column)
        return Found(*place, *words, it.routine, it.joint, it.value, it.bound)  # type: ignore[arg-type]


class _Silencer:
    """The comments of a program that silence findings."""

    def __init__(self, program: Program) -> None:
        sources = (module.source for module in program.modules)
        self.lines = [it.split("\n") if "noqa" in it.lower() else None for it in sources]

    def silences(self, finding: Finding) -> bool:
        lines = self.lines[finding.module]
        match = NOQA.search(lines[finding.line - 1]) if lines else None
        if match is None:
            return False
        codes = match[1]
        return codes is None or any(
            finding.code.startswith(it.strip().upper()) for it in codes.split(",") if it.strip()
        )


class Correction(NamedTuple):
    """Files of a program with the texts that take their place."""

    texts: Sequence[tuple[ModuleFile, str, str]]
    """Each file with its text before and after."""
    fixed: Counter[str]
    """Number of findings that they remove, by severity."""
    program: Program
    """The corrected program."""


def correction(checker: Checker, job: Job) -> Correction:
    """Return the corrections of a program.

    A file stays as it is if something else would be wrong with its corrections.
    """
    program, refused = job.program, set[int]()
    checked = checker.checked(job)
    before = checker.found(job, checked)
    for _ in range(PASSES + len(program.files)):
        edited = _edited(program, checker, checked, refused)
        if edited is None:
            break
        after = checker.checked(job, edited)
        worse = sorted(_places(after) - _places(checked))
        if worse:
            module, line, code = worse[0]
            changed = {
                index
                for index, (old, new) in enumerate(
                    zip(program.modules, edited.modules, strict=True)
                )
                if old.source != new.source
            }
            for index in changed:
                name = shown(program.files[index].path)
                where = "" if index == module else f" of {shown(program.files[module].path)}"
                complain(f"{name}: is not corrected, line {line}{where} would have {code}")
            refused |= changed
            continue
        program, checked = edited, after
    after_found = checker.found(job, checked, program)
    fixed = Counter(it.severity for it in before) - Counter(it.severity for it in after_found)
    pairs = zip(job.program.files, job.program.modules, program.modules, strict=True)
    texts = [(file, old.source, new.source) for file, old, new in pairs if old.source != new.source]
    return Correction(texts, fixed, program)


def _places(checked: Checked) -> set[tuple[int, int, str]]:
    """Modules, lines and codes of what is wrong; what is undecided is not."""
    return {(it.module, it.line, it.code) for it in checked.findings if it.severity != "note"}


def _edited(
    program: Program, checker: Checker, checked: Checked, refused: Collection[int]
) -> Program | None:
    """The program with the edits of wanted findings, but for modules that are refused."""
    from irbkin.rapid.program import program_of

    silencer = _Silencer(program)
    edits: dict[int, set[tuple[int, int, str]]] = {}
    for it in checked.findings:
        if it.code in checker.codes and not silencer.silences(it):
            for module, begin, end, text in it.edits:
                edits.setdefault(module, set()).add((begin, end, text))
    edits = {module: own for module, own in edits.items() if module not in refused}
    if not edits:
        return None
    files = [
        replace(file, content=file.encoded(edited(module.source, sorted(edits.get(index, ())))))
        for index, (file, module) in enumerate(zip(program.files, program.modules, strict=True))
    ]
    return program_of(files)


def edited(source: str, edits: Sequence[tuple[int, int, str]]) -> str:
    """A text with edits in the order of its bytes."""
    content, parts, copied = source.encode(), [], 0
    for begin, end, text in edits:
        parts += [content[copied:begin], text.encode()]
        copied = end
    return b"".join([*parts, content[copied:]]).decode()
