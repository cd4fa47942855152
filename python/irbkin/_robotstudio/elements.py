"""RobotStudio's files: XML, a ZIP of it (.rslib, .rsstn), a ZIP of these (.rspag).

The XML has two spellings, in any namespace: attributes, or children with a `Value`. Names are given
in lower case.
"""

import io
import os
import zipfile
from collections.abc import Iterator
from typing import IO
from xml.etree import ElementTree

import numpy as np

from irbkin._arrays import Floats
from irbkin.errors import InvalidModelError

MOST_XML = 2**26
"""Bytes of one document: the largest public station has 11 MB."""
MOST_BYTES = 2**29
"""Bytes of all that is unpacked; geometry is not."""
LEAST_BYTES, MOST_RATIO = 2**20, 100
"""Bytes that are unpacked of any file, and of a larger one for each of its bytes."""
Element = ElementTree.Element
SKEW = 1e-5
"""How far a rotation may be from an orthonormal one [1]."""
MOST_ELEMENTS, LEAST_SIZE = 100_000, 12
"""Elements of any document, and least bytes of each in a larger one: RobotStudio's have 18."""
MOST_DEPTH = 32
"""Elements of a mechanism in each other: RobotStudio writes five."""
MOST_NUMBERS = 100_000
"""Numbers of an element."""


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


def elements_of(content: bytes, *wanted: str) -> Iterator[Element]:
    """The elements of these names; all else is dropped while it is read, a <!DOCTYPE> refused."""
    try:
        text = content.decode("utf-8-sig")
        if "<!DOCTYPE" in text:
            raise InvalidModelError("has a <!DOCTYPE>, RobotStudio writes none: remove it")
        # The text may declare another encoding.
        parser = ElementTree.XMLParser(encoding="utf-8")
        above: list[Element] = []
        most = max(MOST_ELEMENTS, len(content) // LEAST_SIZE)
        # How many are open from the first on that is wanted; these are kept.
        depth = count = 0
        for event, element in ElementTree.iterparse(
            io.BytesIO(text.encode()), ("start", "end"), parser
        ):
            is_wanted = local(element) in wanted
            if event == "start":
                above.append(element)
                depth += depth > 0 or is_wanted
                count += 1
                if count > most or depth > MOST_DEPTH:
                    raise InvalidModelError(
                        f"has more than {most} elements, or mechanisms of more than {MOST_DEPTH} "
                        "elements in each other: RobotStudio writes fewer"
                    )
                continue
            above.pop()
            depth -= depth > 0
            if is_wanted:
                yield element
            if not depth and above:
                above[-1].remove(element)
    except UnicodeDecodeError as error:
        raise InvalidModelError(f"is not UTF-8 at byte {error.start}") from None
    except ElementTree.ParseError as error:
        raise InvalidModelError(f"is not XML: {error}") from None


def local(element: Element) -> str:
    return element.tag.rpartition("}")[2].lower()


def child(element: Element | None, name: str) -> Element | None:
    return next((it for it in element if local(it) == name), None) if element is not None else None


def parts(element: Element, name: str) -> list[Element]:
    found = child(element, name)
    return [] if found is None else [*found]


def word(element: Element | None, name: str) -> str:
    """An attribute, or the `Value` of a child; empty if there is neither."""
    attributes = {} if element is None else element.attrib
    for key, value in attributes.items():
        if key.rpartition("}")[2].lower() == name:
            return value.strip()
    found = child(element, name)
    return "" if found is None else word(found, "value")


def number(element: Element, name: str) -> float:
    text = word(element, name)
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise InvalidModelError(f"{name} of {local(element)} is {text!r}, it must be a number")
    return value


def integer(element: Element, name: str) -> int:
    value = number(element, name)
    if value != int(value):
        raise InvalidModelError(f"{name} of {local(element)} is {value:g}, not a whole number")
    return int(value)


def numbers(element: Element | None) -> list[float]:
    """All numbers in an element in their order, as many as its sizes say; none of no element."""
    if element is None:
        return []
    sizes = ("numrows", "numcols")
    own = [it for it in element.iter() if local(it) not in sizes and word(it, "value")]
    if len(own) > MOST_NUMBERS:
        raise InvalidModelError(f"{local(element)} has more than {MOST_NUMBERS} numbers")
    found = [number(it, "value") for it in own]
    size = [integer(element, it) for it in sizes if word(element, it)]
    if size and len(found) != np.prod(size):
        raise InvalidModelError(f"{local(element)} must have {' x '.join(map(str, size))} numbers")
    return found


def transform(element: Element) -> Floats:
    """A rigid transform: RowX, RowY, RowZ and RowT, the images of axes and origin."""
    rows = [it for it in element if local(it) in ("rowx", "rowy", "rowz", "rowt")]
    values = [number(row, axis) for row in rows for axis in "xyzw"]
    name = local(element)
    if len(values) != 16:
        raise InvalidModelError(f"{name} has {len(values)} numbers, a transform has 16")
    found = np.reshape(values, (4, 4)).T
    skew = np.abs(found[:3, :3] @ found[:3, :3].T - np.eye(3)).max()
    is_turn = skew <= SKEW and np.linalg.det(found[:3, :3]) > 0.0
    if not is_turn or (found[3] != [0.0, 0.0, 0.0, 1.0]).any():
        raise InvalidModelError(
            f"{name} is not a rigid transform: its axes are {skew:.1e} from orthonormal, at most "
            f"{SKEW:g}, or left-handed, or 0 0 0 1 is missing"
        )
    return found
