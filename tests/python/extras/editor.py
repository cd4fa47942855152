"""An editor: a client of `irbkin lsp`, which runs as a process of its own."""

import asyncio
import contextlib
import os
import sys
from pathlib import Path

from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pytest_lsp import ClientServerConfig, client_capabilities

SECONDS = 30.0
WHOLE = types.TextDocumentContentChangeWholeDocument


class Editor:
    """Documents of a client, and what the server says of them."""

    def __init__(self, client):
        self.client = client
        self.texts = {}
        self.published = []
        publish = client.protocol.fm.features["textDocument/publishDiagnostics"]
        self._publish = publish
        client.protocol.fm.features["textDocument/publishDiagnostics"] = self._take

    def _take(self, params):
        self._publish(params)
        self.published.append(params)

    def open(self, path, text=None):
        """Open a file, or a text in its place."""
        uri = uri_of(path)
        text = Path(path).read_text(encoding="utf-8", errors="replace") if text is None else text
        self.texts[uri] = (1, text)
        item = types.TextDocumentItem(uri, "rapid", 1, text)
        self.client.text_document_did_open(types.DidOpenTextDocumentParams(item))
        return uri

    def change(self, uri, old, new):
        """Replace the first place of a part of the text, as an edit."""
        version, text = self.texts[uri]
        begin = text.index(old)
        area = types.Range(position(text, begin), position(text, begin + len(old)))
        self.texts[uri] = (version + 1, text.replace(old, new, 1))
        self.send(uri, types.TextDocumentContentChangePartial(area, new))

    def insert(self, uri, before, new):
        """Type something before the first place of a part of the text."""
        version, text = self.texts[uri]
        at = position(text, text.index(before))
        self.texts[uri] = (version + 1, text.replace(before, new + before, 1))
        self.send(uri, types.TextDocumentContentChangePartial(types.Range(at, at), new))

    def write(self, uri, text):
        """Replace the text."""
        self.texts[uri] = (self.texts[uri][0] + 1, text)
        self.send(uri, WHOLE(text))

    def send(self, uri, *changes):
        document = types.VersionedTextDocumentIdentifier(self.texts[uri][0], uri)
        self.client.text_document_did_change(types.DidChangeTextDocumentParams(document, changes))

    def close(self, uri):
        document = types.TextDocumentIdentifier(uri)
        self.client.text_document_did_close(types.DidCloseTextDocumentParams(document))

    async def marks(self, uri):
        """The findings in a document as it is."""
        wanted = self.texts[uri][0]
        async with asyncio.timeout(SECONDS) if hasattr(asyncio, "timeout") else _forever():
            while not any((it.uri, it.version) == (uri, wanted) for it in self.published):
                await asyncio.sleep(0.002)
        return [it for it in self.published if (it.uri, it.version) == (uri, wanted)][
            -1
        ].diagnostics

    async def codes(self, uri):
        return [it.code for it in await self.marks(uri)]

    def spot(self, uri, part, shift=0):
        """The place of a part of a text."""
        _, text = self.texts[uri]
        return types.TextDocumentIdentifier(uri), position(text, text.index(part) + shift)

    async def hover(self, uri, part, shift=0):
        found = await self.client.text_document_hover_async(
            types.HoverParams(*self.spot(uri, part, shift))
        )
        return found and found.contents.value

    async def definition(self, uri, part, shift=0):
        """The file, the line from 1 and the name that a name leads to."""
        found = await self.client.text_document_definition_async(
            types.DefinitionParams(*self.spot(uri, part, shift))
        )
        if found is None:
            return None
        path = Path(found.uri.removeprefix("file://"))
        text = self.texts[found.uri][1] if found.uri in self.texts else path.read_text("latin-1")
        return path.name, found.range.start.line + 1, part_of(text, found.range)

    async def actions(self, uri, part, only=None):
        _, at = self.spot(uri, part)
        context = types.CodeActionContext(await self.marks(uri), only)
        area, document = types.Range(at, at), types.TextDocumentIdentifier(uri)
        params = types.CodeActionParams(document, area, context)
        return await self.client.text_document_code_action_async(params)

    async def completions(self, uri, part, shift=0, trigger=None):
        """What is offered at a place, in the order in which editors show it."""
        kind = types.CompletionTriggerKind.TriggerCharacter
        context = types.CompletionContext(kind, trigger) if trigger else None
        params = types.CompletionParams(*self.spot(uri, part, shift), context)
        found = await self.client.text_document_completion_async(params)
        return sorted(found.items, key=lambda it: it.sort_text or it.label)

    async def labels(self, uri, part, shift=0, trigger=None):
        return [it.label for it in await self.completions(uri, part, shift, trigger)]

    async def parameter(self, uri, part, shift=0):
        """The header of what is called at a place, and the parameter that is there."""
        params = types.SignatureHelpParams(*self.spot(uri, part, shift))
        found = await self.client.text_document_signature_help_async(params)
        if found is None:
            return None
        (one,) = found.signatures
        spans = [one.label[slice(*it.label)] for it in one.parameters]
        return one.label, spans[found.active_parameter] if found.active_parameter < len(
            spans
        ) else ""

    async def references(self, uri, part, shift=0, *, is_whole=True):
        """The files and lines from 1 at which a name is."""
        context = types.ReferenceContext(is_whole)
        params = types.ReferenceParams(context, *self.spot(uri, part, shift))
        found = await self.client.text_document_references_async(params)
        places = [(Path(it.uri).name, it.range.start.line + 1) for it in found]
        return sorted(places)

    async def rename(self, uri, part, new, shift=0):
        """Rename something; return the texts of files that are not open, or why it is refused."""
        params = types.RenameParams(*self.spot(uri, part, shift), new)
        try:
            return self.apply(await self.client.text_document_rename_async(params))
        except JsonRpcException as refused:
            return refused.message

    def apply(self, edit):
        """Apply an edit to open documents; return the texts of other files."""
        others = {}
        for uri, edits in edit.changes.items():
            is_open = uri in self.texts
            text = self.texts[uri][1] if is_open else Path(uri.removeprefix("file://")).read_text()
            for edit in sorted(edits, key=lambda it: offset(text, it.range.start), reverse=True):
                begin, end = offset(text, edit.range.start), offset(text, edit.range.end)
                text = text[:begin] + edit.new_text + text[end:]
            if is_open:
                self.write(uri, text)
            else:
                others[uri] = text
        return others

    def messages(self):
        return [it.message for it in self.client.messages]


