"""Light reflected and transmitted by a homogeneous plane-parallel layer: what slab tests expect.

    python3 slab_reference.py     writes slab_reflected.csv, slab_transmitted.csv, slab_flux.csv

beside itself in about a minute; needs numpy and scipy. slab_reference_check.py holds the methods
against published values, a limit and photons.

A collimated beam (irradiance 1 on a surface facing it) falls on a layer of given optical depth,
single-scattering albedo and Henyey-Greenstein asymmetry; nothing reflects below. Two methods that
share only the expansion of the phase function are used, and the files are written only if all
their values agree to AGREEMENT:

  adding     doubling and adding of reflection and transmission matrices, started from single
             scattering in a layer of optical depth 2^-36, direct and diffuse light kept apart
             (de Haan, Bosma & Hovenier 1987, A&A 183, 371); the views are nodes of zero weight.
  ordinates  eigensolutions of the transfer equation in discrete ordinates with scaled exponentials
             (Stamnes, Tsay, Wiscombe & Jayaweera 1988, Appl. Opt. 27, 2502), views by integrating
             the source function; conservative scattering by its two exact polynomial solutions in
             place of the vanishing eigenvalue.

Both use Gauss-Legendre nodes on each hemisphere and azimuthal Fourier modes until the moments g^l
are below 1e-9, without delta scaling; single scattering is replaced by its closed form (the TMS
correction of Nakajima & Tanaka 1988, JQSRT 40, 51).

View: `view_cosine` is the cosine of the angle between the line of sight and the vertical, > 0.
`azimuth_deg` is the angle between the horizontal direction in which the camera looks and the
horizontal direction towards the sun: 0 faces the sun's azimuth (forward scattering), 180 has the
sun behind (backscattering). Reflected: the camera is above and looks down; transmitted: it is
below and looks up, and the direct beam is left out.
"""
import pathlib
import sys
from typing import Callable, NamedTuple

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


class Phase(NamedTuple):
    """Phase function whose mean over the sphere is 1."""
    moments: np.ndarray     # Legendre moments, the first is 1
    value: Callable         # of the cosine of the scattering angle


def henyey_greenstein(g):
    """Moments down to 1e-9, at least three."""
    count = 3 if g == 0 else int(np.ceil(np.log(1e-9) / np.log(abs(g))))
    return Phase(np.power(float(g), np.arange(count)),
                 lambda cosine: (1 - g * g) / (1 + g * g - 2 * g * cosine) ** 1.5)


def hemisphere_nodes(count):
    """Gauss-Legendre nodes and weights on (0, 1)."""
    x, w = np.polynomial.legendre.leggauss(count)
    return (x + 1) / 2, w / 2


def legendre(m, lmax, mu):
    """Associated functions sqrt((l-m)!/(l+m)!) P_l^m(mu) for l = m..lmax, in rows l - m."""
    mu = np.asarray(mu, float)
    rows = np.zeros((lmax - m + 1, mu.size))
    lead = np.prod([np.sqrt((2 * k - 1) / (2 * k)) for k in range(1, m + 1)])
    rows[0] = lead * np.sqrt(1 - mu * mu) ** m
    if lmax > m:
        rows[1] = np.sqrt(2 * m + 1) * mu * rows[0]
    for l in range(m + 2, lmax + 1):
        rows[l - m] = ((2 * l - 1) * mu * rows[l - m - 1]
                       - np.sqrt((l - 1) ** 2 - m * m) * rows[l - m - 2]) / np.sqrt(l * l - m * m)
    return rows


def phase_mode(m, moments, out, into):
    """Component m of the phase function between signed cosines, in
    p = sum over m of (2 - delta_m0) p_m cos(m azimuth)."""
    lmax = len(moments) - 1
    l = np.arange(m, lmax + 1)
    a, b = legendre(m, lmax, out), legendre(m, lmax, into)
    return a.T @ (((2 * l + 1) * moments[m:])[:, None] * b)


def attenuated(rate, views, depth, near):
    """Integral over t in (0, depth) of e^(-rate t) e^(-s/mu) dt/mu for views mu, with s the
    distance from the side where the first factor is large (near), or from the other side."""
    if near:
        return -np.expm1(-depth * (rate + 1 / views)) / (1 + rate * views)
    difference = depth * np.abs(1 / views - rate)
    small = difference < 1e-12
    ratio = np.where(small, 1, -np.expm1(-difference) / np.where(small, 1, difference))
    return np.exp(-depth * np.minimum(rate, 1 / views)) * ratio * depth / views


