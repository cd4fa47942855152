"""Where a backup begins: the root of a path that a user gives."""

import os
from collections import deque
from pathlib import Path

from irbkin._files import ways
from irbkin._words import listed
from irbkin.abb.archives import archive_of, unpacked_of
from irbkin.abb.folders import Folder
from irbkin.errors import IrbkinError

PARTS = ("BACKINFO", "RAPID", "SYSPAR")
"""The folders of a backup beside HOME."""
MOST_FOLDERS = 20_000
"""Folders that are searched below a path for a backup."""


def open_backup(path: Path) -> Folder:
    """Find the backup of a path: its folder, a folder or file in it, one above it, or an archive.

    Raises:
        IrbkinError: There is none, or there are several; the message lists them.
    """
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
    """Return how many of the folders of a backup a folder has."""
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
