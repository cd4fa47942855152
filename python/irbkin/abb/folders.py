"""The files of a backup: where it begins, above or below a path that a user gives; archives (.zip,
.rspag) in temporary folders; names without case, and texts in the encodings of controllers.
"""

import os
import re
import shutil
import tempfile
import weakref
import zipfile
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from irbkin._files import is_plain, ways
from irbkin._words import listed
from irbkin.abb.findings import Finding
from irbkin.errors import IrbkinError
from irbkin.rapid.program import ENDINGS, ModuleFile

TASK = re.compile(r"TASK(\d{1,6})", re.IGNORECASE)
ARCHIVE_ENDINGS = (".zip", ".rspag")
READ_ENDINGS = (*ENDINGS, ".pgf", ".cfg", ".txt", ".xml")
MOST_BYTES = 2**30
"""Bytes that are unpacked of an archive: one that has more is no backup."""
PARTS = ("BACKINFO", "RAPID", "SYSPAR")
"""The folders of a backup beside HOME."""
MOST_FOLDERS = 20_000
"""Folders that are searched below a path for a backup."""


class Unpacked:
    """A folder for the files of an archive; removed with the last reference."""

    def __init__(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="irbkin-backup-"))
        weakref.finalize(self, shutil.rmtree, self.folder, ignore_errors=True)


def archive_of(path: Path) -> Path | None:
    """Return the archive that a path is, or leads into."""
    files = (it for it in (path, *path.parents) if it.suffix.lower() in ARCHIVE_ENDINGS)
    return next((it for it in files if it.is_file()), None)


def unpacked_of(archive: Path) -> Unpacked:
    """Unpack the files of an archive that a backup is read from."""
    unpacked = Unpacked()
    try:
        with zipfile.ZipFile(archive) as opened:
            left = MOST_BYTES
            for member in opened.infolist():
                left -= _unpack(opened, member, unpacked.folder, left)
    except Exception as error:
        # Of a broken archive, zipfile raises errors of many kinds.
        raise IrbkinError(f"{archive}: cannot be unpacked: {error}") from error
    return unpacked


def _unpack(opened: zipfile.ZipFile, member: zipfile.ZipInfo, folder: Path, left: int) -> int:
    parts = PurePosixPath(member.filename.replace("\\", "/")).parts
    if not parts or ".." in parts or parts[0].endswith((":", "/")):
        return 0
    path = folder.joinpath(*parts)
    inside = path if member.is_dir() else path.parent
    inside.mkdir(parents=True, exist_ok=True)
    if member.is_dir() or not path.name.lower().endswith(READ_ENDINGS):
        return 0
    with opened.open(member) as file:
        content = file.read(left + 1)
    if len(content) > left:
        raise ValueError(f"it has more than {MOST_BYTES} bytes of text")
    path.write_bytes(content)
    return len(content)


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
    _entries: dict[Path, dict[str, Path]] = field(default_factory=dict)

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
            return path.resolve().is_relative_to(self.root.resolve())
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


def open_backup(path: Path) -> Folder:
    """Find the backup of a path: its folder, one in it or above it, a file in it, or an archive."""
    archive = archive_of(path)
    if archive is not None:
        unpacked = unpacked_of(archive)
        start = unpacked.folder / path.relative_to(archive)
        root = _root(start, archive, unpacked.folder)
        return Folder(root, archive / root.relative_to(unpacked.folder), unpacked)
    if not path.exists():
        raise IrbkinError(f"{path}: no such file or folder")
    root = _root(path, None, None)
    return Folder(root, root)


def _root(start: Path, archive: Path | None, unpacked: Path | None) -> Path:
    def shown(path: Path) -> str:
        return str(path if unpacked is None else archive / path.relative_to(unpacked))  # type: ignore[operator]

    if start.is_file():
        start = start.parent
    if _parts(start):
        return start
    # Not above an archive, and not the root of the file system.
    above = [it for way in ways(start) for it in way.parents[:4]]
    for folder in above:
        if (unpacked is None or folder.is_relative_to(unpacked)) and _parts(folder) > 1:
            return folder
    if _has_cfg(start):
        return start
    whole, half = _below(start)
    found = whole or half
    if not found:
        wanted = "BACKINFO, RAPID or SYSPAR"
        raise IrbkinError(f"{shown(start)}: is no backup of a controller, it has no {wanted}")
    if len(found) > 1:
        names = listed(map(shown, found))
        raise IrbkinError(f"{shown(start)}: has {len(found)} backups, give one: {names}")
    return found[0]


def backup_above(path: Path) -> Path | None:
    """Return the root of the backup that a path is or is in; None if it is in no backup."""
    own = (it for way in ways(path) for it in (way, *way.parents[:5]))
    return next((it for it in own if _parts(it) > 1), None)


def backups_of(path: Path) -> list[Path]:
    """Return the backup that a file or folder is or is in, else those below it."""
    above = backup_above(path)
    return [above] if above else _below(path)[0] if path.is_dir() else []


def _inside(folder: Path) -> list[os.DirEntry[str]]:
    """Return what is in a folder, sorted by name; nothing where it cannot be listed."""
    try:
        with os.scandir(folder) as entries:
            return sorted(entries, key=lambda entry: entry.name)
    except OSError:
        return []


def _parts(folder: Path) -> int:
    names = {entry.name.upper() for entry in _inside(folder) if entry.is_dir()}
    return len(names.intersection(PARTS))


def _has_cfg(folder: Path) -> bool:
    return any(entry.name.lower() in ("moc.cfg", "sys.cfg") for entry in _inside(folder))


def _below(start: Path) -> tuple[list[Path], list[Path]]:
    """Return whole backups below a folder, and halves; not behind links, nor in HOME of another."""
    whole, half = [], []
    queue = deque([start])
    for _ in range(MOST_FOLDERS):
        if not queue:
            break
        folder = queue.popleft()
        parts = _parts(folder)
        if parts > 1:
            whole.append(folder)
            continue
        if parts or (_has_cfg(folder) and folder.name.upper() != "SYSPAR"):
            half.append(folder)
        inside = _inside(folder)
        queue.extend(Path(it.path) for it in inside if it.is_dir(follow_symlinks=False))
    return whole, half
