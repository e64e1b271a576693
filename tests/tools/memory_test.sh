#!/usr/bin/env bash
# A table of rain and a sparse grid of more than 10^7 active voxels render within 2 GiB of address space.
# Usage: memory_test.sh ARCUS
ARCUS=$1
source "$(dirname "${BASH_SOURCE[0]}")/shell_kit.sh"
must "$ARCUS" author rain -o shower.vdb --voxel-m 11 --stretch 3 --wind-m-per-s 3
voxels=$("$ARCUS" info shower.vdb | sed -n 's/^active_voxels: //p' | head -1)
checks=$((checks + 1))
[ "${voxels:-0}" -ge 10000000 ] || complain "the shower has $voxels active voxels"
printf '[camera]\nresolution = [240, 160]\nposition_m = [0, -3000, 30]\nelevation_deg = 18\n[[medium]]\nvdb = "shower.vdb"\n' >shower.toml
ulimit -v $((2 * 1024 * 1024))
must "$ARCUS" render shower.toml -o shower.exr --spp 4 --no-png
grep 'samples/s' .stderr
ulimit -v $((600 * 1024))
expect 1 'memory' "$ARCUS" render shower.toml -o small.exr --spp 4 --no-png
absent small.exr
finish
