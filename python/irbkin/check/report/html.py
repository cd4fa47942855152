"""A report as the page of `irbkin view`, with the program and what was found in it."""

import json
from itertools import chain
from typing import Any

import numpy as np

from irbkin import Robot
from irbkin._core import PageEngine
from irbkin._files import shown
from irbkin.check.findings import Finding
from irbkin.check.jobs import Job
from irbkin.check.report import Report
from irbkin.rapid import Checked
from irbkin.scene import Arm, of
from irbkin.scene._page import page

FINDING = ("code", "name", "severity", "line", "column", "message")
MOVE = ("module", "line", "column", "routine", "target", "unchecked")
"""Fields that a finding and a move have in the words of the engine, too."""


def render(report: Report) -> str:
    ((job, checked),) = report.programs
    assert job.robot is not None
    own = of(job.robot, title=job.title)
    if report.cell is not None:
        own += of(report.cell)
    names = [shown(file.path) for file in job.program.files]
    # Files that were not read, or are no modules, have findings, too.
    others = dict.fromkeys(it.file for it in report.findings)
    names += [name for name in others if name not in names]
    index = {name: module for module, name in enumerate(names)}
    modules = [{"name": name, "text": report.text_of(name).text} for name in names]
    procedures: list[dict[str, Any]] = [
        {"module": index, "name": it.name}
        for index, module in enumerate(job.program.modules)
        for it in module.routines
        if it.kind == "PROC"
    ]
    moves = _moves(job, checked)
    program: dict[str, Any] = {
        "words": f"{report.coverage} {report.conclusion}",
        "modules": modules or [{"name": job.title, "text": ""}],
        "procedures": procedures,
        "moves": moves,
        "findings": [_finding(it, index) for it in report.findings],
        "faults": [],
    }
    # Main is played, or the first procedure that moves.
    main = (it for it in procedures if it["name"].lower() == "main")
    moving = ({"module": it["module"], "name": it["routine"]} for it in moves if it["routine"])
    chosen = next(chain(main, moving), None)
    if chosen is None:
        program["motion"] = {"error": "no procedure moves"}
    else:
        program["routine"] = chosen["name"]
        program["motion"] = _motion(job.robot, own.arms[0], modules, chosen)
    return page(own, program=program)


def _finding(found: Finding, index: dict[str, int]) -> dict[str, Any]:
    edits = [
        {"module": index[file], "begin": begin, "end": end, "text": text}
        for file, begin, end, text in found.edits
    ]
    own = {key: getattr(found, key) for key in FINDING}
    return {**own, "shown": True, "module": index[found.file], "edits": edits}


def _moves(job: Job, checked: Checked) -> list[dict[str, Any]]:
    instructions = {
        (index, it.line, it.column): it.instruction
        for index, module in enumerate(job.program.modules)
        for it in module.moves
    }
    return [
        {
            **{key: getattr(it, key) for key in MOVE},
            "instruction": instructions.get((it.module, it.line, it.column)),
            "q": None if it.q is None else it.q.tolist(),
            "confdata": None if it.confdata is None else list(it.confdata),
        }
        for it in checked.moves
    ]


def _motion(robot: Robot, arm: Arm, modules: list[dict[str, Any]], chosen: Any) -> Any:
    """The answer of the engine to the routine that is played: its motion, or an error."""
    engine = PageEngine()
    source = {"urdf": arm.urdf} if arm.urdf else {"name": arm.name}
    tool, base = (np.ravel(it[:3]).tolist() for it in (robot.tool, robot.base))
    engine.answer(json.dumps({"do": "robot", **source, "tool": tool, "base_pose": base}))
    routine = {"module": chosen["module"], "routine": chosen["name"]}
    return json.loads(engine.answer(json.dumps({"do": "motion", "modules": modules, **routine})))
