"""Print a table of the files in dist: size, sha256, and what ran on each.

Usage: python ship/table.py
"""

from __future__ import annotations

import hashlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def what_ran() -> dict[str, list[str]]:
    """What ship/ran.sh recorded, by the hash of the file."""
    record = ROOT / "target/ship/ran.txt"
    ran: dict[str, list[str]] = {}
    for line in record.read_text().splitlines() if record.exists() else ():
        sha256, what = line.split(" ", 1)
        ran.setdefault(sha256, []).append(what)
    return ran


if __name__ == "__main__":
    ran = what_ran()
    print("| file | bytes | tag | sha256 | ran |\n|---|---|---|---|---|")
    for file in sorted((ROOT / "dist").glob("irbkin-*")):
        sha256 = hashlib.sha256(file.read_bytes()).hexdigest()
        # name-version-python-abi-platform.whl
        tag = "-".join(file.stem.split("-")[2:]) if file.suffix == ".whl" else "source"
        done = ", ".join(dict.fromkeys(ran.get(sha256, ["nothing"])))
        print(f"| {file.name} | {file.stat().st_size:,} | {tag} | `{sha256}` | {done} |")
