"""plan, evaluate, drive, diagnose, benchmark and compare: the program's commands over dicts, tables and files."""

import math
import os
import shutil
import tempfile
from contextlib import contextmanager, suppress
from pathlib import Path

from . import _arguments, _physics, _program, _tables
from ._errors import InputError
from ._maps import TerrainMap, absolute, shown_files
from ._own_follower import OwnFollower
from ._results import (Benchmark, Candidate, Comparison, Diagnosis, Drive, DriveDiagnosis,
                       Evaluation, Plan, Result)

_MAP_FILES = ("elevation", "soil_class", "soils", "rocks")
_FILE_NAME_BYTES_MAX = 100
_WORDS = ("planner", "shard", "follower")
_SENSOR_GRADES = ("A", "B")
_REALS = {"time_s": "--time", "speed_mps": "--speed", "deviation_max_m": "--deviation-max-m"}


def plan(scenario, *, model=None, planner=None, seed=None, time_s=None, iterations=None,
         candidates=None, improve=None, threads=None, out=None, force=False, progress=None):
    """Finds, verifies and ranks paths: ``regoplan plan``.

    Parameters
    ----------
    scenario : dict or file name
        Keys as in docs/scenario.md; file names in a dict are relative to the working folder;
        ``vehicle`` may be a ``Vehicle``, ``map`` a ``TerrainMap``.
    model : dict, file name or Wheel, optional
        A model file, as ``--model``: its variant and mechanisms count everywhere, its soil numbers
        in place of those of the map's soil ``soil_name``; without mechanisms that name is needed.
    planner, seed, time_s, iterations, candidates, improve, threads : optional
        In place of the scenario's. Only ``iterations`` gives the same bits again.
    out : folder, optional
        Where the files stay; else they go with the result. What is given in memory stands there in
        ``plan-inputs`` (of other commands by their names), so that the program may take the folder
        up: ``regoplan export out --nav2 DIR``, ``regoplan plan --again out/plan.json``.
    force : bool, optional
        Files that others wrote in ``out`` are replaced.
    progress : callable, optional
        Told ``(stage, share, text)`` now and then; what it raises ends the plan.

    Returns
    -------
    Plan

    Raises
    ------
    InputError
        Naming file or ``scenario``, key, value and range.
    KeyboardInterrupt
        After Ctrl-C; ``out`` then holds what there was, marked interrupted.
    """
    if time_s is not None and iterations is not None:
        raise InputError("iterations: either time_s or iterations, not both")
    call = _Call(out, force, progress)
    arguments = ["plan", call.scenario("scenario", scenario)]
    arguments += call.model(model)
    arguments += call.options(planner=planner, seed=seed, time_s=time_s, iterations=iterations,
                              candidates=candidates, threads=threads)
    if improve is not None:
        arguments.append("--improve" if _arguments.truth("improve", improve) else "--no-improve")
    return call.run(arguments, Plan)


def evaluate(scenario, paths=(), *, manoeuvres=None, model=None, speed_mps=None,
             deviation_max_m=None, follower=None, draws=None, seed=None, threads=None, out=None,
             force=False, progress=None):
    """Judges given paths and manoeuvres, side by side: ``regoplan evaluate``.

    Parameters
    ----------
    scenario : dict or file name
        As of ``plan``.
    paths : sequence or dict by name
        Each a table (DataFrame or dict of columns ``x_m, y_m``, optional ``speed_mps``), a
        ``Candidate`` of ``plan``, or a file name.
    manoeuvres : list of dict or file name, optional
        Steady turns, lane changes, slaloms, ... (docs/evaluation.md).
    follower : ``compensated`` (default) or ``pursuit``, optional
        What drives the paths in closed loop.
    speed_mps, deviation_max_m, draws, seed, threads : optional
        As the program's options.
    model, out, force, progress : optional
        As of ``plan``.

    Returns
    -------
    Evaluation
    """
    call = _Call(out, force, progress)
    arguments = ["evaluate", call.scenario("scenario", scenario)]
    named = paths if _is_by_name(paths) else {
        f"path-{i + 1}": path for i, path in enumerate(_listed("paths", paths))}
    if not named and manoeuvres is None:
        raise InputError("paths: is needed, where manoeuvres= is not given")
    arguments += [call.table(name, path) for name, path in named.items()]
    arguments += call.model(model)
    if manoeuvres is not None:
        arguments += ["--manoeuvres", call.settings("manoeuvres", manoeuvres)]
    arguments += call.options(speed_mps=speed_mps, deviation_max_m=deviation_max_m,
                              follower=follower, draws=draws, seed=seed, threads=threads)
    return call.run(arguments, Evaluation)


