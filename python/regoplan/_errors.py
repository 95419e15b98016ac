"""What the package raises where its input is wrong."""

import re

_FROM_DICT = re.compile(r"<(\w+)>:\d+: ")
_NOT_VALID = re.compile(
    r"^(?:.*: )?(?P<field>[\w.-]+(?:\[[\d, ]+\][\w.]*)*): (?P<value>.*?) is not valid"
    r" \(allowed: (?P<allowed>.*)\)",
    re.S,
)
# Dicts have no lines: where a misspelt key stands, its name says.
_LINE_OF_KEY = re.compile(r" on line \d+(?=: did you mean | is in another unit)")
_PLACE = re.compile(r"^(?P<file>[^\n]*?):(?P<line>\d+): ")
# What is said of a key or an argument that has no value to tell.
_NAMED = re.compile(
    r"(?:^|: )(?:column )?(?P<field>[\w.-]+(?:\[[\d, ]+\][\w.]*)*)"
    r"(?: is missing|: (?:unknown key|shape does not broadcast|masked values|is needed|is no |stands twice))"
)
# Names that a message begins with, one after the other: "scenario: start: ...". An argument has no
# dot, which tells it from a file.
_LED_BY = re.compile(r"(?P<argument>[A-Za-z_][\w-]*(?:\[[\d, ]+\])?)(?:, row \d+)?: ")
_THEN = re.compile(r"(?P<key>[A-Za-z_][\w.]*(?:\[[\d, ]+\][\w.]*)*): ")


def _first_named(message):
    """The innermost of the names that a message begins with; None where it begins with none."""
    found = _LED_BY.match(message)
    name = found and found["argument"]
    while found:
        found = _THEN.match(message, found.end())
        name = found["key"] if found else name
    return name


def of_dict(message):
    """What is said of settings that came from a dict, without the lines of their file."""
    return _LINE_OF_KEY.sub("", message)


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
    file, line : str and int, or None
        Where it stands, of input in files.
    """

    def __init__(self, message):
        message, dicts = _FROM_DICT.subn(r"\1: ", str(message))
        message = of_dict(message) if dicts else message
        super().__init__(message)
        found = _NOT_VALID.search(message)
        named = found or _NAMED.search(message)
        self.field = named["field"] if named else _first_named(str(self))
        self.value = found["value"] if found else None
        self.allowed = found["allowed"] if found else None
        place = _PLACE.match(message)
        self.file = place["file"] if place else None
        self.line = int(place["line"]) if place else None
