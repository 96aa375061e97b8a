"""Poles of a rotor by ROSS's own matrices, for compare_with_ross.py."""
import numpy as np
import scipy.interpolate
import scipy.linalg as la

RPM = np.pi / 30
MODES = 10
COEFFICIENTS = [a + b for a in "kcm" for b in ("xx", "xy", "yx", "yy", "zz")]


def is_bearing_with_table(element):
    return getattr(element, "frequency", None) is not None and np.size(element.frequency) > 1


def lateral_dofs(rotor):
    """Dofs x, y, alpha, beta of the shafts' nodes, x, y of the nodes off them."""
    shaft_nodes = max(e.n_r if hasattr(e, "n_r") and e.n_r is not None else e.n for e in rotor.shaft_elements) + 1
    per, out = rotor.number_dof, []
    for n in range(shaft_nodes):
        out += [per * n, per * n + 1, per * n + (3 if per == 6 else 2), per * n + (4 if per == 6 else 3)]
    at = per * shaft_nodes
    while at < rotor.ndof:
        out += [at, at + 1]
        at += per // 2
    return np.array(out)


def speeds_of(rotor):
    """(lowest, highest, end) [rad/s]: within all tables of coefficients."""
    tables = [e.frequency for e in rotor.bearing_elements if is_bearing_with_table(e)]
    if not tables:
        return 0.0, 4000 * RPM, 6000 * RPM
    low, high = max(t[0] for t in tables), min(t[-1] for t in tables)
    return low + 0.2 * (high - low), low + 0.7 * (high - low), high


def through_its_rows(rotor):
    """The tables of the bearings without smoothing."""
    for e in rotor.bearing_elements:
        if not is_bearing_with_table(e) or len(e.frequency) < 4:
            continue
        for name in COEFFICIENTS:
            if hasattr(e, name) and np.ptp(getattr(e, name)) > 0:
                spline = scipy.interpolate.UnivariateSpline(e.frequency, getattr(e, name), s=0)
                setattr(e, name + "_interpolated", spline)


def without_magnets(rotor):
    rotor.bearing_elements = [e for e in rotor.bearing_elements if type(e).__name__ != "MagneticBearingElement"]


def matrices(rotor, speed):
    at = np.ix_(lateral_dofs(rotor), lateral_dofs(rotor))
    return [m[at] for m in (rotor.M(speed), rotor.C(speed) + speed * rotor.G(), rotor.K(speed))]


def oscillates(z):
    """Not so damped that one program may take it as two real poles."""
    return z.imag > 0.02 * abs(z)


def poles(rotor, speed):
    """The lowest lateral poles with a frequency, to the last digit of ROSS's own matrices."""
    M, C, K = matrices(rotor, speed)
    n = len(M)
    s, q = la.eig(np.block([[np.zeros((n, n)), np.eye(n)], [-la.solve(M, K), -la.solve(M, C)]]))
    at = [k for k in np.argsort(s.imag) if s[k].imag > 1e-2 and oscillates(s[k])][: MODES + 4]
    out = []
    for k in at:
        z, v = s[k], q[:n, k] / la.norm(q[:n, k])
        w = v.copy()
        for _ in range(8):
            with np.errstate(all="ignore"):
                u = la.solve(z * z * M + z * C + K, (2 * z * M + C) @ v)
            step = np.vdot(w, v) / np.vdot(w, u)
            if not np.isfinite(step) or abs(step) > 0.05 * abs(z):
                break
            z, v = z - step, u / np.vdot(w, u)
            if abs(step) < 1e-14 * abs(z):
                break
        out.append(z)
    return sorted(out, key=lambda z: z.imag)


def pole_differences(mine, theirs):
    """(|frequency|, complex) largest relative differences over the poles that both list; None without any."""
    left, f, c = list(theirs), 0.0, 0.0
    count = min(MODES, len(mine), len(left))
    for m in sorted(mine, key=lambda z: z.imag)[:count]:
        k = min(range(len(left)), key=lambda i: abs(left[i] - m))
        f = max(f, abs(left[k].imag - m.imag) / abs(left[k].imag))
        c = max(c, abs(left[k] - m) / abs(left[k]))
        left.pop(k)
    return (f, c) if count else (np.nan, np.nan)