def drive(scenario, path, *, follower=None, truth=None, sensors=None, model=None,
          deviation_max_m=None, seed=None, out=None, force=False, progress=None):
    """Follows a path in closed loop and records it as a rover would: ``regoplan drive``.

    Parameters
    ----------
    scenario : dict or file name
        As of ``plan``: the world as it is planned in.
    path : DataFrame, dict of columns, Candidate or file name
        As one of ``evaluate``.
    follower : ``compensated`` (default), ``pursuit`` or callable, optional
        A function of your own is asked before every step: ``follower(view)`` gives
        ``(speed_mps, curvature_1pm)``, with ``crab_rad`` behind them where the vehicle crabs, or
        a dict of these.
        ``view`` has ``time_s, x_m, y_m, yaw_rad, forward_mps, offset_m, path_speed_mps, ...``
        (docs/drive.md). What it raises ends the drive.
    truth : dict or file name, optional
        How the world driven in differs (docs/drive.md); the files that it names are absolute.
    sensors : ``A``, ``B``, dict or file name, optional
        Without: exact, and seen by the follower.
    deviation_max_m, seed : optional
        As the program's options.
    model, out, force, progress : optional
        As of ``plan``.

    Returns
    -------
    Drive
    """
    call = _Call(out, force, progress)
    arguments = ["drive", call.scenario("scenario", scenario), call.table("path", path)]
    if truth is not None:
        arguments += ["--truth", call.settings("truth", truth)]
    if sensors is not None:
        graded = isinstance(sensors, str) and sensors in _SENSOR_GRADES
        arguments += ["--sensors", sensors if graded else call.settings("sensors", sensors)]
    arguments += call.model(model)
    arguments += call.options(deviation_max_m=deviation_max_m, seed=seed)
    if not callable(follower):
        return call.run(arguments + call.options(follower=follower), Drive)
    with OwnFollower(follower) as own:
        descriptors = ",".join(map(str, own.descriptors))
        try:
            return call.run([*arguments, f"--follower-fds={descriptors}"], Drive, own.descriptors)
        except InputError:
            if own.error is not None:
                raise own.error from None
            raise


def diagnose(recording, setup, *, reference=(), seed=None, threads=None, out=None, force=False,
             progress=None):
    """Where a single wheel's recording and the model differ, and what physics was left out:
    ``regoplan diagnose``.

    Parameters
    ----------
    recording : DataFrame, dict of columns or file name
        ``run_id, load_n, slip_ratio, slip_angle_deg`` and at least one of ``fx_n, fy_n, torque_nm,
        sinkage_m, rut_left_m, rut_right_m``; more in docs/diagnosis.md. NaN: not measured.
    setup : dict or file name
        ``model, wheel, gravity_mps2, soil`` with priors ``{mean, std}``, optional ``noise``.
    reference : sequence of such recordings, optional
        Of the same rig and soil without the effect: only the difference is diagnosed.
    seed, threads, out, force, progress : optional
        As of ``plan``.

    Returns
    -------
    Diagnosis
    """
    call = _Call(out, force, progress)
    arguments = ["diagnose", call.table("recording", recording),
                 "--setup", call.settings("setup", setup)]
    references = _listed("reference", reference)
    if references:
        arguments += ["--reference", *(call.table(f"reference-{i + 1}", each)
                                       for i, each in enumerate(references))]
    arguments += call.options(seed=seed, threads=threads)
    return call.run(arguments, Diagnosis)


