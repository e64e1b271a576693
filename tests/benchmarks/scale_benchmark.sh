#!/usr/bin/env bash
# A fog of 10^8 active voxels, with a size in each: seconds until the first samples are there, and memory. Prints a Markdown table.
# Takes two minutes, most of them to author the file of 0.6 GB. Usage: scale_benchmark.sh ARCUS
set -euo pipefail
arcus=$(realpath "${1:?usage: scale_benchmark.sh ARCUS}")
work=$(mktemp -d "${TMPDIR:-/tmp}/arcus_benchmark.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
"$arcus" author fog -o fog.vdb --kind advection --voxel-m 2 --size-m 2000 --top-m 200 --quiet
voxels=$("$arcus" info fog.vdb | awk '/^active_voxels:/ {print $2; exit}')
printf '[camera]\nresolution = [64, 48]\nposition_m = [0, -1500, 500]\nlook_at_m = [0, 0, 150]\n[[medium]]\nvdb = "fog.vdb"\n' >fog.toml
"$arcus" render fog.toml -o warm.exr --spp 1 --no-png --quiet  # makes the phase table
ulimit -v $((8 * 1024 * 1024))
begin=$(date +%s.%N)
"$arcus" render fog.toml -o fog.exr --spp 1 --no-png --quiet &
program=$!
peak=0
while kill -0 $program 2>/dev/null; do
  now=$(awk '/^VmHWM:/ {print $2}' /proc/$program/status 2>/dev/null || true)
  [ "${now:-0}" -gt $peak ] && peak=$now
  sleep 0.1
done
wait $program
end=$(date +%s.%N)
echo "| active voxels | from the command to the picture of one sample a pixel | most memory |"
echo "| --- | --- | --- |"
awk -v v="$voxels" -v b="$begin" -v e="$end" -v p="$peak" 'BEGIN {printf "| %.3g | %.1f s | %.2f GiB |\n", v, e - b, p / 1048576}'
