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
from irbkin._core import Checked, ToolData, check_codes
from irbkin._files import shown, write_columns
from irbkin._words import counted, listed
from irbkin.errors import InvalidModelError, IrbkinError, RapidError
from irbkin.rapid.program import Program

STAND_IN = "IRB 2600-12/1.65"
"""The arm that counts the moves, which are as many for every arm."""
STANDS = [sign * way for way in range(20, 501, 20) for sign in (1, -1)]
"""How far a base is moved, the nearest first [mm]."""
MOST_SHOWN = 12


class Candidate(NamedTuple):
    """An arm, and how much of a program it can run: `met` of its moves, without the unchecked ones.

    Payload [kg], reach [m], the least distance of a joint from its limits in a move that is met
    [deg], the moves with a singularity on their way, and how far the base is moved along its x axis
    [mm], negative is back. None is what is not known, or a base that stays.
    """

    name: str
    payload: float | None
    reach: float | None
    moves: int
    met: int
    unchecked: int
    margin_deg: float | None
    singular: int
    shift_mm: int | None

    @property
    def stand(self) -> str:
        """How the base is moved, in words: "240 mm back"; empty if it stays."""
        shift = self.shift_mm or 0
        return f"{abs(shift)} mm {'back' if shift < 0 else 'forward'}" if shift else ""


class Candidates(tuple[Candidate, ...]):
    """The arms of a study, those that meet most moves first."""

    __slots__ = ()

    @property
    def summary(self) -> str:
        """How many arms meet all moves."""
        able = sum(it.met == it.moves for it in self)
        return f"{able} of {counted(len(self), 'arm')} can make all {self[0].moves:,} moves"

    def to_dict(self) -> dict[str, list[Any]]:
        """Return the fields of the rows as columns, for a data frame."""
        return {name: [getattr(it, name) for it in self] for name in Candidate._fields}

    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None:
        """Write the columns of `to_dict` to a path, or a file that is open for text."""
        write_columns(self.to_dict(), path_or_file)

    def __repr__(self) -> str:
        """The summary, and the first arms."""
        rows = [f"{it.name}: {it.met:,} met {it.stand}".rstrip() for it in self[:MOST_SHOWN]]
        return "\n".join([f"<Candidates: {self.summary}", *rows]) + ">"

    def _repr_html_(self) -> str:
        """The first arms, each with a bar of the moves that it meets."""
        rows = ""
        for it in self[:MOST_SHOWN]:
            style = f"width:{8 * it.met / it.moves:.2f}em;background:#2a7ab0"
            bar = f'<div style="{style}">&nbsp;</div>'
            rows += f"<tr><td>{it.name}</td><td>{bar}</td><td>{it.met:,} of {it.moves:,} moves</td>"
            rows += f"<td>{it.stand}</td></tr>"
        return f"<div><b>{self.summary}</b><table>{rows}</table></div>"


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

    A move is met if `program.check` of the arm checks it and finds joints, but nothing on reach,
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
        progress: Called with the number of arms that are ready, and of all; or a bar as of tqdm.
        options: Others of `Program.check`: units, last_values, carried.

    Returns:
        A row for each arm, most moves met first; of equal ones that with the least reach.

    Raises:
        IrbkinError: A program without moves, an unknown name, a payload that no arm has, or as
            `Program.check`.
    """
    report = reporter(progress)
    ended = Event()
    given = catalog() if names is None else [names] if isinstance(names, str) else names
    entries = {it.name: it for it in map(catalog_entry, given)}.values()
    if not entries:
        raise IrbkinError("names is empty, it must have an arm of the catalog")
    most = max(it.payload or 0.0 for it in entries)
    if not 0.0 <= payload <= most:
        words = f"payload is {payload:g} kg, it must be 0 to {most:g} kg"
        raise IrbkinError(f"{words}, the most of {counted(len(entries), 'arm')}")
    tools = tool if tool is None or isinstance(tool, Mapping) else {None: tool}
    codes = [code for code, *_ in check_codes() if code.startswith(("R", "K", "S"))]
    options = {**options, "cell": cell, "tools": tools, "codes": codes}
    placed = np.eye(4) if base is None else base
    moves = len(program.check(Robot(STAND_IN).with_base(placed), **options).moves)
    if not moves:
        raise RapidError(f"no move in {listed(shown(it.path) for it in program.files)}")

    def candidate(row: Candidate) -> Candidate:
        robot = Robot(row.name).with_base(placed)
        try:
            best = _with_check(row, robot, program.check(robot, **options))
        except InvalidModelError:
            # The options are those of the stand-in: this arm has no confdata.
            return row
        for way in STANDS if shift else ():
            if ended.is_set() or best.met == moves:
                break
            moved = robot.with_base(robot.base @ pose([way / 1e3, 0.0, 0.0]))
            found = _with_check(row, moved, program.check(moved, **options))
            if found.met > best.met:
                best = found._replace(shift_mm=way)
        return best

    rows = [
        Candidate(it.name, it.payload, it.reach, moves, 0, moves, None, 0, None)
        for it in entries
        if (it.payload or 0.0) >= payload
    ]
    pool = ThreadPoolExecutor(count(threads or os.cpu_count() or 1, "threads", IrbkinError))
    try:
        futures = [pool.submit(candidate, row) for row in rows]
        for done, future in enumerate(as_completed(futures), 1):
            future.result()
            report(done, len(rows))
    finally:
        # After Ctrl-C no other check begins; those that run end by themselves.
        ended.set()
        pool.shutdown(wait=False, cancel_futures=True)
    found = [future.result() for future in futures]
    return Candidates(sorted(found, key=lambda it: (-it.met, it.reach or np.inf)))


def _with_check(row: Candidate, robot: Robot, checked: Checked) -> Candidate:
    """A row with what the check of its arm finds."""
    wrong: set[tuple[int, int, int]] = set()
    singular: set[tuple[int, int, int]] = set()
    for finding in checked.findings:
        places = singular if finding.code.startswith("S") else wrong
        places.update([(finding.module, finding.line, finding.column), *finding.related])
    unchecked = near = 0
    met = []
    for move in checked.moves:
        place = (move.module, move.line, move.column)
        near += place in singular
        if move.unchecked is not None:
            unchecked += 1
        elif move.q is not None and place not in wrong:
            met.append(move.q)
    margin = _margin(robot, np.array(met)) if met else None
    return row._replace(met=len(met), unchecked=unchecked, margin_deg=margin, singular=near)


def _margin(robot: Robot, q: Floats) -> float:
    """Least distance of joint vectors from the limits [deg]."""
    limits = robot.limits
    linkage = robot.linkage_limits
    if linkage is not None:
        # Of the serial joint 3 any 2 pi equivalent is inside.
        middle = linkage.mean()
        serial = middle + np.remainder(q[:, 2] - q[:, 1] - middle + np.pi, 2 * np.pi) - np.pi
        limits, q = np.vstack([limits, linkage]), np.column_stack([q, serial])
    return float(np.degrees(np.minimum(q - limits[:, 0], limits[:, 1] - q).min()))
