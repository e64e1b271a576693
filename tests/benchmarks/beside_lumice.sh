#!/usr/bin/env bash
# Sunlight through level plates and columns as Arcus and as Lumice trace it: how large the variance of the light in patches of the sky
# is after a processor second. Prints Markdown tables. One thread, 550 nm, the same crystals, tilts and index; rays only.
# Relative variance times rays does not depend on how many rays a run has: Lumice's have an eighth of Arcus's.
# Usage: beside_lumice.sh ARCUS CRYSTAL_BENCHMARK LIBLUMICE [RAYS_OF_A_RUN [RUNS]]
# LIBLUMICE is Lumice's shared library (cmake -DBUILD_SHARED_LIBS=ON). Needs netcdf-bin, python3-numpy and python3-scipy.
set -euo pipefail
usage="usage: beside_lumice.sh ARCUS CRYSTAL_BENCHMARK LIBLUMICE [RAYS_OF_A_RUN [RUNS]]"
arcus=$(realpath "${1:?$usage}")
benchmark=$(realpath "${2:?$usage}")
lumice=$(realpath "${3:?$usage}")
rays=${4:-1000000}
runs=${5:-64}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/arcus_beside_lumice.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"

echo "Arcus, rays through one crystal (eight faces from inside), a processor second:"
"$benchmark" --benchmark_filter='split/(plate|column)_avx512.*threads:1|oriented_and_split/(plate|column).*threads:1' 2>log |
  awk '/threads:1/ { printf "%s: %.1f million rays\n", $1, 256000 / $4 }'

processor_seconds() { local TIMEFORMAT='%U %S'; { time "$@" >"$work/log" 2>&1; } 2>&1 | awk '{ print $1 + $2 }'; }
figures() { "${PYTHON:-python3}" "$here/beside_lumice.py" "$@"; }

# Lumice's scene: hits count the entry too; gauss_legacy is the tilt as Arcus has it, the absolute value of a normal number.
lumice_scene() {  # lumice_scene ASPECT ZENITH_MEAN HITS WIDTH
  cat <<SCENE
{"crystal": [{"id": 1, "type": "prism", "shape": {"height": $1}, "axis": {
   "zenith": {"type": "gauss_legacy", "mean": $2, "std": 1}, "azimuth": {"type": "uniform", "mean": 0, "std": 360},
   "roll": {"type": "uniform", "mean": 0, "std": 360}}}],
 "filter": [],
 "scene": {"light_source": {"type": "sun", "altitude": 20, "azimuth": 0, "diameter": 0.5332, "spectrum": [{"wavelength": 550, "weight": 1}]},
   "ray_num": 1, "max_hits": $3, "scattering": [{"prob": 0, "entries": [{"crystal": 1, "proportion": 1}]}]},
 "render": [{"id": 1, "lens": {"type": "rectangular", "fov": 180}, "resolution": [$4, $(($4 / 2))], "visible": "full",
   "view": {"azimuth": 0, "elevation": 0, "roll": 0}}]}
SCENE
}

# Every wavelength of a map has numbers of its own, so that maps of RUNS wavelengths and one index are as many runs.
arcus_recipe() {  # arcus_recipe ASPECT HABIT RUNS
  cat <<RECIPE
type = "crystal"
habit = "$2"
aspect_ratio = $1
size_um = 200
wavelength_nm = { min = 550, max = 551, nodes = $3 }
material = { n = 1.3110, k = 0 }
optics = "geometric"
forward_lobe = "scatter"
rays_million = $(awk -v rays="$rays" 'BEGIN { print rays / 1e6 }')
map_step_deg = 0.5
map_noise = 1
orientation = { type = "$2", tilt_deg = 1 }
RECIPE
}

for habit in plate column; do
  if [[ $habit == plate ]]; then aspect=0.3 zenith=0 hits=17; else aspect=2 zenith=90 hits=14; fi
  lumice_scene $aspect $zenith $hits 720 >lumice.json
  figures $habit lumice "$lumice" lumice.json "$((rays / 8))" "$runs" | grep -v '\[I\]' >lumice.txt
  arcus_recipe $aspect $habit 2 >start.toml
  arcus_recipe $aspect $habit $((runs + 2)) >map.toml
  start=$(processor_seconds "$arcus" phase compute start.toml --sun-elevation-deg 20 --cache cache -o start.nc)
  whole=$(processor_seconds "$arcus" phase compute map.toml --sun-elevation-deg 20 --cache cache -o map.nc)
  figures $habit arcus map.nc >arcus.txt
  echo
  paste -d '|' lumice.txt arcus.txt | awk -F '|' -v whole="$whole" -v start="$start" -v runs="$runs" -v rays="$rays" -v habit="$habit" '
    NR == 1 {
      arcus = (whole - start) / runs
      lumice = $1 * 8  # seconds for as many rays
      printf "%s: Lumice %.3f, Arcus %.3f million rays a processor second (%.3f with all that a map needs besides)\n\n", habit,
        rays / lumice / 1e6, rays / arcus / 1e6, rays * (runs + 2) / whole / 1e6
      print "| patch of the sky | its share of all light: Lumice | Arcus | relative variance x rays: Lumice | Arcus | Arcus faster by |"
      print "| --- | --- | --- | --- | --- | --- |"
      next
    }
    {
      l = $3 / $2 ^ 2 * rays / 8
      a = $6 / $5 ^ 2 * rays
      printf "| %s | %s | %s | %.1f | %.1f | %.1f |\n", $1, $2, $5, l, a, l * lumice / (a * arcus)
    }'
done
