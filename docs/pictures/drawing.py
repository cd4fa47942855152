"""Style and writer of the pictures.

README and the pages show the pictures of this folder; `make docs` draws all others into
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
    "axes.facecolor": "none",
    "savefig.facecolor": "none",
    "svg.fonttype": "none",
    "svg.hashsalt": "irbkin",
}


# Without a background; where pages are dark, dark lines and words are light.
DARK = {"#000000": "#e6e9ef", "#333333": "#ccd3dd", "#555555": "#aab4c2", "#777777": "#98a2b3"}
GRID = {"#dddddd": "#333c4a", "#dcdcdc": "#3a4452", "#c8c8c8": "#4a5566"}


def twin(svg: str) -> str:
    """Give a drawing other colors where the page that shows it is dark."""
    rules = ["text{fill:#e6e9ef!important}"]
    for light, dark in {**DARK, **GRID}.items():
        for part in ("stroke", "fill"):
            rules.append(f'[style*="{part}: {light}"]{{{part}:{dark}!important}}')
    style = f"<style>@media (prefers-color-scheme:dark){{{''.join(rules)}}}</style>"
    return re.sub(r"(<svg\b[^>]*>)", lambda tag: f"{tag[1]}\n{style}", svg, count=1)


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
    target.write_text(twin(compact(target.read_text())))
    print(f"{target}: {target.stat().st_size / 1000:.0f} kB")
