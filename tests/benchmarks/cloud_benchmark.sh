#!/usr/bin/env bash
# What light in a thick cloud costs, with Henyey-Greenstein's phase function (g = 0.85) and with the droplets' own. Prints a Markdown
# table; relMSE from pairs of renders with different seeds. Usage: cloud_benchmark.sh ARCUS [SAMPLES_PER_PIXEL]
# To compare two programs give each in turn, several times: the machine may be busy with something else.
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

measure() {  # measure TITLE [OPTIONS...]
  local title=$1 seed
  shift
  "$arcus" render cloud.toml -o warm.exr --spp 1 --no-png --quiet "$@"
  for seed in 1 2; do
    "$arcus" render cloud.toml -o "$seed.exr" --spp "$samples" --seed "$seed" --no-png "$@" 2>"$seed.txt"
  done
  # Both pictures are noisy: half of the squared difference is one picture's.
  "$arcus" compare 1.exr 2.exr | awk -v title="$title" -v line="$(tail -n 1 1.txt) $(tail -n 1 2.txt)" '
    $1 == "G" {
      count = split(line, word, " ")
      for (i = 2; i <= count; ++i) {
        if (word[i] ~ /^s,?$/ && word[i - 1] + 0 > 0) seconds += word[i - 1] / 2
        if (word[i] ~ /^samples\/s/) rate += word[i - 2] / 2
        if (word[i] ~ /^scatterings/) scatterings = word[i - 1]
        if (word[i] == "tentative") collisions = word[i - 1]
      }
      printf "| %s | %.3f | %s | %s | %.3g | %.3f |\n", title, rate, scatterings, collisions, $6 / 2, seconds * $6 / 2
    }'
}

echo "| phase function | million samples/s | scatterings a sample | tentative collisions a sample | relMSE of green | relMSE x seconds |"
echo "| --- | --- | --- | --- | --- | --- |"
measure "Henyey-Greenstein" --set medium.0.grid=cloud.extinction --set 'medium.0.phase={ type = "hg", g = 0.85 }'
measure "droplets"
