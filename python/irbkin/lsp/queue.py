"""The programs of open documents, checked one after another in a thread; the latest text counts."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from irbkin.lsp.reading import Reading
from irbkin.lsp.work import Desk, Session

PAUSE = 0.01
"""Time in which changes come together before a check [s]."""


class Queue:
    """The sessions of the documents that are open.

    All its methods are called by the event loop. What takes time is done in one thread, so that
    nothing is read or checked twice at a time.
    """

    def __init__(
        self,
        desk: Desk,
        texts: Callable[[], Mapping[str, str]],
        done: Callable[[Session], None],
        failed: Callable[[BaseException], None],
    ) -> None:
        self._desk, self._texts, self._done, self._failed = desk, texts, done, failed
        self._pool = ThreadPoolExecutor(1, "irbkin")
        self._sessions: dict[tuple[str, tuple[str, ...]], Session] = {}
        self._of: dict[str, list[Session]] = {}
        self._new: dict[str, Mapping[str, Any]] = {}
        self._stale: dict[Session, None] = {}
        self._worker: asyncio.Task[None] | None = None

    def sessions(self, path: str) -> Sequence[Session]:
        """Return the sessions of a document, as far as they are known."""
        return self._of.get(path, ())

    def open(self, path: str, options: Mapping[str, Any]) -> None:
        """Look for the tasks of a document and check them."""
        self._new[path] = options
        self._wake()

    def change(self, path: str) -> None:
        """Check the tasks of a document again."""
        self._stale.update(dict.fromkeys(self.sessions(path)))
        self._wake()

    def close(self, path: str) -> None:
        """Forget a document; the others are checked with the text of its file."""
        self._new.pop(path, None)
        closed = self._of.pop(path, [])
        kept = {session for own in self._of.values() for session in own}
        for session in closed:
            if session in kept:
                self._stale[session] = None
            else:
                self._stale.pop(session, None)
                self._sessions.pop(_key(session), None)
        self._wake()

    def reload(self, paths: Iterable[str], options: Mapping[str, Any]) -> None:
        """Read options and backups again, and look for the tasks of all documents."""
        self._sessions.clear()
        self._stale.clear()
        self._new = dict.fromkeys(paths, options)
        self._pool.submit(self._desk.forget)
        self._wake()

    async def rest(self, path: str, timeout: float) -> None:
        """Wait until a document is checked as it is."""
        loop = asyncio.get_running_loop()
        end = loop.time() + timeout
        while self._worker and not self._worker.done() and self._is_open(path):
            left = end - loop.time()
            if left <= 0.0:
                return
            await asyncio.wait({asyncio.ensure_future(asyncio.sleep(min(0.002, left)))})

    def stop(self) -> None:
        """End the thread when it is done with what it does."""
        self._pool.shutdown(wait=False, cancel_futures=True)

    def _is_open(self, path: str) -> bool:
        """Whether something of a document is yet to be done."""
        return path in self._new or any(it in self._stale for it in self.sessions(path))

    def _wake(self) -> None:
        if self._worker is None or self._worker.done():
            self._worker = asyncio.get_running_loop().create_task(self._work())

    async def _work(self) -> None:
        """Do what there is to do."""
        await asyncio.sleep(PAUSE)
        while self._new or self._stale:
            try:
                if self._new:
                    path, options = next(iter(self._new.items()))
                    await self._find(path, options)
                else:
                    await self._check(next(reversed(self._stale)))
            except Exception as error:
                self._failed(error)

    async def _find(self, path: str, options: Mapping[str, Any]) -> None:
        loop = asyncio.get_running_loop()
        try:
            tasks = await loop.run_in_executor(self._pool, self._desk.tasks, path, options)
        except Exception:
            self._new.pop(path, None)
            raise
        if self._new.get(path) is not options:
            return
        del self._new[path]
        self._of[path] = []
        for task in tasks:
            session = Session(task, Reading(task.paths))
            session = self._sessions.setdefault(_key(session), session)
            self._of[path].append(session)
            self._stale[session] = None

    async def _check(self, session: Session) -> None:
        texts = dict(self._texts())
        loop = asyncio.get_running_loop()
        try:
            result = await loop.run_in_executor(self._pool, session.check, texts)
        except Exception:
            self._stale.pop(session, None)
            raise
        # A text that changed in the meantime is checked again.
        if session in self._stale and _is_same(texts, self._texts(), session):
            del self._stale[session]
            session.result = result
            self._done(session)


def _key(session: Session) -> tuple[str, tuple[str, ...]]:
    return session.task.title, tuple(session.task.paths)


def _is_same(old: Mapping[str, str], new: Mapping[str, str], session: Session) -> bool:
    """Whether the texts of a session are the same objects."""
    return all(old.get(path) is new.get(path) for path in session.reading.paths)
