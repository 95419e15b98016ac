"""The wheel model of Yoshida & Ishigami (2004, 2007) in vectorised numpy: what a laboratory would
write for itself. The tests hold the module to it, the benchmark measures against it.

ishigami2007 only: the sinkage carries the load with Q = 1. Equations are those of the paper, the
integrals Gauss-Legendre from theta_r to theta_m to theta_f.
"""

import numpy as np

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)


class Port:
    def __init__(self, radius_m, width_m, gravity_mps2, soil):
        self.r, self.b, self.g, self.soil = radius_m, width_m, gravity_mps2, soil
        self.phi = np.radians(soil["friction_angle_deg"])

    def forces(self, load_n, slip_ratio, slip_angle_rad):
        """Fx, Fy, torque, sinkage; one-dimensional arrays of one length."""
        s, beta = np.asarray(slip_ratio, float), np.asarray(slip_angle_rad, float)
        load_n = np.broadcast_to(np.asarray(load_n, float), s.shape)
        q = np.where(s >= 0, 1 - s, 1 / (1 + np.minimum(s, 0)))
        u = q * np.tan(np.abs(beta))
        theta_f = self._entry_angle(load_n, s, beta, q, u)
        fx, _, fu, torque = self._integrals(theta_f, s, beta, q, u)
        fy = np.sign(beta) * (fu + self._bulldozing(theta_f, s, beta, u))
        return fx, fy, torque, self.r * (1 - np.cos(theta_f))

    def _entry_angle(self, load_n, s, beta, q, u):
        """The smallest root at which Fz rises: a scan for its bracket, then regula falsi (Illinois)
        in logarithms, in which Fz is nearly a straight line."""
        def excess(theta, rows):
            fz = self._integrals(theta, s[rows], beta[rows], q[rows], u[rows])[1]
            return np.log(np.maximum(fz, 1e-300) / load_n[rows])

        low, high = np.empty(s.shape), np.empty(s.shape)
        f_low, f_high = np.empty(s.shape), np.empty(s.shape)
        open_ = np.arange(s.size)
        before, f_before = np.full(s.size, 1e-3), excess(np.full(s.size, 1e-3), open_)
        for theta in np.geomspace(0.02, np.pi / 2, 24):
            f = excess(np.full(open_.size, theta), open_)
            found = f >= 0
            rows = open_[found]
            low[rows], f_low[rows] = before[found], f_before[found]
            high[rows], f_high[rows] = theta, f[found]
            open_ = open_[~found]
            before, f_before = np.full(open_.size, theta), f[~found]
            if open_.size == 0:
                break
        every = np.arange(s.size)
        low, high = np.log(low), np.log(high)
        for _ in range(12):
            middle = (low * f_high - high * f_low) / (f_high - f_low)
            f = excess(np.exp(middle), every)
            above = f >= 0
            f_low = np.where(above, f_low / 2, f)
            f_high = np.where(above, f, f_high / 2)
            low, high = np.where(above, low, middle), np.where(above, middle, high)
        return np.exp(middle)

    def _integrals(self, theta_f, s, beta, q, u):
        soil, r, b = self.soil, self.r, self.b
        h = r * (1 - np.cos(theta_f))
        theta_r = -np.arccos(np.clip(1 - soil["lambda"] * h / r, -1, 1))
        theta_m = (soil["a0"] + soil["a1"] * s) * theta_f
        kx = soil["kx0_m"] + soil["kx1_m"] * np.abs(beta)
        ky = soil["ky0_m"] + soil["ky1_m"] * np.abs(beta)
        fx = fz = fu = torque = 0
        for low, high in ((theta_r, theta_m), (theta_m, theta_f)):
            half = (high - low) / 2
            for node, weight in zip(_NODES, _WEIGHTS):
                theta = low + half * (node + 1)
                star = theta if low is theta_m else theta_f - (theta - theta_r) / (
                    theta_m - theta_r) * (theta_f - theta_m)
                depth = np.maximum(np.cos(star) - np.cos(theta_f), 0)
                sigma = r ** soil["n"] * (soil["kc"] / b + soil["kphi"]) * depth ** soil["n"]
                strength = soil["cohesion_pa"] + sigma * np.tan(self.phi)
                jx = r * (theta_f - theta - q * (np.sin(theta_f) - np.sin(theta)))
                jy = r * u * (theta_f - theta)
                tau_x = strength * np.sign(jx) * -np.expm1(-np.abs(jx) / kx)
                tau_y = strength * -np.expm1(-jy / ky)
                sine, cosine, w = np.sin(theta), np.cos(theta), weight * half
                fx = fx + w * (tau_x * cosine - sigma * sine)
                fz = fz + w * (tau_x * sine + sigma * cosine)
                fu = fu + w * tau_y
                torque = torque + w * tau_x
        return r * b * fx, r * b * fz, r * b * fu, r * r * b * torque

    def _bulldozing(self, theta_f, s, beta, u):
        soil, r = self.soil, self.r
        xc = np.pi / 4 - self.phi / 2
        d1 = 1 / np.tan(xc) + np.tan(xc + self.phi)
        d2 = 1 / np.tan(xc) + np.tan(self.phi) / np.tan(xc) ** 2
        h0 = r * (1 - np.cos(theta_f))
        theta_r = -np.arccos(np.clip(1 - soil["lambda"] * h0 / r, -1, 1))
        ky = soil["ky0_m"] + soil["ky1_m"] * np.abs(beta)
        half = (theta_f - theta_r) / 2
        total = 0
        for node, weight in zip(_NODES, _WEIGHTS):
            theta = theta_r + half * (node + 1)
            h = np.maximum(r * (np.cos(theta) - np.cos(theta_f)), 0)
            rb = d1 * (soil["cohesion_pa"] * h
                       + d2 * soil["density_kgpm3"] * self.g * h * h / 2)
            total = total + weight * half * rb * (r - h * np.cos(theta))
        return -np.expm1(-r * u * (theta_f - theta_r) / ky) * total
