"""Corrections of confdata: computed until no finding has one, and written into the files."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from irbkin._files import replaced, shown
from irbkin.check.checker import Checker, silenced
from irbkin.errors import IrbkinError

if TYPE_CHECKING:
    from irbkin.check.jobs import Job
    from irbkin.rapid import Checked, ModuleFile, Program

PASSES = 10
"""Iterations of correction and check, beyond one for each file."""


def corrected(
    checker: Checker, job: Job, say: Callable[[str], object]
) -> tuple[Job, list[tuple[ModuleFile, str, str]], Counter[str]]:
    """Return the job with its program corrected, each changed file with its text before and
    after, and the number of removed findings of each severity.

    A file is not corrected if that causes a new error or warning; the reason is reported by `say`.
    """
    program, refused = job.program, set[int]()
    checked, before = checker.check(job)
    left = before
    for _ in range(PASSES + len(program.files)):
        edited = _edited(program, checker, checked, refused)
        if edited is None:
            break
        after, found = checker.check(replace(job, program=edited))
        if worse := sorted(_places(after) - _places(checked)):
            module, line, code = worse[0]
            names = [shown(file.path) for file in program.files]
            for index in _changes(program, edited):
                where = "" if index == module else f" of {names[module]}"
                say(f"{names[index]}: is not corrected, line {line}{where} would have {code}")
                refused.add(index)
        else:
            program, checked, left = edited, after, found
    old, new = (Counter(one.severity for one in found) for found in (before, left))
    texts = [
        (job.program.files[index], job.program.modules[index].source, program.modules[index].source)
        for index in _changes(job.program, program)
    ]
    return replace(job, program=program), texts, old - new


def _changes(old: Program, new: Program) -> list[int]:
    """Return the indices of the modules that differ."""
    pairs = enumerate(zip(old.modules, new.modules, strict=True))
    return [index for index, (before, after) in pairs if before.source != after.source]


def _places(checked: Checked) -> set[tuple[int, int, str]]:
    """Modules, lines and codes of errors and warnings; notes are left out."""
    wrong = [found for found in checked.findings if found.severity != "note"]
    own = {(found.module, found.line, found.code) for found in wrong}
    return own | {(place[0], place[1], found.code) for found in wrong for place in found.related}


def _edited(
    program: Program, checker: Checker, checked: Checked, refused: Collection[int]
) -> Program | None:
    """The program with the edits of selected findings, except in refused modules; None without."""
    from irbkin.rapid.program import program_of

    is_silent = silenced(program)
    edits: dict[int, set[tuple[int, int, str]]] = {}
    for finding in checked.findings:
        wanted = checker.wanted(program.files[finding.module].path)
        if finding.code in wanted and not is_silent(finding):
            for module, *edit in checker.edits(finding):
                if module not in refused:
                    edits.setdefault(module, set()).add(tuple(edit))  # type: ignore[arg-type]
    if not edits:
        return None
    files = [
        replace(file, content=file.encoded(edited(module.source, sorted(edits.get(index, ())))))
        for index, (file, module) in enumerate(zip(program.files, program.modules, strict=True))
    ]
    return replace(program_of(files), findings=program.findings)


def edited(source: str, edits: Sequence[tuple[int, int, str]]) -> str:
    """A text after edits, which are sorted by their first bytes."""
    content, parts, copied = source.encode(), [], 0
    for begin, end, text in edits:
        parts += [content[copied:begin], text.encode()]
        copied = end
    return b"".join([*parts, content[copied:]]).decode()


def write(file: ModuleFile, before: str, after: str, say: Callable[[str], object]) -> None:
    """Overwrite a file with its corrected text; report a checksum that no longer matches."""
    if file.encoded(before) != file.content:
        raise IrbkinError(
            f"{shown(file.path)}: has bytes that are no {file.encoding} text, so it cannot be "
            "written back as it is: repair them first"
        )
    with open(file.path, "rb") as stream:
        # A file in several tasks of a backup is corrected by the first of them.
        is_done = stream.read() == file.encoded(after)
    if not is_done:
        with replaced(file.path, file.content) as stream:
            stream.write(file.encoded(after))
    if hashes := _checksum_of(file.path):
        say(f"{file.path}: is changed, its hash in {hashes} no longer agrees with it")


def _checksum_of(name: str) -> str | None:
    """The checksum list of the backup that a file is in; None if the file is not listed."""
    path = os.path.abspath(name)
    root = os.path.dirname(path)
    while not os.path.isfile(file := os.path.join(root, "BACKINFO", "checksum.txt")):
        if root == os.path.dirname(root):
            return None
        root = os.path.dirname(root)
    own = f"/{os.path.relpath(path, root)}".replace("\\", "/").lower()
    with open(file, encoding="latin-1") as lines:
        is_in = any(line.strip().replace("\\", "/").lower() == own for line in lines)
    return file if is_in else None
