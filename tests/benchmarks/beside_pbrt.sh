#!/usr/bin/env bash
# The cloud of cloud_benchmark.sh, with Henyey-Greenstein's phase function, rendered by Arcus and by pbrt-v4 (volpath, both of its samplers):
# the same voxels, camera, sun of equal energy at all wavelengths, no sky. Prints Markdown tables: what the pictures show, and
# processor time times error. Usage: beside_pbrt.sh ARCUS PBRT [SAMPLES_PER_PIXEL [SAMPLES_OF_THE_MEANS]]
# Needs a C++ compiler, libopenvdb-dev, libnanovdb-dev, openimageio-tools and python3-numpy.
set -euo pipefail
arcus=$(realpath "${1:?usage: beside_pbrt.sh ARCUS PBRT [SAMPLES_PER_PIXEL [SAMPLES_OF_THE_MEANS]]}")
pbrt=$(realpath "${2:?usage: beside_pbrt.sh ARCUS PBRT [SAMPLES_PER_PIXEL [SAMPLES_OF_THE_MEANS]]}")
samples=${3:-16}
many=${4:-256}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/arcus_beside_pbrt.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
cp "$here/cloud.toml" .
"$arcus" author cloud -o cloud.vdb --name cloud --size-m 1024 --depth-m 640 --base-m 0 --voxel-m 4 --cell-m 1000 --cover 0.45 \
  --drops-per-cm3 250 --liquid-gradient-g-per-m3-km 2.2 --adiabatic-share 0.7 --seed 1 --quiet
"${CXX:-c++}" -std=c++17 "$here/beside_pbrt_grid.cpp" -o grid -lopenvdb -ltbb -lImath
./grid cloud.vdb cloud.extinction cloud.nvdb

# pbrt's axes are left-handed and its angle of view is across the shorter side: 2 atan(tan(15) 128 / 192). The sun is at 230 degrees
# from north (y), clockwise, 40 degrees up. The box only tells where the medium begins.
write_scene() {  # write_scene SAMPLER
  cat <<SCENE
Scale -1 1 1
LookAt 0 -1900 200  0 0 300  0 0 1
Camera "perspective" "float fov" [ 20.2562 ]
Film "rgb" "integer xresolution" [ 192 ] "integer yresolution" [ 128 ] "bool savefp16" false "string filename" "pbrt.exr"
PixelFilter "box" "float xradius" [ 0.5 ] "float yradius" [ 0.5 ]
Sampler "$1"
Integrator "volpath" "integer maxdepth" [ 100000 ]
WorldBegin
LightSource "distant" "spectrum L" [ 300 1 900 1 ] "point3 from" [ -0.586824 -0.492404 0.642788 ] "point3 to" [ 0 0 0 ]
MakeNamedMedium "cloud" "string type" "nanovdb" "string filename" "cloud.nvdb" "float g" 0.85
  "spectrum sigma_s" [ 300 1 900 1 ] "spectrum sigma_a" [ 300 0 900 0 ]
MediumInterface "cloud" ""
Material "interface"
Shape "trianglemesh"
  "point3 P" [ -600 -600 -20  600 -600 -20  600 600 -20  -600 600 -20  -600 -600 700  600 -600 700  600 600 700  -600 600 700 ]
  "integer indices" [ 0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7 ]
SCENE
}
for sampler in independent zsobol; do write_scene "$sampler" >"$sampler.pbrt"; done

# render PROGRAM SAMPLES SEED PICTURE
render() {
  case $1 in
    arcus)
      "$arcus" render cloud.toml -o "$4.exr" --spp "$2" --seed "$3" --threads 1 --no-png --set medium.0.grid=cloud.extinction \
        --set 'medium.0.phase={ type = "hg", g = 0.85 }' --set 'sky={ type = "none" }' --set sun.spectrum=equal_energy
      ;;
    *) "$pbrt" --quiet --nthreads 1 --spp "$2" --seed "$3" --outfile "$4.exr" "$1.pbrt" ;;
  esac
}

# Processor seconds of a command: of what else runs on the machine, only the caches are shared.
processor_seconds() { local TIMEFORMAT='%U'; { time "$@" >"$work/log" 2>&1; } 2>&1; }

for program in arcus independent zsobol; do
  render "$program" 1 1 warm >log 2>&1
  start=$(processor_seconds render "$program" 1 1 warm)  # nearly all of it loading
  for seed in 1 2; do  # of independent numbers; with 1 sample of it paid for by the start
    echo "$(processor_seconds render "$program" "$samples" "$seed" "$program$seed") $start"
  done >"$program.seconds"
  render "$program" "$many" 3 "$program.mean" >log 2>&1
done
for picture in *.exr; do oiiotool "$picture" --ch R,G,B -d float --compression none --scanline -o "$picture"; done
"${PYTHON:-python3}" "$here/beside_pbrt.py" "$samples"
