"""pandas, where it is there."""

from ._errors import InputError


def dataframe(columns):
    try:
        import pandas
    except ImportError:
        raise InputError("to_dataframe: pandas is not installed (Debian: python3-pandas)") from None
    return pandas.DataFrame(columns)