# ---- adding and doubling -----------------------------------------------------------------------


class Layer:
    """Reflection r and diffuse transmission t of one azimuthal mode between the nodes [in van de
    Hulst's normalisation: a white Lambert surface has r = 1], and the direct transmission."""

    def __init__(self, r, t, depth, mu, weight):
        self.r, self.t, self.depth, self.mu, self.weight = r, t, depth, mu, weight
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
    share = albedo / 4 / into
    return Layer(share * phase_mode(m, moments, -mu, mu) * attenuated(1 / into, out, depth, True),
                 share * phase_mode(m, moments, mu, mu) * attenuated(1 / into, out, depth, False),
                 depth, mu, weight)


def layers_by_adding(m, moments, albedo, depths, mu, weight):
    """One layer for every depth, as sums of powers of two."""
    power = thin_layer(m, moments, albedo, 2.0 ** -36, mu, weight)
    found = {}
    while power.depth <= max(depths):
        for depth in depths:
            if int(depth / power.depth) % 2 == 1:
                found[depth] = found[depth].over(power) if depth in found else power
        power = power.over(power)
    assert all(abs(found[depth].depth - depth) < 2.0 ** -35 for depth in depths)
    return found


# ---- discrete ordinates ------------------------------------------------------------------------


def mode_by_ordinates(m, moments, albedo, depth, sun_cosine, views, nodes=NODES):
    """Component m of the multiply scattered radiances (reflected, transmitted) in the views, and
    for m = 0 the two diffuse fluxes, for irradiance 1 on a surface facing the sun."""
    mu, weight = hemisphere_nodes(nodes)
    root = np.sqrt(weight)
    same, opposite = phase_mode(m, moments, mu, mu), phase_mode(m, moments, mu, -mu)
    # With s = I(down) + I(up) and d = I(down) - I(up), both times sqrt(weight), M = diag(mu):
    # M d' = -Y s + Q_s and M s' = -X d + Q_d, so Y s = k^2 M X^-1 M s for solutions e^(-k tau).
    one = np.eye(nodes)
    y = one - albedo / 2 * root[:, None] * (same + opposite) * root
    x = one - albedo / 2 * root[:, None] * (same - opposite) * root
    to_d = solve(x, np.diag(mu), assume_a="pos")
    b = mu[:, None] * to_d
    b = (b + b.T) / 2
    k2, v = eigh(y, b)
    conservative = m == 0 and albedo == 1
    if conservative:
        k2, v = k2[1:], v[:, 1:]
    k = np.sqrt(k2)
    dv = to_d @ v * k
    # A solution that falls from the top has `high` downward and `low` upward; one that falls from
    # the bottom the other way round.
    high, low = (v + dv) / 2 / root[:, None], (v - dv) / 2 / root[:, None]
    fade, fade_sun = np.exp(-k * depth), np.exp(-depth / sun_cosine)

    def beam_source(out):
        return albedo / (4 * np.pi) * phase_mode(m, moments, out, [sun_cosine])[:, 0]

    q_down, q_up = beam_source(mu) * root, beam_source(-mu) * root
    s = solve(y - b / sun_cosine ** 2, q_down + q_up + mu * solve(x, q_down - q_up) / sun_cosine)
    d = solve(x, q_down - q_up + mu * s / sun_cosine)
    z_down, z_up = (s + d) / 2 / root, (s - d) / 2 / root

    # No diffuse light enters: downward at the top and upward at the bottom vanish.
    top, bottom = [high, low * fade], [low * fade, high]
    g = moments[1]
    if conservative:  # I = 1 and I = (1 - g) tau - mu solve the equation exactly, mu > 0 downward
        top += [np.ones((nodes, 1)), -mu[:, None]]
        bottom += [np.ones((nodes, 1)), (1 - g) * depth + mu[:, None]]
    coefficients = np.linalg.solve(np.vstack([np.hstack(top), np.hstack(bottom)]),
                                   -np.concatenate([z_down, z_up * fade_sun]))
    a, c, line = np.split(coefficients, [len(k), 2 * len(k)])

    def radiance(sign):
        """Source function of the views, integrated in closed form."""
        out, up = sign * views, sign < 0
        p_down = albedo / 2 * phase_mode(m, moments, out, mu) * weight
        p_up = albedo / 2 * phase_mode(m, moments, out, -mu) * weight
        from_top, from_bottom = (p_down @ high + p_up @ low) * a, (p_down @ low + p_up @ high) * c
        total = (from_top * attenuated(k, views[:, None], depth, up)).sum(1)
        total += (from_bottom * attenuated(k, views[:, None], depth, not up)).sum(1)
        total += (p_down @ z_down + p_up @ z_up) * attenuated(1 / sun_cosine, views, depth, up)
        if conservative:  # the source of I = (1 - g) tau - mu is (1 - g) tau - g mu
            gone = np.exp(-depth / views)
            mean_depth = views - (depth + views) * gone if up else depth - views * (1 - gone)
            total += (line[0] - line[1] * g * out) * (1 - gone) + line[1] * (1 - g) * mean_depth
        return total

    up_top = low @ a + (high * fade) @ c + z_up
    down_bottom = (high * fade) @ a + low @ c + z_down * fade_sun
    if conservative:
        up_top += line[0] + line[1] * mu
        down_bottom += line[0] + line[1] * ((1 - g) * depth - mu)
    fluxes = 2 * np.pi * np.array([(mu * weight) @ up_top, (mu * weight) @ down_bottom])
    return radiance(-1), radiance(+1), fluxes


