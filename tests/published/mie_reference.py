#!/usr/bin/env python3
"""Lorenz-Mie efficiencies and amplitudes in arbitrary precision: writes mie_reference.csv.

The series is summed as Bohren & Huffman (1983) print it, eq. 4.53, 4.61, 4.62 and 4.74: a_n and
b_n from psi_n(mx) itself, not from ratios, and pi_n, tau_n from the plain upward recurrence in
cos(theta), so that it shares no step with the program's own evaluation. The numbers of a case are
computed with two precisions and lengths of the series, and must agree to 25 digits. Before that,
psi_n and chi_n are held against mpmath's Bessel functions.

    python3 mie_reference.py              # needs mpmath; minutes
    python3 mie_reference.py 3 1.55 0 90  # one sphere on the screen: x, n, k, angles in degrees

Inputs are doubles taken exactly, angles in radians.
"""
import math
import pathlib
import sys

import mpmath as mp

# size parameter, n, k
CASES = [
    # small: the limits of Rayleigh scattering and of absorption by volume
    (1e-3, 1.333, 0.0), (1e-3, 1.333, 1e-9), (1e-3, 1.5, 1.0), (1e-3, 1.000001, 0.0),
    (1e-3, 0.75, 0.0),
    (1e-2, 1.33, 1e-8), (0.1, 1.5, 0.1), (0.1, 10.0, 10.0),
    # moderate, of every kind
    (1.0, 1.5, 1.0), (1.0, 1.000001, 0.0), (1.0, 1.000001, 1e-9), (3.0, 1.55, 0.0),
    (5.21282, 1.55, 0.0), (10.0, 1.33, 1e-5), (10.0, 0.75, 0.0), (10.0, 1.5, 1.0),
    (10.0, 10.0, 10.0), (25.0, 4.0, 3.0),
    (100.0, 1.33, 0.0), (100.0, 1.333, 1e-9), (100.0, 0.75, 0.0), (100.0, 1.5, 1.0),
    (100.0, 0.2, 3.0),
    (100.0, 1.000001, 0.0), (100.0, 0.999999, 1e-7), (137.5, 1.31, 2e-9),
    # large
    (1000.0, 1.333, 1.9e-9), (1000.0, 0.75, 0.0), (1000.0, 1.5, 1.0), (1000.0, 1.000001, 0.0),
    (1000.0, 1.000001, 1e-6), (1000.0, 1.0001, 0.0), (1000.0, 0.05, 7.0), (987.654321, 1.5, 0.0),
    (5000.0, 1.33, 1e-5), (5000.0, 1.5, 1.0), (10000.0, 1.3343, 0.0), (10000.0, 0.9, 0.01),
    (20000.0, 1.333, 1e-9), (20000.0, 0.75, 0.0), (20000.0, 1.5, 1.0), (20000.0, 1.000001, 0.0),
    (20000.0, 3.0, 7.0),
]
ANGLES_DEG = [0.0, 0.01, 1.0, 30.0, 90.0, 129.0, 138.0, 179.9, 180.0]


def riccati_psi(z, terms):
    """psi_n(z) = z j_n(z), n = 0 ... terms; downward from beyond |z|, scaled by psi_0 or psi_1."""
    size = float(abs(z))
    start = int(max(size, terms) + 30 * max(size, terms) ** (1 / 3) + 2 * mp.mp.dps + 50)
    psi = [mp.mpf(0)] * (terms + 2)
    after, current = mp.mpf(0), mp.mpf(10) ** (-mp.mp.dps)
    inverse = 1 / z
    for n in range(start, -1, -1):
        if n <= terms + 1:
            psi[n] = current
        after, current = current, (2 * n + 1) * inverse * current - after
    psi0, psi1 = mp.sin(z), mp.sin(z) / z - mp.cos(z)
    scale = psi0 / psi[0] if abs(psi0) > abs(psi1) else psi1 / psi[1]
    return [scale * p for p in psi[: terms + 1]]


def riccati_chi(x, terms):
    """chi_n(x) = -x y_n(x), n = 0 ... terms: upward."""
    chi = [mp.cos(x), mp.cos(x) / x + mp.sin(x)]
    for n in range(2, terms + 1):
        chi.append((2 * n - 1) / x * chi[-1] - chi[-2])
    return chi


def check_bessel():
    mp.mp.dps = 60
    for z, n in [(mp.mpf("0.5"), 3), (mp.mpc(40, 3), 20), (mp.mpf(40), 60), (mp.mpc(20, 35), 45)]:
        bessel = mp.sqrt(mp.pi * z / 2) * mp.besselj(n + mp.mpf(1) / 2, z)
        assert abs(riccati_psi(z, 80)[n] / bessel - 1) < mp.mpf(10) ** -50
    for x, n in [(mp.mpf("0.5"), 3), (mp.mpf(40), 60)]:
        bessel = -mp.sqrt(mp.pi * x / 2) * mp.bessely(n + mp.mpf(1) / 2, x)
        assert abs(riccati_chi(x, 80)[n] / bessel - 1) < mp.mpf(10) ** -50


