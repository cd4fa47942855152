"""The program of benches/instructions.rs, built."""

from __future__ import annotations

import json
import subprocess


def executable() -> str:
    """Build it and give its path."""
    build = [
        "cargo",
        "bench",
        "--quiet",
        "--bench",
        "instructions",
        "--no-run",
        "--message-format=json",
    ]
    messages = subprocess.run(
        build, stdout=subprocess.PIPE, check=True, text=True
    ).stdout.splitlines()
    targets = [message for message in map(json.loads, messages) if message.get("executable")]
    return next(
        target["executable"] for target in targets if target["target"]["name"] == "instructions"
    )


def toolchain() -> str:
    """Compiler and target."""
    lines = subprocess.run(
        ["rustc", "-vV"], stdout=subprocess.PIPE, check=True, text=True
    ).stdout.splitlines()
    fields = dict(line.split(": ", 1) for line in lines if ": " in line)
    return f"rustc {fields['release']}, LLVM {fields['LLVM version']}, {fields['host']}"