# ---- radiances from modes ----------------------------------------------------------------------


def scattering_cosine(view, sun_cosine, azimuth_deg, reflected):
    vertical = -view * sun_cosine if reflected else view * sun_cosine
    across = np.sqrt((1 - view ** 2) * (1 - sun_cosine ** 2))
    return vertical + across * np.cos(np.radians(azimuth_deg))


def single_scattering(phase_value, albedo, depth, sun_cosine, views, reflected):
    """Radiance in closed form, for the phase function's value at each view."""
    path = attenuated(1 / sun_cosine, views, depth, reflected)
    return albedo / (4 * np.pi) * phase_value * path


def multiple_by_adding(m, moments, layer, sun_cosine, views, albedo):
    """What mode_by_ordinates gives. The views and the sun are nodes of zero weight; single
    scattering, as far as the modes hold it, is taken out."""
    at = [int(np.argmin(abs(layer.mu - v))) for v in views]
    column = int(np.argmin(abs(layer.mu - sun_cosine)))
    sides = []
    for matrix, sign in ((layer.r, -1), (layer.t, 1)):
        p = phase_mode(m, moments, sign * views, [sun_cosine])[:, 0]
        single = single_scattering(p, albedo, layer.depth, sun_cosine, views, sign < 0)
        sides.append(sun_cosine / np.pi * matrix[at, column] - single)
    fluxes = [2 * (layer.mu * layer.weight) @ t[:, column] for t in (layer.r, layer.t)]
    return *sides, sun_cosine * np.array(fluxes)


def solve_slab(method, phase, albedo, depths, sun_cosines, views, azimuths_deg, nodes=NODES):
    """method: "adding" or "ordinates". Returns, by (depth, sun_cosine), the reflected and the
    transmitted radiances [view][azimuth] for irradiance 1 facing the sun, and the reflected and
    the diffusely transmitted flux as fractions of the irradiance on the layer."""
    moments = phase.moments
    assert len(moments) <= 2 * nodes
    views, azimuths_deg = np.asarray(views, float), np.asarray(azimuths_deg, float)
    result = {}
    for depth in depths:
        for sun in sun_cosines:
            result[depth, sun] = [
                single_scattering(
                    phase.value(scattering_cosine(views[:, None], sun, azimuths_deg, reflected)),
                    albedo, depth, sun, views[:, None], reflected) for reflected in (True, False)
            ]
    gauss, gauss_weight = hemisphere_nodes(nodes)
    extra = np.union1d(views, sun_cosines)
    mu = np.concatenate([gauss, extra])
    weight = np.concatenate([gauss_weight, np.zeros(len(extra))])
    for m in range(np.flatnonzero(moments)[-1] + 1):
        wave = (1 if m == 0 else 2) * np.cos(m * np.radians(azimuths_deg))
        if method == "adding":
            layers = layers_by_adding(m, moments, albedo, depths, mu, weight)
        for (depth, sun), entry in result.items():
            if method == "adding":
                mode = multiple_by_adding(m, moments, layers[depth], sun, views, albedo)
            else:
                mode = mode_by_ordinates(m, moments, albedo, depth, sun, views, nodes)
            entry[0] = entry[0] + mode[0][:, None] * wave
            entry[1] = entry[1] + mode[1][:, None] * wave
            if m == 0:
                entry.append(mode[2] / sun)
    return result


