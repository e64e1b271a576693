"""Holds slab_reference.py against what others published, against a limit, and against photons.

    python3 slab_reference_check.py     prints each comparison, fails if one is off; half a minute
"""
import numpy as np
from numpy.polynomial.legendre import legval

from slab_reference import (Phase, hemisphere_nodes, henyey_greenstein, mode_by_ordinates,
                            scattering_cosine, single_scattering, solve_slab)

ISOTROPIC = henyey_greenstein(0.0)
RAYLEIGH = Phase(np.array([1, 0, 0.1]), lambda cosine: 0.75 * (1 + cosine * cosine))


def report(name, found, expected, tolerance):
    worst = np.max(np.abs(np.asarray(found) / np.asarray(expected) - 1))
    print(f"{name}: {worst:.1e}")
    assert worst < tolerance, name


def check_disort():
    """Values printed with the tests of DISORT (Stamnes et al. 1988; problems 1 and 2, which it
    compares with van de Hulst 1980, Multiple Light Scattering, table 12, and Sweigart 1970, ApJS
    22, 1), repeated with its 8 nodes a hemisphere: the digits printed must return."""
    cases = (  # phase, albedo, depth, sun cosine, irradiance facing the sun,
        #        reflected and transmitted radiances by view, upward and diffuse downward flux
        (ISOTROPIC, 0.2, 0.03125, 0.1, 10 * np.pi, (1.17771e-1, 2.64170e-2, 1.34041e-2),
         (1.15898e-1, 2.63324e-2, 1.33826e-2), 7.99451e-2, 7.94108e-2),
        (ISOTROPIC, 1.0, 0.03125, 0.1, 10 * np.pi, (6.22884e-1, 1.39763e-1, 7.09192e-2),
         (6.13458e-1, 1.39337e-1, 7.08109e-2), 4.22922e-1, 4.20233e-1),
        (ISOTROPIC, 1.0, 32.0, 0.1, 10 * np.pi, (1.93321, 1.02732, 7.97199e-1),
         (1.16385e-2, 1.87805e-2, 2.71316e-2), 3.07390, 6.76954e-2),
        (RAYLEIGH, 0.5, 0.2, 0.080442, np.pi, (1.61796e-1, 2.11501e-2, 7.86713e-3),
         (2.57685e-2, 2.00778e-2, 7.71897e-3), 5.35063e-2, 4.41791e-2),
        (RAYLEIGH, 1.0, 5.0, 0.080442, np.pi, (3.64010e-1, 8.26993e-2, 4.92370e-2),
         (3.79276e-3, 7.69337e-3, 1.05950e-2), 2.25915e-1, 2.68008e-2),
    )
    for phase, albedo, depth, sun, beam, up, down, flux_up, flux_down in cases:
        for method in ("adding", "ordinates"):
            at = [0.1, 0.5, 1.0] if phase is ISOTROPIC else [0.018014, 0.538263, 0.981986]
            slab = solve_slab(method, phase, albedo, [depth], [sun], at, [0.0], nodes=8)[depth, sun]
            found = beam * np.concatenate([slab[0][:, 0], slab[1][:, 0], sun * slab[2]])
            name = "isotropic" if phase is ISOTROPIC else "Rayleigh"
            report(f"DISORT {name} albedo {albedo} depth {depth:g}, {method}", found,
                   [*up, *down, flux_up, flux_down], 3e-5)


def check_disort_forward_peak():
    """Its problem 3 (van de Hulst's table 37: Henyey-Greenstein g = 0.75 under the zenith sun)
    with its approximations: delta-M scaling by the moment of order 16, single scattering from 33
    moments. Straight down is left out: there DISORT corrects the aureole further."""
    g, views, sun = 0.75, np.array([0.1, 0.5, 1.0]), 1.0
    moments, peak = g ** np.arange(16), g ** 16
    cases = (
        (1.0, (1.51159e-1, 1.01103e-1, 3.95460e-2), (2.13750e-1, 2.66648e-1), 2.47374e-1),
        (8.0, (3.79740e-1, 5.19598e-1, 4.93302e-1), (2.36362e-1, 4.22350e-1), 1.59096),
    )
    for depth, up, down, flux_up in cases:
        scaled = (1 - peak) * depth
        mode = mode_by_ordinates(0, (moments - peak) / (1 - peak), 1.0, scaled, sun, views, nodes=8)
        sides = []
        for reflected, radiance in ((True, mode[0]), (False, mode[1])):
            cosine = scattering_cosine(views, sun, 0.0, reflected)
            p = legval(cosine, (2 * np.arange(33) + 1) * g ** np.arange(33)) / (1 - peak)
            single = single_scattering(p, 1.0, scaled, sun, views, reflected)
            sides.append(np.pi * (radiance + single))
        report(f"DISORT g 0.75 depth {depth:g}", [*sides[0], *sides[1][:2], np.pi * mode[2][0]],
               [*up, *down, flux_up], 3e-5)


