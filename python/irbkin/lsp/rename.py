"""Whether something declared can have another name."""

from irbkin import rapid
from irbkin.errors import IrbkinError
from irbkin.lsp.code import before, occurrences
from irbkin.lsp.instructions import known
from irbkin.lsp.names import Declared
from irbkin.lsp.session import Result

LONGEST = 32
"""Characters of a name in RAPID."""
ENTRY = "main"
"""The procedure that a controller calls."""


def refusal(result: Result, declared: Declared, new: str) -> str | None:
    """Return why something declared cannot have another name; None if it can."""
    try:
        rapid.dump({new: 0.0})
    except IrbkinError as error:
        return str(error)
    if len(new) > LONGEST:
        return f"{new} has {len(new)} characters, more than RAPID's {LONGEST}"
    if new.lower() == declared.name.lower():
        return None
    if declared.kind == "PROC" and ENTRY in (declared.name.lower(), new.lower()):
        return f"a controller begins at {ENTRY}: no procedure gets or loses this name"
    if new.lower() in known():
        return f"{new} is a name of RAPID itself"
    # It would lead to something else where it is named now, even if that is out of sight.
    routine = (declared.routine or "").lower()
    for module in result.scope(declared):
        text, file = result.text(module), result.job.program.files[module].path
        for at in occurrences(text.source, new):
            line, _ = text.place(at)
            of = (result.names.routine_at(module, line) or "").lower()
            if routine in ("", of) and before(text.source, at) not in ("\\", "."):
                return f"{new} is taken: {file}:{line}"
    return None
