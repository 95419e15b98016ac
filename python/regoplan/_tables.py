"""Tables as the program reads and writes them: CSV whose numbers come back to the last bit."""

import csv
import io

import numpy as np

from . import _arguments
from ._errors import InputError


def columns_of(name, table):
    """A DataFrame or dict of one-dimensional columns as a dict of arrays."""
    keys = list(getattr(table, "columns", None) if hasattr(table, "columns") else table)
    columns = {}
    for key in keys:
        if not isinstance(key, str):
            raise InputError(f"{name}: {key!r} is not valid as a column's name (allowed: text)")
        column = np.asarray(table[key])
        if column.ndim != 1:
            raise InputError(f"{name}: {key}: shape {column.shape} is not valid (allowed: one axis)")
        columns[key] = column
    if not columns:
        raise InputError(f"{name}: no column")
    lengths = {key: len(column) for key, column in columns.items()}
    if len(set(lengths.values())) > 1:
        raise InputError(f"{name}: columns differ in length ({lengths})")
    return columns


def is_table(value):
    return isinstance(value, dict) or hasattr(value, "columns")


def csv_text(name, table):
    """A table as CSV; None and NaN are empty cells."""
    columns = columns_of(name, table)
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    cells = [_cells(name, key, column) for key, column in columns.items()]
    writer.writerows(zip(*cells))
    return stream.getvalue()


def _cells(name, key, column):
    if column.dtype.kind == "M":
        return ["" if np.isnat(day) else str(day) for day in column.astype("M8[D]")]
    if column.dtype.kind in "OUS":
        return [_cell(name, key, item) for item in column.tolist()]
    return ["" if value != value else repr(value) for value in
            _arguments.numbers(f"{name}: {key}", column).tolist()]


def _cell(name, key, item):
    if item is None or item != item:
        return ""
    if isinstance(item, bool):
        raise InputError(f"{name}: {key}: {item} is not valid (allowed: numbers, text)")
    if isinstance(item, (int, float)):
        return repr(item)
    text = item.decode("utf-8", "replace") if isinstance(item, bytes) else str(item)
    if "\n" in text or "\r" in text or "\0" in text:
        raise InputError(f"{name}: {key}: text of one line is allowed only")
    return text


def read_csv(text):
    """Columns by name: numbers as float64, NaN where a cell is empty; words as str."""
    rows = list(csv.reader(io.StringIO(text)))
    columns = {}
    for i, key in enumerate(rows[0]):
        cells = [row[i] for row in rows[1:]]
        try:
            columns[key] = np.array([float(cell) if cell else np.nan for cell in cells])
        except ValueError:
            columns[key] = np.array(cells, dtype=str)
    return columns