def check_semi_infinite():
    """Isotropic scattering, albedo 0.99, depth 2048: R = albedo/4 H H0/(mu + mu0) with
    Chandrasekhar's H from its integral equation, and H itself against table XI of his Radiative
    Transfer (1950; albedo 1: H(1) = 2.9078, H(0.5) = 2.0128)."""
    mu, weight = hemisphere_nodes(200)

    def h_function(albedo, at):
        def right_side(h, at):
            kernel = mu * h * weight / (np.asarray(at)[:, None] + mu)
            return 1 / (np.sqrt(1 - albedo) + albedo / 2 * kernel.sum(1))

        h, change = np.ones_like(mu), 1.0
        while change > 1e-13:
            new = (h + right_side(h, mu)) / 2
            h, change = new, np.max(abs(new - h))
        return right_side(h, at)

    report("H function, Chandrasekhar", h_function(1.0, [1.0, 0.5]), [2.9078, 2.0128], 3e-5)
    views, sun = np.array([0.2, 0.5, 1.0]), 0.5
    expected = 0.99 / 4 * h_function(0.99, views) * h_function(0.99, [sun]) / (views + sun)
    for method in ("adding", "ordinates"):
        slab = solve_slab(method, ISOTROPIC, 0.99, [2048.0], [sun], views, [0.0])[2048.0, sun]
        report(f"H function, {method}", slab[0][:, 0] * np.pi / sun, expected, 1e-6)


def check_monte_carlo(photons=400_000, g=0.85, depth=5.0, sun=0.5, albedo=0.99):
    """Photons with exact directions know nothing of modes: fluxes, and radiances by local
    estimation. z points down, x away from the sun."""
    phase = henyey_greenstein(g)
    rng = np.random.default_rng(1)
    cosines, azimuths = [0.9, 0.5, 0.2], [90.0, 180.0]
    views = [(side, i, j) for side in (0, 1) for i in range(3) for j in range(2)]
    toward = []
    for side, i, j in views:
        v, phi = cosines[i], np.radians(azimuths[j])
        across = np.sqrt(1 - v * v)
        toward.append((across * np.cos(phi), across * np.sin(phi), v if side else -v))
    direction = np.tile([np.sqrt(1 - sun * sun), 0.0, sun], (photons, 1))
    z, w, owner = np.zeros(photons), np.ones(photons), np.arange(photons)
    scores = np.zeros((len(views) + 2, photons))
    scattered = False
    while len(z):
        z = z - np.log(1 - rng.random(len(z))) * direction[:, 2]
        np.add.at(scores[-2], owner[z <= 0], w[z <= 0])
        if scattered:
            np.add.at(scores[-1], owner[z >= depth], w[z >= depth])
        scattered = True
        inside = (z > 0) & (z < depth)
        z, direction, owner, w = z[inside], direction[inside], owner[inside], w[inside] * albedo
        for score, t in zip(scores, toward):
            out = np.exp(-(z if t[2] < 0 else depth - z) / abs(t[2])) / abs(t[2])
            score[owner] += w * phase.value(direction @ t) / (4 * np.pi) * out * sun
        u = rng.random(len(z))
        cosine = (1 + g * g - ((1 - g * g) / (1 - g + 2 * g * u)) ** 2) / (2 * g)
        sine = np.sqrt(np.maximum(0, 1 - cosine * cosine))
        turn = 2 * np.pi * rng.random(len(z))
        helper = np.where(np.abs(direction[:, 2:]) < 0.9, [[0.0, 0.0, 1.0]], [[1.0, 0.0, 0.0]])
        a = np.cross(direction, helper)
        a /= np.linalg.norm(a, axis=1)[:, None]
        b = np.cross(direction, a)
        side_step = np.cos(turn)[:, None] * a + np.sin(turn)[:, None] * b
        direction = cosine[:, None] * direction + sine[:, None] * side_step
        keep = np.where(w < 0.5, rng.random(len(w)) < w, True)
        w = np.where(w < 0.5, 1.0, w)
        z, direction, owner, w = z[keep], direction[keep], owner[keep], w[keep]
    slab = solve_slab("adding", phase, albedo, [depth], [sun], cosines, azimuths)[depth, sun]
    expected = [*(slab[side][i, j] for side, i, j in views), *slab[2]]
    error = scores.std(1) / np.sqrt(photons)
    off = (scores.mean(1) - expected) / error
    print("photons: standard errors off", np.round(off, 1))
    print("         which are, relative", np.round(error / expected, 4))
    assert np.max(abs(off)) < 4.5


if __name__ == "__main__":
    check_disort()
    check_disort_forward_peak()
    check_semi_infinite()
    check_monte_carlo()
