"""A follower of the caller's own: a function that `drive` asks before every step, over two pipes."""

import json
import os
import threading
from collections.abc import Iterable, Mapping
from types import SimpleNamespace

from . import _arguments
from ._errors import InputError


class OwnFollower:
    """Serves the program while it drives; what the function raises ends the drive.

    Attributes
    ----------
    descriptors : tuple of int
        The program's ends of the pipes: where it writes what is seen, where it reads commands.
    error : BaseException or None
        What the function raised.
    """

    def __init__(self, function):
        self._function = function
        self.error = None

    def __enter__(self):
        seen, seen_out = os.pipe()
        commands_in, commands = os.pipe()
        self.descriptors = (seen_out, commands_in)
        self._thread = threading.Thread(target=self._serve, args=(seen, commands), daemon=True)
        self._thread.start()
        return self

    def __exit__(self, *_):
        for file in self.descriptors:
            os.close(file)
        self._thread.join()

    def _serve(self, seen, commands):
        with os.fdopen(seen, encoding="utf-8") as views, os.fdopen(commands, "w") as answers:
            for line in views:
                try:
                    answer = _command(self._function(SimpleNamespace(**json.loads(line))))
                except BaseException as error:  # noqa: B902 - told where `drive` was called
                    self.error = error
                    return
                try:
                    answers.write(json.dumps(answer) + "\n")
                    answers.flush()
                except BrokenPipeError:  # the program has ended
                    return


_NAMES = ("speed_mps", "curvature_1pm", "crab_rad")


def _command(answer):
    """``(speed_mps, curvature_1pm)``, with ``crab_rad`` or without, or a dict of these, as the
    program reads it."""
    if isinstance(answer, Mapping):
        given = dict(answer)
    else:
        values = tuple(answer) if isinstance(answer, Iterable) else ()
        given = dict(zip(_NAMES, values)) if len(values) <= len(_NAMES) else {}
    if not set(_NAMES[:2]) <= set(given) <= set(_NAMES):
        raise InputError("follower: its answer is not valid (allowed: (speed_mps, curvature_1pm) "
                         "or (speed_mps, curvature_1pm, crab_rad), or a dict of these)")
    return {name: _arguments.finite(f"follower: {name}", value) for name, value in given.items()}