def difference(a, b):
    """Largest relative difference of two results."""
    return max(np.max(np.abs(p / q - 1)) for key in a for p, q in zip(a[key], b[key]))


# ---- files -------------------------------------------------------------------------------------

HEADER = """\
# {what}
# Homogeneous plane-parallel layer, Henyey-Greenstein phase function, black below, collimated beam.
# {units}
{views}# Source: slab_reference.py in this folder. Adding-doubling (the values given) and discrete
# ordinates agree in every value to {worst:.0e} relative. Tolerance: the digits printed.
"""
VIEWS = """\
# view_cosine: cosine of the angle between the line of sight and the vertical.
# azimuth_deg: from the horizontal direction in which the camera looks to the one towards the sun;
# 0 faces the sun's azimuth (forward scattering), 180 has the sun behind.
"""
REFLECTED = "Radiance leaving the top of a layer; the camera is above and looks down."
TRANSMITTED = """\
Diffuse radiance leaving the bottom of a layer, direct beam left out; the camera is below and
# looks up. The rows with view_cosine 0.5, azimuth_deg 0 and the sun at 60 look straight into it."""


def write_files(folder):
    radiances, fluxes, worst = {"reflected": [], "transmitted": []}, [], 0.0
    suns = {float(np.cos(np.radians(z))): z for z in SUN_ZENITHS_DEG}
    for g in ASYMMETRIES:
        for albedo in ALBEDOS:
            question = henyey_greenstein(g), albedo, DEPTHS, list(suns), VIEW_COSINES, AZIMUTHS_DEG
            adding = solve_slab("adding", *question)
            ordinates = solve_slab("ordinates", *question)
            worst = max(worst, difference(adding, ordinates))
            for (depth, sun), (up, down, (reflected, transmitted)) in adding.items():
                key = f"{g:g},{albedo:g},{depth:g},{suns[sun]:g}"
                for rows, values in zip(radiances.values(), (up, down)):
                    for view, row in zip(VIEW_COSINES, values):
                        for azimuth, value in zip(AZIMUTHS_DEG, row):
                            if view < 1 or azimuth == 0:
                                rows.append(f"{key},{view:g},{azimuth:g},{value:.6e}")
                direct = np.exp(-depth / sun)
                absorbed = abs(round(1 - reflected - transmitted - direct, 7))
                parts = reflected, transmitted, direct, absorbed
                fluxes.append(f"{key}," + ",".join(f"{part:.7f}" for part in parts))
    print(f"adding and ordinates differ by at most {worst:.1e}")
    if worst > AGREEMENT:
        sys.exit(f"the methods differ by {worst:.1e}, more than {AGREEMENT:.0e}: nothing written")
    worst = 10 ** np.ceil(np.log10(worst))
    columns = "asymmetry,albedo,optical_depth,sun_zenith_deg"
    for side, what in (("reflected", REFLECTED), ("transmitted", TRANSMITTED)):
        units = "Per unit irradiance on a surface facing the sun [1/sr]."
        text = HEADER.format(what=what, units=units, views=VIEWS, worst=worst)
        text += f"{columns},view_cosine,azimuth_deg,radiance_per_sr\n"
        (folder / f"slab_{side}.csv").write_text(text + "\n".join(radiances[side]) + "\n")
    units = "As fractions of the irradiance on the layer, a horizontal surface [1]; they sum to 1."
    what = "Fluxes through the faces of a layer."
    text = HEADER.format(what=what, units=units, views="", worst=worst)
    text += f"{columns},reflected,transmitted_diffuse,transmitted_direct,absorbed\n"
    (folder / "slab_flux.csv").write_text(text + "\n".join(fluxes) + "\n")


if __name__ == "__main__":
    write_files(pathlib.Path(__file__).resolve().parent)
