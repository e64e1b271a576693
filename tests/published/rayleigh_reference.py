"""Light of a plane-parallel molecular atmosphere over a Lambert ground, without polarisation: what the test of the clear sky expects.

    python3 rayleigh_reference.py     writes rayleigh_sky.csv beside itself in seconds; needs numpy and scipy

Both methods of slab_reference.py, adding-doubling and discrete ordinates, with the phase function of air; the ground is added in closed form
(van de Hulst, Multiple Light Scattering, 1980, section 4.5): with the plane albedo r and the total transmission t of the layer by cosine, and its
spherical albedo s, a ground of albedo A is lit by E = mu0 t(mu0) / (1 - A s), and its light A E / pi comes back as r(mu) below and as t(mu) above.

Polarisation is left out on purpose: the renderer carries none through air. Radiances with it differ by up to a tenth at an optical depth of 1
(V. Natraj, K.-F. Li and Y. L. Yung, Astrophysical Journal 691, 1909, 2009; Coulson, Dave and Sekera 1960).
"""
import pathlib
import sys

import numpy as np

import slab_reference as slab

DEPOLARISATION = 0.0279
DEPTHS = (0.1, 0.5, 1.0)
ALBEDOS = (0.0, 0.8)
SUN_COSINES = (0.2, 0.6, 1.0)
VIEW_COSINES = (1.0, 0.64, 0.2)
AZIMUTHS_DEG = (0.0, 90.0, 180.0)


def air():
    gamma = DEPOLARISATION / (2 - DEPOLARISATION)
    moments = np.array([1, 0, (1 - gamma) / (10 * (1 + 2 * gamma))])
    return slab.Phase(moments, lambda c: 3 / (4 * (1 + 2 * gamma)) * (1 + 3 * gamma + (1 - gamma) * c * c))


def radiances(method):
    """By (depth, ground albedo, sun, reflected?): radiance [view][azimuth] per unit irradiance facing the sun."""
    gauss, weight = slab.hemisphere_nodes(32)
    suns = [*SUN_COSINES, *VIEW_COSINES, *gauss]
    # The sun's cosines of the quadrature give plane albedos; conservative ordinates have no albedo exactly 1 there.
    found = slab.solve_slab(method, air(), 1.0, DEPTHS, sorted(set(suns)), VIEW_COSINES, AZIMUTHS_DEG)
    result = {}
    for depth in DEPTHS:
        plane = {mu: found[depth, mu][2][0] for mu in suns}
        through = {mu: found[depth, mu][2][1] + np.exp(-depth / mu) for mu in suns}
        spherical = 2 * sum(w * mu * plane[mu] for mu, w in zip(gauss, weight))
        for sun in SUN_COSINES:
            up, down, _ = found[depth, sun]
            for albedo in ALBEDOS:
                ground = albedo * sun * through[sun] / (1 - albedo * spherical) / np.pi
                result[depth, albedo, sun, True] = up + ground * np.array([[through[v]] for v in VIEW_COSINES])
                result[depth, albedo, sun, False] = down + ground * np.array([[plane[v]] for v in VIEW_COSINES])
    return result


def main():
    adding, ordinates = radiances("adding"), radiances("ordinates")
    worst = max(np.max(np.abs(adding[key] / ordinates[key] - 1)) for key in adding)
    print(f"adding and ordinates differ by at most {worst:.1e}")
    if worst > slab.AGREEMENT:
        sys.exit("nothing written")
    lines = [f"""\
# Radiance of a plane-parallel conservative molecular layer (depolarisation {DEPOLARISATION}) over a Lambert ground, without polarisation.
# Per unit irradiance on a surface facing the sun [1/sr]. looks_down 1: leaving the top, the camera is above; 0: arriving at the ground, the camera looks up, the sun itself left out.
{slab.VIEWS}# Source: rayleigh_reference.py in this folder. Adding-doubling (the values given) and discrete ordinates agree to {10 ** np.ceil(np.log10(worst)):.0e}.
optical_depth,ground_albedo,sun_cosine,looks_down,view_cosine,azimuth_deg,radiance_per_sr"""]
    for (depth, albedo, sun, reflected), values in adding.items():
        for view, row in zip(VIEW_COSINES, values):
            for azimuth, value in zip(AZIMUTHS_DEG, row):
                if (view < 1 and sun < 1) or azimuth == 0:
                    lines.append(f"{depth:g},{albedo:g},{sun:g},{int(reflected)},{view:g},{azimuth:g},{value:.6e}")
    (pathlib.Path(__file__).parent / "rayleigh_sky.csv").write_text("\n".join(lines) + "\n")


main()
