"""What the package raises where its input is wrong."""

import re

_FROM_DICT = re.compile(r"<(\w+)>:\d+: ")
_NOT_VALID = re.compile(
    r"^(?:.*: )?(?P<field>[\w.-]+(?:\[[\d, ]+\][\w.]*)*): (?P<value>.*?) is not valid"
    r" \(allowed: (?P<allowed>.*)\)",
    re.S,
)


class InputError(ValueError):
    """Bad input. The message is one line: argument or file, field, value and allowed range.

    Attributes
    ----------
    field : str or None
        The argument or key, with the place in an array: ``slip_ratio[3, 5]``, ``wheel.radius_m``.
    value : str or None
        What stood there.
    allowed : str or None
        The valid range in words: ``-1 to 1``, ``above 0``.
    """

    def __init__(self, message):
        message = _FROM_DICT.sub(r"\1: ", str(message))
        super().__init__(message)
        found = _NOT_VALID.search(message)
        self.field = found["field"] if found else None
        self.value = found["value"] if found else None
        self.allowed = found["allowed"] if found else None
