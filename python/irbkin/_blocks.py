"""Work in blocks: here, or by the workers of a cluster."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

_Block = TypeVar("_Block")
_Answer = TypeVar("_Answer")

# Blocks that wait for each thread of a cluster: so that none is idle, and memory stays flat.
WAITING = 2


class Client(Protocol):
    """The part of `distributed.Client` that is used."""

    def submit(self, function: Callable[..., Any], *args: Any, **options: Any) -> Any:
        """Run a function on a worker."""

    def scatter(self, data: Any, *, broadcast: bool, hash: bool) -> Any:
        """Hand data to every worker."""

    def nthreads(self) -> dict[str, int]:
        """Threads of each worker."""

    def cancel(self, futures: list[Any]) -> Any:
        """Stop what is waiting."""


def worked(
    client: Client | None,
    function: Callable[[Any, _Block], _Answer],
    shared: Any,
    blocks: Iterable[_Block],
) -> Iterator[tuple[_Block, _Answer]]:
    """Each block with `function(shared, block)`, in the order in which they are ready.

    Raises:
        Exception: Whatever the function raises. What is waiting then is stopped.
    """
    if client is None:
        for block in blocks:
            yield block, function(shared, block)
        return
    import distributed

    # As one object, and not by its value: that of an earlier call may be on its way out.
    [given] = client.scatter([shared], broadcast=True, hash=False)
    remaining, waiting = iter(blocks), {}

    def submit() -> Any:
        for block in remaining:
            future = client.submit(function, given, block, pure=False)
            waiting[future] = block
            return future
        return None

    size = WAITING * max(sum(client.nthreads().values()), 1)
    first = [future for future in (submit() for _ in range(size)) if future is not None]
    ready: Any = distributed.as_completed(first)  # type: ignore[no-untyped-call]
    try:
        for future in ready:
            answer = future.result()
            more = submit()
            if more is not None:
                ready.add(more)
            yield waiting.pop(future), answer
    finally:
        if waiting:
            client.cancel(list(waiting))
