"""The page: one HTML file that needs no network. It solves by the crate as WebAssembly in the file,
or by the process that serves it; without either it draws and plays.
"""

import base64
import json
import re
from functools import cache
from pathlib import Path
from typing import Any

from irbkin.scene._data import Scene

FOLDER = Path(__file__).with_name("page")
ENGINE = FOLDER / "irbkin.wasm.gz"
SCRIPTS = (
    "math", "engine", "shapes", "arm", "camera", "gl", "dom", "handle", "read", "write",
    "source", "program", "scene", "view", "panels", "app",
)  # fmt: skip
"""The scripts, each behind those that it uses."""


def page(
    scene: Scene | None = None, *, served: bool = False, program: dict[str, Any] | None = None
) -> str:
    """Return the page as HTML, without a scene with an arm of the catalog.

    A program has its modules, what is known of them as the engine answers `check`, and the routine
    that is played with the answer to `motion`.
    """
    text = (FOLDER / "page.html").read_text(encoding="utf-8")
    own = "null" if scene is None else scene.to_json()
    title = "irbkin" if scene is None or not scene.title else f"irbkin: {scene.title}"
    parts = {
        "/*title*/": title.replace("&", "&amp;").replace("<", "&lt;"),
        "/*css*/": style(),
        "/*js*/": scripts(),
        "/*engine*/": "served" if served else engine(),
        # A text cannot begin or end the script that it is in.
        "/*scene*/": own.replace("<", "\\u003c"),
        "/*program*/": json.dumps(program).replace("<", "\\u003c"),
    }
    marks = "|".join(map(re.escape, parts))
    return re.sub(marks, lambda mark: parts[mark[0]], text)


@cache
def scripts() -> str:
    """Return the scripts in the order of their uses, without comments and indents."""
    whole = "\n".join((FOLDER / f"{name}.js").read_text(encoding="utf-8") for name in SCRIPTS)
    return re.sub(r"^\s*(//.*)?\n?", "", whole, flags=re.MULTILINE)


@cache
def style() -> str:
    return (FOLDER / "style.css").read_text(encoding="utf-8")


@cache
def engine() -> str:
    """Return the crate as WebAssembly, gzip in base 85 with . for <; empty if it is not built."""
    packed = ENGINE.read_bytes() if ENGINE.exists() else b""
    return base64.b85encode(packed).decode().replace("<", ".")


@cache
def module() -> str:
    """Return the page as a module of JavaScript that a notebook's widget imports."""
    widget = (FOLDER / "widget.js").read_text(encoding="utf-8")
    own = f"const WASM = {json.dumps(engine())};\nconst STYLE = {json.dumps(style())};"
    return f"{scripts()}\n{own}\n{widget}"
