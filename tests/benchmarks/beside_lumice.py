"""Power in patches of the sky, of plates lit by the sun, as Lumice and as Arcus find it. Helper of beside_lumice.sh.

  beside_lumice.py plate|column lumice LIBRARY SETTINGS.json RAYS RUNS   runs Lumice, each time with another seed
  beside_lumice.py plate|column arcus MAP.nc                             reads a map, whose wavelengths are runs with numbers of their own

Prints processor seconds a run (0 for a map), then a line for each patch of the sky: name|mean|variance over runs of its share of all light.
"""
import ctypes
import json
import subprocess
import sys
import time

import numpy as np
from scipy.io import netcdf_file

# Azimuth from the sun, both sides together, and elevation [degrees].
PATCHES = {
    "plate": {"parhelia": ((22, 30), (17, 23)), "parhelic circle": ((60, 100), (17, 23)), "circumzenithal arc": ((0, 40), (60, 75))},
    "column": {"upper tangent arc": ((0, 15), (40, 48)), "parhelic circle": ((60, 100), (17, 23)), "open sky": ((60, 120), (30, 60))},
}


def shares(habit, power, azimuth, elevation):
    """Shares of all light by patch; cells [elevation, azimuth], their middles in degrees."""
    found = []
    for (a, b), (low, high) in PATCHES[habit].values():
        rows = (elevation > low) & (elevation < high)
        columns = (np.abs(azimuth) > a) & (np.abs(azimuth) < b)
        found.append(power[np.ix_(rows, columns)].sum() / power.sum())
    return found


class RawXyz(ctypes.Structure):
    _fields_ = [("renderer", ctypes.c_int), ("width", ctypes.c_int), ("height", ctypes.c_int), ("xyz", ctypes.POINTER(ctypes.c_float)),
                ("intensity", ctypes.c_float), ("factor", ctypes.c_float), ("valid", ctypes.c_int), ("generation", ctypes.c_ulonglong),
                ("pixels", ctypes.c_int), ("epoch", ctypes.c_ulonglong)]


class ServerConfig(ctypes.Structure):
    _fields_ = [("workers", ctypes.c_int), ("seed", ctypes.c_uint), ("backend", ctypes.c_int)]


def run_lumice(habit, library, settings, rays, seeds):
    lumice = ctypes.CDLL(library)
    lumice.LUMICE_CreateServerEx.restype = ctypes.c_void_p
    found, seconds = [], []
    for seed in range(1, seeds + 1):
        settings["scene"]["ray_num"] = rays
        config = ServerConfig(1, seed, 0)
        start = time.process_time()  # of all threads
        server = ctypes.c_void_p(lumice.LUMICE_CreateServerEx(ctypes.byref(config)))
        scene, frame, state, count = ctypes.c_void_p(), ctypes.c_void_p(), ctypes.c_int(), ctypes.c_ulonglong()
        lumice.LUMICE_SceneFromJson(json.dumps(settings).encode(), ctypes.byref(scene))
        if lumice.LUMICE_CommitScene(server, scene, None) != 0:
            sys.exit("Lumice refused the scene")
        while count.value < rays or state.value != 0:
            time.sleep(0.02)
            lumice.LUMICE_QueryServerState(server, ctypes.byref(state))
            lumice.LUMICE_GetSimRayCount(server, ctypes.byref(count))
        lumice.LUMICE_AcquireResultFrame(server, ctypes.byref(frame))
        seconds.append(time.process_time() - start)
        raw = (RawXyz * 2)()
        lumice.LUMICE_FrameGetRawXyz(frame, raw, 1)
        width, height = raw[0].width, raw[0].height
        image = np.ctypeslib.as_array(raw[0].xyz, (height, width, 3))[:, :, 1].astype(float)
        lumice.LUMICE_ReleaseResultFrame(frame)
        lumice.LUMICE_SceneDestroy(scene)
        lumice.LUMICE_DestroyServer(server)
        # The sun is where light goes in the picture's middle.
        found.append(shares(habit, image, (np.arange(width) + 0.5) * 360 / width - 180, 90 - (np.arange(height) + 0.5) * 180 / height))
    return found, np.mean(seconds)


def read_arcus(habit, path):
    subprocess.run(["nccopy", "-k", "64-bit-offset", path, path + "3"], check=True)
    with netcdf_file(path + "3", mmap=False) as file:
        light = file.variables["scattering"][0].astype(float)
        azimuth, elevation = file.variables["azimuth_deg"][:].copy(), file.variables["elevation_deg"][:].copy()
    half = 0.5 * (elevation[1] - elevation[0])
    edges = np.sin(np.radians(np.clip(np.array([elevation - half, elevation + half]), -90, 90)))
    widths = np.full(azimuth.size, 2 * half)
    widths[[0, -1]] = half
    power = light * (edges[1] - edges[0])[:, None, None] * widths[None, :, None]
    return [shares(habit, power[:, :, run], azimuth, elevation) for run in range(power.shape[2])], 0


habit, program = sys.argv[1:3]
if program == "lumice":
    with open(sys.argv[4]) as file:
        result, seconds = run_lumice(habit, sys.argv[3], json.load(file), int(sys.argv[5]), int(sys.argv[6]))
else:
    result, seconds = read_arcus(habit, sys.argv[3])
result = np.array(result)
print("%.4f" % seconds)
for name, mean, variance in zip(PATCHES[habit], result.mean(axis=0), result.var(axis=0, ddof=1)):
    print("%s|%.6g|%.4g" % (name, mean, variance))
