#!/usr/bin/env python3
"""What a sea of Cox and Munk's slopes (even in all directions) reflects with all reflections between waves, by the random walk over heights and slopes of
E. Heitz, J. Hanika, E. d'Eon and C. Dachsbacher, "Multiple-scattering microfacet BSDFs with the Smith model", ACM TOG 35(4), 58 (2016), written from the paper,
with uniform heights. Prints, by wind and zenith angle, the light that leaves after one, two and more reflections, and what a smooth surface reflects: the figures of docs/sea.md.
Usage: sea_walk.py [walks]"""

import math
import random
import sys

INDEX = 1.34


def fresnel(cosine):
    inner = math.sqrt(1 - (1 - cosine * cosine) / INDEX**2)
    across = (cosine - INDEX * inner) / (cosine + INDEX * inner)
    along = (INDEX * cosine - inner) / (INDEX * cosine + inner)
    return 0.5 * (across * across + along * along)


def smith(direction, width):
    """Lambda; below -1 for directions that go down."""
    if abs(direction[2]) > 0.9999:
        return 0 if direction[2] > 0 else -1
    a = direction[2] / (width * math.hypot(direction[0], direction[1]))
    return 0.5 * (math.erf(a) - 1) + math.exp(-a * a) / (2 * a * math.sqrt(math.pi))


def visible_slope(cosine, sine):
    """Drawn with the density (cosine + u sine) exp(-u^2) above -cosine / sine, by halving its integral."""
    first = max(-cosine / sine, -6.0) if sine > 1e-9 else -6.0

    def integral(u):
        return 0.5 * cosine * (math.erf(u) - math.erf(first)) + 0.5 / math.sqrt(math.pi) * sine * (math.exp(-first * first) - math.exp(-u * u))

    wanted, low, high = random.random() * integral(6), first, 6.0
    for _ in range(50):
        middle = 0.5 * (low + high)
        if integral(middle) < wanted:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def visible_normal(back, width):
    x, y, z = width * back[0], width * back[1], back[2]
    flat, whole = math.hypot(x, y), math.sqrt(x * x + y * y + z * z)
    cx, cy = (x / flat, y / flat) if flat > 0 else (1, 0)
    u, v = visible_slope(z / whole, flat / whole), random.gauss(0, math.sqrt(0.5))
    sx, sy = width * (u * cx - v * cy), width * (u * cy + v * cx)
    scale = 1 / math.sqrt(1 + sx * sx + sy * sy)
    return sx * scale, sy * scale, scale


def walk(zenith, width):
    """Reflections, and what they leave of the light."""
    ray, below, light, count = (-math.sin(zenith), 0, -math.cos(zenith)), 0.9995, 1.0, 0  # below: share of the surface that lies below the ray
    while light > 1e-5 and count < 30:
        chance = random.random()
        if ray[2] > 0.9999:
            break
        if ray[2] < -0.9999:
            below *= chance
        else:
            shape = smith(ray, width)
            if ray[2] > 0 and chance > 1 - below**shape:
                break
            below = min(1.0, below / (1 - chance) ** (1 / shape))
        normal = visible_normal((-ray[0], -ray[1], -ray[2]), width)
        facing = -sum(r * n for r, n in zip(ray, normal))
        light *= fresnel(min(1.0, facing))
        ray = tuple(r + 2 * facing * n for r, n in zip(ray, normal))
        count += 1
    return count, light


def main():
    walks = int(sys.argv[1]) if len(sys.argv) > 1 else 20000
    random.seed(1)
    for wind in (3, 10):
        width = math.sqrt(0.003 + 0.00512 * wind)
        for zenith in (50, 60, 70, 75, 80, 85):
            sums = [0.0] * 4
            for _ in range(walks):
                count, light = walk(math.radians(zenith), width)
                sums[min(count, 3)] += light / walks
            print(f"wind {wind} m/s, zenith {zenith}: once {sums[1]:.4f}, twice {sums[2]:.4f}, more {sums[3]:.4f}, all {sum(sums):.4f}; smooth {fresnel(math.cos(math.radians(zenith))):.4f}")


if __name__ == "__main__":
    main()
