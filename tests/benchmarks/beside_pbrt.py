"""Figures of the pictures of beside_pbrt.sh, in the folder where they are: beside_pbrt.py SAMPLES_PER_PIXEL."""
import struct
import sys

import numpy as np

NAMES = {"arcus": "Arcus", "independent": "pbrt-v4, independent", "zsobol": "pbrt-v4, zsobol"}


def read_exr(path):
    """Rows from the top, [y, x, R G B]; only what beside_pbrt.sh makes: float, scan lines, not compressed."""
    with open(path, "rb") as file:
        data = file.read()
    at, header = 8, {}
    while data[at] != 0:
        name, kind, rest = data[at:].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        (size,) = struct.unpack_from("<i", data, at)
        header[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    left, top, right, bottom = struct.unpack("<4i", header[b"dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    if header[b"compression"] != b"\0" or len(data) != at + 1 + height * (8 + 8 + 12 * width):
        sys.exit(path + ": not three channels of floats in plain scan lines")
    lines = np.frombuffer(data, "<f4", offset=at + 1 + 8 * height).reshape(height, 2 + 3 * width)[:, 2:]
    return lines.reshape(height, 3, width).transpose(0, 2, 1)[:, :, ::-1].astype(float)  # their order is B, G, R


def luminance(picture):
    return picture @ np.array([0.2126, 0.7152, 0.0722])


def errors(a, b, mean):
    """Of one of two noisy pictures, half of their squared difference: relative as `arcus compare` has it; the same in pixels
    brighter than a tenth of the picture's mean; the mean square over the mean's square, which bright pixels decide."""
    square, level = 0.5 * (a - b) ** 2, np.mean(mean)
    relative = square / (mean**2 + level**2 / 1000)
    return np.mean(relative), np.mean(relative[mean > 0.1 * level]), np.mean(square) / level**2


def main(samples):
    means = {name: luminance(read_exr(name + ".mean.exr")) for name in NAMES}
    print("| program | mean luminance over Arcus's | the same in blocks of 32 x 32 pixels, over the picture's, by rows |\n" + "| --- " * 3 + "|")
    for name, mean in means.items():
        blocks = mean.reshape(4, 32, 6, 32).mean(axis=(1, 3)) / np.mean(mean)
        rows = "; ".join(" ".join("%.2f" % block for block in row) for row in blocks)
        print("| %s | %.4f | %s |" % (NAMES[name], np.mean(mean) / np.mean(means["arcus"]), rows))
    print("\n| program | a sample | relMSE: all pixels | brighter ones | MSE over mean^2 | each x processor seconds |\n" + "| --- " * 6 + "|")
    for name in NAMES:
        first, second = (luminance(read_exr(name + seed + ".exr")) for seed in "12")
        start = np.loadtxt(name + ".seconds")
        seconds = np.mean(start[:, 0] - start[:, 1]) * samples / (samples - 1)
        found = errors(first, second, means[name])
        products = "; ".join("%.3g" % (error * seconds) for error in found)
        print("| %s | %.1f us | %.3g | %.3g | %.3g | %s |" % (NAMES[name], seconds * 1e6 / first.size / samples, *found, products))


if __name__ == "__main__":
    main(int(sys.argv[1]))
