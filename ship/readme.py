"""Write absolute addresses into README's links: on PyPI there is no folder for relative ones.

Usage: python ship/readme.py, in a checkout that is built for PyPI and not committed from.
"""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def absolute(text: str, repository: str, version: str) -> str:
    """Return a text of Markdown with its relative links and pictures at the tag of a version."""

    def link(found: re.Match[str]) -> str:
        view = "raw" if found[1] else "blob"
        return f"{found[1]}[{found[2]}]({repository}/{view}/v{version}/{found[3]})"

    return re.sub(r"(!?)\[([^\]]*)\]\((?!https?:|#)([^)]*)\)", link, text)


def main() -> None:
    """Rewrite README.md."""
    manifest = (ROOT / "Cargo.toml").read_text(encoding="utf-8")
    version, repository = re.findall(r'^(?:version|repository) = "(.*)"', manifest, re.MULTILINE)
    readme = ROOT / "README.md"
    # As bytes: on Windows a text would get another encoding and other ends of lines.
    readme.write_bytes(absolute(readme.read_bytes().decode(), repository, version).encode())


if __name__ == "__main__":
    main()
