"""Runs the program for what it does in whole processes: plan, evaluate, diagnose, benchmark, map.

The searches of a plan and the runs of a benchmark are child processes, which `plan()` of the library
may only start while its process has one thread; a Python process with numpy has several. So the
program is run beside Python: its numbers are the program's by construction, a crash of it is an
exception, Python's lock is free, and its folder of results is what the command line would write.
"""

import os
import re
import select
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from ._errors import InputError, of_dict

_PROGRESS = re.compile(r"^(?P<stage>[^\d%]*?) ?(?P<share>\d+) %(?P<more>.*)$")
_PIECES = re.compile(r"[\r\n]+")
_HELP = re.compile(r" \(regoplan [\w -]*--help\)$")
_OPTION = re.compile(r"(?<!\S)--(?P<name>[a-z][a-z-]*)(?: [A-Z]+\.\w+)?")
_ESCAPES = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")
_PATIENCE_S = 60  # for whole files, after a first Ctrl-C


class ProgramError(RuntimeError):
    """The program ended as it never should: killed, crashed, without an answer."""


def program_file():
    """The program: ``$REGOPLAN_PROGRAM``, that of the build or wheel of this package, or the path's."""
    named = os.environ.get("REGOPLAN_PROGRAM")
    package = Path(__file__).resolve().parent
    for candidate in (named, package / "bin" / "regoplan", package.parents[1] / "regoplan",
                      shutil.which("regoplan")):
        if candidate and Path(candidate).is_file() and os.access(candidate, os.X_OK):
            return str(candidate)
    raise InputError("the program regoplan is not found (set REGOPLAN_PROGRAM to it)")


def run(arguments, progress=None, shown=(), folder=None, pass_fds=()):
    """Runs the program to its end.

    Parameters
    ----------
    arguments : list of str
    progress : callable, optional
        Told ``(stage, share, text)``, share in [0, 1]; what it raises ends the program.
    shown : pairs of str
        File names that stand in messages, and what to call them.
    folder : folder name, optional
        What relative file names are relative to.
    pass_fds : file descriptors
        That stay open in the program.

    Returns
    -------
    int, list of str
        Exit status 0, 2 and the notices.

    Raises
    ------
    InputError
        What the program says of its input.
    KeyboardInterrupt
        After Ctrl-C, when the program has written what it had.
    """
    master, terminal = os.openpty()  # progress is for terminals
    try:
        child = subprocess.Popen([program_file(), *arguments], stdin=subprocess.DEVNULL,
                                 stdout=subprocess.DEVNULL, stderr=terminal,
                                 start_new_session=True, cwd=folder, pass_fds=pass_fds)
    except BaseException:
        os.close(master)
        raise
    finally:
        os.close(terminal)
    listener = _Listener(master, progress)
    try:
        while listener.listen():
            pass
        child.wait()
    except BaseException:
        _end(child, listener)
        raise
    finally:
        os.close(master)
    lines = [_renamed(line, shown) for line in listener.lines]
    if child.returncode in (0, 2):
        return child.returncode, [line.removeprefix("regoplan: ") for line in lines]
    if child.returncode == 1:
        raise InputError(_message(lines))
    raise ProgramError(f"regoplan {arguments[0]} ended with status {child.returncode}: "
                       f"{' '.join(lines[-3:])}")


class _Listener:
    """Splits what stands on the program's terminal into progress and lines."""

    def __init__(self, master, progress):
        self.lines = []
        self._master, self._progress = master, progress
        self._rest = ""

    def ignore_progress(self):
        self._progress = None

    def listen(self, timeout_s=0.2):
        """Reads a little; false at the end."""
        ready, _, _ = select.select([self._master], [], [], timeout_s)
        if not ready:
            return True
        try:
            piece = os.read(self._master, 65536)
        except OSError:  # the program has closed the terminal
            piece = b""
        *whole, self._rest = _PIECES.split(self._rest + piece.decode("utf-8", "replace"))
        for text in whole if piece else [*whole, self._rest]:
            self._take(_ESCAPES.sub("", text).strip())
        if piece and self._progress is not None:
            self._tell(_ESCAPES.sub("", self._rest).strip())
        return bool(piece)

    def _take(self, text):
        if text and not self._tell(text):
            self.lines.append(text)

    def _tell(self, text):
        found = _PROGRESS.match(text)
        if not found or text.startswith("regoplan:"):
            return False
        if self._progress is not None:
            self._progress(found["stage"], min(int(found["share"]) / 100, 1.0), text)
        return True


def _end(child, listener):
    """Asks the program to stop with whole files; kills it where it does not, or on a second Ctrl-C."""
    listener.ignore_progress()
    until = time.monotonic() + _PATIENCE_S
    try:
        child.send_signal(signal.SIGINT)
        while child.poll() is None and time.monotonic() < until:
            listener.listen(0.1)  # who writes to a full terminal waits
    finally:
        if child.poll() is None:
            child.kill()
        child.wait()


def _renamed(line, shown):
    """What came from Python has no file: lines of a table are its rows, counted from 0."""
    for file, name in shown:
        is_table = str(file).endswith(".csv")

        def called(found, name=name, is_table=is_table):
            number = int(found["line"] or 0)
            return f"{name}, row {number - 2}" if is_table and number > 1 else name

        line, count = re.subn(re.escape(str(file)) + r"(?::(?P<line>\d+))?", called, line)
        if count:
            # An array has no empty cells: tables hold its NaN and None so.
            line = line.replace(": an empty cell is not valid", ": NaN is not valid") if is_table \
                else of_dict(line)
    return line


def _message(lines):
    """What went wrong, with the argument in place of the option that it became."""
    said = [line for line in lines if line.startswith("regoplan: ")]
    what = (said[-1] if said else " ".join(lines) or "no message").removeprefix("regoplan: ")
    if "--force replaces it" in what:
        what = f"out: {what}"
    what = re.sub(r"^--([a-z-]+)(?=: )", lambda option: option[1].replace("-", "_"), what)
    return _OPTION.sub(_in_python, _HELP.sub("", what))


def _in_python(option):
    """An option that a message advises, as the argument or function that stands for it."""
    name = option["name"].replace("-", "_")
    return {"force": "force=True", "scenario": "diagnose_drives"}.get(name, f"{name}=")


class ResultFolder:
    """Where a command writes: a folder that is given and stays, or one that goes with the result."""

    def __init__(self, out):
        self._own = None
        if out is None:
            self._own = tempfile.TemporaryDirectory(prefix="regoplan-")
            out = self._own.name
        self.path = Path(out)

    def text(self, name):
        return (self.path / name).read_text(encoding="utf-8")


def output(arguments, shown=()):
    """Standard output of a short command; errors as of ``run``."""
    ran = subprocess.run([program_file(), *arguments], stdin=subprocess.DEVNULL,
                         capture_output=True, check=False)
    if ran.returncode not in (0, 2):
        raise InputError(_message([_renamed(line, shown)
                                   for line in ran.stderr.decode("utf-8", "replace").splitlines()]))
    return ran.stdout.decode("utf-8")
