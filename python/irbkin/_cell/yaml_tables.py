"""Tables of a YAML file, read by PyYAML: `pip install 'irbkin[yaml]'`."""

from __future__ import annotations

import re
from typing import Any

from irbkin.errors import InvalidModelError

# YAML 1.1 takes 1e-5 for a text, which other writers than PyYAML write.
_FLOAT = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$")


def parsed(content: bytes) -> Any:
    """The one document of a YAML file, in which no key is given twice."""
    try:
        import yaml  # type: ignore[import-untyped, unused-ignore]
    except ImportError as missing:
        raise ImportError(
            "a cell in YAML is read by PyYAML: pip install 'irbkin[yaml]'", name="yaml"
        ) from missing

    class Loader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
        def construct_mapping(self, node: Any, deep: bool = False) -> Any:
            keys = [str(key.value) for key, _ in node.value]
            if len(keys) > len(set(keys)):
                twice = f"{max(keys, key=keys.count)} is given twice"
                raise yaml.MarkedYAMLError(problem=twice, problem_mark=node.start_mark)
            table = super().construct_mapping(node, deep)
            # YAML 1.1 takes on, off, yes and no for truth values.
            for key in (it for it in table if not isinstance(it, str)):
                words = f"the key {key!r} is no text: write it in quotes"
                raise yaml.MarkedYAMLError(problem=words, problem_mark=node.start_mark)
            return table

    Loader.add_implicit_resolver("tag:yaml.org,2002:float", _FLOAT, list("-+.0123456789"))
    try:
        documents = [own for own in yaml.load_all(content, Loader) if own is not None]
    except (yaml.YAMLError, ValueError) as error:
        raise InvalidModelError(f"is not YAML: {error}") from None
    if len(documents) != 1:
        raise InvalidModelError(f"has {len(documents)} documents, it must have one PlanningScene")
    # Without aliases there are no more parts than bytes.
    left, parts = len(content), documents[:]
    while parts:
        part, left = parts.pop(), left - 1
        if left < 0:
            raise InvalidModelError("repeats its parts by aliases (*name): write them out")
        parts += part.values() if isinstance(part, dict) else part if isinstance(part, list) else ()
    return documents[0]
