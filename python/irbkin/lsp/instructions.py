"""RAPID's own instructions, functions, data and words."""

import re
from collections.abc import Mapping
from functools import cache

from irbkin._core import instructions
from irbkin.lsp.names import Declared

NOWHERE = -1
"""The module that it is in."""
RETURNED = {
    "bool": "Present",
    "jointtarget": "CalcJointT CJointT",
    "num": "Abs ClkRead Distance EulerZYX",
    "orient": "OrientZYX",
    "pos": "CPos",
    "pose": "PoseInv PoseMult",
    "robtarget": "CalcRobT CRobT Offs RelTool",
    "string": "NumToStr ValToStr",
}
"""Functions by the types of their values; others are offered where any type fits."""
PERSISTENT = re.compile(r"\b(tooldata|wobjdata|loaddata)\b")
"""Types of data that moves take by reference."""
DATA = {
    "speeddata": "v5 v10 v20 v30 v40 v50 v60 v80 v100 v150 v200 v300 v400 v500 v600 v800 v1000 "
    "v1500 v2000 v2500 v3000 v4000 v5000 v6000 v7000 vmax",
    "zonedata": "fine z0 z1 z5 z10 z15 z20 z30 z40 z50 z60 z80 z100 z150 z200",
    "tooldata": "tool0",
    "wobjdata": "wobj0",
    "loaddata": "load0",
    "bool": "TRUE FALSE",
    "type": "num bool string pos orient pose robtarget jointtarget tooldata wobjdata speeddata "
    "zonedata loaddata confdata extjoint robjoint dnum byte clock intnum errnum triggdata",
    "keyword": "IF FOR WHILE TEST RETURN GOTO CONNECT RAISE RETRY TRYNEXT EXIT VAR CONST PERS",
}


@cache
def known() -> Mapping[str, Declared]:
    """Return RAPID's own instructions, functions, data, types and words, by names in lower case."""
    found = {}
    types = {name: kind for kind, names in RETURNED.items() for name in names.split()}
    for name, kind, arguments in instructions():
        begin = "PROC" if kind == "instruction" else f"FUNC {types.get(name, 'anytype')}"
        written = PERSISTENT.sub(r"PERS \1", arguments).replace(",", ", ").replace("|", " | ")
        header = f"{begin} {name}({written})"
        found[name.lower()] = Declared(NOWHERE, name, begin[:4], header, None, False, 0, 0)
    for kind, names in DATA.items():
        for name in names.split():
            words = "" if kind in ("type", "keyword") else f"CONST {kind} {name}"
            found[name.lower()] = Declared(NOWHERE, name, kind, words, None, False, 0, 0)
    return found
