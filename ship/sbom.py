"""Write the software bill of materials that each wheel carries, CycloneDX 1.5.

Usage: python ship/sbom.py [--check]

It lists the crates that are linked into the extension on any platform. maturin's own bill names the
folder of the build, and lists crates that only tests and macros use.
"""

from __future__ import annotations

import json
import sys

from crates import ROOT, linked

FILE = ROOT / "ship/irbkin.cyclonedx.json"


def bill() -> str:
    """The text of the file."""
    components: dict[str, dict[str, object]] = {}
    uses: dict[str, set[str]] = {}
    # The package of each depth above the line.
    above: list[str] = []
    for crate in linked():
        purl = f"pkg:cargo/{crate.name}@{crate.version}"
        components[purl] = {
            "type": "library",
            "bom-ref": purl,
            "name": crate.name,
            "version": crate.version,
            # Old manifests have a slash.
            "licenses": [{"expression": crate.license.replace("/", " OR ")}],
            "purl": purl,
        }
        above[crate.depth :] = [purl]
        uses.setdefault(purl, set())
        if len(above) > 1:
            uses[above[-2]].add(purl)
    (irbkin,) = (purl for purl in components if purl.startswith("pkg:cargo/irbkin-python@"))
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
        sys.exit(f"{FILE.relative_to(ROOT)} is not current: `make thirdparty` writes it")
