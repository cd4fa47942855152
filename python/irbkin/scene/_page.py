"""The page: one HTML file with the crate as WebAssembly, which needs no network."""

from __future__ import annotations

import base64
import json
import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from irbkin.scene._data import Scene

FOLDER = Path(__file__).with_name("page")
ENGINE = FOLDER / "irbkin.wasm.gz"
SCRIPTS = (
    "math", "engine", "shapes", "arm", "camera", "gl", "flat", "dom", "handle", "read", "write",
    "program", "scene", "view", "panels", "app",
)  # fmt: skip
"""The scripts, each behind those that it uses."""


def page(scene: Scene | None = None) -> str:
    """Return the page as HTML.

    Args:
        scene: What it shows at first; an arm of the catalog when not given.

    Raises:
        FileNotFoundError: This installation has no `irbkin.wasm.gz`.
    """
    text = (FOLDER / "page.html").read_text(encoding="utf-8")
    # A text cannot begin or end the script that it is in.
    own = "null" if scene is None else scene.to_json().replace("<", "\\u003c")
    title = "irbkin" if scene is None or not scene.title else f"irbkin: {scene.title}"
    parts = {
        "/*title*/": title.replace("&", "&amp;").replace("<", "&lt;"),
        "/*css*/": style(),
        "/*js*/": scripts(),
        "/*wasm*/": engine(),
        "/*scene*/": own,
    }
    marks = "|".join(map(re.escape, parts))
    return re.sub(marks, lambda mark: parts[mark[0]], text)


@cache
def scripts() -> str:
    """Return the scripts in the order in which they use each other."""
    return "\n".join((FOLDER / f"{name}.js").read_text(encoding="utf-8") for name in SCRIPTS)


@cache
def style() -> str:
    """Return the style sheet."""
    return (FOLDER / "style.css").read_text(encoding="utf-8")


@cache
def engine() -> str:
    """Return the crate as WebAssembly, packed by gzip, in base 64."""
    if not ENGINE.exists():
        raise FileNotFoundError(
            f"this irbkin was built without {ENGINE.name}, which draws and solves in a browser: "
            "`make page` in its sources builds it. Without it, save a scene as a picture (.svg), "
            "or draw it by irbkin.viewer or irbkin.plot"
        )
    return base64.b64encode(ENGINE.read_bytes()).decode()


@cache
def module() -> str:
    """Return the page as a module of JavaScript that a notebook's widget imports."""
    widget = (FOLDER / "widget.js").read_text(encoding="utf-8")
    own = f"const WASM = {json.dumps(engine())};\nconst STYLE = {json.dumps(style())};"
    return f"{scripts()}\n{own}\n{widget}"
