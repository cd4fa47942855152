"""A language server for RAPID with an arm behind it: `pip install 'irbkin[lsp]'`.

`irbkin lsp` starts it; docs/guide/lsp.md says how editors do.
"""

from __future__ import annotations

import os
import sys

try:
    import pygls as _pygls  # noqa: F401
except ImportError as _missing:
    raise ImportError(
        "irbkin.lsp needs pygls: pip install 'irbkin[lsp]'", name="pygls"
    ) from _missing

from irbkin.lsp.handlers import register
from irbkin.lsp.server import Server
from irbkin.lsp.work import Desk, Task

__all__ = ["Desk", "Server", "Task", "serve"]


def serve(desk: Desk) -> None:
    """Serve an editor over stdin and stdout until it ends.

    Args:
        desk: Gives files their programs and arms.
    """
    server = Server(desk)
    register(server)
    # A printed line would be read as a message: it goes to stderr.
    sys.stdout.flush()
    stream = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    server.start_io(stdout=stream)
