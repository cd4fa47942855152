"""Write THIRDPARTY.txt: the crates that wheels link, by license, each text of a license once.

Usage: python ship/thirdparty.py [--check]
"""

from __future__ import annotations

import json
import re
import sys
import textwrap
from collections import defaultdict
from pathlib import Path

from crates import ROOT, cargo, linked

FILE = ROOT / "THIRDPARTY.txt"
# How the text of a license begins, after the copyright notices. If a crate offers several licenses,
# the first of these is taken.
OPENINGS = {
    "MIT": "Permission is hereby granted",
    "BSD-2-Clause": "Redistribution and use",
    "Apache-2.0": "Licensed under the Apache License",
}
HEAD = """\
The wheels of irbkin contain the Rust standard library (MIT, The Rust Project Developers) and the
crates below, with their copyright notices, each under the license that is named. `make thirdparty`
writes this file.
"""


def in_wheels() -> list[tuple[str, str, Path]]:
    """Name with version, license expression and folder of each crate in wheels of any platform."""
    names = {(crate.name, crate.version) for crate in linked()}
    packages = json.loads(cargo("metadata", "--all-features", "--format-version", "1"))["packages"]
    return [
        (f"{package['name']} {package['version']}", package["license"], folder)
        for package in packages
        if (package["name"], package["version"]) in names
        and ROOT not in (folder := Path(package["manifest_path"]).parent, *folder.parents)
    ]


def chosen(crate: str, expression: str) -> str:
    """Return the license of an expression such as `Apache-2.0 OR MIT` that irbkin takes."""
    offered = re.split(r" OR |/", expression)
    for license in OPENINGS:
        if license in offered:
            return license
    sys.exit(f"{crate} has the license {expression}: {__file__} knows {', '.join(OPENINGS)}")


def notice_and_text(crate: str, license: str, folder: Path) -> tuple[str, str]:
    """Return the copyright notice of a crate and the text of its license."""
    for file in sorted(folder.glob("LICENSE*")):
        before, opening, after = file.read_text(encoding="utf-8").partition(OPENINGS[license])
        if not opening:
            continue
        if license == "Apache-2.0":
            # Its names are between the license, which irbkin has already, and the opening.
            notices = re.findall(r"^ *(Copyright \d.*)$", before, re.MULTILINE)
            return ", ".join(notices), "The text is in LICENSE-APACHE."
        titles = r"(?im)^.*(licen[cs]e|all rights reserved).*$"
        return " ".join(re.sub(titles, "", before).split()), " ".join((opening + after).split())
    sys.exit(f"{crate} has no file with the text of its license, {license}: look into {folder}")


def third_party() -> str:
    """Return the content of THIRDPARTY.txt."""
    crates = defaultdict(list)
    for crate, expression, folder in in_wheels():
        license = chosen(crate, expression)
        notice, text = notice_and_text(crate, license, folder)
        crates[license, text].append(f"  {crate}{': ' if notice else ''}{notice}")
    parts = [HEAD]
    for (license, text), lines in sorted(crates.items()):
        parts.append("\n".join([license, *sorted(lines), "", textwrap.fill(text, 100), ""]))
    return "\n".join(parts)


if __name__ == "__main__":
    content = third_party()
    if "--check" not in sys.argv:
        FILE.write_text(content, encoding="utf-8")
    elif not FILE.exists() or FILE.read_text(encoding="utf-8") != content:
        sys.exit(f"{FILE.name} is not current: `make thirdparty` writes it")
