"""Light reflected and transmitted by a homogeneous layer of cloud droplets, for a few views.

    python3 slab_droplets.py     writes slab_droplets.csv beside itself in ten minutes

Needs numpy and scipy.

Droplets: gamma distribution of effective radius 10 um and effective variance 0.1 (Hansen & Travis
1974, Space Sci. Rev. 16, 527), refractive index 1.3343 relative to air, vacuum wavelength 550 nm,
no absorption. Phase function from Lorenz-Mie series (Bohren & Huffman 1983, eq. 4.53 and 4.74) in
numpy; the layer by discrete ordinates (slab_reference.py) with delta-M scaling at order 400 and
single scattering from the unscaled phase function. Conventions as in slab_reference.py.
"""
import pathlib

import numpy as np
from numpy.polynomial.legendre import leggauss, legval

from slab_reference import mode_by_ordinates, scattering_cosine, single_scattering

WAVELENGTH_UM = 0.55 / 1.00028      # in air
INDEX = 1.3343
EFFECTIVE_RADIUS_UM, EFFECTIVE_VARIANCE = 10.0, 0.1
RADII = 10000
NODES = 200                         # per hemisphere
MOMENTS = 1000

QUESTIONS = (  # optical depth, sun's zenith angle, camera's elevation, azimuth from the sun [deg]
    (10.0, 60.0, -90.0, 0.0),
    (40.0, 60.0, -90.0, 0.0),
    (3.0, 30.0, 90.0, 0.0),
    (2.0, 30.0, 55.0, 0.0),
    (10.0, 30.0, 55.0, 0.0),
    (2.0, 40.0, -10.0, 180.0),
)


def coefficients(x, m):
    """a_n, b_n for n = 1 ... of a sphere of size parameter x."""
    terms = int(x + 4.05 * x ** (1 / 3) + 2)
    ratio = np.zeros(int(max(terms, m * x)) + 17)      # psi'(mx) / psi(mx), downward
    for n in range(len(ratio) - 1, 0, -1):
        ratio[n - 1] = n / (m * x) - 1 / (ratio[n] + n / (m * x))
    a, b = np.zeros(terms, complex), np.zeros(terms, complex)
    before, now = np.array([np.cos(x), -np.sin(x)]), np.array([np.sin(x), np.cos(x)])  # psi, chi
    for n in range(1, terms + 1):
        after = (2 * n - 1) / x * now - before
        xi, xi_before = complex(after[0], -after[1]), complex(now[0], -now[1])
        for series, d in ((a, ratio[n] / m), (b, ratio[n] * m)):
            series[n - 1] = ((d + n / x) * after[0] - now[0]) / ((d + n / x) * xi - xi_before)
        before, now = now, after
    return a, b


def phase_function(mu):
    """Of the droplets, at cosines mu, mean over the sphere 1 by its own normalisation."""
    radius = np.linspace(0.5, 30, RADII)
    count = radius ** ((1 - 3 * EFFECTIVE_VARIANCE) / EFFECTIVE_VARIANCE)
    count *= np.exp(-radius / (EFFECTIVE_RADIUS_UM * EFFECTIVE_VARIANCE))
    size = 2 * np.pi * radius / WAVELENGTH_UM
    terms = int(size[-1] + 4.05 * size[-1] ** (1 / 3) + 2)
    pi, tau = np.zeros((terms + 1, len(mu))), np.zeros((terms + 1, len(mu)))
    pi[1], tau[1] = 1, mu
    for n in range(2, terms + 1):
        pi[n] = ((2 * n - 1) * mu * pi[n - 1] - n * pi[n - 2]) / (n - 1)
        tau[n] = n * mu * pi[n] - (n + 1) * pi[n - 1]
    n = np.arange(1, terms + 1)
    factor = (2 * n + 1) / (n * (n + 1))
    intensity, scattered = np.zeros(len(mu)), 0.0
    for block in np.array_split(np.arange(RADII), 200):
        a, b = np.zeros((len(block), terms), complex), np.zeros((len(block), terms), complex)
        for row, i in enumerate(block):
            one = coefficients(size[i], INDEX)
            a[row, :len(one[0])], b[row, :len(one[1])] = one
        scattered += count[block] @ ((abs(a) ** 2 + abs(b) ** 2) @ (2 * n + 1))
        a, b = a * factor, b * factor
        for p, t in ((a, b), (b, a)):                  # S1, S2
            s2 = (p.real @ pi[1:] + t.real @ tau[1:]) ** 2
            s2 += (p.imag @ pi[1:] + t.imag @ tau[1:]) ** 2
            intensity += count[block] @ s2
    return intensity / scattered


def radiance(moments, depth, sun_zenith_deg, elevation_deg, azimuth_deg):
    sun = np.cos(np.radians(sun_zenith_deg))
    view = np.array([abs(np.sin(np.radians(elevation_deg)))])
    reflected = elevation_deg < 0
    peak = moments[2 * NODES]
    scaled, scaled_depth = (moments[:2 * NODES] - peak) / (1 - peak), (1 - peak) * depth
    cosine = scattering_cosine(view, sun, azimuth_deg, reflected)
    p = legval(cosine, (2 * np.arange(MOMENTS) + 1) * moments) / (1 - peak)
    total = single_scattering(p, 1.0, scaled_depth, sun, view, reflected)
    for m in range(2 * NODES if view[0] < 1 else 1):
        mode = mode_by_ordinates(m, scaled, 1.0, scaled_depth, sun, view, NODES)
        wave = (1 if m == 0 else 2) * np.cos(m * np.radians(azimuth_deg))
        share = mode[0 if reflected else 1] * wave
        total = total + share
        if m > 30 and abs(share[0]) < 1e-9 * total[0]:
            break
    return total[0]


HEADER = """\
# Radiance of a homogeneous layer of cloud droplets over black under a collimated beam.
# Gamma distribution, effective radius 10 um, effective variance 0.1; index 1.3343 relative to air,
# 550 nm in vacuum, no absorption. Per unit irradiance on a surface facing the sun [1/sr].
# view_elevation_deg: of the line of sight, negative where the camera is above and looks down.
# azimuth_deg: from the horizontal direction in which it looks to the one towards the sun.
# Source: slab_droplets.py in this folder. Tolerance: 1e-3 (resonances between the radii).
optical_depth,sun_zenith_deg,view_elevation_deg,azimuth_deg,radiance_per_sr
"""

if __name__ == "__main__":
    mu, weight = leggauss(2200)
    phase = phase_function(mu)
    print("norm - 1:", phase @ weight / 2 - 1, " g:", phase @ (weight * mu) / 2)
    rows = [np.ones_like(mu), mu]
    for l in range(2, MOMENTS):
        rows.append(((2 * l - 1) * mu * rows[-1] - (l - 1) * rows[-2]) / l)
    moments = np.array(rows) @ (phase * weight) / 2
    moments /= moments[0]
    text = HEADER
    for question in QUESTIONS:
        text += ",".join(f"{q:g}" for q in question) + f",{radiance(moments, *question):.5e}\n"
        print(text.splitlines()[-1], flush=True)
    (pathlib.Path(__file__).resolve().parent / "slab_droplets.csv").write_text(text)
