"""Files and streams: read from a name or stdin, how messages name them, and written whole."""

import contextlib
import sys
from collections.abc import Iterator
from typing import BinaryIO, cast

from irbkin import _files
from irbkin._files import replaced as replaced
from irbkin.cli.errors import CommandError

STDIN = "-"
"""The name of stdin, and of stdout as an output."""


@contextlib.contextmanager
def opened(name: str) -> Iterator[BinaryIO]:
    if name == STDIN:
        if sys.stdin is None:
            raise CommandError("stdin is closed")
        yield cast(BinaryIO, sys.stdin.buffer)
        return
    with open(name, "rb") as file:
        yield file


def put_text(name: str | None, text: str) -> None:
    if name in (None, STDIN):
        sys.stdout.write(text)
    else:
        with replaced(name) as file:
            file.write(text.encode())


def shown(name: str) -> str:
    return "stdin" if name == STDIN else _files.shown(name)
