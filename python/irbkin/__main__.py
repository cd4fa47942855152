"""`python -m irbkin`: the command `irbkin`."""

import sys

from irbkin.cli import main

if __name__ == "__main__":
    sys.exit(main())
