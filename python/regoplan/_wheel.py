"""One wheel on one soil: forces over arrays."""

import json
from types import MappingProxyType

import numpy as np

from . import _arguments, _physics
from ._errors import InputError
from ._frames import Columns
from ._settings import Immutable
from ._soil import Soil

#: Status codes of ``WheelForces.status`` by their names in files.
STATUS = MappingProxyType({name: code for code, name in enumerate(_physics.status_names())})

_METHODS = _physics.method_names()
_VARIANTS = _physics.variant_names()
_CONDITIONS = _physics.condition_names()


class WheelForces(Columns):
    """Soil reaction on a wheel, arrays of the arguments' common shape (numbers for scalars).

    The force on the wheel is (fx_n, -fy_n) in its frame, x along the heading, y left: ``fy_n`` keeps
    the paper's sign, positive for a positive slip angle and opposing the lateral motion. Where no
    sinkage carries the load, forces are NaN and ``status`` says why.

    Attributes
    ----------
    fx_n, fy_n : float64
        Drawbar pull and side force, N.
    torque_nm : float64
        Driving torque at the axle, N m.
    sinkage_m : float64
        h, m.
    status : uint8
        A code of ``regoplan.STATUS``.
    rut_left_m, rut_right_m, roll_moment_nm : float64 or None
        Of ``channels`` only: depths at the wheel's edges, m, and the moment about its heading, N m.
    """

    __slots__ = ("fx_n", "fy_n", "torque_nm", "sinkage_m", "status", "rut_left_m", "rut_right_m",
                 "roll_moment_nm")

    def __init__(self, arrays):
        self.rut_left_m = self.rut_right_m = self.roll_moment_nm = None  # of `channels` only
        super().__init__(arrays)

    @property
    def ok(self):
        """Where the forces may be trusted: status ``ok``."""
        return self.status == STATUS["ok"]

    def to_dict(self):
        """Columns by name, those that there are; the status as words."""
        found = super().to_dict()
        found["status"] = np.array(list(STATUS))[self.status]
        return {name: column for name, column in found.items() if column is not None}

    def __repr__(self):
        return f"WheelForces(shape {np.shape(self.fx_n)}, {int(np.sum(self.ok))} ok)"


