"""Broken files, for the tests of readers."""

import os
import random

INPUTS = int(os.environ.get("IRBKIN_INPUTS", "5000"))
"""How many broken texts a test reads."""


def dice(seed):
    """Random numbers, the same in each run; `IRBKIN_SEED` draws others."""
    return random.Random(f"{seed} {os.environ.get('IRBKIN_SEED', 0)}")


def enough(counts):
    """Whether enough was drawn to show something; of another `IRBKIN_SEED` nothing is asked."""
    return counts or "IRBKIN_SEED" in os.environ


def mangled(random_, content):
    """A file with lines and bytes lost, doubled, exchanged and replaced."""
    lines = content.split(b"\n")
    for _ in range(random_.randrange(1, 6)):
        place = random_.randrange(len(lines))
        change = random_.randrange(6)
        line = lines[place]
        if change == 0:
            del lines[place]
        elif change == 1:
            lines.insert(place, lines[random_.randrange(len(lines))])
        elif change == 2:
            cut = random_.randrange(len(line) + 1)
            lines[place] = line[:cut]
        elif change == 3 and line:
            at = random_.randrange(len(line))
            lines[place] = line[:at] + random_.randbytes(random_.randrange(1, 4)) + line[at:]
        elif change == 4:
            tokens = [b"-", b'"', b"\\", b"9E999", b"-1e400", b"nan", b"#", b">>", b"<<<<<<< x"]
            lines[place] = line + b" " + random_.choice(tokens)
        else:
            lines[place] = b" ".join(random_.sample(line.split(b" "), k=len(line.split(b" "))))
        lines = lines or [b""]
    return b"\n".join(lines)
