"""Arms from RobotStudio's files: `Robot.from_robotstudio`. What is read is in
docs/guide/robotstudio.md.
"""

import os

import numpy as np

from irbkin._core import Robot
from irbkin._robotstudio.elements import documents
from irbkin._robotstudio.mechanisms import chosen, mechanisms_of, robot_of_arm
from irbkin.errors import InvalidModelError, IrbkinError


def robot_of(path: str | os.PathLike[str], name: str | None, coupled_limits: bool) -> Robot:
    """Read the arm of a name, or the only one, of a station or a library."""
    where = path = os.fspath(path)
    try:
        # Numbers that overflow are as far from their bounds as NaN.
        with np.errstate(all="ignore"):
            found = chosen(mechanisms_of(documents(path)), name)
            where = f"{path}: {found.names[0]}"
            return robot_of_arm(found.read(), found.names[0], coupled_limits)
    except RecursionError:
        raise InvalidModelError(f"{where}: is nested too deeply") from None
    except IrbkinError as error:
        raise InvalidModelError(f"{where}: {error}") from None
