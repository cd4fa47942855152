"""Figures that show themselves: in a notebook as its last line, in a script by `show`."""

import io

from matplotlib.figure import Figure


class Picture(Figure):
    """A figure of matplotlib, of no window and without pyplot until it is shown."""

    def _repr_svg_(self) -> str:
        """Return the picture as a notebook shows it."""
        file = io.StringIO()
        self.savefig(file, format="svg", transparent=False)
        text = file.getvalue()
        return text[text.index("<svg") :]

    def show(self, warn: bool = True) -> None:
        """Open a window with the figure, and wait until it is closed.

        Args:
            warn: As matplotlib has it; without effect.

        Raises:
            RuntimeError: matplotlib has no screen here: `savefig` writes a file.
        """
        import matplotlib.pyplot as plt

        window = plt.figure().canvas
        if window.required_interactive_framework is None:
            plt.close()
            raise RuntimeError(
                f"matplotlib opens no window here (its backend is {plt.get_backend()}): write a "
                'file with savefig("picture.svg")'
            )
        # pyplot makes windows for its own figures only: this one moves into a new window of theirs.
        window.figure = self
        self.set_canvas(window)
        plt.show()
