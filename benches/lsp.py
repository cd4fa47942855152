"""Time from a keystroke to its findings in `irbkin lsp`, beside one check of the same module.

A client of its own over pipes types a digit of a target's coordinate, waits for the findings of
that text, and types the next. The least and the median of the times; `rapid.parse` and
`rapid.check` of the same text are what a keystroke cannot be faster than. `MOVES` in the
environment sets the moves of the module, 2,000; `KEYS` the keystrokes, 40; `OTHERS` the modules
beside it, of 100 moves each, in a second table, 300 (0 leaves it out).
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import irbkin
import rapid_check
from irbkin import rapid

MOVES = int(os.environ.get("MOVES", "2000"))
KEYS = int(os.environ.get("KEYS", "40"))
OTHERS = int(os.environ.get("OTHERS", "300"))
ROBOT = rapid_check.ROBOT


class Client:
    """A client that sends what it is given and waits for findings."""

    def __init__(self, folder: Path) -> None:
        command = [sys.executable, "-m", "irbkin", "lsp", "--robot", ROBOT]
        pipe = subprocess.PIPE
        self.server = subprocess.Popen(command, stdin=pipe, stdout=pipe, cwd=folder)
        self.send("initialize", {"processId": None, "rootUri": None, "capabilities": {}}, 1)
        self.wait(lambda it: it.get("id") == 1)
        self.send("initialized", {})

    def send(self, method: str, params: object, number: int | None = None) -> None:
        """Send a message."""
        message = {"jsonrpc": "2.0", "method": method, "params": params}
        content = json.dumps(message if number is None else {**message, "id": number}).encode()
        assert self.server.stdin
        self.server.stdin.write(b"Content-Length: %d\r\n\r\n" % len(content) + content)
        self.server.stdin.flush()

    def wait(self, is_wanted) -> tuple[dict, float]:
        """Wait for a message, and give the time at which it came."""
        assert self.server.stdout
        while True:
            length = 0
            while (line := self.server.stdout.readline().strip()) != b"":
                if line.lower().startswith(b"content-length:"):
                    length = int(line.split(b":")[1])
            content, came = self.server.stdout.read(length), time.perf_counter()
            message = json.loads(content)
            assert message.get("method") != "window/logMessage", message
            if is_wanted(message):
                return message, came

    def findings(self, version: int) -> float:
        """Wait for the findings of a version, and give the time at which they came."""
        return self.wait(lambda it: it.get("params", {}).get("version") == version)[1]

    def stop(self) -> None:
        """End the server."""
        self.send("shutdown", None, 2)
        self.wait(lambda it: it.get("id") == 2)
        self.send("exit", None)
        assert self.server.wait() == 0


def keystrokes(folder: Path, file: Path) -> list[float]:
    """The times from a keystroke to its findings [s]; the file is opened before."""
    client, uri, text = Client(folder), file.as_uri(), file.read_text()
    document = {"uri": uri, "languageId": "rapid", "version": 0, "text": text}
    client.send("textDocument/didOpen", {"textDocument": document})
    client.findings(0)
    row = next(at for at, line in enumerate(text.splitlines()) if f" p{MOVES // 2}:" in line)
    column = text.splitlines()[row].index(".00,") + 1
    area = {
        "start": {"line": row, "character": column},
        "end": {"line": row, "character": column + 1},
    }
    times = []
    for key in range(1, KEYS + 1):
        change = {"range": area, "text": str(key % 10)}
        document = {"uri": uri, "version": key}
        begin = time.perf_counter()
        client.send(
            "textDocument/didChange", {"textDocument": document, "contentChanges": [change]}
        )
        times.append(client.findings(key) - begin)
    client.stop()
    return times


def others(folder: Path) -> None:
    """Modules beside the one that is typed in, with names of their own."""
    for number in range(OTHERS):
        text = rapid_check.program(100, 20.0).replace(" p", f" q{number}_")
        text = text.replace("tGun", f"tGun{number}").replace("main", f"rOther{number}")
        (folder / f"other{number}.mod").write_text(text.replace("Many", f"Other{number}"))


def main() -> None:
    """Print a table, alone and with other modules."""
    robot, text = irbkin.Robot(ROBOT), rapid_check.program(MOVES, 20.0)
    module = rapid.parse(text)
    parts = rapid_check.least(
        {
            "rapid.parse": lambda: rapid.parse(text),
            "rapid.check": lambda: rapid.check(robot, module),
        }
    )
    print(f"{MOVES} moves, {len(text) / 1e3:.0f} kB, {KEYS} keystrokes [ms]")
    for name, seconds in parts.items():
        print(f"  {name:40} {1e3 * seconds:7.1f}")
    floor = sum(parts.values())
    for count in dict.fromkeys((0, OTHERS)):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (file := folder / "many.mod").write_text(text)
            if count:
                others(folder)
            times = keystrokes(folder, file)
        words = f"keystroke to findings, {count} other modules"
        least, median = min(times), statistics.median(times)
        print(f"  {words:40} {1e3 * least:7.1f} median {1e3 * median:7.1f}, {least / floor:.2f} x")


if __name__ == "__main__":
    main()
