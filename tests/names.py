"""The public names of the crates, of the C library and of the Python package, as text files.

Usage: python tests/names.py [--write], after `cargo doc`. Fails if a name came or went that
`tests/names` does not have; --write takes them as they are.
"""

from __future__ import annotations

import difflib
import importlib
import inspect
import pkgutil
import re
import sys
from pathlib import Path
from types import ModuleType

import irbkin

ROOT = Path(__file__).parents[1]
NAMES = ROOT / "tests" / "names"
ITEM = re.compile(r'<li><a href="([\w/]*?)(\w+)\.(\w+)\.html">')
FUNCTION = re.compile(r"\b(irbkin_\w+)\(")


def rust() -> list[str]:
    """The items of the crates, by rustdoc's list of all of them."""
    names = []
    for crate in ("irbkin", "irbkin_motion", "irbkin_abb"):
        page = (ROOT / "target" / "doc" / crate / "all.html").read_text()
        for path, kind, name in ITEM.findall(page):
            names.append(f"{crate}::{path.replace('/', '::')}{name} {kind}")
    return sorted(names)


def c() -> list[str]:
    """The functions of the header."""
    header = (ROOT / "crates" / "irbkin-capi" / "include" / "irbkin.h").read_text()
    return sorted(set(FUNCTION.findall(header)))


def of_module(module: ModuleType) -> list[str]:
    """The public names of a module, and of its classes."""
    names = []
    for name in getattr(module, "__all__", []):
        value = getattr(module, name)
        names.append(f"{module.__name__}.{name}")
        if inspect.isclass(value):
            own = (it for it in dir(value) if not it.startswith("_"))
            inherited = {it for base in value.__mro__[1:] for it in vars(base)}
            names += [f"{module.__name__}.{name}.{it}" for it in own if it not in inherited]
    return names


def python() -> list[str]:
    """The names of the package's public modules."""
    found = pkgutil.walk_packages(irbkin.__path__, "irbkin.")
    public = [it.name for it in found if not re.search(r"\._|\.__main__$", it.name)]
    modules = [irbkin, *(importlib.import_module(name) for name in public)]
    return sorted(name for module in modules for name in of_module(module))


def main() -> int:
    """Compare the names with the files."""
    is_wrong = False
    for kind in (rust, c, python):
        file, found = NAMES / f"{kind.__name__}.txt", kind()
        if "--write" in sys.argv[1:]:
            NAMES.mkdir(exist_ok=True)
            file.write_text("\n".join(found) + "\n")
        recorded = file.read_text().splitlines()
        for line in difflib.unified_diff(recorded, found, f"tests/names/{file.name}", "found", n=0):
            is_wrong = True
            print(line.rstrip())
    if is_wrong:
        print("public names differ: a new one takes the place of another (tests/names.py --write)")
    return int(is_wrong)


if __name__ == "__main__":
    sys.exit(main())
