"""Light reflected and transmitted by a homogeneous plane-parallel layer: the reference for the slab tests.

    /usr/bin/python3 slab_reference.py             writes slab_reflected.csv, slab_transmitted.csv, slab_flux.csv beside itself
    /usr/bin/python3 slab_reference.py --check     compares the methods with published values, a limit and Monte Carlo

A collimated beam (irradiance 1 on a surface facing it) falls on a layer of given optical depth, single-scattering albedo and
Henyey-Greenstein asymmetry; nothing reflects below. Two methods that share only the expansion of the phase function are used,
and the files are written only if all their radiances agree to AGREEMENT:

  adding     doubling and adding of reflection and transmission matrices, started from single scattering in a layer of
             optical depth 2^-30, direct and diffuse light kept apart (de Haan, Bosma & Hovenier 1987, A&A 183, 371);
             the views are nodes of zero weight.
  ordinates  eigensolutions of the transfer equation in discrete ordinates (Stamnes, Tsay, Wiscombe & Jayaweera 1988,
             Appl. Opt. 27, 2502), scaled exponentials, views by integrating the source function; conservative
             scattering by its two exact polynomial solutions in place of the vanishing eigenvalue.

Both use Gauss-Legendre nodes on each hemisphere and azimuthal Fourier modes until the moments g^l are below 1e-9, without
delta scaling; single scattering is replaced by its closed form (the TMS correction of Nakajima & Tanaka 1988, JQSRT 40, 51).

Conventions. View: `view_cosine` is the cosine of the angle between the line of sight and the vertical, > 0. `azimuth_deg` is the
angle between the horizontal direction in which the camera looks and the horizontal direction towards the sun: 0 faces the sun's
azimuth (forward scattering), 180 has the sun behind (backscattering). Reflected: the camera is above and looks down; transmitted:
it is below and looks up, and the direct beam is left out.
"""
import pathlib
import sys

import numpy as np
from scipy.linalg import eigh, solve

NODES = 64            # per hemisphere
AGREEMENT = 1e-4      # relative, between the two methods, every radiance and flux
ASYMMETRIES = (0.0, 0.85)
ALBEDOS = (1.0, 0.99)
DEPTHS = (1.0, 5.0, 20.0)
SUN_ZENITHS_DEG = (60.0, 30.0)
VIEW_COSINES = (1.0, 0.9, 0.7, 0.5, 0.2)
AZIMUTHS_DEG = (0.0, 90.0, 180.0)


def hemisphere_nodes(count):
    """Gauss-Legendre nodes and weights on (0, 1)."""
    x, w = np.polynomial.legendre.leggauss(count)
    return (x + 1) / 2, w / 2


def henyey_greenstein(cosine, g):
    """Phase function, mean over the sphere 1."""
    return (1 - g * g) / (1 + g * g - 2 * g * cosine) ** 1.5


def legendre(m, lmax, mu):
    """Associated Legendre functions sqrt((l-m)!/(l+m)!) P_l^m(mu) for l = m..lmax, rows l - m."""
    mu = np.asarray(mu, float)
    rows = np.zeros((lmax - m + 1, mu.size))
    rows[0] = np.prod([np.sqrt((2 * k - 1) / (2 * k)) for k in range(1, m + 1)]) * np.sqrt(1 - mu * mu) ** m
    if lmax > m:
        rows[1] = np.sqrt(2 * m + 1) * mu * rows[0]
    for l in range(m + 2, lmax + 1):
        rows[l - m] = ((2 * l - 1) * mu * rows[l - m - 1]
                       - np.sqrt((l - 1) ** 2 - m * m) * rows[l - m - 2]) / np.sqrt(l * l - m * m)
    return rows


def phase_mode(m, moments, out, incoming):
    """Fourier component m of the phase function between signed cosines: p = sum over m of (2 - delta_m0) p_m cos(m phi)."""
    lmax = len(moments) - 1
    l = np.arange(m, lmax + 1)
    a, b = legendre(m, lmax, out), legendre(m, lmax, incoming)
    return a.T @ (((2 * l + 1) * moments[m:])[:, None] * b)


