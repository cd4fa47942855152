"""Style and writer of the pictures.

README and the pages show three pictures of this folder; `make docs` draws all others into
target/pictures. The same irbkin and matplotlib give the same files.
"""

import re
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

HERE = Path(__file__).parent
DRAWN = HERE.parents[1] / "target" / "pictures"
STYLE: dict[Any, Any] = {
    "axes.edgecolor": "#777777",
    "axes.grid": True,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": 9,
    "backend": "svg",
    "font.sans-serif": ["DejaVu Sans", "Verdana"],
    "font.size": 9,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.6,
    "path.simplify_threshold": 0.3,
    "savefig.facecolor": "white",
    "svg.fonttype": "none",
    "svg.hashsalt": "irbkin",
}


def compact(svg: str) -> str:
    """Shorten a drawing: a path on one line, coordinates to 0.01 pt, no metadata."""
    svg = re.sub(r"\n *<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r'"[^"]*"', lambda text: " ".join(text[0].split()).replace(' "', '"'), svg)
    svg = re.sub(r"(?<=[\s\"(,-])(\d+\.\d{3,})", lambda number: f"{float(number[0]):.2f}", svg)
    return "\n".join(line.rstrip() for line in svg.splitlines()) + "\n"


def save(figure: Figure, name: str, folder: Path = DRAWN) -> None:
    """Write `name`.svg, shortened, and print its size."""
    folder.mkdir(parents=True, exist_ok=True)
    target = folder / f"{name}.svg"
    figure.savefig(target, dpi=150, metadata={"Date": None, "Creator": None})
    target.write_text(compact(target.read_text()))
    print(f"{target}: {target.stat().st_size / 1000:.0f} kB")
