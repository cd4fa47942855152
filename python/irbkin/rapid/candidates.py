"""The arms of the catalog that can run a program, and where they must stand for it."""

import os
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from os import PathLike
from threading import Event
from typing import IO, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin import Cell, Robot, catalog, catalog_entry, pose
from irbkin._arguments import Bar, Report, count, reporter
from irbkin._arrays import Floats
from irbkin._core import CatalogEntry, Checked, ToolData, check_codes
from irbkin._files import write_columns
from irbkin._words import counted
from irbkin.errors import InvalidModelError, IrbkinError, RapidError
from irbkin.rapid.program import Program

STAND_IN = "IRB 2600-12/1.65"
"""The arm that counts the moves, which are as many for every arm."""
WAYS = [sign * way for way in range(20, 501, 20) for sign in (1, -1)]
"""How far a base is moved, the nearest first [mm]."""
MOST_LINES, MOST_ROWS = 8, 16
"""Arms that a representation and a notebook show."""


class Candidate(NamedTuple):
    """An arm, and how much of a program it can run."""

    name: str
    payload: float | None
    """[kg]"""
    reach: float | None
    """[m]"""
    moves: int
    """Number of moves, as in `Checked.moves`."""
    met: int
    """Those that are checked and have joints, without a finding R (reach, limits, path) or K."""
    unchecked: int
    """Those that are not checked: all, if the arm has no confdata."""
    margin_deg: float | None
    """Least distance of a joint from its limits at the targets of the moves that are met."""
    singular: int
    """Those with a singularity on their way."""
    shift_mm: int | None
    """How far the base is moved along its x axis, negative is back; None if it stays."""

    @property
    def stand(self) -> str:
        """How the base is moved, in words: "240 mm back"; empty if it stays."""
        shift = self.shift_mm or 0
        return f"{abs(shift)} mm {'back' if shift < 0 else 'forward'}" if shift else ""


