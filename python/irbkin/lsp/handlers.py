"""The handlers of messages."""

from collections.abc import Container

from lsprotocol import types

from irbkin import rapid
from irbkin.errors import IrbkinError
from irbkin.lsp.code import before, occurrences
from irbkin.lsp.completion import MOST, completions, signature
from irbkin.lsp.hover import hover
from irbkin.lsp.marks import FIX_ALL, actions, folds, location, places, symbols
from irbkin.lsp.names import Declared, known
from irbkin.lsp.server import WAIT, Document, Refusal, Server, path_of
from irbkin.lsp.session import Result
from irbkin.lsp.text import Text
from irbkin.rapid.program import ENDINGS

CODE_ACTIONS = types.CodeActionOptions([types.CodeActionKind.QuickFix, FIX_ALL])
LONGEST = 32
"""Characters of a name in RAPID."""
ENTRY = "main"
"""The procedure that a controller calls."""


def register(server: Server) -> None:
    @server.feature(types.INITIALIZE)
    def initialize(params: types.InitializeParams) -> None:
        folders = [folder.uri for folder in params.workspace_folders or ()]
        if root := params.root_uri or next(iter(folders), None):
            server.programs.folder = path_of(root)
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
        if all(it.type == changed and it.uri.lower().endswith(ENDINGS) for it in params.changes):
            for path in server.documents:
                server.queue.change(path)
        else:
            server.queue.reload(server.documents, server.options)

    @server.feature(types.SHUTDOWN)
    def shutdown(params: None) -> None:
        server.queue.stop()

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
            if text or isinstance(change, types.TextDocumentContentChangeWholeDocument):
                text = (text or Text("")).changed(change)
        if text is not None:
            server.put(of.uri, of.version, text)

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: types.DidSaveTextDocumentParams) -> None:
        # Other programs may have changed files that are not open.
        server.queue.change(path_of(params.text_document.uri))

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: types.DidCloseTextDocumentParams) -> None:
        path = path_of(params.text_document.uri)
        if path in server.documents:
            server.show(path, [])
            del server.documents[path]
        server.queue.close(path)

    @server.feature(types.TEXT_DOCUMENT_HOVER)
    async def hovered(params: types.HoverParams) -> types.Hover | None:
        for result, module, text, offset in await server.at(params):
            words, span = hover(result, module, offset)
            content = types.MarkupContent(types.MarkupKind.Markdown, words)
            return types.Hover(content, text.range(*span)) if words else None
        return None

    @server.feature(types.TEXT_DOCUMENT_DEFINITION)
    @server.feature(types.TEXT_DOCUMENT_DECLARATION)
    async def declared(params: Document) -> types.Location | None:
        return next((location(*own) for own in await named(params)), None)

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    async def listed(params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
        return [it for own in (await server.at(params))[:1] for it in symbols(*own[:2])]

    @server.feature(types.TEXT_DOCUMENT_FOLDING_RANGE)
    async def folded(params: types.FoldingRangeParams) -> list[types.FoldingRange]:
        return [it for own in (await server.at(params))[:1] for it in folds(*own[:2])]

    async def named(params: Document) -> list[tuple[Result, Declared]]:
        """The name at a position, in each program of the document."""
        found = [(own[0], own[0].declared(own[1], own[3])) for own in await server.at(params)]
        return [(result, declared) for result, declared in found if declared is not None]

    async def everywhere(params: Document) -> list[tuple[Result, Declared]]:
        """The name at a position, in every program of its backup that has the same; of files that
        are not open, as they are on disk now.
        """
        path = path_of(params.text_document.uri)
        if path in server.texts():
            server.queue.open(path, server.options)
        found = await named(params)
        others = await server.queue.read_tasks(path, server.options) if found else {}
        for result, _ in found:
            others.pop(result.job.title, None)
        for result, declared in found:
            for title, other in list(others.items()):
                if same := result.counterpart(other, declared):
                    found.append((others.pop(title), same))
        return found

    @server.feature(types.TEXT_DOCUMENT_REFERENCES)
    async def referred(params: types.ReferenceParams) -> list[types.Location]:
        return places(await everywhere(params), is_whole=params.context.include_declaration)

    @server.feature(types.TEXT_DOCUMENT_PREPARE_RENAME)
    async def renamable(params: types.PrepareRenameParams) -> types.Range | None:
        for _, _, text, offset in await server.at(params) if await named(params) else ():
            return text.range(*text.word(offset))
        return None

    @server.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
    async def renamed(params: types.RenameParams) -> types.WorkspaceEdit:
        own, new = await everywhere(params), params.new_name
        taken = server.programs.task_names()
        reasons = [refusal(*one, new, taken) for one in own] or ["nothing that is declared is here"]
        if not await server.queue.rest(path_of(params.text_document.uri), 0.0):
            reasons.append("the program is still being checked")
        for reason in filter(None, reasons):
            raise Refusal(reason)
        edits: dict[str, list[types.TextEdit]] = {}
        for it in places(own):
            edits.setdefault(it.uri, []).append(types.TextEdit(it.range, new))
        return types.WorkspaceEdit(edits)

    @server.feature(types.TEXT_DOCUMENT_COMPLETION, types.CompletionOptions([*" ,=(\\"]))
    async def completed(params: types.CompletionParams) -> types.CompletionList:
        trigger = params.context.trigger_character if params.context else None
        found = await server.at(params, is_now=True)
        items = completions(found[0], trigger) if found else []
        return types.CompletionList(len(items) == MOST, items)

    @server.feature(types.TEXT_DOCUMENT_SIGNATURE_HELP, types.SignatureHelpOptions([*" ,(\\"]))
    async def signed(params: types.SignatureHelpParams) -> types.SignatureHelp | None:
        found = await server.at(params, is_now=True)
        return signature(found[0]) if found else None

    @server.feature(types.TEXT_DOCUMENT_CODE_ACTION, CODE_ACTIONS)
    async def corrected(params: types.CodeActionParams) -> list[types.CodeAction]:
        path = path_of(params.text_document.uri)
        await server.queue.rest(path, WAIT)
        return actions(server.results(path), path, params)


def refusal(result: Result, declared: Declared, new: str, tasks: Container[str]) -> str | None:
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
    for name in (declared.name, new):
        if name.lower() in tasks:
            return f"{name} is the name of a task"
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
