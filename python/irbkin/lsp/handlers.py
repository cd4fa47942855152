"""The handlers of messages."""

from __future__ import annotations

from lsprotocol import types

from irbkin.lsp.hover import hover
from irbkin.lsp.marks import FIX_ALL, actions, location, symbols
from irbkin.lsp.server import WAIT, Server, Spot, path_of
from irbkin.lsp.text import Text

CODE_ACTIONS = types.CodeActionOptions([types.CodeActionKind.QuickFix, FIX_ALL])


def register(server: Server) -> None:
    """Register all handlers."""
    _of_session(server)
    _of_documents(server)
    _of_questions(server)


def _of_session(server: Server) -> None:
    @server.feature(types.INITIALIZE)
    def initialize(params: types.InitializeParams) -> None:
        server.set_options(params.initialization_options)

    @server.feature(types.INITIALIZED)
    async def initialized(params: types.InitializedParams) -> None:
        await server.watch()
        await server.fetch_options()

    @server.feature(types.WORKSPACE_DID_CHANGE_CONFIGURATION)
    async def configured(params: types.DidChangeConfigurationParams) -> None:
        server.set_options(params.settings)
        await server.fetch_options()

    @server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def files_changed(params: types.DidChangeWatchedFilesParams) -> None:
        changed = types.FileChangeType.Changed
        paths = [path_of(it.uri) for it in params.changes]
        is_content = all(it.type == changed for it in params.changes)
        if is_content and not any(it.lower().endswith((".toml", ".cfg")) for it in paths):
            for path in server.documents:
                server.queue.change(path)
        else:
            server.queue.reload(server.documents, server.options)

    @server.feature(types.SHUTDOWN)
    def shutdown(params: None) -> None:
        server.queue.stop()


def _of_documents(server: Server) -> None:
    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: types.DidOpenTextDocumentParams) -> None:
        of = params.text_document
        server.documents.pop(path_of(of.uri), None)
        server.put(of.uri, of.version, Text(of.text))

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: types.DidChangeTextDocumentParams) -> None:
        of = params.text_document
        _, _, text = server.documents.get(path_of(of.uri), ("", 0, None))
        for change in params.content_changes:
            if isinstance(change, types.TextDocumentContentChangeWholeDocument):
                text = Text(change.text)
            elif text is not None:
                text = text.changed(change)
        if text is not None:
            server.put(of.uri, of.version, text)

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: types.DidSaveTextDocumentParams) -> None:
        # Another program may have changed what is not open.
        server.queue.change(path_of(params.text_document.uri))

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: types.DidCloseTextDocumentParams) -> None:
        path = path_of(params.text_document.uri)
        if path in server.documents:
            server.show(path, [])
            del server.documents[path]
        server.queue.close(path)


def _of_questions(server: Server) -> None:
    @server.feature(types.TEXT_DOCUMENT_HOVER)
    async def hovered(params: types.HoverParams) -> types.Hover | None:
        found = await server.place(params)
        if found is None:
            return None
        result, module, offset = found
        words, span = hover(result, module, offset, server.desk)
        if not words:
            return None
        content = types.MarkupContent(types.MarkupKind.Markdown, words)
        return types.Hover(content, result.text(module).range(*span))

    @server.feature(types.TEXT_DOCUMENT_DEFINITION)
    async def defined(params: types.DefinitionParams) -> types.Location | None:
        return await _declared(params)

    @server.feature(types.TEXT_DOCUMENT_DECLARATION)
    async def declared(params: types.DeclarationParams) -> types.Location | None:
        return await _declared(params)

    async def _declared(params: Spot) -> types.Location | None:
        found = await server.place(params)
        if found is None:
            return None
        result, module, offset = found
        text = result.text(module)
        begin, end = text.word(offset)
        routine = result.names.routine_at(module, text.place(offset)[0])
        it = result.names.find(module, routine, text.source[begin:end])
        return location(result, it) if it else None

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    async def listed(params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
        begin = types.Position(0, 0)
        found = await server.place(types.TextDocumentPositionParams(params.text_document, begin))
        return symbols(*found[:2]) if found else []

    @server.feature(types.TEXT_DOCUMENT_CODE_ACTION, CODE_ACTIONS)
    async def corrected(params: types.CodeActionParams) -> list[types.CodeAction]:
        path = path_of(params.text_document.uri)
        await server.queue.rest(path, WAIT)
        return actions(server.results(path), path, params)
