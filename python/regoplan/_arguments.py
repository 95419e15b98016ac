"""Arguments from Python, checked and named before C++ sees them."""

import json
import operator
import os

import numpy as np

from . import _physics
from ._errors import InputError

_READ_IN_PLACE = frozenset("f4 f8 i1 i2 i4 i8 u1 u2 u4 u8".split())


def numbers(name, value):
    """The value as an array of real numbers; arrays are not copied, unless of a type that is rare."""
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        raise InputError(f"{name}: masked values are not valid (allowed: numbers)")
    try:
        array = np.asarray(value)
    except (ValueError, TypeError) as bad:
        raise InputError(f"{name}: {bad}") from None
    if array.dtype.kind == "O" and getattr(getattr(value, "dtype", None), "kind", "O") in "iuf":
        array = value.to_numpy(dtype=np.float64, na_value=np.nan)  # pandas' nullable numbers
    if array.dtype.kind not in "iuf":
        raise InputError(
            f"{name}: dtype {array.dtype} is not valid (allowed: real numbers: float or integer)"
        )
    if array.dtype.str[1:] not in _READ_IN_PLACE:
        array = array.astype(np.float64)  # half, long double
    return array


def require_all(name, array, valid, allowed):
    """Refuses the first number of an array that is not valid, and says where it stands."""
    bad = np.argwhere(~valid)
    if len(bad):
        place = ", ".join(map(str, bad[0]))
        raise InputError(f"{name}[{place}]: {array[tuple(bad[0])]} is not valid (allowed: {allowed})")


def scalar(name, value):
    """A single real number."""
    array = numbers(name, value)
    if array.size != 1:
        raise InputError(f"{name}: shape {array.shape} is not valid (allowed: a single number)")
    return float(array.reshape(())[()])


def finite(name, value):
    """A single finite number."""
    number = scalar(name, value)
    if not np.isfinite(number):
        raise InputError(f"{name}: {number} is not valid (allowed: any finite number)")
    return number


def integer(name, value, least=-(2**63), most=2**63 - 1):
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        raise InputError(f"{name}: {value!r} is not valid (allowed: an integer)") from None
    if not least <= number <= most:
        raise InputError(f"{name}: {number} is not valid (allowed: {least} to {most})")
    return number


def threads(value):
    return integer("threads", value, 1, _physics.THREADS_MAX)


def choice(name, value, allowed):
    if not isinstance(value, str) or value not in allowed:
        raise InputError(f"{name}: {value!r} is not valid (allowed: {' | '.join(allowed)})")
    return value


def truth(name, value):
    if not isinstance(value, (bool, np.bool_)):
        raise InputError(f"{name}: {value!r} is not valid (allowed: True | False)")
    return bool(value)


def word(name, value):
    """Text of one line, as UTF-8 can hold it."""
    if not isinstance(value, str) or not value.isprintable():
        raise InputError(f"{name}: {value!r} is not valid (allowed: text of one line)")
    return value


def path(name, value):
    """A file name, as str."""
    try:
        text = os.fsdecode(os.fspath(value))
        os.fsencode(text)
    except (TypeError, UnicodeError):
        raise InputError(
            f"{name}: {type(value).__name__} is not valid (allowed: a file name)"
        ) from None
    if "\0" in text:
        raise InputError(f"{name}: a file name with a null byte is not valid")
    return text


def settings(name, value):
    """A dict of settings as JSON: keys as in files, numpy's numbers as Python's."""

    def plain(item):
        if isinstance(item, np.generic):
            return item.item()
        if isinstance(item, np.ndarray):
            return item.tolist()
        if hasattr(item, "to_dict"):
            return item.to_dict()
        if isinstance(item, os.PathLike):
            return os.fspath(item)
        raise InputError(f"{name}: {type(item).__name__} is not valid as a setting")

    try:
        return json.dumps(_given(name, value), allow_nan=False, default=plain)
    except InputError:
        raise
    except RecursionError:
        raise InputError(f"{name}: nested too deeply") from None
    except (TypeError, ValueError) as bad:  # NaN, keys that are no text, references to itself
        raise InputError(f"{name}: {bad}") from None


def _given(place, value):
    """Without the keys whose value is None, which count as not given."""
    if hasattr(value, "to_dict"):
        value = value.to_dict()
    if isinstance(value, dict):
        for key in value:
            if not isinstance(key, (str, int)) or isinstance(key, bool):
                raise InputError(f"{place}: {key!r} is not valid as a key (allowed: text)")
        return {str(key): _given(f"{place}.{key}", item) for key, item in value.items()
                if item is not None}
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [_given(f"{place}[{i}]", item) for i, item in enumerate(value)]
    if isinstance(value, (float, np.floating)) and not np.isfinite(value):
        raise InputError(f"{place}: {value} is not valid (allowed: a finite number)")
    return value
