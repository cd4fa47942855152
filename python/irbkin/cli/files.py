"""Files and streams: read from a name or stdin, written beside and renamed."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator
from typing import BinaryIO, cast

from irbkin.cli.errors import CommandError

STDIN = "-"
"""The name of stdin, and of stdout as an output."""


@contextlib.contextmanager
def opened(name: str) -> Iterator[BinaryIO]:
    """The bytes of a file, or of stdin where the name is `-`."""
    if name == STDIN:
        if sys.stdin is None:
            raise CommandError("stdin is closed")
        yield cast(BinaryIO, sys.stdin.buffer)
        return
    with open(name, "rb") as file:
        yield file


def shown(name: str) -> str:
    """How messages name an input: a path in the working folder is relative."""
    if name == STDIN:
        return "stdin"
    here = os.path.join(os.getcwd(), "")
    return name[len(here) :] if os.path.isabs(name) and name.startswith(here) else name


@contextlib.contextmanager
def replaced(name: str) -> Iterator[BinaryIO]:
    """A file to write, which takes the place of another one when it is whole.

    It is written beside it and renamed. A link stays a link; the permissions of a file that is
    there are kept. What is not a plain file, such as a pipe, is written directly.
    """
    target = os.path.realpath(name)
    if os.path.isdir(target):
        raise IsADirectoryError(21, "is a folder", name)
    if os.path.exists(target) and not os.path.isfile(target):
        with open(target, "wb") as file:
            yield file
        return
    mode = os.stat(target).st_mode & 0o777 if os.path.exists(target) else 0o666
    folder, last = os.path.split(target)
    beside = os.path.join(folder, f".{last}.{os.getpid()}.part")
    flags = os.O_RDWR | os.O_CREAT | os.O_TRUNC | getattr(os, "O_BINARY", 0)
    try:
        handle = os.open(beside, flags, mode)
    except OSError as error:
        raise OSError(error.errno, f"cannot be written: {error.strerror}", name) from None
    try:
        with open(handle, "w+b") as file:
            yield file
        os.replace(beside, target)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(beside)
        raise