def moments_of(g):
    """Legendre moments of Henyey-Greenstein down to 1e-9, at least three."""
    count = 3 if g == 0 else int(np.ceil(np.log(1e-9) / np.log(abs(g)))) + 1
    moments = np.power(float(g), np.arange(count))
    assert len(moments) <= 2 * NODES
    return moments


# ---- adding and doubling -------------------------------------------------------------------------------------------


class Layer:
    """Reflection R and diffuse transmission T [van de Hulst's normalisation: a white Lambert surface has R = 1] of one
    azimuthal mode between the nodes, and the direct transmission along each node."""

    def __init__(self, reflection, transmission, depth, mu, weight):
        self.r, self.t, self.depth, self.mu, self.weight = reflection, transmission, depth, mu, weight
        self.direct = np.exp(-depth / mu)

    def over(self, below):
        """This layer on top of another one."""
        c = 2 * self.mu * self.weight
        x = (self.r * c) @ below.r
        s = np.linalg.solve(np.eye(len(c)) - x * c, x)
        down = self.t + (s * c) @ self.t + s * self.direct
        up = (below.r * c) @ down + below.r * self.direct
        return Layer(self.r + self.direct[:, None] * up + (self.t * c) @ up,
                     below.direct[:, None] * down + below.t * self.direct + (below.t * c) @ down,
                     self.depth + below.depth, self.mu, self.weight)


def thin_layer(m, moments, albedo, depth, mu, weight):
    """Single scattering; the neglected second order is smaller by the optical depth."""
    out, into = mu[:, None], mu[None, :]
    reflection = albedo / 4 * phase_mode(m, moments, -mu, mu) * -np.expm1(-depth * (1 / out + 1 / into)) / (out + into)
    # e^-d/out - e^-d/into over (out - into), written with expm1 so that neither thinness nor equality cancels
    difference = depth * (1 / into - 1 / out)
    ratio = np.where(difference == 0, 1, np.expm1(difference) / np.where(difference == 0, 1, difference))
    transmission = albedo / 4 * phase_mode(m, moments, mu, mu) * np.exp(-depth / into) * ratio * depth / (out * into)
    return Layer(reflection, transmission, depth, mu, weight)


def layers_by_adding(m, moments, albedo, depths, mu, weight):
    """One layer for every depth (sums of powers of two)."""
    power = thin_layer(m, moments, albedo, 2.0 ** -30, mu, weight)
    found = {}
    while power.depth <= max(depths):
        for depth in depths:
            if int(depth / power.depth) % 2 == 1:
                found[depth] = found[depth].over(power) if depth in found else power
        power = power.over(power)
    assert all(found[depth].depth == depth for depth in depths)
    return found


# ---- discrete ordinates --------------------------------------------------------------------------------------------


