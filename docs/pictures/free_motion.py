"""Draw the table of free motions in docs/evidence/benchmarks.md.

Run without arguments. It needs `irbkin[plot]`.
"""

import re

import matplotlib.pyplot as plt
from drawing import HERE, STYLE, save

PAGE = HERE.parent / "evidence" / "benchmarks.md"
COLORS = {"commit 003ca028": "#c6ccd3", "now": "#0072b2"}


def main() -> None:
    """A bar to the median and a line to 95 % of each scene, then and now."""
    plt.rcParams.update(STYLE)
    section = PAGE.read_text().split("## Free motion")[1]
    rows = re.findall(r"^\| (.+?) \| ([\d.]+), ([\d.]+) \| ([\d.]+), ([\d.]+) \|", section, re.M)
    figure, axes = plt.subplots(layout="constrained")
    for row, (_, *numbers) in enumerate(rows):
        medians, most = numbers[:2], numbers[2:]
        for bar, (color, median, end) in enumerate(
            zip(COLORS.values(), map(float, medians), map(float, most), strict=True)
        ):
            y = -row - 0.36 * bar
            axes.barh(y, median, height=0.34, color=color)
            axes.plot([median, end], [y, y], color="#777777", linewidth=0.8, marker="|")
            axes.text(end * 1.15, y, f"{median:g}, {end:g} ms", va="center", fontsize=8)
    axes.set(xscale="log", xlim=(0.03, 100), xlabel="ms, logarithmic: median, line to 95 %")
    axes.set_yticks([-row - 0.18 for row in range(len(rows))], [name for name, *_ in rows])
    axes.tick_params(axis="both", which="both", length=0)
    axes.grid(axis="y", visible=False)
    axes.set_axisbelow(True)
    handles = [plt.Rectangle((0, 0), 1, 1, color=color) for color in COLORS.values()]
    figure.legend(handles, COLORS, loc="outside lower center", ncols=2, frameon=False)
    figure.set_size_inches(7.5, 3.6)
    save(figure, "free_motion", HERE)


if __name__ == "__main__":
    main()
