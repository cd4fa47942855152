"""Corrections of confdata: computed until no finding has one, and written into the files."""

import os
from collections import Counter
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from pathlib import Path

from irbkin._files import replaced, shown, ways
from irbkin.check.checker import Checker
from irbkin.check.findings import Finding
from irbkin.check.jobs import Job
from irbkin.rapid import Checked, ModuleFile
from irbkin.rapid.program import Edits, edited, program_of

PASSES = 10
"""Iterations of correction and check, beyond one for each file."""
Text = tuple[ModuleFile, str, str]
"""A file, its text before and after corrections."""
EditsByFile = dict[str, Edits]
Checks = Sequence[tuple[Checked, Sequence[Finding]]]


def corrected(
    checker: Checker, jobs: Sequence[Job], say: Callable[[str], object]
) -> tuple[list[Job], list[Text], Counter[str]]:
    """Return jobs with their programs corrected, the files that change, and the number of removed
    findings of each severity.

    A file, which may be in several programs, is not corrected if that causes a new error or warning
    in one of them; the reason is reported by `say`.
    """
    before: Checks = [checker.check(job) for job in jobs]
    own, left, refused = list(jobs), before, set[str]()
    for _ in range(PASSES + sum(len(job.program.files) for job in own)):
        edits = _edits(left, refused)
        if not edits:
            break
        tried = [_edited(job, edits) for job in own]
        after = [checker.check(job) for job in tried]
        if worse := sorted(_places(tried, after) - _places(own, left)):
            _, line, code, other = worse[0]
            for file in map(shown, edits):
                where = "" if file == other else f" of {other}"
                say(f"{file}: is not corrected, line {line}{where} would have {code}")
            refused.update(edits)
        else:
            own, left = tried, after
    texts = {
        os.path.realpath(file.path): (file, old.source, new.source)
        for one, other in zip(jobs, own, strict=True)
        for file, old, new in zip(
            one.program.files, one.program.modules, other.program.modules, strict=True
        )
        if old.source != new.source
    }
    return own, list(texts.values()), _severities(before) - _severities(left)


def _severities(checks: Checks) -> Counter[str]:
    """The number of findings of each severity; those in shared modules are in several programs."""
    return Counter(found.severity for found in {own for _, all_own in checks for own in all_own})


def _places(jobs: Sequence[Job], checks: Checks) -> set[tuple[int, int, str, str]]:
    """Programs, lines, codes and files of errors and warnings; notes are left out."""
    return {
        (index, line, found.code, shown(job.program.files[module].path))
        for index, (job, (checked, _)) in enumerate(zip(jobs, checks, strict=True))
        for found in checked.findings
        for module, line, *_ in ((found.module, found.line), *found.related)
        if found.severity != "note"
    }


def _edits(checks: Checks, refused: Collection[str]) -> EditsByFile:
    """The corrections in files that are not refused, without those that contradict each other."""
    rows = [own.edits for _, found in checks for own in found]
    wanted = Counter(edit[:2] for edit in {edit for row in rows for edit in row})
    edits: EditsByFile = {}
    for row in rows:
        if all(wanted[edit[:2]] == 1 and edit[0] not in refused for edit in row):
            for file, begin, end, text in row:
                edits.setdefault(file, {})[begin] = (end, text)
    return edits


def _edited(job: Job, edits: EditsByFile) -> Job:
    program = job.program
    files = [
        replace(file, content=file.encoded(edited(module.source, edits.get(file.path, {}))))
        for file, module in zip(program.files, program.modules, strict=True)
    ]
    return replace(job, program=replace(program_of(files), findings=program.findings))


def write(file: ModuleFile, before: str, after: str, say: Callable[[str], object]) -> None:
    """Overwrite a file with its corrected text; report a checksum that no longer matches."""
    content = file.rewritten(before, after)
    with replaced(file.path, file.content) as stream:
        stream.write(content)
    if hashes := _checksum_of(file.path):
        say(f"{file.path}: is changed, its hash in {hashes} no longer agrees with it")


def _checksum_of(name: str) -> Path | None:
    """The checksum list of the backup that a file is in; None if the file is not listed."""
    for path, root in ((way, it) for way in ways(name) for it in way.parents):
        if (file := root / "BACKINFO" / "checksum.txt").is_file():
            own = f"/{path.relative_to(root).as_posix()}".lower()
            lines = file.read_text(encoding="latin-1").replace("\\", "/").lower().splitlines()
            return file if own in map(str.strip, lines) else None
    return None
