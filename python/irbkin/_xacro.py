"""URDF of xacro files, expanded by `xacrodoc`: `pip install 'irbkin[xacro]'`."""

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from irbkin import _bounded
from irbkin._arguments import check_extra
from irbkin._words import listed
from irbkin.errors import InvalidModelError

MOST_OPEN = 3
"""How often a file may be open: once, and again where a condition ends its including itself."""


def expanded(
    path: str | os.PathLike[str],
    args: Mapping[str, str] | None = None,
    packages: Mapping[str, str | os.PathLike[str]] | None = None,
) -> str:
    """Expand a xacro file, or a text that begins with "<", to a URDF.

    A xacro file is a program; expand only those that you would run. Its Python expressions are not
    sandboxed: xacro forbids names that begin with "__", but not in a lambda, and `$(eval ..)` has
    all builtins. Time and memory are bounded.

    Args:
        path: The file, or a text, whose includes are relative to the working folder.
        args: Values of its `<xacro:arg>`.
        packages: Folders of ROS packages. Others are looked for above the file, where ROS has
            them, and by name in each folder above the file.

    Raises:
        InvalidModelError: It cannot be expanded; the message says what is missing.
        OSError: The file cannot be read.
    """
    check_extra("a xacro file", "xacro", "xacrodoc")
    values = {name: str(own) for name, own in (args or {}).items()}
    folders = {name: os.path.abspath(own) for name, own in (packages or {}).items()}
    with _bounded.source(path) as (text, file):
        return str(_bounded.call("xacrodoc", "irbkin._xacro.expand", text, file, values, folders))


def expand(text: str, file: str | None, args: dict[str, str], folders: dict[str, str]) -> str:
    """Expand a text in this process, and change xacro for it."""
    import xacro
    from xacrodoc import XacroDoc, packages

    above = [] if file is None else Path(file).resolve().parents
    get_path = packages.get_path
    parse = xacro.parse

    def find(name: str) -> str:
        beside = (str(folder / name) for folder in above if (folder / name).is_dir())
        try:
            return str(get_path(name))
        except packages.PackageNotFoundError:
            if found := next(beside, None):
                return found
            raise

    def open_file(text: Any, name: str | None = None) -> Any:
        opened = [os.path.realpath(it) for it in xacro.filestack if it]
        if name and opened.count(os.path.realpath(name)) > MOST_OPEN:
            raise InvalidModelError(f"{name!r} includes itself")
        return parse(text, name)

    packages.get_path, xacro.parse = find, open_file
    packages.update_package_cache(folders)
    if file is not None:
        packages.walk_up_from(file)
    xacro.init_stacks(file)
    try:
        return str(XacroDoc.from_string(text, args, resolve_packages=False).dom.toxml())
    except Exception as error:
        raise _fault(error) from None


def _fault(error: Any) -> Exception:
    """What is wrong, by the first cause of an error."""
    import xacro
    from xacro.substitution_args import ArgException
    from xacrodoc.packages import PackageNotFoundError

    words = str(error)
    files = [it for it in xacro.filestack if it]
    cause = error
    while getattr(cause, "exc", None):
        cause = cause.exc
    if isinstance(cause, RecursionError | MemoryError):
        return cause
    name = cause.args[0] if cause.args else ""
    if isinstance(cause, PackageNotFoundError):
        words = f"the package {name!r} is not found: pass packages={{{name!r}: folder}}"
    elif isinstance(cause, ArgException):
        words = f"the argument {name!r} has no value: pass args={{{name!r}: value}}"
    elif isinstance(cause, OSError):
        names = listed(xacro.substitution_args_context["arg"]) or "none"
        words = f"{cause.filename!r}: {cause.strerror} (arguments of the file: {names})"
    elif found := re.search(r"when evaluating expression '(.*?)'(?=\s|$)", words, re.DOTALL):
        words = f"${{{found[1]}}}: {cause}"
        for file in (*files, *xacro.all_includes):
            before, at, _ = Path(file).read_text("utf-8", "replace").partition(f"${{{found[1]}}}")
            if at:
                return InvalidModelError(f"{file}, line {before.count(chr(10)) + 1}: {words}")
    words += "".join(
        f" (macro {it.body.getAttribute('name')!r})" for it in getattr(error, "macros", [])[:1]
    )
    return InvalidModelError(f"{files[-1]}: {words}" if len(files) > 1 else words)
