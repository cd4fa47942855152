"""Documents in RobotStudio's files: XML, a ZIP of it (.rslib, .rsstn), a ZIP of these (.rspag)."""

import io
import os
import zipfile
from collections.abc import Iterator
from typing import IO

from irbkin.errors import InvalidModelError

MOST_XML = 2**26
"""Bytes of one document: the largest public station has 11 MB."""
MOST_BYTES = 2**29
"""Bytes of all that is unpacked; geometry is not."""
LEAST_BYTES, MOST_RATIO = 2**20, 100
"""Bytes that are unpacked of any file, and of a larger one for each of its bytes."""


def documents(path: str) -> Iterator[tuple[str, bytes]]:
    """The XML documents of a file, with the lower-case name of the library or station."""
    with open(path, "rb") as file:
        most = max(LEAST_BYTES, MOST_RATIO * os.fstat(file.fileno()).st_size)
        left = [min(MOST_BYTES, most)]
        yield from _documents(file, os.path.basename(path).lower(), left, True)


def _documents(
    file: IO[bytes], name: str, left: list[int], is_outer: bool
) -> Iterator[tuple[str, bytes]]:
    """The documents of an archive and of those in it, which have none in them; or the one."""
    start = file.read(64).removeprefix(b"\xef\xbb\xbf").lstrip()
    file.seek(0)
    if start.startswith(b"<"):
        yield name, _bounded(file, name, MOST_XML)
        return
    if not start.startswith(b"PK"):
        raise InvalidModelError(f"{name} is no .rslib, .rsstn, .rspag or .rsstnx")
    try:
        with zipfile.ZipFile(file) as archive:
            for member in archive.infolist():
                own = member.filename.replace("\\", "/").rpartition("/")[2].lower()
                if own == "pim.xml":
                    yield name, _content(archive, member, left, MOST_XML)
                elif own.endswith((".rsstnx", ".rsstn", ".rslib") if is_outer else ".rsstnx"):
                    content = _content(archive, member, left, MOST_BYTES)
                    yield from _documents(io.BytesIO(content), own, left, False)
    except InvalidModelError:
        raise
    except Exception as error:
        # Of a broken archive, zipfile raises errors of many kinds.
        raise InvalidModelError(f"{name} is a broken archive: {error}") from None


def _content(
    archive: zipfile.ZipFile, member: zipfile.ZipInfo, left: list[int], most: int
) -> bytes:
    """The content of a member, whose size is checked before it is read and while it is."""
    name, most = member.filename, min(most, left[0])
    if member.flag_bits & 1:
        raise InvalidModelError(f"{name} is encrypted: pack it in RobotStudio without a password")
    if member.file_size > most:
        raise InvalidModelError(f"{name} has {member.file_size} bytes, at most {most} are read")
    with archive.open(member) as opened:
        content = _bounded(opened, name, most)
    left[0] -= len(content)
    return content


def _bounded(file: IO[bytes], name: str, most: int) -> bytes:
    content = file.read(most + 1)
    if len(content) > most:
        raise InvalidModelError(f"{name} has more than {most} bytes, the most that are read")
    return content
