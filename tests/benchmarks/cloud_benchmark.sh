#!/usr/bin/env bash
# What light in a thick cloud costs, with Henyey-Greenstein's phase function (g = 0.85) and with the droplets' own. Prints a Markdown
# table: processor time, and relMSE from pairs of renders with different seeds. Usage: cloud_benchmark.sh ARCUS [SAMPLES_PER_PIXEL]
set -euo pipefail
arcus=$(realpath "${1:?usage: cloud_benchmark.sh ARCUS [SAMPLES_PER_PIXEL]}")
samples=${2:-16}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/arcus_benchmark.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
cp "$here/cloud.toml" .
"$arcus" author cloud -o cloud.vdb --name cloud --size-m 1024 --depth-m 640 --base-m 0 --voxel-m 4 --cell-m 1000 --cover 0.45 \
  --drops-per-cm3 250 --liquid-gradient-g-per-m3-km 2.2 --adiabatic-share 0.7 --seed 1 --quiet

# Processor seconds of a command: of what else runs on the machine, only the caches are shared.
processor_seconds() { local TIMEFORMAT='%U'; { time "$@" >"$work/log" 2>&1; } 2>&1; }

measure() {  # measure TITLE [OPTIONS...]
  local title=$1 seed start seconds=""
  shift
  "$arcus" render cloud.toml -o warm.exr --spp 1 --no-png --quiet "$@"
  start=$(processor_seconds "$arcus" render cloud.toml -o warm.exr --spp 1 --no-png "$@")  # nearly all of it loading
  for seed in 1 2; do
    seconds="$seconds $(processor_seconds "$arcus" render cloud.toml -o "$seed.exr" --spp "$samples" --seed "$seed" --no-png "$@")"
  done
  # Both pictures are noisy: half of the squared difference is one picture's.
  "$arcus" compare 1.exr 2.exr | awk -v title="$title" -v line="$(tail -n 1 log)" -v seconds="$seconds" -v start="$start" -v spp="$samples" '
    $1 == "G" {
      split(seconds, both, " ")
      time = ((both[1] + both[2]) / 2 - start) * spp / (spp - 1)
      count = split(line, word, " ")
      scatterings = collisions = ns = "-"
      for (i = 2; i <= count; ++i) {
        if (word[i] ~ /^scatterings/) scatterings = word[i - 1]
        if (word[i] == "tentative") collisions = word[i - 1]
      }
      us = time * 1e6 / (192 * 128 * spp)
      if (collisions + 0 > 0) ns = sprintf("%.0f", us * 1000 / collisions)
      printf "| %s | %.1f us | %s | %s | %s ns | %.3g | %.2f |\n", title, us, scatterings, collisions, ns, $6 / 2, time * $6 / 2
    }'
}

echo "| phase function | a sample | scatterings a sample | tentative collisions a sample | a collision, everything counted | relMSE of green | relMSE x processor seconds |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
measure "Henyey-Greenstein" --set medium.0.grid=cloud.extinction --set 'medium.0.phase={ type = "hg", g = 0.85 }'
measure "droplets"