class Wheel(Immutable):
    """A rigid wheel on a soil, by the model of Yoshida & Ishigami (2004). Immutable.

    Parameters
    ----------
    radius_m, width_m : float
        m, above 0.
    soil : Soil or dict
    gravity_mps2 : float, optional
        m/s^2, above 0 to 100; Earth's.
    model : {"ishigami2007", "yoshida2004"}, optional
        ishigami2007 solves the sinkage for the load at every slip; yoshida2004 is the paper's own,
        h = h0 + c0 s.
    mechanisms : list of dict, optional
        ``{"id", "form", "parameters"}`` of what the base model leaves out; ``regoplan.mechanisms()``
        lists them.
    method : {"direct", "fast", "table"}, optional
        ``direct`` is the program's ``wheel``, bit for bit; ``fast`` integrates to 1.5e-4 of the
        load; ``table`` looks up splines and is cached on disk. It is held to 1e-3 of the larger of
        the load and a tenth of the nominal load in 99.9 % of states and to 5e-3 in all (measured:
        4e-4 and 1.6e-3, docs/validation.md).
    nominal_load_n : float, optional
        N; of a table, which covers 2 to 300 % of it; beyond, the direct model answers.
    soil_name : str, optional
        The soil of a map that this soil's numbers replace where the wheel is the ``model`` of
        ``plan``, ``evaluate`` or ``drive``.

    Raises
    ------
    InputError
        Naming the key, its value and its range.
    """

    def __init__(self, radius_m, width_m, soil, *, gravity_mps2=9.80665, model="ishigami2007",
                 mechanisms=(), method="direct", nominal_load_n=None, soil_name=None):
        named = {} if soil_name is None else {"soil_name": _arguments.word("soil_name", soil_name)}
        self._set_up({"model": _arguments.choice("model", model, _VARIANTS),
                      "wheel": {"radius_m": _arguments.scalar("radius_m", radius_m),
                                "width_m": _arguments.scalar("width_m", width_m)},
                      "gravity_mps2": _arguments.scalar("gravity_mps2", gravity_mps2),
                      "soil": _model_soil(soil), **named,
                      "mechanisms": list(mechanisms)}, method, nominal_load_n)

    @classmethod
    def from_file(cls, file, *, method="direct", nominal_load_n=None):
        """The wheel of a model file, such as the ``corrected-model.yaml`` of a diagnosis."""
        wheel = cls.__new__(cls)
        text = _physics.model_file_settings(_arguments.path("file", file))
        wheel._set_up(json.loads(text), method, nominal_load_n)
        return wheel

    @classmethod
    def of_paper(cls):
        """The wheel of the paper's Figs. 6 and 7: variant yoshida2004, Table I in consistent units."""
        wheel = cls.__new__(cls)
        wheel._set_up(json.loads(_physics.paper_wheel_settings()), "direct", None)
        return wheel

    def _set_up(self, settings, method, nominal_load_n):
        _arguments.choice("method", method, _METHODS)
        if (method == "table") != (nominal_load_n is not None):
            raise InputError("nominal_load_n: is needed for method='table', and for no other")
        nominal = 0.0 if nominal_load_n is None else _arguments.scalar("nominal_load_n",
                                                                       nominal_load_n)
        text = _arguments.settings("wheel", settings)
        self._set(_settings=settings, _method=method, _nominal_load_n=nominal_load_n,
                  _source=_physics.WheelSource(text, method, nominal))

    def to_dict(self):
        """The keys of a model file."""
        return json.loads(_arguments.settings("wheel", self._settings))

    def __reduce__(self):
        return (_restored, (self.to_dict(), self._method, self._nominal_load_n))

    def __repr__(self):
        wheel = self._settings["wheel"]
        return (f"Wheel(radius_m={wheel['radius_m']}, width_m={wheel['width_m']}, "
                f"model={self._settings['model']!r}, method={self._method!r})")

    def forces(self, load_n, slip_ratio, slip_angle_rad, *, threads=1):
        """Forces under a load at a slip, for all rows of arrays that broadcast with each other.

        Arrays are read where they are, whatever their strides and byte order; nothing but the
        results is allocated. Python's lock is released, Ctrl-C is heeded.

        Parameters
        ----------
        load_n : array_like
            Vertical load, N, 0 (lifted) or above.
        slip_ratio : array_like
            Eq. (1) of the paper, in [-1, 1]; trusted from -0.9 to 0.95.
        slip_angle_rad : array_like
            atan2(Vy, |Vx|), in [-pi/2, pi/2]; positive when the wheel moves to its left; trusted up
            to 60 deg.
        threads : int, optional
            Changes no result.

        Returns
        -------
        WheelForces

        Raises
        ------
        InputError
            Naming the argument, the place in it, the value and the range.
        """
        return WheelForces(self._source.forces(*_conditions(load_n, slip_ratio, slip_angle_rad),
                                               _arguments.threads(threads)))

    def plane_forces(self, load_n, slip_ratio, slip_angle_rad, *, threads=1):
        """``fx_n, fy_n`` only, of a table: many rows at once, several times as fast as ``forces``.

        Wheels without forces have 0 here. Arguments and errors as ``forces``.
        """
        if self._method != "table":
            raise InputError("plane_forces: method is not valid (allowed: a wheel of method='table')")
        fx_n, fy_n = self._source.plane_forces(*_conditions(load_n, slip_ratio, slip_angle_rad),
                                               _arguments.threads(threads))
        return fx_n[()], fy_n[()]

    def channels(self, load_n, slip_ratio, slip_angle_rad, *, threads=1, **conditions):
        """All that a single wheel shows, by the direct model, with what mechanisms need to know.

        Parameters
        ----------
        load_n, slip_ratio, slip_angle_rad : array_like
            As ``forces``.
        speed_mps, position_m, time_s, heading_rad, wheel_angle_rad, sinkage_offset_m : array_like
            Keywords; travel speed (0: that of the motion), place along the bed, time, heading from
            that of the bed, wheel angle, measured sinkage over the model's.
        pass_number : array_like
            How often a wheel has come by, this time included; 1.

        Returns
        -------
        WheelForces
            With ``rut_left_m``, ``rut_right_m`` (m) and ``roll_moment_nm`` (N m) as well.
        """
        unknown = sorted(set(conditions) - set(_CONDITIONS))
        if unknown:
            raise InputError(f"{unknown[0]}: is no condition (allowed: {', '.join(_CONDITIONS)})")
        given = [_arguments.numbers(name, conditions.get(name, 1 if name == "pass_number" else 0))
                 for name in _CONDITIONS]
        return WheelForces(self._source.channels(
            [*_conditions(load_n, slip_ratio, slip_angle_rad), *given],
            _arguments.threads(threads)))

    def table_facts(self):
        """Of a table: its measured error against the direct model, its loads, its size."""
        if self._method != "table":
            raise InputError("table_facts: method is not valid (allowed: a wheel of method='table')")
        return self._source.table_facts()


def cornering_and_drag(fx_n, fy_n, slip_angle_rad):
    """Cornering and drag force of a wheel, eqs. (18) and (19): FC = Fx sin b + Fy cos b,
    FB = Fx cos b - Fy sin b. Newtons; arrays that broadcast.

    Returns
    -------
    fc_n, fb_n : float64
    """
    fc_n, fb_n = _physics.cornering_and_drag(_arguments.numbers("fx_n", fx_n),
                                             _arguments.numbers("fy_n", fy_n),
                                             _arguments.numbers("slip_angle_rad", slip_angle_rad))
    return fc_n[()], fb_n[()]


def mechanisms():
    """All mechanisms that the base model leaves out, each with form, formula, source, parameters."""
    return _physics.mechanisms()


def _conditions(load_n, slip_ratio, slip_angle_rad):
    return (_arguments.numbers("load_n", load_n), _arguments.numbers("slip_ratio", slip_ratio),
            _arguments.numbers("slip_angle_rad", slip_angle_rad))


def _model_soil(soil):
    """The keys of a model file's ``soil``: where the numbers come from is not among them."""
    if isinstance(soil, Soil):
        return soil.model_keys()
    if isinstance(soil, dict):
        return {key: value for key, value in soil.items() if key != "source"}
    return soil


def _restored(settings, method, nominal_load_n):
    wheel = Wheel.__new__(Wheel)
    wheel._set_up(settings, method, nominal_load_n)
    return wheel
