"""The modules of the Python package, and which of them uses which, read from their syntax trees."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "python" / "irbkin"
CORE = "irbkin._core"


@cache
def modules() -> dict[str, ast.Module]:
    """The syntax tree of every module by its name; the extension has none."""
    found = {CORE: ast.Module([], [])}
    for file in sorted(PACKAGE.rglob("*.py")):
        path = file.relative_to(PACKAGE.parent).with_suffix("")
        name = path.parent if path.name == "__init__" else path
        found[".".join(name.parts)] = ast.parse(file.read_text(encoding="utf-8"))
    return found


def imported(tree: ast.AST) -> Iterator[tuple[str, str]]:
    """The modules that a tree imports, in functions and for types too, and the name that it takes
    from each.
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            assert node.module, "an import has the whole name of its module"
            yield from ((node.module, alias.name) for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from ((alias.name, "") for alias in node.names)
        # The names of a package that is imported whole.
        elif isinstance(node, ast.Attribute) and ast.unparse(node.value) == "irbkin":
            yield "irbkin", node.attr


@cache
def home(module: str, name: str) -> str:
    """The module that a name of a module is, or is defined in if a package hands it on."""
    if f"{module}.{name}" in modules():
        return f"{module}.{name}"
    is_package = any(other.startswith(f"{module}.") for other in modules())
    for node in ast.walk(modules()[module]) if is_package else ():
        if isinstance(node, ast.ImportFrom) and node.module in modules():
            for alias in node.names:
                if name == (alias.asname or alias.name) and node.module != module:
                    return home(node.module, alias.name)
    return module


def used_by() -> dict[str, set[str]]:
    """The modules that each module imports."""
    graph = {}
    for own, tree in modules().items():
        used = {home(*pair) for pair in imported(tree) if pair[0] in modules()}
        graph[path(own)] = {path(other) for other in used - {own}}
    return graph


def path(module: str) -> str:
    """A module as the table of layers names it."""
    return module.removeprefix("irbkin.").replace(".", "/")


def cycles(graph: dict[str, set[str]]) -> list[list[str]]:
    """Files that use one another in a circle: the strongly connected components (Tarjan)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found = []

    def visit(node: str) -> None:
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in graph[node]:
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            circle = stack[stack.index(node) :]
            del stack[stack.index(node) :]
            if len(circle) > 1:
                found.append(sorted(circle))

    for node in sorted(graph):
        if node not in index:
            visit(node)
    return sorted(found)