class Candidates(tuple[Candidate, ...]):
    """The arms of a study, those that meet all moves first."""

    __slots__ = ()

    @property
    def summary(self) -> str:
        """How many arms meet all moves."""
        able = [it for it in self if it.met == it.moves]
        moved = sum(bool(it.stand) for it in able)
        words = f"{len(able)} of {counted(len(self), 'arm')} can make all "
        words += counted(self[0].moves, "move")
        return words + (f", {moved} of them from another stand" if moved else "")

    def to_dict(self) -> dict[str, list[Any]]:
        """Return the fields of `Candidate` as columns, for a data frame."""
        return {name: [getattr(it, name) for it in self] for name in Candidate._fields}

    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None:
        """Write the columns of `to_dict` to a path or a file that is open for text."""
        write_columns(self.to_dict(), path_or_file)

    def __repr__(self) -> str:
        """The summary, and the first arms."""
        lines = [f"<Candidates: {self.summary}"]
        for it in self[:MOST_LINES]:
            margin = "" if it.margin_deg is None else f"{it.margin_deg:.1f} deg from limits"
            lines.append(", ".join(filter(None, (f"{it.name}: {it.met:,} met", margin, it.stand))))
        more = len(self) - MOST_LINES
        return "\n".join([*lines, *([f"{more} more"] if more > 0 else [])]) + ">"

    def _repr_html_(self) -> str:
        """A table of the first arms, each with a bar of the moves that it meets."""
        rows = []
        for it in self[:MOST_ROWS]:
            bar = f'<div style="width:{8 * it.met / it.moves}em;background:#2a7ab0">&nbsp;</div>'
            margin = "-" if it.margin_deg is None else f"{it.margin_deg:.1f} deg"
            cells = (it.name, bar, f"{it.met:,} of {it.moves:,}", margin, it.stand)
            rows.append(f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>")
        head = "<tr><th>arm</th><th></th><th>met</th><th>from limits</th><th>stand</th></tr>"
        return f"<div><b>{self.summary}</b><table>{head}{''.join(rows)}</table></div>"


def arms(
    program: Program,
    *,
    names: Iterable[str] | None = None,
    cell: Cell | None = None,
    payload: float = 0.0,
    tool: ToolData | npt.ArrayLike | Mapping[str | None, Any] | None = None,
    base: npt.ArrayLike | None = None,
    shift: bool = False,
    threads: int = 0,
    progress: Report | Bar | None = None,
    **options: Any,
) -> Candidates:
    """Study which arms of the catalog can run a program.

    A move is met if `program.check` of the arm checks it and finds joints, and nothing on reach,
    limits or path (R) and no collision (K) at its place. Confdata do not count: of another arm they
    are wrong by nature. An arm without confdata has all moves unchecked.

    Args:
        program: The program, as of `load_program`.
        names: Arms; all of the catalog when not given.
        cell: Obstacles around the arms; collisions are not looked for when not given.
        payload: Payload that an arm must have [kg].
        tool: TCP in the flange of tools that nothing declares, shape (4, 4) [m], or a ToolData; or
            a dict of these by name, where None is for all others.
        base: Base in the world, shape (4, 4) [m].
        shift: Whether an arm that misses moves is moved along the x axis of its base, by up to 500
            mm in steps of 20 mm, to the nearest stand where it meets most.
        threads: Number of threads; 0 for one a core.
        progress: Called with the number of arms that are ready, and of all; or a bar as
            `tqdm.tqdm()`.
        options: As of `Program.check`: units, last_values, carried.

    Returns:
        A row for each arm, most moves met first; of equal ones that with the least reach.

    Raises:
        RapidError: The program has no move.
        IrbkinError: A name that is not in the catalog, a payload that no arm has, or as
            `Program.check`.
    """
    report = reporter(progress)
    entries = _entries(names, payload)
    tools = tool if tool is None or isinstance(tool, Mapping) else {None: tool}
    codes = [code for code, *_ in check_codes() if code.startswith(("R", "K", "S"))]
    options = {**options, "cell": cell, "tools": tools, "codes": codes}
    placed = np.eye(4) if base is None else base
    moves = len(program.check(Robot(STAND_IN).with_base(placed), **options).moves)
    if not moves:
        raise RapidError("the program has no move: give the modules with its routines")
    ended = Event()

    def candidate(entry: CatalogEntry) -> Candidate:
        """The row of an arm."""
        robot = Robot(entry.name).with_base(placed)
        facts = (entry.name, entry.payload, entry.reach)
        row = Candidate(*facts, moves, 0, moves, None, 0, None)
        try:
            best = _checked(row, program.check(robot, **options), robot)
        except InvalidModelError:
            # The stand-in was checked with the same options: this arm has no confdata.
            return row
        for way in WAYS if shift else ():
            if ended.is_set() or best.met == moves:
                break
            moved = robot.with_base(robot.base @ pose([way / 1e3, 0, 0]))
            found = _checked(row._replace(shift_mm=way), program.check(moved, **options), moved)
            best = found if found.met > best.met else best
        return best

    pool = ThreadPoolExecutor(count(threads or os.cpu_count() or 1, "threads", IrbkinError))
    try:
        futures = [pool.submit(candidate, entry) for entry in entries]
        for done, future in enumerate(as_completed(futures), 1):
            future.result()
            report(done, len(futures))
    finally:
        # After Ctrl-C no other check begins; those that run end by themselves.
        ended.set()
        pool.shutdown(wait=False, cancel_futures=True)
    rows = [future.result() for future in futures]
    return Candidates(sorted(rows, key=lambda it: (-it.met, it.reach or np.inf)))


def _entries(names: Iterable[str] | None, payload: float) -> list[CatalogEntry]:
    """The arms to study, each once."""
    if not payload >= 0.0:
        raise IrbkinError(f"payload is {payload:g} kg, it must be 0 or more")
    wanted = [names] if isinstance(names, str) else catalog() if names is None else names
    entries = list({it.name: it for it in map(catalog_entry, wanted)}.values())
    most = max((it.payload or 0.0 for it in entries), default=0.0)
    if not entries or payload > most:
        words = f"none of {counted(len(entries), 'arm')} has a payload of {payload:g} kg"
        raise IrbkinError(f"{words}: at most {most:g} kg")
    return [it for it in entries if (it.payload or 0.0) >= payload]


def _checked(row: Candidate, checked: Checked, robot: Robot) -> Candidate:
    """A row with what a check of its arm finds."""
    wrong: set[tuple[int, int, int]] = set()
    singular: set[tuple[int, int, int]] = set()
    for found in checked.findings:
        places = singular if found.code.startswith("S") else wrong
        places.update([(found.module, found.line, found.column), *found.related])
    places_of = [(it.module, it.line, it.column) for it in checked.moves]
    met = [
        it.q
        for it, place in zip(checked.moves, places_of, strict=True)
        if it.unchecked is None and it.q is not None and place not in wrong
    ]
    return row._replace(
        met=len(met),
        unchecked=sum(it.unchecked is not None for it in checked.moves),
        margin_deg=_margin(robot, np.array(met)) if met else None,
        singular=sum(place in singular for place in places_of),
    )


def _margin(robot: Robot, q: Floats) -> float:
    """Least distance of joint vectors from the limits, of a linkage too [deg]."""
    least = np.minimum(q - robot.limits[:, 0], robot.limits[:, 1] - q).min()
    if robot.linkage_limits is not None:
        low, high = robot.linkage_limits
        # Any 2 pi equivalent of the serial joint 3 meets these limits.
        middle = 0.5 * (low + high)
        off = np.remainder(q[:, 2] - q[:, 1] - middle + np.pi, 2 * np.pi) - np.pi
        least = min(least, (high - middle - np.abs(off)).min())
    return float(np.degrees(least))
