"""Terrain from arrays or files, as scenarios take it."""

import json
import os
import tempfile
from pathlib import Path

import numpy as np

from . import _arguments, _program
from ._errors import InputError
from ._soil import Soil

_NO_CLASS = -(2**31)
_UNKNOWN_M = -3.4e38
_HEIGHT_MAX_M = 1e6  # what the program takes of heights in rasters
_ARGUMENTS = {"elevation.bil": "elevation_m", "soil_class.bil": "soil_class", "rocks.csv": "rocks"}


class TerrainMap:
    """Heights, soils and rocks of a map, from arrays; a value of ``map`` in a scenario.

    Map frame: x east, y north, z up, metres. Row 0 of an array is the northernmost.

    Parameters
    ----------
    elevation_m : array_like, (rows, columns)
        Heights of the cells' centres, m, kept as float32; NaN where unknown.
    cell_m : float
        Side of a cell, m, above 0.
    soils : Soil, or dict of str to Soil or dict
        One soil for all, or the soils by name. Numbers that are given as ``{mean, std}`` vary in
        the draws of ``plan`` and ``evaluate``; a dict needs a ``source``
        (docs/vehicle-and-soil.md).
    west_m, south_m : float, optional
        Of the raster's edges; 0.
    soil_class : array_like of int, (rows, columns), optional
        Class codes; needs ``classes``.
    classes : dict of int to str, optional
        Which soil each code stands for.
    unmapped : str, optional
        Soil of cells of other codes; ``forbidden``.
    rocks : array_like, (n, 4), optional
        x_m, y_m, radius_m, height_m of each.

    Raises
    ------
    InputError
    """

    def __init__(self, elevation_m, cell_m, soils, *, west_m=0.0, south_m=0.0, soil_class=None,
                 classes=None, unmapped=None, rocks=None):
        self._elevation_m = _raster("elevation_m", elevation_m).astype("<f4")
        _arguments.require_all("elevation_m", self._elevation_m,
                               ~(np.abs(self._elevation_m) > _HEIGHT_MAX_M),
                               f"-{_HEIGHT_MAX_M:.0f} to {_HEIGHT_MAX_M:.0f}, NaN: unknown")
        if np.isnan(self._elevation_m).all():
            raise InputError("elevation_m: NaN everywhere is not valid "
                             "(allowed: a known height in one cell at least)")
        self._elevation_m.flags.writeable = False
        cell = _arguments.scalar("cell_m", cell_m)
        if not 0 < cell < np.inf:
            raise InputError(f"cell_m: {cell} is not valid (allowed: above 0)")
        self.cell_m = cell
        self.west_m = _arguments.finite("west_m", west_m)
        self.south_m = _arguments.finite("south_m", south_m)
        self._classes = self._checked_classes(soil_class, classes)
        self._rocks = None if rocks is None else _rocks(rocks)
        self._catalogue = _catalogue(soils, classes, unmapped)

    @property
    def elevation_m(self):
        """Heights, m, float32, read-only."""
        return self._elevation_m

    def _checked_classes(self, soil_class, classes):
        if soil_class is None:
            return None
        codes = _raster("soil_class", soil_class)
        if codes.shape != self._elevation_m.shape:
            raise InputError(f"soil_class: shape {codes.shape} is not valid "
                             f"(allowed: that of elevation_m, {self._elevation_m.shape})")
        allowed = "integers of 32 bits"
        _arguments.require_all("soil_class", codes, (codes > _NO_CLASS) & (codes < 2**31), allowed)
        if codes.dtype.kind == "f":
            raise InputError(f"soil_class: dtype {codes.dtype} is not valid (allowed: {allowed})")
        if not classes:
            raise InputError("classes: is needed with soil_class (code: name of a soil)")
        return codes.astype("<i4")

    def write(self, folder):
        """Writes the map's files.

        Returns
        -------
        dict
            The ``map`` of a scenario in any folder.
        """
        folder = Path(_arguments.path("folder", folder)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        found = {"elevation": self._write_raster(folder, "elevation", self._elevation_m),
                 "soils": self._catalogue}
        if self._classes is not None:
            found["soil_class"] = self._write_raster(folder, "soil_class", self._classes)
        if self._rocks is not None:
            lines = [",".join(map(repr, row)) for row in self._rocks.tolist()]
            (folder / "rocks.csv").write_text(
                "x_m,y_m,radius_m,height_m\n" + "".join(line + "\n" for line in lines))
            found["rocks"] = str(folder / "rocks.csv")
        return found

    def _write_raster(self, folder, name, values):
        """Raw numbers with a header of text, which GDAL reads as EHdr."""
        rows, columns = values.shape
        real = values.dtype.kind == "f"
        nodata = _UNKNOWN_M if real else _NO_CLASS
        north_m = self.south_m + rows * self.cell_m
        header = {"NROWS": rows, "NCOLS": columns, "NBANDS": 1, "NBITS": 32,
                  "PIXELTYPE": "FLOAT" if real else "SIGNEDINT", "BYTEORDER": "I", "LAYOUT": "BIL",
                  "ULXMAP": repr(self.west_m + self.cell_m / 2),
                  "ULYMAP": repr(north_m - self.cell_m / 2),
                  "XDIM": repr(self.cell_m), "YDIM": repr(self.cell_m), "NODATA": repr(nodata)}
        (folder / f"{name}.hdr").write_text(
            "".join(f"{key} {value}\n" for key, value in header.items()))
        # GDAL takes cells of 1 m with their upper left corner at (0, 1) for a header that says nothing
        # of places, and looks for them here.
        (folder / f"{name}.blw").write_text("".join(f"{number!r}\n" for number in (
            self.cell_m, 0.0, 0.0, -self.cell_m, self.west_m + self.cell_m / 2,
            north_m - self.cell_m / 2)))
        written = np.where(np.isnan(values), np.float32(nodata), values) if real else values
        written.astype(values.dtype).tofile(folder / f"{name}.bil")
        return str(folder / f"{name}.bil")

    def info(self):
        """What ``regoplan map info`` says of the map: extent, heights, slopes, soils, rocks."""
        with tempfile.TemporaryDirectory(prefix="regoplan-") as folder:
            scenario = Path(folder, "scenario.yaml")
            scenario.write_text(_arguments.settings("map", {"map": self.write(folder)}))
            told = json.loads(_program.output(["map", "info", str(scenario), "--json"],
                                              [*shown_files(folder), (scenario, "map"),
                                               (folder, "map")]))
            return next(iter(told.values()))

    def __repr__(self):
        rows, columns = self._elevation_m.shape
        return f"TerrainMap({rows} x {columns} cells of {self.cell_m} m)"


def shown_files(folder):
    """What to call the files of a map in messages: the arguments that they were made of."""
    return [(os.path.join(folder, file), name) for file, name in _ARGUMENTS.items()]


def _raster(name, value):
    array = _arguments.numbers(name, value)
    if array.ndim != 2 or array.size == 0:
        raise InputError(f"{name}: shape {array.shape} is not valid (allowed: rows x columns)")
    return array


def _rocks(value):
    rocks = _arguments.numbers("rocks", value).astype(float)
    if rocks.ndim != 2 or rocks.shape[1] != 4:
        raise InputError(f"rocks: shape {rocks.shape} is not valid "
                         "(allowed: n x 4 finite numbers x_m, y_m, radius_m, height_m)")
    _arguments.require_all("rocks", rocks, np.isfinite(rocks), "finite numbers")
    return rocks


def _catalogue(soils, classes, unmapped):
    if isinstance(soils, Soil):
        soils = {"soil": soils}
        unmapped = unmapped or "soil"
    if not isinstance(soils, dict) or not soils:
        told = "an empty dict" if isinstance(soils, dict) else type(soils).__name__
        raise InputError(f"soils: {told} is not valid (allowed: a Soil, or a dict of them by name)")
    entries = {}
    for name, soil in soils.items():
        if not isinstance(name, str):
            raise InputError(f"soils: {name!r} is not valid as a name (allowed: text)")
        entry = soil.to_dict() if hasattr(soil, "to_dict") else soil
        entries[name] = {"source": "given in Python", **entry} if isinstance(soil, Soil) else entry
    if unmapped is None and not classes and len(entries) == 1:
        unmapped = next(iter(entries))
    found = {"soils": entries}
    if classes:
        found["classes"] = {str(code): name for code, name in classes.items()}
    if unmapped:
        found["unmapped"] = unmapped
    return found


def absolute(value, name="file"):
    """A file name as it is relative to the folder of the process; variables as they are."""
    text = _arguments.path(name, value)
    return text if text.startswith("${") else os.path.abspath(text)
