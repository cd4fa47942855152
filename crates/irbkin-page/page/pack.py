"""Pack target/page/irbkin.wasm into the package, and write the page: target/page/irbkin.html."""

from pathlib import Path

from irbkin.scene._page import ENGINE, page
from zopfli.gzip import compress

MADE = Path(__file__).parents[3] / "target" / "page"


def main() -> None:
    """Write both files and print their sizes."""
    ENGINE.write_bytes(compress((MADE / "irbkin.wasm").read_bytes(), numiterations=5))
    text = page()
    (MADE / "irbkin.html").write_text(text, encoding="utf-8")
    packed, whole = ENGINE.stat().st_size / 1e3, len(text.encode()) / 1e3
    print(f"{ENGINE.name}: {packed:.0f} kB; target/page/irbkin.html: {whole:.0f} kB")


if __name__ == "__main__":
    main()
