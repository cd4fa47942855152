"""Files of modules, written back in their encoding."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from irbkin.cli.errors import CommandError
from irbkin.cli.files import replaced, shown

if TYPE_CHECKING:
    from irbkin.rapid import ModuleFile


def write(file: ModuleFile, before: str, after: str) -> None:
    """Write a corrected text in the place of a file."""
    if file.encoded(before) != file.content:
        raise CommandError(
            f"{shown(file.path)}: has bytes that are no {file.encoding} text, so it cannot be "
            "written back as it is: repair them first"
        )
    with replaced(file.path) as stream:
        stream.write(file.encoded(after))


def checksum_of(name: str) -> str | None:
    """The list of hashes of a controller's backup that has a line for a file, if there is one."""
    path = os.path.abspath(name)
    root = os.path.dirname(path)
    while not os.path.isfile(file := os.path.join(root, "BACKINFO", "checksum.txt")):
        if root == os.path.dirname(root):
            return None
        root = os.path.dirname(root)
    own = f"/{os.path.relpath(path, root)}".replace("\\", "/").lower()
    with open(file, encoding="latin-1") as lines:
        return file if any(it.strip().replace("\\", "/").lower() == own for it in lines) else None