def sphere(x, n, k, angles, digits, extra):
    """Q_ext, Q_sca, Q_abs, Q_back, g and [(S1, S2)] of one sphere."""
    mp.mp.dps = digits
    x = mp.mpf(x)
    m = mp.mpc(n, k) if k else mp.mpf(n)
    terms = int(x + (14 + extra) * mp.cbrt(x) + 20 + extra)
    psi_x, psi_z, chi = riccati_psi(x, terms), riccati_psi(m * x, terms), riccati_chi(x, terms)
    a, b = [mp.mpc(0)] * (terms + 1), [mp.mpc(0)] * (terms + 1)
    for j in range(1, terms + 1):
        dpsi_x = psi_x[j - 1] - j / x * psi_x[j]
        dpsi_z = psi_z[j - 1] - j / (m * x) * psi_z[j]
        xi = mp.mpc(psi_x[j], -chi[j])
        dxi = mp.mpc(psi_x[j - 1], -chi[j - 1]) - j / x * xi
        a[j] = (m * psi_z[j] * dpsi_x - psi_x[j] * dpsi_z) / (m * psi_z[j] * dxi - xi * dpsi_z)
        b[j] = (psi_z[j] * dpsi_x - m * psi_x[j] * dpsi_z) / (psi_z[j] * dxi - m * xi * dpsi_z)
    def power(w):
        return w.real ** 2 + w.imag ** 2
    orders = range(1, terms + 1)
    ext = 2 / x ** 2 * mp.fsum((2 * j + 1) * (a[j] + b[j]).real for j in orders)
    sca = 2 / x ** 2 * mp.fsum((2 * j + 1) * (power(a[j]) + power(b[j])) for j in orders)
    back = abs(mp.fsum((2 * j + 1) * (-1) ** j * (a[j] - b[j]) for j in orders)) ** 2 / x ** 2
    g = 4 / x ** 2 / sca * mp.fsum(
        mp.mpf(j * (j + 2)) / (j + 1) * (a[j] * mp.conj(a[j + 1]) + b[j] * mp.conj(b[j + 1])).real
        + mp.mpf(2 * j + 1) / (j * (j + 1)) * (a[j] * mp.conj(b[j])).real for j in range(1, terms))
    amplitudes = []
    for angle in angles:
        mu = mp.cos(mp.mpf(angle))
        before, current = mp.mpf(0), mp.mpf(1)
        s1 = s2 = mp.mpc(0)
        for j in range(1, terms + 1):
            tau = j * mu * current - (j + 1) * before
            weight = mp.mpf(2 * j + 1) / (j * (j + 1))
            s1 += weight * (a[j] * current + b[j] * tau)
            s2 += weight * (a[j] * tau + b[j] * current)
            before, current = current, ((2 * j + 1) * mu * current - (j + 1) * before) / j
        amplitudes.append((s1, s2))
    return [ext, sca, ext - sca, back, g], amplitudes


def checked_sphere(x, n, k, angles):
    # Amplitudes for m near 1 lose the most: some 35 digits where S2 nearly vanishes.
    first = sphere(x, n, k, angles, 80, 0)
    second = sphere(x, n, k, angles, 100, 4)
    for u, v in zip(first[0], second[0]):
        assert abs(u - v) <= mp.mpf(10) ** -25 * max(abs(v), mp.mpf(10) ** -25), (x, n, k, u, v)
    for u, v in zip(first[1], second[1]):
        assert all(abs(p - q) <= mp.mpf(10) ** -25 * abs(q) for p, q in zip(u, v)), (x, n, k, u, v)
    return second


def main():
    check_bessel()
    if len(sys.argv) > 3:
        x, n, k, *degrees = map(float, sys.argv[1:])
        numbers, amplitudes = checked_sphere(x, n, k, [math.radians(d) for d in degrees])
        for name, value in zip(["Q_ext", "Q_sca", "Q_abs", "Q_back", "g"], numbers):
            print(name, mp.nstr(value, 20))
        for degree, (s1, s2) in zip(degrees, amplitudes):
            print(degree, "S1", mp.nstr(s1, 20), "S2", mp.nstr(s2, 20))
        return
    angles = [math.radians(d) for d in ANGLES_DEG]
    with open(pathlib.Path(__file__).with_name("mie_reference.csv"), "w", encoding="ascii") as out:
        out.write("# quantity: Lorenz-Mie efficiencies and amplitudes S1, S2 of homogeneous spheres\n"
                  "# units: 1; scattering angle in radians; time factor exp(-i omega t), m = n + ik\n"
                  "# source: mie_reference.py (mpmath, 100 digits), "
                  "series of Bohren & Huffman 1983 eq. 4.53-4.74\n")
        out.write("x,n,k,q_ext,q_sca,q_abs,q_back,g,angle_rad,s1_re,s1_im,s2_re,s2_im\n")
        for x, n, k in CASES:
            numbers, amplitudes = checked_sphere(x, n, k, angles)
            for angle, (s1, s2) in zip(angles, amplitudes):
                values = [mp.nstr(v, 17) for v in (*numbers,)]
                parts = [mp.nstr(v, 17) for v in (s1.real, s1.imag, s2.real, s2.imag)]
                row = [repr(x), repr(n), repr(k), *values, repr(angle), *parts]
                out.write(",".join(row) + "\n")
            print(x, n, k, flush=True)


if __name__ == "__main__":
    main()
