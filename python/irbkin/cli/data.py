"""RAPID in place of numbers: a value in brackets, or its declaration."""

import re
from collections.abc import Iterator, Sequence
from typing import Any

from irbkin.cli.errors import CommandError

KINDS = {
    "robtarget": ("RobTarget", "irbkin ik takes it"),
    "jointtarget": ("JointTarget", "irbkin fk takes it"),
    "tooldata": ("ToolData", "--tool takes it"),
    "wobjdata": ("WobjData", "--wobj takes it"),
    "pose": ("Pose", "irbkin ik takes it"),
}
"""Kinds of data: the class in `irbkin.rapid`, and where it goes."""
FILE = re.compile(r"(.+\.(?:mod|sys|prg))(?::(\w+))?", re.IGNORECASE)
"""A module, and behind a colon one of its data."""
MOST_SHOWN = 60


def is_data(text: str) -> bool:
    """Whether a word is RAPID, or a file of it."""
    return text.lstrip()[:1] == "[" or ":=" in text or FILE.fullmatch(text) is not None


def data_of(text: str, *kinds: str) -> list[tuple[str, Any]]:
    """Names and values of some kinds in RAPID; the name of a value alone is empty."""
    from irbkin import rapid
    from irbkin.errors import RapidError

    found, reasons = [], {}
    if is_declared := FILE.fullmatch(text):
        data = rapid.load(is_declared[1]).items()
        name = (is_declared[2] or "").lower()
        found = [pair for pair in data if name in ("", pair[0].lower())]
    elif is_declared := re.search(r"\b\w+\s+\w+\s*:=", text):
        # Lines that are pasted may lack their last semicolon.
        found = [*rapid.parse(f"{text.rstrip().rstrip(';')};").items()]
    else:
        value = text.rpartition(":=")[2].strip().rstrip(";")
        for kind in KINDS:
            try:
                found += [("", rapid.parse(f"PERS {kind} it:={value};")["it"])]
            except (KeyError, RapidError) as error:
                reasons[kind] = re.sub(r"^line 1, column \d+: (\w+ it:? )?(has)?", "", str(error))
    wanted = {getattr(rapid, KINDS[kind][0]) for kind in kinds}
    if taken := [pair for pair in found if type(pair[1]) in wanted]:
        return taken
    shown = text if len(text) <= MOST_SHOWN else f"{text[:MOST_SHOWN]} ..."
    words = f"a {' or '.join(kinds)} is wanted"
    for kind, (name, where) in KINDS.items():
        if any(isinstance(value, getattr(rapid, name)) for _, value in found):
            raise CommandError(f"{shown} is a {kind}, {words} ({where})")
    why = "" if is_declared else f": {reasons[kinds[0]].strip()}"
    raise CommandError(f"{shown} is no {kinds[0]}{why}; {words}, as [[..],..] or declared")


def split(words: Sequence[str]) -> Iterator[str]:
    """RAPID that a shell has split at blanks: words up to each bracket that closes."""
    text = ""
    for word in words:
        text = f"{text} {word}".strip()
        if text.count("[") == text.count("]") > 0 or FILE.fullmatch(text):
            yield text
            text = ""
    if text:
        yield text


def frame_of(words: Sequence[Any], name: str) -> list[float]:
    import numpy as np

    from irbkin import to_xyz_wxyz

    kind = {"tool": "tooldata", "wobj": "wobjdata"}.get(name)
    (_, it), *others = data_of(" ".join(map(str, words)), *filter(None, (kind, "pose")))
    if others:
        raise CommandError(f"--{name} takes one value, got {len(others) + 1} (FILE:NAME has one)")
    is_tool = kind == "tooldata"
    if getattr(it, "robhold", is_tool) != is_tool or not getattr(it, "ufprog", True):
        words = "a stationary tool, or a work object that is held or moved, is for irbkin.rapid"
        raise CommandError(f"--{name}: {words} in Python")
    T = np.eye(4)
    for frame in [own for own in ("uframe", "oframe", "tframe") if hasattr(it, own)]:
        T = T @ getattr(it, frame).matrix()
    xyz, wxyz = to_xyz_wxyz(T if kind and hasattr(it, "robhold") else it.matrix())
    return [*(xyz * 1e3), *wxyz]


def angles_of(words: Sequence[Any], count: int) -> list[float]:
    if not any(isinstance(it, str) for it in words):
        return [*words]
    ((_, target), *_) = data_of(" ".join(map(str, words)), "jointtarget")
    return [*target.robax_deg, *target.extax][:count]
