"""Vehicles, and what steady manoeuvres demand of them and the soil supplies."""

import json

import numpy as np

from . import _arguments, _physics
from ._errors import InputError
from ._frames import Columns
from ._settings import Immutable, Settings
from ._soil import Soil

_MOMENT = _physics.moment_names()


class Vehicle(Settings):
    """A wheeled vehicle with the keys of a vehicle file (docs/vehicle-and-soil.md), angles in degrees.
    Immutable; ``vehicle.replace(mass_kg=900)`` gives another.

    Raises
    ------
    InputError
        Naming the key, its value and its range.
    """

    __slots__ = ("_source",)

    def __init__(self, **keys):
        self._take(_physics.vehicle_from(_arguments.settings("vehicle", keys)))

    @classmethod
    def preset(cls, name):
        """A vehicle that comes with regoplan: one of ``Vehicle.presets()``."""
        return cls._of(_physics.preset_vehicle(_arguments.choice("name", name, cls.presets())))

    @classmethod
    def presets(cls):
        """Names of the vehicles that come with regoplan."""
        return _physics.preset_vehicle_names()

    @classmethod
    def from_file(cls, file):
        """The vehicle of a vehicle file."""
        return cls._of(_physics.vehicle_from_file(_arguments.path("file", file)))

    @classmethod
    def _of(cls, source):
        vehicle = cls.__new__(cls)
        vehicle._take(source)
        return vehicle

    def _take(self, source):
        super().__init__(json.loads(source.settings()))
        self._set(_source=source)

    def __repr__(self):
        return f"Vehicle({self.name!r}, {self.mass_kg} kg, {len(self.wheels)} wheels)"


class Margins(Columns):
    """Demand, supply and margins of steady manoeuvres; arrays of the arguments' common shape.

    Attributes
    ----------
    demand_n : float64
        Lateral force that the wheels must give, N, left positive: m (v^2 k - g_left).
    supply_min_n, supply_max_n : float64
        The interval [A-, A+] of lateral forces that steady trims can give, N; NaN without a trim.
    cornering, tip_over, traction : float64
        Margins as shares of the weight. Where the demand lies beyond the supply, no trim holds it
        and traction is the cornering margin, as in ``side-slope.csv`` of ``evaluate --chart``.
        Without any supply cornering and traction are NaN: nothing tells by how much they fail.
    margin : float64
        The stability margin: the smallest of the three; NaN without supply.
    """

    __slots__ = ("demand_n", "supply_min_n", "supply_max_n", "cornering", "tip_over", "traction",
                 "margin")

    def __repr__(self):
        return f"Margins(shape {np.shape(self.margin)})"


class SafeCurvature(Columns):
    """The largest safe curvatures; arrays of the arguments' common shape.

    Attributes
    ----------
    curvature_1pm : float64
        1/m; 0 where not even straight on is safe.
    supply_n : float64
        The lateral supply in that turn, the smaller side, N.
    limit : str
        What forbids more: cornering, tip_over, traction, sinkage, slope or steering.
    """

    __slots__ = ("curvature_1pm", "supply_n", "limit")

    def __init__(self, columns):
        curvature_1pm, supply_n, limit = columns
        words = np.array(limit, dtype=str if limit else "U1")
        super().__init__((curvature_1pm, supply_n, words.reshape(curvature_1pm.shape)))

    def __repr__(self):
        if np.ndim(self.limit) == 0:
            return (f"SafeCurvature({self.curvature_1pm:.4g} 1/m, supply {self.supply_n:.4g} N, "
                    f"limited by {self.limit})")
        if np.size(self.limit) == 0:
            return f"SafeCurvature(shape {np.shape(self.limit)})"
        limits = ", ".join(np.unique(self.limit))
        return (f"SafeCurvature(shape {np.shape(self.limit)}, {np.min(self.curvature_1pm):.4g} to "
                f"{np.max(self.curvature_1pm):.4g} 1/m, limited by {limits})")


