"""A language server for RAPID with an arm behind it: `pip install 'irbkin[lsp]'`.

`irbkin lsp` starts it; docs/guide/lsp.md shows how to set up editors.
"""

import logging
import os
import sys
from collections.abc import Mapping
from typing import Any

try:
    import pygls as _pygls  # noqa: F401
except ImportError as _missing:
    raise ImportError(
        "irbkin.lsp needs pygls: pip install 'irbkin[lsp]'", name="pygls"
    ) from _missing

from irbkin.lsp.handlers import register
from irbkin.lsp.server import Server

__all__ = ["Server", "serve"]


def serve(options: Mapping[str, Any]) -> None:
    """Serve an editor over stdin and stdout until it ends.

    Args:
        options: As in irbkin.toml, but with underscores; missing ones are read from files.
    """
    server = Server(options)
    register(server)
    # `Server.fail` says what pygls would print, too.
    logging.getLogger("pygls").setLevel(logging.CRITICAL)
    # A printed line would be read as a message: it goes to stderr.
    sys.stdout.flush()
    stream = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    server.start_io(stdout=stream)