def diagnose_drives(drives, scenario, *, setup=None, columns=None, seed=None, threads=None,
                    out=None, force=False, progress=None):
    """The same for logs of whole drives on the map of a scenario (docs/drive-diagnosis.md).

    Parameters
    ----------
    drives : DataFrame, dict of columns, file name, or a sequence of them
    scenario : dict or file name
    setup, columns : dict or file name, optional
    seed, threads, out, force, progress : optional
        As of ``plan``.

    Returns
    -------
    DriveDiagnosis
    """
    call = _Call(out, force, progress)
    logs = _listed("drives", drives)
    if not logs:
        raise InputError("drives: is empty")
    arguments = ["diagnose", *(call.table(f"drive-{i + 1}", log) for i, log in enumerate(logs)),
                 "--scenario", call.scenario("scenario", scenario)]
    for option, value in (("--setup", setup), ("--columns", columns)):
        if value is not None:
            arguments += [option, call.settings(option[2:], value)]
    return call.run(arguments + call.options(seed=seed, threads=threads), DriveDiagnosis)


def benchmark(suite, *, shard=None, processes=None, out=None, force=False, progress=None):
    """Runs planners on scenarios over seeds: ``regoplan benchmark``.

    Parameters
    ----------
    suite : dict or file name
        ``name, scenarios, planners, seeds, time_s, ...`` (docs/benchmark.md); ``scenarios`` may be
        a dict of scenarios by name.
    shard : str, optional
        ``I/N``.
    processes : int, optional
        Runs at once.
    out, force, progress : optional
        As of ``plan``. Called again with the same ``out`` after an end, it goes on where it was.

    Returns
    -------
    Benchmark
    """
    call = _Call(out, force, progress)
    if isinstance(suite, dict):
        suite = {**suite, "scenarios": call.suite_scenarios(suite.get("scenarios"))}
    arguments = ["benchmark", call.settings("suite", suite)]
    return call.run(arguments + call.options(shard=shard, processes=processes), Benchmark)


def compare(a, b, *, out=None, force=False):
    """What differs between two results of one command: ``regoplan compare``.

    Parameters
    ----------
    a, b : Plan, Evaluation, Benchmark, or folder name
        What the command gave, or wrote.
    out, force : optional
        As of ``plan``.

    Returns
    -------
    Comparison
    """
    call = _Call(out, force, None)
    return call.run(["compare", call.result("a", a), call.result("b", b)], Comparison)


def _is_one(value):
    """A path or recording, and not several."""
    return isinstance(value, (str, bytes, os.PathLike, Candidate)) or _tables.is_table(value)


def _is_by_name(paths):
    return isinstance(paths, dict) and (not paths or any(map(_is_one, paths.values())))


def _listed(name, value):
    if _is_one(value):
        return [value]
    try:
        return list(value)
    except TypeError:
        raise InputError(f"{name}: {type(value).__name__} is not valid "
                         "(allowed: a table, a file name, or a sequence of them)") from None


def _option_text(name, value):
    """Ranges are the program's to check: here a number is only brought to it unharmed."""
    if name in _WORDS:
        return _arguments.word(name, value)
    if name in _REALS:
        return repr(_arguments.finite(name, value))
    return str(_arguments.integer(name, value, -math.inf, math.inf))


