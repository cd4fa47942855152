"""HTML for notebooks: tables of robots, solutions, plans and trajectories; pictures of arms."""

from collections.abc import Iterable, Sequence
from html import escape

import numpy as np

from irbkin import Plan, Robot, Solutions
from irbkin._shown import facts_of, joints_of
from irbkin.scene._arms import arm_of, rest
from irbkin.scene._svg import picture
from irbkin.trajectory import Trajectory

MOST_ROWS = 16


def of_robot(robot: Robot) -> str:
    title = f"<b>{escape(robot.name or 'Robot')}</b>"
    drawn = picture([(arm_of(robot), rest(robot), ())])
    return _beside(drawn, title, facts_of(robot), _table(*joints_of(robot)))


def of_solutions(solutions: Solutions, robot: Robot) -> str:
    head = ["slot", *(f"q{joint + 1} [deg]" for joint in range(robot.dof)), "limits"]
    rows = []
    for it in list(solutions)[:MOST_ROWS]:
        inside = "inside" if it.is_within_limits else "outside"
        rows.append([str(it.slot), *(f"{angle:.2f}" for angle in it.q_deg), inside])
    more = len(solutions) - len(rows)
    words = [solutions.explain(), *([f"{more} more"] if more > 0 else [])]
    q = [it.q for it in solutions]
    drawn = picture([(arm_of(robot), q[0], q[1:])]) if rows else ""
    table = _table(head, rows) if rows else ""
    return _beside(drawn, f"<b>{escape(robot.name)}</b>", words, table)


def of_trajectory(move: Trajectory) -> str:
    """Return the peaks of a motion; `irbkin.plot.trajectory` draws its curves."""
    peaks = move.peaks()
    head = ["", *(f"J{joint + 1}" for joint in range(move.dof))]
    rows = [
        ["fastest [deg/s]", *(f"{it:.1f}" for it in np.degrees(peaks.velocity))],
        ["hardest [deg/s^2]", *(f"{it:.0f}" for it in np.degrees(peaks.acceleration))],
    ]
    words = [f"{move.duration:.3f} s", f"{len(move.t)} samples"]
    return _beside("", "<b>Trajectory</b>", words, _table(head, rows))


def of_plan(plan: Plan) -> str:
    """Return the extremes of a plan; `irbkin.plot.plan` draws its curves."""
    q = np.degrees(np.asarray(plan.q))
    known = q[np.isfinite(q).all(axis=1)]
    head = ["", *(f"J{joint + 1}" for joint in range(q.shape[1]))]
    extremes = {"least [deg]": np.min, "most [deg]": np.max} if len(known) else {}
    rows = [[name, *(f"{it:.1f}" for it in most(known, axis=0))] for name, most in extremes.items()]
    words = [f"{len(q)} poses", f"{len(plan.breaks)} breaks" if plan.breaks else "without a break"]
    words += ["certified"] if plan.certified else []
    return _beside("", "<b>Plan</b>", words, _table(head, rows))


def _beside(drawn: str, title: str, words: Iterable[str], table: str) -> str:
    line = escape(", ".join(words))
    text = f"<div>{title}<br>{line}{table}</div>"
    return f'<div style="display:flex;gap:1rem;align-items:center">{drawn}{text}</div>'


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    cells = "".join(f"<th>{escape(it)}</th>" for it in head)
    body = "".join(f"<tr>{''.join(f'<td>{escape(it)}</td>' for it in row)}</tr>" for row in rows)
    return f"<table><thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table>"
