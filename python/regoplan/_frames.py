"""Results over arrays as columns by name; pandas, where it is there."""

import numpy as np

from ._errors import InputError


class Columns:
    """Arrays of one shape, each an attribute of its name: the slots, in their order."""

    __slots__ = ()

    def __init__(self, arrays):
        for name, array in zip(self.__slots__, arrays):
            setattr(self, name, array[()])

    def to_dict(self):
        """Columns by name."""
        return {name: getattr(self, name) for name in self.__slots__}

    def to_dataframe(self):
        """A pandas DataFrame, one row for each row of the raveled arrays."""
        return dataframe({name: np.ravel(column) for name, column in self.to_dict().items()})


def dataframe(columns):
    try:
        import pandas
    except ImportError:
        raise InputError("to_dataframe: pandas is not installed (Debian: python3-pandas)") from None
    return pandas.DataFrame(columns)
