#!/usr/bin/env bash
# VDB files as other programs may leave them: each gives a picture that is not black, or exit code 2 and a message that names the file,
# the grid and what to do. Usage: odd_vdb_test.sh ARCUS WRITE_ODD_VDBS
ARCUS=$1
writer=$2
source "$(dirname "${BASH_SOURCE[0]}")/shell_kit.sh"
must "$writer" "$work"

# The camera stands in the middle of the cube and looks around; one optical depth in six voxels of 1 m.
printf '[camera]\ntype = "equirectangular"\nresolution = [8, 4]\nposition_m = [0, 0, 0]\n[film]\nchannels = ["rgb"]\n[render]\nseed = 3\n[sun]\nelevation_deg = 40\nspectrum = "equal_energy"\n[[medium]]\nvdb = "float.vdb"\nextinction_per_m = 0.17\nphase = { type = "isotropic" }\n' >odd.toml

# What it looks like where there is nothing to see; densities that vanish as floats are nothing.
expect 0 '' "$ARCUS" render odd.toml -o dark.exr --spp 1 --set medium.0.vdb=denormal.vdb
checks=$((checks + 1))
if grep -q 'not finite' .stderr; then complain 'densities below the range of floats make samples that are not finite'; fi

# shows FILE [OPTIONS...]: a picture with light in it, and all of its samples finite.
shows() {
  local name=$1
  shift
  rm -f odd.exr odd.png
  must "$ARCUS" render odd.toml -o odd.exr --spp 4 --set "medium.0.vdb=$name.vdb" "$@"
  checks=$((checks + 1))
  if [ ! -s odd.png ] || cmp -s dark.png odd.png; then complain "$name.vdb gave a black picture"; fi
  if grep -q 'not finite' .stderr; then complain "$name.vdb gave samples that are not finite"; fi
}
# refuses FILE REGEX [OPTIONS...]: exit code 2 and a message with the file and the words.
refuses() {
  local name=$1 words=$2
  shift 2
  expect 2 "$name.vdb.*($words)" "$ARCUS" render odd.toml -o bad.exr --spp 1 --no-png --set "medium.0.vdb=$name.vdb" "$@"
  absent bad.exr
}

# Types and compression.
for name in half double half_double plain zip; do shows "$name"; done
if [ -e blosc.vdb ]; then shows blosc; fi
refuses int 'int32.*float or double'
refuses long 'int64.*float or double'
refuses bool 'bool.*float or double'
refuses vector 'vec3s.*float or double'
refuses mask 'mask.*float or double'
refuses points 'points.*float or double'
refuses level_set 'level set.*fog volume expected.*sdfToFogVolume'

# Names.
shows empty_name
refuses empty_names '\[0\].*smoke'
shows empty_names --set 'medium.0.grid="[0]"'
refuses two_empty_names '\[0\].*\[1\]'
shows two_empty_names --set 'medium.0.grid="[1]"'
refuses spaces "'smoke density '.*'heat'"
shows spaces --set 'medium.0.grid=smoke density '
refuses unicode 'Dichte ρ雲'
shows unicode --set 'medium.0.grid=Dichte ρ雲'
refuses twins "density\[0\].*density\[1\]"
shows twins --set 'medium.0.grid=density[1]'
refuses brackets "'density\[1\]'"
refuses absent "'smoke'.*'heat'.*grid = "
refuses absent "no such grid.*Did you mean 'smoke'" --set medium.0.grid=smok
refuses absent 'vec3s' --set medium.0.grid=velocity
refuses escape 'red\?\[31mpaint\?line.*heat'
shows escape --set 'medium.0.grid=red?[31mpaint?line'
checks=$((checks + 1))
if "$ARCUS" render odd.toml -o bad.exr --set medium.0.vdb=escape.vdb 2>&1 | grep -q $'\x1b'; then complain 'a grid name reaches the terminal as it is'; fi

# Values.
refuses negative 'density.*-0.5 at voxel \(1, 2, 3\)'
refuses nan 'density.*NaN at voxel \(1, 2, 3\)'
refuses infinite 'density.*infinity at voxel \(1, 2, 3\)'
refuses beyond_float '1e\+300 at voxel \(1, 2, 3\)'
shows below_float
refuses no_voxels 'no active voxel'
shows tiles
shows root_tile --set 'camera.position_m=[3, 3, 3]'
refuses metadata 'no grid'

# Transforms.
shows huge --set medium.0.extinction_per_m=1.7e-7
shows tiny --set medium.0.extinction_per_m=8.5e3
shows nano --set medium.0.extinction_per_m=1.7e8
for name in mirrored upside_down shear; do shows "$name"; done
shows flattened --set medium.0.extinction_per_m=17
shows far --set 'camera.position_m=[1e7, 0, 0]'
refuses frustum 'frustum'

for file in huge.vdb nano.vdb frustum.vdb points.vdb escape.vdb metadata.vdb nan.vdb; do
  checks=$((checks + 1))
  "$ARCUS" info "$file" >"$work/.stdout" 2>"$work/.stderr"
  found=$?
  [ $found -eq 0 ] || [ $found -eq 2 ] || complain "info $file ended with $found"
done
finish
