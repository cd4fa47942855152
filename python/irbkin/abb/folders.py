"""The files of a backup by name without case; texts in the encodings of controllers."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from irbkin._files import is_plain
from irbkin.abb.archives import Unpacked
from irbkin.abb.findings import Finding
from irbkin.rapid.program import ENDINGS, ModuleFile

TASK = re.compile(r"TASK(\d{1,6})", re.IGNORECASE)


def decoded(content: bytes) -> str:
    """Decode a text: by its byte order mark, else as UTF-8, else as Latin-1."""
    file = ModuleFile("", content)
    return content[len(file.mark) :].decode(file.encoding, "replace")


@dataclass
class Folder:
    """The root of a backup, with its files by name without case."""

    root: Path
    """Folder that has BACKINFO, RAPID, SYSPAR and HOME, or some of them."""
    origin: Path
    """The root; of an archive, the path in it."""
    unpacked: Unpacked | None = None
    """Where an archive was unpacked; it lives as long as this record."""
    findings: list[Finding] = field(default_factory=list)
    _inside: Path = field(init=False)
    _entries: dict[Path, dict[str, Path]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._inside = self.root.resolve()

    def shown(self, path: Path) -> str:
        """Return a path relative to the root, with `/`."""
        return path.relative_to(self.root).as_posix() if path != self.root else ""

    def report(self, path: Path, code: str, message: str) -> None:
        """Add a warning about a file, once."""
        finding = Finding(self.shown(path), 0, code, "warning", message)
        if finding not in self.findings:
            self.findings.append(finding)

    def entries(self, folder: Path) -> dict[str, Path]:
        """Return the files and folders in a folder by name in lower case, sorted. What leads out of
        the backup is left out.
        """
        if folder not in self._entries:
            self._entries[folder] = dict(self._listed(folder))
        return self._entries[folder]

    def _listed(self, folder: Path) -> Iterator[tuple[str, Path]]:
        try:
            paths = sorted(folder.iterdir())
        except OSError as error:
            self.report(folder, "unreadable", f"cannot be listed: {error.strerror}")
            return
        names: set[str] = set()
        for path in paths:
            if path.is_symlink() and not self._is_inside(path):
                self.report(path, "symlink", "is a link out of the backup: not followed")
            elif path.exists() and not is_plain(path.stat()):
                message = "is a pipe, a socket or a device: it is not read"
                self.report(path, "unreadable", message)
            elif path.name.lower() in names:
                self.report(
                    path, "doubled-name", "differs from another name only in case: not read"
                )
            else:
                names.add(path.name.lower())
                yield path.name.lower(), path

    def _is_inside(self, path: Path) -> bool:
        try:
            return path.resolve().is_relative_to(self._inside)
        except (OSError, RuntimeError):
            # A circle of links.
            return False

    def find(self, name: str) -> Path | None:
        r"""Return the file of a path relative to the root, compared without case; `\` is `/`."""
        path = self.root
        for part in PurePosixPath(name.replace("\\", "/")).parts:
            found = self.entries(path).get(part.lower()) if path.is_dir() else None
            if found is None:
                return None
            path = found
        return path

    def text(self, *names: str) -> tuple[str, str]:
        """Return the text of the first file that is there, and its path in the backup; both empty
        without one, and of one that cannot be read, which is a finding.
        """
        path = next(filter(None, map(self.find, names)), None)
        if path is None or not path.is_file():
            return "", ""
        try:
            return decoded(path.read_bytes()), self.shown(path)
        except OSError as error:
            self.report(path, "unreadable", f"cannot be read: {error.strerror}")
            return "", ""

    def tasks(self) -> list[tuple[int, Path]]:
        """Return the folders RAPID/TASKn with their numbers, in order."""
        rapid = self.find("RAPID")
        inside = self.entries(rapid).values() if rapid and rapid.is_dir() else ()
        found = [(TASK.fullmatch(path.name), path) for path in inside if path.is_dir()]
        return sorted((int(match[1]), path) for match, path in found if match)

    def modules(self, folder: Path) -> list[Path]:
        """Return the modules in a folder, sorted by name."""
        return [
            path
            for name, path in self.entries(folder).items()
            if name.endswith(ENDINGS) and path.is_file()
        ]
