"""Checks of the programs of open documents: one at a time in a thread, of the latest text."""

import asyncio
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

from irbkin.lsp.programs import Programs
from irbkin.lsp.session import Result, Session
from irbkin.lsp.text import Text


class Queue:
    """The sessions of the documents that are open.

    All methods are called in the event loop. One thread reads and checks, so that no two checks run
    at a time.
    """

    def __init__(
        self,
        programs: Programs,
        texts: Callable[[], Mapping[str, Text]],
        done: Callable[[Session], None],
        failed: Callable[[BaseException], None],
    ) -> None:
        self._programs, self._texts = programs, texts
        self._done, self._failed = done, failed
        self._pool = ThreadPoolExecutor(1, "irbkin")
        self._sessions: dict[tuple[str, tuple[str, ...]], Session] = {}
        self._of: dict[str, list[Session]] = {}
        self._new: dict[str, Mapping[str, Any]] = {}
        self._stale: dict[Session, None] = {}
        self._worker: asyncio.Task[None] | None = None

    def sessions(self, path: str) -> Sequence[Session]:
        return self._of.get(path, ())

    def open(self, path: str, options: Mapping[str, Any]) -> None:
        self._new[path] = options
        self._wake()

    def change(self, path: str) -> None:
        self._stale.update(dict.fromkeys(self.sessions(path)))
        self._wake()

    def close(self, path: str) -> None:
        """Remove a document; sessions that share it continue with the text of its file."""
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
        """Reload options and backups, and find the sessions of all documents again."""
        self._sessions.clear()
        self._stale.clear()
        self._new = dict.fromkeys(paths, options)
        self._pool.submit(self._programs.forget)
        self._wake()

    async def rest(self, path: str, timeout: float) -> bool:
        """Wait until the current text of a document is checked; return whether it is in time."""
        loop = asyncio.get_running_loop()
        end = loop.time() + timeout
        while self._worker and not self._worker.done():
            if path not in self._new and self._stale.keys().isdisjoint(self.sessions(path)):
                break
            left = end - loop.time()
            if left <= 0.0:
                return False
            await asyncio.sleep(min(0.002, left))
        return True

    async def read_tasks(self, path: str, options: Mapping[str, Any]) -> dict[str, Result]:
        """Read the programs of all tasks of the backup of a file, by titles; check no moves."""
        texts, programs = dict(self._texts()), self._programs

        def read() -> dict[str, Result]:
            files = programs.files_of_tasks(path)
            sessions = (own for file in files for own in programs.sessions(file, options))
            unmoved = (replace(own, job=replace(own.job, robot=None)) for own in sessions)
            return {own.job.title: own.check(texts) for own in unmoved}

        return await asyncio.get_running_loop().run_in_executor(self._pool, read)

    def stop(self) -> None:
        """End the thread after its current check."""
        self._pool.shutdown(wait=False, cancel_futures=True)

    def _wake(self) -> None:
        if self._worker is None or self._worker.done():
            self._worker = asyncio.get_running_loop().create_task(self._work())

    async def _work(self) -> None:
        # Changes that are already here come together.
        await asyncio.sleep(0)
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
            found = await loop.run_in_executor(self._pool, self._programs.sessions, path, options)
        except Exception:
            self._new.pop(path, None)
            raise
        if self._new.get(path) is not options:
            return
        del self._new[path]
        self._of[path] = []
        for new in found:
            session = self._sessions.setdefault(_key(new), new)
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
        # A text that changed meanwhile is checked again.
        now = self._texts()
        if session in self._stale and all(texts.get(it) is now.get(it) for it in session.paths):
            del self._stale[session]
            session.result = result
            self._done(session)


def _key(session: Session) -> tuple[str, tuple[str, ...]]:
    return session.job.title, tuple(session.paths)
