"""The scatter of many values of a quantity, in words."""

import numpy

from ..quantities.formatting import amount


def scatter_in_words(name: str, values: numpy.ndarray) -> str:
    """Return the phrase with the median, quartiles, mean and standard deviation of at least two values of a quantity.

    >>> scatter_in_words("pull_off_force", numpy.array([1e-9, 2e-9, 3e-9]))
    'median 2 nN, quartiles 1.5 nN and 2.5 nN; mean 2 nN, scatter 1 nN'
    """
    low, median, high = numpy.quantile(values, [0.25, 0.5, 0.75]).tolist()
    middle = f"median {amount(name, median)}, quartiles {amount(name, low)} and {amount(name, high)}"
    mean, scatter = float(values.mean()), float(values.std(ddof=1))
    return f"{middle}; mean {amount(name, mean)}, scatter {amount(name, scatter)}"