class _Call:
    """One run of the program: what is given in memory stands in files beside the results."""

    def __init__(self, out, force, progress):
        if progress is not None and not callable(progress):
            raise InputError(f"progress: {type(progress).__name__} is not valid "
                             "(allowed: a callable)")
        self._out = out if out is None else absolute(out, "out")
        self._force, self._progress = _arguments.truth("force", force), progress
        self._inputs = _program.ResultFolder(None)
        self._shown = []

    def _new(self, name, suffix):
        """The name of a file or folder that is not there yet, and that names no other place."""
        file = f"{_arguments.word('name', name)}{suffix}"
        if not name or "/" in name or len(os.fsencode(file)) > _FILE_NAME_BYTES_MAX:
            raise InputError(f"name: {name!r} is not valid (allowed: text without /, up to "
                             f"{_FILE_NAME_BYTES_MAX - len(suffix)} bytes)")
        if (self._inputs.path / file).exists():
            raise InputError(f"name: {name!r} is not valid (allowed: one that nothing else has)")
        return file

    def _file(self, name, suffix, text):
        file = self._new(name, suffix)
        (self._inputs.path / file).write_text(text, encoding="utf-8")
        self._shown.append((file, name))
        return file

    def options(self, **values):
        """The program's options for what is not None; its errors then name the arguments."""
        found = []
        for name, value in values.items():
            if value is not None:
                option = _REALS.get(name, f"--{name}")
                self._shown.append((option, name))
                found.append(f"{option}={_option_text(name, value)}")
        return found

    def settings(self, name, value):
        """A settings file: the one that is named, or one made of a dict."""
        if isinstance(value, (dict, list, tuple)) or hasattr(value, "to_dict"):
            return self._file(name, ".yaml", _arguments.settings(name, value))
        return absolute(value, name)

    def scenario(self, name, value):
        if not isinstance(value, dict):
            return self.settings(name, value)
        value = dict(value)
        vehicle = value.get("vehicle")
        if isinstance(vehicle, str) and vehicle not in _physics.preset_vehicle_names():
            value["vehicle"] = absolute(vehicle)
        terrain = value.get("map")
        if isinstance(terrain, TerrainMap):
            # Relative names: the same map is the same scenario, whatever folder it stands in.
            folder = self._new(name, "-map")
            files = terrain.write(self._inputs.path / folder)
            self._shown += shown_files(folder)
            value["map"] = {key: os.path.relpath(item, self._inputs.path.resolve())
                            if isinstance(item, str) and key in _MAP_FILES else item
                            for key, item in files.items()}
        elif isinstance(terrain, dict):
            value["map"] = {key: absolute(item) if key in _MAP_FILES and not isinstance(item, dict)
                            and item is not None else item for key, item in terrain.items()}
        return self.settings(name, value)

    def suite_scenarios(self, scenarios):
        if isinstance(scenarios, dict):
            return [{"name": name, "file": self.scenario(str(name), each)}
                    for name, each in scenarios.items()]
        if not isinstance(scenarios, (list, tuple)):
            raise InputError(f"suite.scenarios: {type(scenarios).__name__} is not valid "
                             "(allowed: a list of files, or a dict)")
        return [{**each, "file": absolute(each["file"])} if isinstance(each, dict) and "file" in each
                else absolute(each) if not isinstance(each, dict) else each for each in scenarios]

    def model(self, value):
        return [] if value is None else ["--model", self.settings("model", value)]

    def table(self, name, value):
        """A CSV file: the one that is named, or one made of columns or a candidate's."""
        if isinstance(value, Candidate):
            return self._file(name, ".csv", value.csv)
        if _tables.is_table(value):
            return self._file(name, ".csv", _tables.csv_text(name, value))
        if not isinstance(value, (str, bytes, os.PathLike)):
            raise InputError(f"{name}: {type(value).__name__} is not valid (allowed: named columns, "
                             "a candidate of a plan, a file name)")
        return absolute(value, name)

    def result(self, name, value):
        """The folder of a result."""
        return str(value.folder) if isinstance(value, Result) else absolute(value, name)

    def run(self, arguments, result, pass_fds=()):
        folder = _program.ResultFolder(self._out)
        with self._inputs_in(folder.path / f"{arguments[0]}-inputs") as inputs:
            shown = [*self._shown, (inputs, "given")]
            arguments = [*arguments, "--out", str(folder.path)] + (["--force"] if self._force else [])
            _, notices = _program.run(arguments, self._progress, shown, inputs, pass_fds)
        return result(folder, notices)

    @contextmanager
    def _inputs_in(self, folder):
        """What is given in memory in a folder of its own, which results name as theirs. Where it is
        refused, all is as it was: earlier results keep their inputs."""
        if not any(self._inputs.path.iterdir()):
            yield self._inputs.path
            return
        missing = [made for made in folder.parents if not made.exists()]
        with tempfile.TemporaryDirectory(prefix="regoplan-") as aside:
            earlier = Path(aside, "earlier")
            try:
                self._put_inputs(folder, earlier)
                yield folder
            except (InputError, _program.ProgramError):
                shutil.rmtree(folder, ignore_errors=True)
                if earlier.exists():
                    shutil.move(earlier, folder)
                for made in missing:
                    with suppress(OSError):  # what others have put there stays
                        made.rmdir()
                raise

    def _put_inputs(self, folder, earlier):
        try:
            if folder.exists():
                shutil.move(folder, earlier)
            shutil.copytree(self._inputs.path, folder)
        except OSError as bad:
            raise InputError(f"out: {folder}: {bad.strerror or bad}") from None
