"""Settings objects: immutable, with the keys of regoplan's files as attributes."""

from . import _arguments


class Immutable:
    """What was checked as a whole does not change in parts."""

    __slots__ = ()

    def __setattr__(self, key, value):
        raise AttributeError(f"{type(self).__name__} cannot be changed")

    def __delattr__(self, key):
        raise AttributeError(f"{type(self).__name__} cannot be changed")

    def _set(self, **attributes):
        for name, value in attributes.items():
            object.__setattr__(self, name, value)


class Settings(Immutable):
    """Numbers and words under the names that they have in files. Immutable."""

    __slots__ = ("_values",)

    def __init__(self, values):
        self._set(_values=values)

    def to_dict(self):
        """A new dict with the keys of the file."""
        return _copied(self._values)

    def replace(self, **changes):
        """The same with other values: ``soil.replace(cohesion_pa=300)``."""
        return type(self)(**{**self.to_dict(), **changes})

    def __getattr__(self, key):
        try:
            return _copied(object.__getattribute__(self, "_values")[key])
        except (KeyError, AttributeError):
            raise AttributeError(f"{type(self).__name__} has no {key}") from None

    def __setattr__(self, key, value):
        raise AttributeError(f"{type(self).__name__} cannot be changed; use replace({key}=...)")

    def __dir__(self):
        return [*super().__dir__(), *self._values]

    def __eq__(self, other):
        return type(self) is type(other) and self._values == other._values

    def __hash__(self):
        return hash(_arguments.settings("settings", self._values))

    def __reduce__(self):
        return (_restored, (type(self), self.to_dict()))

    def __repr__(self):
        inside = ", ".join(f"{key}={value!r}" for key, value in self._values.items())
        return f"{type(self).__name__}({inside})"


def _restored(kind, values):
    return kind(**values)


def _copied(value):
    if isinstance(value, dict):
        return {key: _copied(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_copied(item) for item in value]
    return value
