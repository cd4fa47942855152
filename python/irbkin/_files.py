"""Files: how messages name them; written whole or not at all, and never where a link leads."""

import contextlib
import csv
import errno
import io
import os
import stat
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import IO, Any, BinaryIO

STREAMS = ("/dev/fd/", "/dev/std", "/proc/")
"""Names of streams that are open; they are links, perhaps to a file."""


def shown(name: str) -> str:
    """How messages name an input: a path in the working folder is relative."""
    here = os.path.join(os.getcwd(), "")
    return name[len(here) :] if os.path.isabs(name) and name.startswith(here) else name


def read(path: str | os.PathLike[str]) -> bytes:
    """The content of a file; an OSError of a pipe, a socket or a device, which may never end."""
    name = os.fspath(path)
    if not name.startswith(STREAMS) and not is_plain(os.stat(name)):
        raise OSError(errno.EINVAL, "is a pipe, a socket or a device", name)
    return _content(name)


def is_plain(of: os.stat_result) -> bool:
    """Whether a path is a file or a folder."""
    return stat.S_ISREG(of.st_mode) or stat.S_ISDIR(of.st_mode)


def ways(path: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Return the absolute paths of a file or folder: as it is spelled, and without links; the
    second alone where a `..` behind a link leads elsewhere than it reads.
    """
    spelled, real = Path(os.path.abspath(path)), Path(os.path.realpath(path))
    return (spelled, real) if Path(os.path.realpath(spelled)) == real else (real,)


@contextlib.contextmanager
def replaced(path: str | os.PathLike[str], before: bytes | None = None) -> Iterator[BinaryIO]:
    """A file to write, which takes the place of another one when it is whole.

    It is written without a name, or under one beside it that nobody can foretell, and renamed.
    Permissions and extended attributes of a file that is there are kept, its owner and group where
    this user may set them. A link stays a link; one that leads out of its folder is refused. A file
    of several names (hard links) keeps them: when all is written, it is overwritten. What is not a
    plain file, such as a pipe, is written directly.

    Args:
        path: The file.
        before: What it must still have when its place is taken; anything when not given.

    Raises:
        OSError: It cannot be written, is a link out of its folder, is read-only, or has changed.
    """
    name = os.fspath(path)
    target = name if name.startswith(STREAMS) else _target(name)
    old = os.stat(target) if os.path.exists(target) else None
    if target.startswith(STREAMS) or not (old is None or stat.S_ISREG(old.st_mode)):
        with open(target, "wb") as file:
            yield file
        return
    # Root may write everywhere: the bits are what the owner wants.
    if old is not None and not (old.st_mode & 0o222 and os.access(target, os.W_OK)):
        words = "is read-only: make it writable first, or give another file"
        raise PermissionError(errno.EACCES, words, name)
    beside = os.path.join(os.path.dirname(target), f".{os.urandom(8).hex()}.part")
    content = None
    try:
        # Until it has the permissions of the old file, nobody else may open it.
        handle, is_nameless = _created(beside, 0o666 if old is None else 0o600)
        try:
            with open(handle, "w+b") as file:
                if old is not None:
                    _keep(target, old, handle, beside)
                yield file
                file.flush()
                os.fsync(handle)
                if before is not None and _content(target) != before:
                    words = "has changed since it was read: it is left as it is, run this again"
                    raise OSError(errno.EBUSY, words, name)
                if old is not None and old.st_nlink > 1:
                    file.seek(0)
                    content = file.read()
                elif is_nameless:
                    # Given a folder, `os.link` follows the link to the file.
                    os.link(f"/proc/self/fd/{handle}", beside, src_dir_fd=handle)
            if content is None:
                os.replace(beside, target)
            else:
                with open(target, "r+b") as file:
                    file.write(content)
                    file.truncate()
        finally:
            with contextlib.suppress(OSError):
                os.unlink(beside)
    except OSError as error:
        if error.errno is None or error.filename not in (None, beside):
            raise
        raise OSError(error.errno, f"cannot be written: {error.strerror}", name) from None


def write_columns(
    columns: Mapping[str, Any], path_or_file: str | os.PathLike[str] | IO[str]
) -> None:
    """Write columns, arrays or lists of one length, under a line of their names; with every digit
    of a number, and nothing for None.
    """
    if isinstance(path_or_file, str | os.PathLike):
        with replaced(path_or_file) as file:
            text = io.TextIOWrapper(file, "utf-8", newline="")
            write_columns(columns, text)
            text.detach()
        return
    rows = csv.writer(path_or_file, lineterminator="\n")
    rows.writerow(columns)
    lists = (it if isinstance(it, list) else it.tolist() for it in columns.values())
    rows.writerows(zip(*lists, strict=True))


def _target(name: str) -> str:
    """The file that a name means; of a link, the one that it leads to in its own folder."""
    target, folder = os.path.realpath(name), os.path.realpath(os.path.dirname(name))
    if os.path.islink(name) and os.path.dirname(target) != folder:
        # Who made it may want a file written that the user does not mean.
        words = f"is a link out of its folder: give {target} itself"
        raise OSError(errno.ELOOP, words, name)
    if os.path.isdir(target):
        raise IsADirectoryError(errno.EISDIR, "is a folder", name)
    return target


def _keep(target: str, old: os.stat_result, handle: int, beside: str) -> None:
    """Give a new file the owner, the group, the permissions and, where the system has them, the
    extended attributes of the old one.
    """
    if hasattr(os, "fchown"):
        for owner in (old.st_uid, -1):
            with contextlib.suppress(OSError):
                os.fchown(handle, owner, old.st_gid)
                break
    mode = old.st_mode & 0o777
    if os.fstat(handle).st_mode & 0o777 != mode:
        os.chmod(handle if os.chmod in os.supports_fd else beside, mode)
    with contextlib.suppress(AttributeError, OSError):
        for name in os.listxattr(target):
            with contextlib.suppress(OSError):
                os.setxattr(handle, name, os.getxattr(target, name))


def _created(beside: str, mode: int) -> tuple[int, bool]:
    """Open a new file; where the system can, without a name: a killed process leaves nothing."""
    with contextlib.suppress(AttributeError, OSError):
        os.stat("/proc/self/fd")
        return os.open(os.path.dirname(beside) or ".", os.O_RDWR | os.O_TMPFILE, mode), True
    flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    return os.open(beside, flags, mode), False


def _content(name: str) -> bytes:
    with open(name, "rb") as file:
        return file.read()