def mode_by_ordinates(m, moments, albedo, depth, sun_cosine, views):
    """Fourier component m of the multiply scattered radiances (reflected, transmitted) in the views, and for m = 0 the two
    diffuse fluxes, for irradiance 1 on a surface facing the sun."""
    mu, weight = hemisphere_nodes(NODES)
    root = np.sqrt(weight)
    same, opposite = phase_mode(m, moments, mu, mu), phase_mode(m, moments, mu, -mu)
    # with s = I(down) + I(up), d = I(down) - I(up), both times sqrt(weight):  mu d' = -Y s + Q_s,  mu s' = -X d + Q_d
    one = np.eye(NODES)
    y = one - albedo / 2 * root[:, None] * (same + opposite) * root
    x = one - albedo / 2 * root[:, None] * (same - opposite) * root
    to_d = solve(x, np.diag(mu), assume_a="pos")              # X^-1 M
    b = mu[:, None] * to_d                                    # M X^-1 M
    b = (b + b.T) / 2
    k2, v = eigh(y, b)
    conservative = m == 0 and albedo == 1
    if conservative:
        k2, v = k2[1:], v[:, 1:]
    k = np.sqrt(k2)
    dv = to_d @ v * k
    # solutions falling from the top (down, up) and from the bottom (the same with the sides exchanged)
    high, low = (v + dv) / 2 / root[:, None], (v - dv) / 2 / root[:, None]
    fade = np.exp(-k * depth)

    def beam_source(out):
        return albedo / (4 * np.pi) * phase_mode(m, moments, out, [sun_cosine])[:, 0]

    q_down, q_up = beam_source(mu) * root, beam_source(-mu) * root
    s = solve(y - b / sun_cosine ** 2, q_down + q_up + mu * solve(x, q_down - q_up) / sun_cosine)
    d = solve(x, q_down - q_up + mu * s / sun_cosine)
    z_down, z_up = (s + d) / 2 / root, (s - d) / 2 / root
    fade_sun = np.exp(-depth / sun_cosine)

    top = [high, low * fade]                                  # downward at the top, must cancel z_down
    bottom = [low * fade, high]                               # upward at the bottom
    ones = np.ones((NODES, 1))
    g = moments[1]
    if conservative:                                          # I = 1 and I = (1 - g) tau - mu solve the equation exactly
        top += [ones, -mu[:, None]]
        bottom += [ones, (1 - g) * depth + mu[:, None]]
    system = np.vstack([np.hstack(top), np.hstack(bottom)])
    coefficients = np.linalg.solve(system, -np.concatenate([z_down, z_up * fade_sun]))
    n = len(k)
    a, bb, rest = coefficients[:n], coefficients[n:2 * n], coefficients[2 * n:]

    def source_terms(out):
        """Scattered source toward the signed cosines `out`: factors of the time functions below."""
        p_down = albedo / 2 * phase_mode(m, moments, out, mu) * weight
        p_up = albedo / 2 * phase_mode(m, moments, out, -mu) * weight
        terms = [(p_down @ high + p_up @ low) * a, (p_down @ low + p_up @ high) * bb, p_down @ z_down + p_up @ z_up]
        if conservative:                                      # the source of I = (1-g) tau - mu is (1-g) tau - g mu
            terms.append((rest[0] - rest[1] * g * out, np.full_like(out, rest[1] * (1 - g))))
        return terms

    def toward(rate, near):
        """Integral of e^(-rate t) e^(-(t or depth - t)/mu) dt/mu: seen from the side where the term is large, or the other."""
        mv = views[:, None]
        if near:
            return -np.expm1(-depth * (rate + 1 / mv)) / (1 + rate * mv)
        difference = depth * (1 / mv - rate)
        small = np.abs(difference) < 1e-9
        ratio = np.where(small, 1, -np.expm1(-np.abs(difference)) / np.where(small, 1, np.abs(difference)))
        return np.exp(-depth * np.minimum(rate, 1 / mv)) * ratio * depth / mv

    def radiance(sign):
        from_top, from_bottom, beam, *line = source_terms(sign * views)
        up = sign < 0
        total = (from_top * toward(k, up)).sum(1) + (from_bottom * toward(k, not up)).sum(1)
        total += beam * toward(np.array([1 / sun_cosine]), up)[:, 0]
        for constant, slope in line:
            gone = np.exp(-depth / views)
            mean = views - (depth + views) * gone if up else depth - views * (1 - gone)
            total += constant * (1 - gone) + slope * mean
        return total

    up_flux = 2 * np.pi * (mu * weight) @ (high @ a + low * fade @ bb + z_up * 0) if False else None
    up_top = low @ a + (high * fade) @ bb + z_up
    down_bottom = (high * fade) @ a + low @ bb + z_down * fade_sun
    if conservative:
        up_top += rest[0] + rest[1] * mu
        down_bottom += rest[0] + rest[1] * ((1 - g) * depth - mu)
    fluxes = 2 * np.pi * np.array([(mu * weight) @ up_top, (mu * weight) @ down_bottom])
    return radiance(-1), radiance(+1), fluxes
