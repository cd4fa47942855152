"""Weights of residuals: standard deviations, and losses that outliers do not lead astray."""

from typing import Literal, get_args

import numpy as np

from irbkin._arrays import Floats

Loss = Literal["linear", "soft_l1", "huber", "cauchy", "arctan"]
LOSSES = get_args(Loss)
# Median absolute deviation of a normal distribution to its standard deviation.
FROM_MEDIAN = 1.4826
# Part of the scatter from which on a robust loss counts residuals less [1].
OUTLIER = 3.0


def check_weights(position_std: float, rotation_std: float, loss: str) -> None:
    """Refuse a standard deviation that is not positive and finite, and an unknown loss."""
    for name, value in (("position_std", position_std), ("rotation_std", rotation_std)):
        if not 0.0 < value < np.inf:
            raise ValueError(f"{name} is {value}, it must be positive and finite")
    if loss not in LOSSES:
        raise ValueError(f'loss must be one of {", ".join(LOSSES)}, got "{loss}"')


def outlying(residuals: Floats) -> float:
    """Residual from which on one counts less: the scatter without outliers measures it."""
    scatter = FROM_MEDIAN * float(np.median(np.abs(residuals)))
    return max(OUTLIER * scatter, np.finfo(float).eps)
