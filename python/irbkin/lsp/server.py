"""The language server: messages of the protocol in, findings out."""

from __future__ import annotations

import contextlib
import traceback
from collections.abc import Generator, Mapping, Sequence
from typing import Any, Protocol

from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer
from pygls.protocol.language_server import LanguageServerProtocol, lsp_method
from pygls.uris import to_fs_path

from irbkin import __version__
from irbkin.lsp.marks import SOURCE, diagnostics
from irbkin.lsp.queue import Queue
from irbkin.lsp.reading import MOST_BYTES, is_large
from irbkin.lsp.text import Text
from irbkin.lsp.work import Desk, Result, Session

WAIT = 5.0
"""How long a question waits until the text is checked as it is [s]; then the last check counts."""
WATCHED = ("**/*.{mod,modx,sys,sysx,prg,cfg}", "**/irbkin.toml", "**/pyproject.toml")
"""Files whose changes count although they are not open."""


class _Messages(LanguageServerProtocol):
    """The messages of the protocol, without the copies of documents that pygls keeps.

    pygls ends a line at characters that editors do not, such as a form feed, and moves the
    positions of a change to where it believes that the line ends.
    """

    @lsp_method(types.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(
        self, params: types.DidChangeTextDocumentParams
    ) -> Generator[Any, Any, None]:
        """Pass a change on."""
        yield self.fm.features[types.TEXT_DOCUMENT_DID_CHANGE], (params,), None


class Spot(Protocol):
    """A question about a position in a document."""

    text_document: types.TextDocumentIdentifier
    position: types.Position


class Server(LanguageServer):
    """Findings, hovers, corrections and declarations of RAPID modules."""

    def __init__(self, desk: Desk) -> None:
        super().__init__(SOURCE, __version__, protocol_cls=_Messages)
        self.desk = desk
        self.options: Mapping[str, Any] = {}
        """The settings of the editor: options as in irbkin.toml."""
        self.documents: dict[str, tuple[str, int, Text | None]] = {}
        """Address, version and text of open documents by path; no text if it is too large."""
        self.queue = Queue(desk, self.texts, self.publish, self.fail)
        self._said: set[str] = set()

    def texts(self) -> dict[str, str]:
        """Return the texts of open documents by path."""
        return {path: text.source for path, (_, _, text) in self.documents.items() if text}

    def set_options(self, settings: object) -> None:
        """Take options, perhaps in a section `irbkin`; nothing for any other value."""
        own = settings.get(SOURCE, settings) if isinstance(settings, Mapping) else None
        if isinstance(own, Mapping) and own != self.options:
            self.options = dict(own)
            self.queue.reload(self.documents, self.options)

    def put(self, uri: str, version: int, text: Text) -> None:
        """Set the text of a document."""
        path = path_of(uri)
        if is_large(text.source):
            size = f"{len(text.source) / 1e6:.1f} MB, more than {MOST_BYTES / 1e6:g} MB"
            self.say(f"{path} has {size}: it is not checked while it is open (irbkin check does)")
            self.documents[path] = (uri, version, None)
            self.queue.close(path)
            self.show(path, [])
            return
        is_new = path not in self.documents or self.documents[path][2] is None
        self.documents[path] = (uri, version, text)
        if is_new:
            self.queue.open(path, self.options)
        else:
            self.queue.change(path)

    def publish(self, session: Session) -> None:
        """Show what is found in the open documents of a session."""
        for note in session.task.notes:
            self.say(note)
        for path in session.task.paths:
            if path in self.documents:
                results = self.results(path)
                self.show(path, diagnostics(results, path, self.desk))

    def show(self, path: str, marks: Sequence[types.Diagnostic]) -> None:
        """Show findings in a document."""
        uri, version, _ = self.documents[path]
        self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, marks, version))

    def results(self, path: str) -> list[Result]:
        """Return the last checks of a document, of all its tasks."""
        return [it.result for it in self.queue.sessions(path) if it.result is not None]

    async def place(self, params: Spot) -> tuple[Result, int, int] | None:
        """Return a check of a document as it is, the module, and the offset of a position."""
        path = path_of(params.text_document.uri)
        await self.queue.rest(path, WAIT)
        for result in self.results(path):
            module = result.modules.get(path)
            if module is not None:
                return result, module, result.text(module).offset(params.position)
        return None

    def say(self, message: str) -> None:
        """Show a message to the user, once."""
        if message not in self._said:
            self._said.add(message)
            self.window_show_message(
                types.ShowMessageParams(types.MessageType.Warning, f"irbkin: {message}")
            )

    def fail(self, error: BaseException) -> None:
        """Log an error, which ends nothing but what it was about."""
        lines = "".join(traceback.format_exception(error))
        self.window_log_message(types.LogMessageParams(types.MessageType.Error, lines))
        self.say(f"internal error, which the log has: {error!r}")

    def report_server_error(self, error: Exception, source: object) -> None:
        """Log an error of a handler."""
        self.fail(error)

    async def fetch_options(self) -> None:
        """Ask the editor for the section `irbkin` of its settings, if it answers."""
        workspace = self.client_capabilities.workspace
        if workspace and workspace.configuration:
            items = [types.ConfigurationItem(section=SOURCE)]
            with contextlib.suppress(JsonRpcException):
                params = types.ConfigurationParams(items)
                found = await self.workspace_configuration_async(params)
                self.set_options(found[0] if found else None)

    async def watch(self) -> None:
        """Ask the editor to report changes of files, if it can."""
        workspace = self.client_capabilities.workspace
        watched = workspace.did_change_watched_files if workspace else None
        if watched and watched.dynamic_registration:
            globs = [types.FileSystemWatcher(it) for it in WATCHED]
            options = types.DidChangeWatchedFilesRegistrationOptions(globs)
            method = types.WORKSPACE_DID_CHANGE_WATCHED_FILES
            asked = types.RegistrationParams([types.Registration("irbkin", method, options)])
            with contextlib.suppress(JsonRpcException):
                await self.client_register_capability_async(asked)


def path_of(uri: str) -> str:
    """Return the path of a document; of one that is no file, its address."""
    path = to_fs_path(uri) if uri.startswith("file:") else None
    return path or uri
