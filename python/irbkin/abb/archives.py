"""Archives of backups (.zip, .rspag): unpacked into a temporary folder."""

import shutil
import tempfile
import weakref
import zipfile
from pathlib import Path, PurePosixPath

from irbkin.errors import IrbkinError
from irbkin.rapid.program import ENDINGS

ARCHIVE_ENDINGS = (".zip", ".rspag")
READ_ENDINGS = (*ENDINGS, ".pgf", ".cfg", ".txt", ".xml")
MOST_BYTES = 2**30
"""Bytes that are unpacked of an archive: one that has more is no backup."""


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
