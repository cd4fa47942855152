"""The crates that the extension links."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]


class Crate(NamedTuple):
    """A line of the tree of dependencies."""

    depth: int
    name: str
    version: str
    license: str
    """As its manifest says: `MIT OR Apache-2.0`, in old ones `MIT/Apache-2.0`."""


def cargo(*arguments: str) -> str:
    """Return what a command of cargo prints."""
    command = ["cargo", *arguments, "--locked"]
    return subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


def linked() -> list[Crate]:
    """The tree of the crates that are linked on any platform, the extension first."""
    tree = cargo(
        *("tree", "--package", "irbkin-python"),
        *("--target", "all", "--edges", "normal,no-proc-macro"),
        *("--prefix", "depth", "--format", "|{p}|{l}"),
    )
    crates = []
    for line in tree.splitlines():
        depth, package, license = line.removesuffix(" (*)").split("|")
        name, version = package.split()[:2]
        crates.append(Crate(int(depth), name, version.removeprefix("v"), license))
    return crates
