#!/usr/bin/env bash
# One worker and two on one machine, three times in turn; then what a cumulus takes on up to 1,000 machines, from the measured times of 1,600 tiles.
# Takes ten minutes on two cores. Usage: farm_benchmark.sh ARCUS
set -euo pipefail
arcus=$(realpath "${1:?usage: farm_benchmark.sh ARCUS}")
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/arcus_benchmark.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
"$arcus" author box --optical-depth 1 --phase-type hg -o box.vdb --quiet
printf '[render]\nsamples_per_pixel = 6000\n[camera]\nresolution = [48, 32]\nposition_m = [0, -2000, 0]\n[[medium]]\nvdb = "box.vdb"\n' >box.toml
echo "| one worker | two workers | efficiency |"
echo "| ---: | ---: | ---: |"
for run in 1 2 3; do
  for jobs in 1 2; do
    begin=$(date +%s.%N)
    "$arcus" farm box.toml --out "box_${run}_$jobs" --jobs $jobs --threads 1 --tiles 16 --tiles-per-task 2 --no-png --quiet
    seconds[jobs]=$(awk -v b="$begin" -v e="$(date +%s.%N)" 'BEGIN {print e - b}')
  done
  awk -v a="${seconds[1]}" -v b="${seconds[2]}" 'BEGIN {printf "| %.1f s | %.1f s | %.0f %% |\n", a, b, 50 * a / b}'
done
echo
[ -e "$root/scenes/cumulus.vdb" ] || bash "$root/scenes/author.sh" "$arcus" cumulus >&2
"$arcus" tile "$root/scenes/cumulus.toml" --tiles 0-1599/1600 --out cumulus --threads 1 --quiet --set render.samples_per_pixel=2
# Start, writing and merging as docs/many_machines.md has them, for a medium of 1 GB and an 8k picture with 20 spectral bins.
python3 "$root/tests/benchmarks/many_workers.py" cumulus --start-seconds 8 --write-seconds 0.05 --merge-seconds 60 --hours 1000