class VehicleOnSoil(Immutable):
    """A vehicle that drives on planes of one soil, judged as plans and charts judge. Immutable.

    Parameters
    ----------
    vehicle : Vehicle, dict or str
        A str names a preset.
    soil : Soil or dict
    gravity_mps2 : float
        m/s^2, above 0 to 100.
    model, mechanisms, method, nominal_load_n : optional
        As of ``Wheel``. The program's verdicts use ``direct``, its charts ``fast``.

    Notes
    -----
    Functions of a moment take ``speed_mps`` (0 or above, also beyond the vehicle's own largest),
    ``curvature_1pm`` (commanded, left positive, within the vehicle's ``curvature_max_1pm``; without
    it straight on), and the keywords ``acceleration_mps2``, ``slope_forward_rad``
    (the ground rises ahead) and ``slope_left_rad`` (and to the left). At rest it sets off, backwards
    where ``acceleration_mps2`` is below 0: the end of a stop is that of a small speed.
    """

    def __init__(self, vehicle, soil, gravity_mps2, *, model="ishigami2007", mechanisms=(),
                 method="direct", nominal_load_n=None):
        from ._wheel import Wheel

        if isinstance(vehicle, str):
            vehicle = Vehicle.preset(_arguments.choice("vehicle", vehicle, Vehicle.presets()))
        elif not isinstance(vehicle, Vehicle):
            if not isinstance(vehicle, dict):
                raise InputError(f"vehicle: {type(vehicle).__name__} is not valid "
                                 "(allowed: Vehicle, dict, name of a preset)")
            vehicle = Vehicle(**vehicle)
        wheel = Wheel(**vehicle.wheel, soil=soil, gravity_mps2=gravity_mps2, model=model,
                      mechanisms=mechanisms, method=method, nominal_load_n=nominal_load_n)
        self._set_up(vehicle, soil if isinstance(soil, Soil) else Soil(**soil), wheel,
                     _arguments.scalar("gravity_mps2", gravity_mps2))

    def _set_up(self, vehicle, soil, wheel, gravity_mps2):
        self._set(vehicle=vehicle, soil=soil, wheel=wheel, gravity_mps2=gravity_mps2,
                  _source=_physics.VehicleOnSoil(vehicle._source, wheel._source, gravity_mps2))

    def __reduce__(self):
        return (_restored, (self.vehicle, self.soil, self.wheel, self.gravity_mps2))

    def __repr__(self):
        return f"VehicleOnSoil({self.vehicle!r}, {self.gravity_mps2} m/s^2)"

    def margins(self, speed_mps, curvature_1pm=0.0, *, threads=1, **ground):
        """Demand, supply and margins of moments; arrays that broadcast.

        Returns
        -------
        Margins
        """
        return Margins(self._source.margins(_moment(speed_mps, curvature_1pm, ground),
                                            _arguments.threads(threads)))

    def largest_safe_curvature(self, speed_mps, slope_left_rad=0.0, *, margin_min=_physics.MARGIN_MIN,
                               threads=1):
        """The largest path curvature that is safe to both sides, as are all smaller ones: what the
        chart of ``evaluate`` draws, with the limits that the vehicle brings.

        Parameters
        ----------
        speed_mps : array_like
            m/s, 0 or above; also beyond the vehicle's own largest.
        slope_left_rad : array_like, optional
            Of the ground across the path, rad, 0 or above.
        margin_min : float, optional
            The stability margin that must be kept, 0 to below 1 (share of the weight); 0.05.

        Returns
        -------
        SafeCurvature
            Found to within 1 % from below.
        """
        return SafeCurvature(self._source.largest_safe_curvature(
            _arguments.numbers("speed_mps", speed_mps),
            _arguments.numbers("slope_left_rad", slope_left_rad),
            _arguments.scalar("margin_min", margin_min), _arguments.threads(threads)))

    def supply(self, speed_mps, curvature_1pm=0.0, **ground):
        """Both ends of the supply of one moment, with what ends it and at which wheel.

        Returns
        -------
        dict
            ``right`` and ``left``, each ``{force_n, limit, wheel, fold_n, understeer_1pm}`` or None;
            ``reason`` (sinkage, traction or yaw) where there is no supply.
        """
        return self._source.supply(_single(_moment(speed_mps, curvature_1pm, ground)))

    def trim(self, speed_mps, curvature_1pm=0.0, **ground):
        """The steady balance of one moment: body slip angle, steering, every wheel's load, slip, slip
        angle and forces.

        Returns
        -------
        dict
            ``found``; where it is, ``forward_n, left_n, body_slip_angle_rad, steer_curvature_1pm,
            drive_factor, wheels``; else ``limit`` and ``wheel``: what ends the branch of trims before.
        """
        return self._source.trim(_single(_moment(speed_mps, curvature_1pm, ground)))


def _restored(*parts):
    on_soil = VehicleOnSoil.__new__(VehicleOnSoil)
    on_soil._set_up(*parts)
    return on_soil


def _moment(speed_mps, curvature_1pm, ground):
    unknown = sorted(set(ground) - set(_MOMENT[2:]))
    if unknown:
        raise InputError(f"{unknown[0]}: is no keyword (allowed: {', '.join(_MOMENT[2:])})")
    given = {"speed_mps": speed_mps, "curvature_1pm": curvature_1pm, **ground}
    return [_arguments.numbers(name, given.get(name, 0.0)) for name in _MOMENT]


def _single(arrays):
    for name, array in zip(_MOMENT, arrays):
        if array.size != 1:
            raise InputError(f"{name}: shape {array.shape} is not valid (allowed: a single number)")
    return arrays
