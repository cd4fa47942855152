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
    manifest = (ROOT / "Cargo.toml").read_text()
    repository, version = (
        re.search(rf'^{key} = "(.*)"', manifest, re.MULTILINE)[1]  # type: ignore[index]
        for key in ("repository", "version")
    )
    readme = ROOT / "README.md"
    readme.write_text(absolute(readme.read_text(), repository, version))


if __name__ == "__main__":
    main()