@contextlib.asynccontextmanager
async def _forever():
    yield


@contextlib.asynccontextmanager
async def editing(
    folder=None, *arguments, options=None, client="visual-studio-code", settings=None
):
    """An editor, with the options that it gives the server."""
    environment = {**os.environ, "IRBKIN_ROBOT": ""}
    command = [sys.executable, "-m", "irbkin", "lsp", *arguments]
    connected = await ClientServerConfig(command, server_env=environment).start()
    if settings is not None:
        connected.set_configuration(settings)
    root = None if folder is None else uri_of(folder)
    params = types.InitializeParams(
        client_capabilities(client), root_uri=root, initialization_options=options
    )
    await connected.initialize_session(params)
    editor = Editor(connected)
    try:
        yield editor
        # Whatever was asked of it, the server lives, and nothing went wrong in it.
        assert connected.log_messages == []
    finally:
        await asyncio.wait_for(connected.shutdown_session(), SECONDS)
        assert connected._server.returncode == 0
        await connected.stop()


def uri_of(path):
    return path if str(path).startswith("untitled:") else Path(path).as_uri()


def position(text, at):
    """The position of an offset: units of UTF-16, lines as editors count them."""
    before = text[:at].replace("\r\n", "\n ").replace("\r", "\n")
    line = before.count("\n")
    # A blank stands for each line feed behind a carriage return.
    last = text[:at].replace("\r", "\n").rpartition("\n")[2]
    return types.Position(line, len(last.encode("utf-16-le")) // 2)


def offset(text, at):
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    ends = "\r\n" if "\r\n" in text else "\n"
    begin = sum(len(it) + len(ends) for it in lines[: at.line])
    return begin + len(lines[at.line].encode("utf-16-le")[: 2 * at.character].decode("utf-16-le"))


def part_of(text, area):
    return text[offset(text, area.start) : offset(text, area.end)]
