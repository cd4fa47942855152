"""Draw times relative to irbkin's, of the tables in docs/evidence/benchmarks.md.

Run without arguments. It needs `irbkin[plot]`.
"""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
from drawing import HERE, STYLE, save
from matplotlib.axes import Axes
from matplotlib.patches import Patch

PAGE = HERE.parent / "evidence" / "benchmarks.md"
OWN, STICK, FASTEST, SLOWEST = "#0072b2", "#e69f00", "#7f8a96", "#c6ccd3"
YARDSTICKS = "A @ B", "out.fill(0.0)"
# A yardstick far below the times of a row compares nothing.
LEAST = 0.1
PICTURES = {
    "peers_irb2600": (
        "IRB 2600",
        (
            "IK of one pose, every solution, IRB 2600",
            "IK of one pose, the solution nearest to a seed, IRB 2600",
            "IK of a batch, every solution, IRB 2600",
        ),
        (
            "FK of one joint vector, IRB 2600",
            "Jacobian of one joint vector, IRB 2600",
            "FK of a batch, IRB 2600",
        ),
    ),
    "peers_others": (
        "Other arms, motions",
        (
            "IK of one pose, every solution, UR3",
            "IK of a batch, every solution, UR3",
            "IK of one pose with q7 given, Panda",
            "IK of one pose, every solution, CRX-10iA/L",
            "IK of one pose, every solution, GoFa 5",
            "IK of one pose with axis 4 at zero, every solution, GoFa 5",
        ),
        (
            "IK of one pose, every solution, Manseur and Doty's arm",
            "Quintic of six joints, 50 samples",
            "Quintic of six joints, 1,000 samples",
            "Six joints from rest to rest within limits of jerk",
            "Line of the tool, 1,000 poses",
            "Path of 1,000 samples within limits of acceleration",
        ),
    ),
}


class Row(NamedTuple):
    """A table: irbkin's time, and the ratios of each package, the fastest first."""

    time: str
    ratios: dict[str, list[float]]


def read(page: Path) -> dict[str, Row]:
    """The tables of times by their titles."""
    found = {}
    tables, _ = page.read_text().split("<!-- peers: end -->")
    for section in tables.split("\n### ")[1:]:
        title, *lines = section.splitlines()
        cells = [re.split(r" *\| *", line.strip("| ")) for line in lines if line.startswith("| ")]
        if not cells or cells[0][:2] not in (["a call", "/ irbkin"], ["a pose", "/ irbkin"]):
            continue
        ratios: dict[str, list[float]] = {}
        for name, _, ratio, *_ in cells[2:]:
            package = name.split(",")[0]
            if package not in YARDSTICKS or float(ratio) >= LEAST:
                ratios.setdefault(package, []).append(float(ratio))
        own = next(it for it in cells[2:] if it[2] == "1.00")
        found[title] = Row(own[1], {name: sorted(it) for name, it in ratios.items()})
    return found


def number(ratio: float) -> str:
    """Two digits that count."""
    return f"{ratio:,.0f}" if ratio >= 10 else f"{ratio:.2g}"


def brief(title: str, subject: str) -> str:
    """A title without the words of the picture's own."""
    return title.removesuffix(f", {subject}").replace("of one pose with", "with")


def column(axes: Axes, rows: Sequence[tuple[str, Row]]) -> float:
    """Draw tables below each other; return the height."""
    y, ticks = 0.0, {}
    for title, row in rows:
        axes.text(0, -y, title, weight="bold", fontsize=8.5, transform=axes.get_yaxis_transform())
        y += 0.9
        for name, ratios in sorted(row.ratios.items(), key=lambda it: it[1][0]):
            own, stick = name == "irbkin", name in YARDSTICKS
            color = OWN if own else STICK if stick else FASTEST
            axes.barh(-y, ratios[-1], height=0.7, color=color if own or stick else SLOWEST)
            axes.barh(-y, ratios[0], height=0.7, color=color)
            words = " to ".join(number(it) for it in dict.fromkeys((ratios[0], ratios[-1])))
            time = f", {row.time}" if own else ""
            axes.text(ratios[-1] * 1.15, -y, f"{words} x{time}", va="center", fontsize=8)
            ticks[-y] = name
            y += 1.0
        y += 0.9
    axes.set_yticks(list(ticks), list(ticks.values()))
    return y


def draw(name: str, subject: str, columns: Sequence[Sequence[str]], rows: dict[str, Row]) -> None:
    """Write a picture."""
    figure, panels = plt.subplots(1, 2, sharex=True, layout="constrained")
    figure.suptitle(f"{subject}: time relative to irbkin, logarithmic", fontsize=10)
    tables = [[(brief(title, subject), rows.pop(title)) for title in each] for each in columns]
    height = max(column(axes, each) for axes, each in zip(panels, tables, strict=True))
    for axes in panels:
        axes.set(xscale="log", xlim=(0.1, 2e4), ylim=(-height + 0.5, 1.0))
        axes.set_xticks([1, 10, 100, 1000], ["1 x", "10 x", "100 x", "1,000 x"])
        axes.tick_params(axis="y", length=0)
        axes.tick_params(axis="x", which="minor", length=0)
        axes.grid(axis="y", visible=False)
        axes.set_axisbelow(True)
        axes.axvline(1.0, color=OWN, linewidth=0.8, zorder=0)
        axes.spines[["left", "bottom"]].set_visible(False)
    keys = {OWN: "irbkin", STICK: "yardstick", FASTEST: "peer", SLOWEST: "its slowest interface"}
    handles = [Patch(color=color, label=words) for color, words in keys.items()]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, frameon=False)
    figure.set_size_inches(9.5, 0.21 * height + 1.0)
    save(figure, name, HERE)


def main() -> None:
    """Draw both.

    Raises:
        ValueError: The page has a table with a peer that no picture has.
    """
    plt.rcParams.update(STYLE)
    rows = read(PAGE)
    for name, (subject, *columns) in PICTURES.items():
        draw(name, subject, columns, rows)
    left = [title for title, row in rows.items() if set(row.ratios) - {"irbkin", *YARDSTICKS}]
    if left:
        raise ValueError(f"PICTURES lacks {', '.join(left)}")


if __name__ == "__main__":
    main()
