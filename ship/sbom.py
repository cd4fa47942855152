"""Write the software bill of materials that each wheel carries, CycloneDX 1.5.

Usage: python ship/sbom.py [--check]

It lists the crates that are linked into the extension on any platform. maturin's own bill names the
folder of the build, and lists what only tests and macros use.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FILE = ROOT / "ship/irbkin.cyclonedx.json"
TREE = "cargo tree --locked --target all --features python -e normal,no-proc-macro --prefix depth"


def bill() -> str:
    """The text of the file."""
    command = [*TREE.split(), "--format", "|{p}|{l}"]
    lines = subprocess.run(command, cwd=ROOT, capture_output=True, check=True, text=True).stdout
    components: dict[str, dict[str, object]] = {}
    uses: dict[str, set[str]] = {}
    # The package of each depth above the line.
    above: list[str] = []
    for line in lines.splitlines():
        depth, package, license_text = line.removesuffix(" (*)").split("|")
        name, version = package.split()[:2]
        purl = f"pkg:cargo/{name}@{version.removeprefix('v')}"
        components[purl] = {
            "type": "library",
            "bom-ref": purl,
            "name": name,
            "version": version.removeprefix("v"),
            # Old manifests have a slash.
            "licenses": [{"expression": license_text.replace("/", " OR ")}],
            "purl": purl,
        }
        above[int(depth) :] = [purl]
        uses.setdefault(purl, set())
        if len(above) > 1:
            uses[above[-2]].add(purl)
    (irbkin,) = (purl for purl in components if purl.startswith("pkg:cargo/irbkin@"))
    content = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"component": components.pop(irbkin)},
        "components": [components[purl] for purl in sorted(components)],
        "dependencies": [
            {"ref": purl, "dependsOn": sorted(used)} for purl, used in sorted(uses.items())
        ],
    }
    return json.dumps(content, indent=1) + "\n"


if __name__ == "__main__":
    if sys.argv[1:] != ["--check"]:
        FILE.write_text(bill())
    elif FILE.read_text() != bill():
        sys.exit(f"{FILE.relative_to(ROOT)} is not that of Cargo.lock: run python ship/sbom.py")
