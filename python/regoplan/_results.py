"""Results of the program's commands, as objects."""

import html
import json
from functools import cached_property

import numpy as np

from . import _tables
from ._frames import dataframe


class Result:
    """What a command came to.

    Attributes
    ----------
    json : dict
        The command's JSON, keys as documented for the file.
    notices : list of str
        What was taken to be so, or is odd.
    report_html : str
        The report, one self-contained page; read from ``folder`` when it is asked for.
    folder : pathlib.Path
        The files; where no ``out`` was given they go with this object.
    """

    _FILE = ""

    def __init__(self, folder, notices):
        self._folder = folder
        self.notices = notices
        self.json = json.loads(folder.text(self._FILE))

    @property
    def folder(self):
        return self._folder.path

    @property
    def report_html(self):
        return self._folder.text("report.html")

    def __getattr__(self, key):
        values = self.__dict__.get("json", {})
        if key in values:
            return values[key]
        raise AttributeError(f"{type(self).__name__} has no {key} (keys: {', '.join(values)})")

    def __dir__(self):
        return [*super().__dir__(), *self.json]

    def _repr_html_(self):
        """The report's page, map and charts, in a frame of its own."""
        return (f'<iframe srcdoc="{html.escape(self.report_html)}" sandbox="allow-scripts" '
                'style="width:100%;height:48em;border:0"></iframe>')


class Candidate:
    """One path of a plan.

    Attributes
    ----------
    json : dict
        Its entry in ``plan.json``: rank, planner, length_m, margin_min, ...
    columns : dict of str to array
        Its ``candidate-K.csv`` (docs/plan-json.md): time_s, x_m, y_m, ..., margin.
    csv : str
        The same as text.
    """

    def __init__(self, entry, csv):
        self.json, self.csv = entry, csv

    @cached_property
    def columns(self):
        return _tables.read_csv(self.csv)

    def __getattr__(self, key):
        if key in self.__dict__.get("json", {}):
            return self.json[key]
        if key[0] != "_" and "csv" in self.__dict__ and key in self.columns:
            return self.columns[key]
        raise AttributeError(f"Candidate has no {key}")

    def to_dataframe(self):
        """A pandas DataFrame of the path's points."""
        return dataframe(self.columns)

    def __repr__(self):
        return f"Candidate(rank {self.json['rank']}, {self.planner}, {self.length_m:.1f} m)"


class Plan(Result):
    """A plan: ``status``, ``reason``, ``candidates`` in rank order, and all keys of ``plan.json``
    (docs/plan-json.md)."""

    _FILE = "plan.json"

    def __init__(self, folder, notices):
        super().__init__(folder, notices)
        self.candidates = [Candidate(entry, folder.text(entry["file"]))
                           for entry in self.json["candidates"]]

    def to_dataframe(self):
        """A pandas DataFrame, one row a candidate."""
        return dataframe(_rows(self.json["candidates"]))

    def __repr__(self):
        return f"Plan({self.status}, {len(self.candidates)} candidates)"


class Evaluation(Result):
    """Paths and manoeuvres judged side by side; keys of ``evaluation.json``
    (docs/evaluation-json.md)."""

    _FILE = "evaluation.json"

    def to_dataframe(self):
        """A pandas DataFrame, one row a path, in rank order."""
        return dataframe(_rows(self.json["paths"]))

    def __repr__(self):
        feasible = sum(path["feasible"] for path in self.json["paths"])
        return f"Evaluation({feasible} of {len(self.json['paths'])} feasible)"


class Drive(Result):
    """How a path was driven: ``status``, ``reason``, and all keys of ``drive.json``
    (docs/drive.md)."""

    _FILE = "drive.json"

    @property
    def recording(self):
        """Columns of ``drive.csv``, what a rover would have recorded; NaN: not sampled."""
        return _tables.read_csv(self._folder.text("drive.csv"))

    def to_dataframe(self):
        """A pandas DataFrame of ``recording``."""
        return dataframe(self.recording)

    def __repr__(self):
        return f"Drive({self.status}{': ' + self.reason if self.reason else ''})"


class Diagnosis(Result):
    """Where a recording and the model differ, and why; keys of ``diagnosis.json``
    (docs/diagnosis.md)."""

    _FILE = "diagnosis.json"

    def corrected_wheel(self, *, method="direct", nominal_load_n=None):
        """The wheel of ``corrected-model.yaml``: calibrated soil, and what was found missing."""
        from ._wheel import Wheel

        return Wheel.from_file(self.folder / "corrected-model.yaml", method=method,
                               nominal_load_n=nominal_load_n)

    @property
    def residuals(self):
        """Columns of ``residuals.csv``: the recording, its noise, and each model's values."""
        return _tables.read_csv(self._folder.text("residuals.csv"))

    def to_dataframe(self):
        """A pandas DataFrame of ``residuals``."""
        return dataframe(self.residuals)

    def __repr__(self):
        names = [entry["id"] for entry in self.json["mechanisms"]]
        return f"Diagnosis({self.verdict}{': ' + ', '.join(names) if names else ''})"


class Benchmark(Result):
    """Runs of planners on scenarios; keys of ``benchmark.json`` (docs/benchmark.md)."""

    _FILE = "benchmark.json"

    def to_dataframe(self):
        """A pandas DataFrame, one row for each planner of each experiment."""
        rows = [{"experiment": experiment["name"], **planner}
                for experiment in self.json["experiments"] for planner in experiment["planners"]]
        return dataframe(_rows(rows))

    def __repr__(self):
        return f"Benchmark({len(self.json['experiments'])} experiments)"


class Comparison(Result):
    """What differs between two results; keys of ``comparison.json`` (docs/compare.md)."""

    _FILE = "comparison.json"

    def to_dataframe(self):
        """A pandas DataFrame, one row an entry: ``a.margin_min``, ``b.margin_min``,
        ``change.margin_min``, ..."""
        return dataframe(_rows(self.json["entries"]))

    def __repr__(self):
        return f"Comparison({self.headline})"


def _rows(entries):
    """Entries with their one-level mappings spread: ``limiting.x_m``."""
    spread = []
    for entry in entries:
        row = {}
        for key, value in entry.items():
            if isinstance(value, dict):
                row.update({f"{key}.{inner}": item for inner, item in value.items()
                            if not isinstance(item, (dict, list))})
            elif not isinstance(value, list):
                row[key] = np.nan if value is None else value
        spread.append(row)
    return spread


class DriveDiagnosis(Result):
    """What logs of whole drives show (docs/drive-diagnosis.md); keys of its ``diagnosis.json``."""

    _FILE = "diagnosis.json"

    def __repr__(self):
        return f"DriveDiagnosis({self.folder})"
