"""The language server: messages of the protocol in, findings out."""

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
from irbkin.lsp.completion import Place
from irbkin.lsp.marks import SOURCE, diagnostics
from irbkin.lsp.programs import Programs
from irbkin.lsp.queue import Queue
from irbkin.lsp.reading import MOST_BYTES
from irbkin.lsp.session import Result, Session
from irbkin.lsp.text import Text

WAIT = 5.0
"""Longest wait of a request for the check of the current text [s]; then the last result is used."""
WATCHED = ("**/*.{mod,modx,sys,sysx,prg,pgf,cfg,toml,urdf,npy,stl,obj,ply}", "**/BACKINFO/*.txt")
"""Files that are watched although they are not open: of programs, backups, options, cells."""


class _Messages(LanguageServerProtocol):
    """The messages of the protocol, without the copies of documents that pygls keeps.

    pygls ends a line at characters that editors do not, such as a form feed, and moves the
    positions of a change to where it believes that the line ends.
    """

    @lsp_method(types.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(
        self, params: types.DidChangeTextDocumentParams
    ) -> Generator[Any, Any, None]:
        yield self.fm.features[types.TEXT_DOCUMENT_DID_CHANGE], (params,), None


class Document(Protocol):
    """A request about a document, perhaps about a position in it."""

    text_document: types.TextDocumentIdentifier


class Refusal(JsonRpcException):
    """A request that cannot be fulfilled; editors show why."""

    CODE = types.LSPErrorCodes.RequestFailed


class Server(LanguageServer):
    """Findings, hovers, corrections and declarations of RAPID modules."""

    def __init__(self, options: Mapping[str, Any]) -> None:
        super().__init__(SOURCE, __version__, protocol_cls=_Messages)
        self.programs = Programs(options)
        self.options: Mapping[str, Any] = {}
        """The settings of the editor: options as in irbkin.toml."""
        self.documents: dict[str, tuple[str, int, Text | None]] = {}
        """Address, version and text of open documents by path; no text if it is too large."""
        self.queue = Queue(self.programs, self.texts, self.publish, self.fail)
        self._said: set[str] = set()

    def texts(self) -> dict[str, Text]:
        return {path: text for path, (_, _, text) in self.documents.items() if text}

    def set_options(self, settings: object) -> None:
        own = settings.get(SOURCE, settings) if isinstance(settings, Mapping) else None
        if isinstance(own, Mapping) and own != self.options:
            self.options = dict(own)
            self.queue.reload(self.documents, self.options)

    def put(self, uri: str, version: int, text: Text) -> None:
        path = path_of(uri)
        if len(text.source) > MOST_BYTES:
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
        for note in session.notes:
            self.say(note)
        for path in session.paths:
            if path in self.documents:
                self.show(path, diagnostics(self.results(path), path))

    def show(self, path: str, marks: Sequence[types.Diagnostic]) -> None:
        uri, version, _ = self.documents[path]
        self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, marks, version))

    def results(self, path: str) -> list[Result]:
        return [own.result for own in self.queue.sessions(path) if own.result is not None]

    async def at(self, params: Document, *, is_now: bool = False) -> list[Place]:
        """Return the checks of a document, each with its module, text and the offset of a position;
        now: without waiting for one of the text as it is now.
        """
        path = path_of(params.text_document.uri)
        if not (is_now and self.results(path)):
            await self.queue.rest(path, WAIT)
        _, _, now = self.documents.get(path, ("", 0, None))
        found = []
        for result in self.results(path):
            if path in result.modules:
                module = result.modules[path]
                text = (now if is_now else None) or result.text(module)
                offset = text.offset(getattr(params, "position", types.Position(0, 0)))
                found.append((result, module, text, offset))
        return found

    def say(self, message: str) -> None:
        if message not in self._said:
            self._said.add(message)
            self.window_show_message(
                types.ShowMessageParams(types.MessageType.Warning, f"irbkin: {message}")
            )

    def fail(self, error: BaseException) -> None:
        lines = "".join(traceback.format_exception(error))
        self.window_log_message(types.LogMessageParams(types.MessageType.Error, lines))
        self.say(f"internal error, which the log has: {error!r}")

    def report_server_error(self, error: Exception, source: object) -> None:
        if not isinstance(error, Refusal):
            self.fail(error)

    async def fetch_options(self) -> None:
        """Request the section `irbkin` of the editor's settings, if it supports that."""
        workspace = self.client_capabilities.workspace
        if workspace and workspace.configuration:
            items = [types.ConfigurationItem(section=SOURCE)]
            with contextlib.suppress(JsonRpcException):
                params = types.ConfigurationParams(items)
                found = await self.workspace_configuration_async(params)
                self.set_options(found[0] if found else None)

    async def watch(self) -> None:
        """Register for changes of files, if the editor supports that."""
        workspace = self.client_capabilities.workspace
        watched = workspace.did_change_watched_files if workspace else None
        if watched and watched.dynamic_registration:
            globs = [types.FileSystemWatcher(pattern) for pattern in WATCHED]
            options = types.DidChangeWatchedFilesRegistrationOptions(globs)
            method = types.WORKSPACE_DID_CHANGE_WATCHED_FILES
            params = types.RegistrationParams([types.Registration("irbkin", method, options)])
            with contextlib.suppress(JsonRpcException):
                await self.client_register_capability_async(params)


def path_of(uri: str) -> str:
    path = to_fs_path(uri) if uri.startswith("file:") else None
    return path or uri
