"""Figures of the pictures of beside_pbrt.sh, in the folder where they are: beside_pbrt.py SAMPLES_PER_PIXEL."""
import struct
import sys

import numpy as np

NAMES = {"arcus": "Arcus", "independent": "pbrt-v4, independent", "zsobol": "pbrt-v4, zsobol"}
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


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


def channels(picture):
    return {"luminance": picture @ LUMINANCE, "green": picture[:, :, 1]}


def relative_error(a, b, mean):
    """Of one of two noisy pictures: half of their squared difference, relative as `arcus compare` has it."""
    return np.mean(0.5 * (a - b) ** 2 / (mean**2 + np.mean(mean) ** 2 / 1000))


def main(samples):
    means = {name: read_exr(name + ".mean.exr") for name in NAMES}
    scale = {name: np.mean(means[name] @ LUMINANCE) / np.mean(means["arcus"] @ LUMINANCE) for name in NAMES}
    print("| luminance of 32 x 32 pixels over the mean, by rows | from - to |\n| --- | --- |")
    for name, mean in means.items():
        blocks = (mean @ LUMINANCE / scale[name]).reshape(4, 32, 6, 32).mean(axis=(1, 3)) / np.mean(means["arcus"] @ LUMINANCE)
        print("| %s | %s |" % (NAMES[name], "; ".join(" ".join("%.3f" % block for block in row) for row in blocks)))
    print("\n| program | a sample | relMSE of luminance | of green | relMSE x processor seconds: luminance | green |\n" + "| --- " * 6 + "|")
    for name in NAMES:
        first, second = read_exr(name + "1.exr"), read_exr(name + "2.exr")
        start = np.loadtxt(name + ".seconds")
        seconds = np.mean(start[:, 0] - start[:, 1]) * samples / (samples - 1)
        errors = [relative_error(channels(first)[c], channels(second)[c], channels(means[name])[c]) for c in ("luminance", "green")]
        time = seconds / (first.shape[0] * first.shape[1] * samples)
        print("| %s | %.1f us | %.4g | %.4g | %.2f | %.2f |" % (NAMES[name], time * 1e6, *errors, *(e * seconds for e in errors)))


if __name__ == "__main__":
    main(int(sys.argv[1]))
