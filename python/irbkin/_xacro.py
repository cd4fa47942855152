"""URDF of xacro files, expanded by `xacrodoc`: `pip install 'irbkin[xacro]'`."""

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from irbkin import _bounded
from irbkin._arguments import check_extra
from irbkin._files import read
from irbkin._words import visible
from irbkin.errors import InvalidModelError

MOST_NESTED = 3
"""How often a file may be among those that include each other: once, and behind its guards."""


def expanded(
    path: str | os.PathLike[str],
    args: Mapping[str, object] | None = None,
    packages: Mapping[str, str | os.PathLike[str]] | None = None,
) -> str:
    """Expand a xacro file, or a text that begins with "<", to the text of a URDF.

    A xacro file is a program: its properties and conditions are Python expressions. xacro only
    forbids them names that begin with "__", which a lambda gets around, and `$(eval ..)` has the
    builtins: they can do all that this user can, such as to read any file and the environment. So
    expand only files that you would run. Their time and memory are bounded.

    Args:
        path: The file or text; in a text, includes are relative to the working folder.
        args: Values of its `<xacro:arg>`.
        packages: Folders of ROS packages; those not given are looked for above the file, beside it
            and each folder above it, and where ROS has them.

    Raises:
        InvalidModelError: It cannot be expanded; the message says what is missing.
        OSError: The file cannot be read.
    """
    check_extra("a xacro file", "xacro", "xacrodoc")
    text = os.fspath(path)
    is_text = text.lstrip().startswith("<")
    content = text if is_text else read(text).decode("utf-8-sig", "replace")
    words = {it: str(own).lower() if own in (True, False) else str(own) for it, own in (args or {}).items()}
    folders = {it: os.path.abspath(own) for it, own in (packages or {}).items()}
    file = None if is_text else os.path.abspath(text)
    try:
        result: str = _bounded.call(
            "xacrodoc", "irbkin._xacro.expand", content, file, words, folders
        )
    except InvalidModelError as error:
        where = "the text" if is_text else text
        raise InvalidModelError(f"{where}: {visible(str(error))}") from None
    return result


def expand(text: str, file: str | None, args: dict[str, str], folders: dict[str, str]) -> str:
    """Expand a text in this process."""
    import xacro
    from xacrodoc import XacroDoc, packages

    if file is not None:
        packages.walk_up_from(file)
    packages.update_package_cache(folders)
    find, parse = packages.get_path, xacro.parse

    def find_beside(name: str) -> str:
        above = [] if file is None else Path(file).parents
        beside = next((it / name for it in above if (it / name).is_dir()), None)
        try:
            return str(find(name))
        except packages.PackageNotFoundError:
            if beside is None:
                raise
            return str(beside)

    def parse_once(text: Any, path: str | None = None) -> Any:
        if path and [*map(os.path.realpath, xacro.filestack)].count(os.path.realpath(path)) > MOST_NESTED:
            raise InvalidModelError(f"{path} includes itself")
        return parse(text, path)

    packages.get_path, xacro.parse = find_beside, parse_once
    xacro.init_stacks(file)
    try:
        return str(XacroDoc.from_string(text, args, resolve_packages=False).dom.toxml())
    except (RecursionError, MemoryError):
        raise
    except Exception as error:
        raise InvalidModelError(_reason(error, [file, *xacro.all_includes])) from None


def _reason(error: Any, files: list[str | None]) -> str:
    """What is wrong, by the first cause of an error."""
    from xacro.substitution_args import ArgException
    from xacrodoc.packages import PackageNotFoundError
    cause = error
    while getattr(cause, "exc", None) is not None:
        cause = cause.exc
    if isinstance(cause, PackageNotFoundError):
        name = cause.args[0]
        return f"the package {name!r} is not found: pass packages={{{name!r}: its folder}}"
    if isinstance(cause, ArgException):
        name = cause.args[0]
        return f"the argument {name!r} has no value: pass args={{{name!r}: its value}}"
    if isinstance(cause, FileNotFoundError):
        return f"needs {cause.filename!r}, which is not there"
    found = re.search(r"when evaluating expression '(.*?)'\s", f"{error} ", re.DOTALL)
    if found is None:
        return str(error)
    for file in filter(None, files):
        lines = Path(file).read_text("utf-8", "replace").split("${" + found[1] + "}")
        if len(lines) > 1:
            return f"{file}, line {lines[0].count(chr(10)) + 1}: ${{{found[1]}}} is wrong: {cause}"
    return f"${{{found[1]}}} is wrong: {cause}"
