"""Soils: the numbers of the wheel model of Yoshida & Ishigami (2004)."""

import json
from pathlib import Path

from . import _arguments, _physics
from ._settings import Settings


class Soil(Settings):
    """Soil under a wheel. Keys and units are those of soil files (docs/vehicle-and-soil.md); immutable.

    Each number may be given as ``{"mean": 170, "std": 30}`` where it is not known better. Attributes
    are the means, and wheels and vehicles count with them; in a map of ``plan``, ``evaluate`` and the
    other commands the soil varies as such a soil of a file does (``soil_draws``).

    Parameters
    ----------
    cohesion_pa : float
        c, Pa, 0 or above.
    friction_angle_deg : float
        phi, degrees, 0 to 60.
    kc, kphi : float
        Pressure-sinkage moduli, N/m^(n+1) and N/m^(n+2).
    n : float
        Sinkage exponent, 0.3 to 2.
    a0, a1 : float
        theta_m / theta_f at zero slip and its growth with slip; within (0, 1) for every slip.
    lambda : float
        Rear contact height over sinkage, 0 to 1.5. A keyword of Python: ``Soil(**{"lambda": 0.9})``
        or ``lambda_=0.9``.
    density_kgpm3 : float
        rho, kg/m^3.
    kx0_m, ky0_m : float
        Shear deformation moduli along and across, m.
    kx1_m, ky1_m : float, optional
        Their growth per radian of slip angle, m; 0.
    c0_m : float, optional
        Slip sinkage coefficient, m, eq. (14); required by the variant yoshida2004.
    source : str, optional
        Where the numbers come from.

    Raises
    ------
    InputError
        Naming the key, its value and its range.
    """

    __slots__ = ()

    def __init__(self, **keys):
        if "lambda_" in keys:
            keys["lambda"] = keys.pop("lambda_")
        source = keys.pop("source", None)
        values = json.loads(_physics.checked_soil(_arguments.settings("soil", keys)))
        if source is not None:
            values["source"] = str(source)
        super().__init__(values)

    @classmethod
    def preset(cls, name):
        """A soil that comes with regoplan: one of ``Soil.presets()``."""
        known = cls._presets()
        return cls(**known[_arguments.choice("name", name, list(known))])

    @classmethod
    def presets(cls):
        """Names of the soils that come with regoplan: three of the demo's lunar map (sources there)
        and ``simulant_2004``, the paper's Lunar Regolith Simulant in consistent units; those that
        ``regoplan soil`` prints."""
        return list(cls._presets())

    @classmethod
    def from_file(cls, file):
        """All soils of a soils file (docs/vehicle-and-soil.md) by name.

        Returns
        -------
        dict of str to Soil
        """
        text = _physics.soils_file_settings(_arguments.path("file", file))
        return {name: cls(**keys) for name, keys in json.loads(text).items()}

    @classmethod
    def _presets(cls):
        demo_soils = str(Path(__file__).with_name("soils.yaml"))
        return json.loads(_physics.preset_soil_settings(demo_soils))

    @property
    def lambda_(self):
        """Rear contact height over sinkage; ``lambda`` is a word of Python."""
        return _mean(self._values["lambda"])

    @property
    def standard_deviations(self):
        """By key, of the numbers that are not known exactly."""
        return {key: value["std"] for key, value in self._values.items() if isinstance(value, dict)}

    def __getattr__(self, key):
        return _mean(super().__getattr__(key))

    def model_keys(self):
        """The keys of a model file's ``soil`` at their means: all but ``source``."""
        return {key: _mean(value) for key, value in self._values.items() if key != "source"}


def _mean(value):
    return value["mean"] if isinstance(value, dict) else value
