"""Final states of the bench's problems to 32 digits: writes bench.nml beside this file.

    python3 data/reference/make_reference.py        (needs mpmath; about five minutes)

Each problem is integrated twice by Taylor series in arithmetic of 60 digits, with two orders and two
steps; both must agree to 36 digits. Where there is a closed form the result must agree with that too.
The accelerations solve M a = f, as it comes from the Lagrangian, not the solved form that src/systems
has. Parameters and initial values are the doubles that the Fortran program reads: 9.81 is not 981/100.
"""
import pathlib

from mpmath import mp, mpf

mp.dps = 60
AGREE = mpf(10)**-36


class Series:
    """A power series in time whose coefficients are found when they are asked for, in order."""

    def __init__(self, rule):
        self.rule, self.c = rule, []

    def __getitem__(self, k):
        while len(self.c) <= k:
            self.c.append(self.rule(len(self.c)))
        return self.c[k]

    def upto(self, k):
        self[k]
        return self.c[:k + 1]

    def __add__(self, other):
        other = series(other)
        return Series(lambda k: self[k] + other[k])

    def __sub__(self, other):
        other = series(other)
        return Series(lambda k: self[k] - other[k])

    def __neg__(self):
        return Series(lambda k: -self[k])

    def __mul__(self, other):
        if not isinstance(other, Series):
            return Series(lambda k: self[k] * other)
        return Series(lambda k: mp.fdot(self.upto(k), reversed(other.upto(k))))

    __radd__, __rmul__ = __add__, __mul__

    def __truediv__(self, other):
        quotient = Series(None)
        quotient.rule = lambda k: (self[k] - mp.fdot(quotient.c, reversed(other.upto(k)[1:]))) / other[0]
        return quotient


def series(x):
    return x if isinstance(x, Series) else Series(lambda k: mpf(x) if k == 0 else mpf(0))


def sin_cos(u):
    """From s' = c u', c' = -s u'."""
    def rule(other, start, sign):
        def coefficient(k):
            if k == 0:
                return start(u[0])
            return sign * mp.fdot([j * u[j] for j in range(1, k + 1)], reversed(other().upto(k - 1))) / k
        return coefficient
    s = Series(rule(lambda: c, mp.sin, 1))
    c = Series(rule(lambda: s, mp.cos, -1))
    return s, c


def oscillator(p, q, v):
    m, k = p
    return [q[0] * (-k / m)]


def pendulum(p, q, v):
    m, l, g = p
    return [sin_cos(q[0])[0] * (-g / l)]


def double_pendulum(p, q, v):
    m1, m2, l1, l2, g = p
    sd, cd = sin_cos(q[0] - q[1])
    s1, s2 = sin_cos(q[0])[0], sin_cos(q[1])[0]
    m11, m12, m22 = (m1 + m2) * l1**2, cd * (m2 * l1 * l2), series(m2 * l2**2)
    f1 = sd * v[1] * v[1] * (-m2 * l1 * l2) - s1 * ((m1 + m2) * g * l1)
    f2 = sd * v[0] * v[0] * (m2 * l1 * l2) - s2 * (m2 * g * l2)
    det = m22 * m11 - m12 * m12
    return [(m22 * f1 - m12 * f2) / det, (f2 * m11 - m12 * f1) / det]


def cart_pendulum(p, q, v):
    m1, m2, l, g = p
    s, c = sin_cos(q[1])
    m11, m12, m22 = m1 + m2, c * (m2 * l), series(m2 * l**2)
    f1 = s * v[1] * v[1] * (m2 * l)
    f2 = s * (-m2 * g * l)
    det = m22 * m11 - m12 * m12
    return [(m22 * f1 - m12 * f2) / det, (f2 * m11 - m12 * f1) / det]


def charged_particle(p, q, v):
    m, e, e1, e2, e3, b1, b2, b3, trap = p
    return [(v[1] * b3 - v[2] * b2 + e1) * (e / m) - q[0] * (trap / m),
            (v[2] * b1 - v[0] * b3 + e2) * (e / m) - q[1] * (trap / m),
            (v[0] * b2 - v[1] * b1 + e3) * (e / m) - q[2] * (trap / m)]


def taylor(accelerations, p, q0, v0, duration, steps, order):
    """Series of the motion, summed over `steps` equal steps."""
    h, q0, v0 = mpf(duration) / steps, list(q0), list(v0)
    for _ in range(steps):
        q, v = [Series(None) for _ in q0], [Series(None) for _ in q0]
        a = accelerations(p, q, v)
        for i in range(len(q0)):
            q[i].rule = lambda k, i=i: q0[i] if k == 0 else v[i][k - 1] / k
            v[i].rule = lambda k, i=i: v0[i] if k == 0 else a[i][k - 1] / k
        for k in range(order + 1):  # one order after the other: no deep recursion
            for x in q + v:
                x[k]
        q0, v0 = [[mp.polyval(x.upto(order)[::-1], h) for x in y] for y in (q, v)]
    return q0, v0


def oscillator_exact(p, q, v, t):
    w = mp.sqrt(p[1] / p[0])
    return ([q[0] * mp.cos(w * t) + v[0] / w * mp.sin(w * t)],
            [v[0] * mp.cos(w * t) - q[0] * w * mp.sin(w * t)])


def pendulum_exact(p, q, v, t):
    """From rest: sin(theta/2) = k cd(w t | k^2)."""
    w, k = mp.sqrt(p[2] / p[1]), mp.sin(q[0] / 2)
    cd, sd, nd = (mp.ellipfun(name, w * t, m=k**2) for name in ("cd", "sd", "nd"))
    theta = 2 * mp.asin(k * cd)
    return [theta], [-2 * k * w * (1 - k**2) * sd * nd / mp.cos(theta / 2)]


def charged_exact(p, q, v, t):
    """B along z, E along y, no trap: drift E/B along x, and a turn about it."""
    m, e, b, drift = p[0], p[1], p[7], p[3] / p[7]
    w = e * b / m
    c, s, u = mp.cos(w * t), mp.sin(w * t), v[0] - drift
    return ([q[0] + drift * t + (u * s + v[1] * (1 - c)) / w, q[1] + (v[1] * s - u * (1 - c)) / w,
             q[2] + v[2] * t],
            [drift + u * c + v[1] * s, v[1] * c - u * s, v[2]])


# name, title, system, parameters, q, v, duration, (steps, order) twice, closed form
PROBLEMS = [
    ("oscillator", "32 periods", oscillator, [2.0, 8.0], [1.0], [0.4], 100.0,
     (50, 80), (80, 60), oscillator_exact),
    ("p1", "double pendulum, regular", double_pendulum, [1.0, 1.0, 1.0, 1.0, 9.81], [0.5, 0.8],
     [0.0, 0.0], 100.0, (2000, 50), (3000, 40), None),
    ("p1a", "double pendulum, chaotic", double_pendulum, [1.0, 1.0, 1.0, 1.0, 9.81], [2.0, 1.0],
     [0.0, 0.0], 10.0, (2000, 50), (3000, 40), None),
    ("p2", "cart-pendulum, wide swing", cart_pendulum, [2.0, 1.0, 1.0, 9.81], [0.0, 1.2], [0.0, 0.0],
     100.0, (3000, 60), (4000, 50), None),
    ("p3", "pendulum, 3 rad", pendulum, [1.0, 1.0, 9.81], [3.0], [0.0], 100.0,
     (2000, 50), (3000, 40), pendulum_exact),
    ("p4", "charge in E x B", charged_particle, [1.0, 1.0, 0.0, 0.1, 0.0, 0.0, 0.0, 1.0, 0.0],
     [0.0, 0.0, 0.0], [1.0, 0.0, 0.25], 1000.0, (500, 80), (800, 60), charged_exact),
]


def distance(x, y):
    return max(abs(a - b) for a, b in zip(x[0] + x[1], y[0] + y[1]))


def numbers(values, digits=None):
    return ", ".join(repr(x) if digits is None else mp.nstr(x, digits, strip_zeros=False) for x in values)


def main():
    text = "! The problems of `lagrangia bench`, with the state at the end of each to 32 digits.\n"
    text += "! Made by: python3 data/reference/make_reference.py (Taylor series, 60 digits, two orders).\n"
    for name, title, system, p, q, v, duration, first, second, exact in PROBLEMS:
        exact_p, start_q, start_v = ([mpf(x) for x in values] for values in (p, q, v))
        end = taylor(system, exact_p, start_q, start_v, duration, *first)
        spread = distance(end, taylor(system, exact_p, start_q, start_v, duration, *second))
        assert spread < AGREE, (name, spread)
        print(f"{name}: two orders agree to {mp.nstr(spread, 2)}", flush=True)
        if exact:
            spread = distance(end, exact(exact_p, start_q, start_v, mpf(duration)))
            assert spread < AGREE, (name, spread)
            print(f"{name}: closed form agrees to {mp.nstr(spread, 2)}", flush=True)
        text += f"\n&{name}\n  title = '{title}'\n  system = '{system.__name__}'\n"
        text += f"  parameters = {numbers(p)}\n  q = {numbers(q)}\n  v = {numbers(v)}\n"
        text += f"  duration = {duration!r}\n"
        text += f"  q_end = {numbers(end[0], 32)}\n  v_end = {numbers(end[1], 32)}\n/\n"
    pathlib.Path(__file__).with_name("bench.nml").write_text(text)


main()
