#!/usr/bin/env bash
# Times what a user waits for: phase tables without a cache, and whole renders with their noise. Prints a Markdown table.
# Usage: render_benchmark.sh ARCUS [NAME...]   names: rain_table narrow_table cloud_table demo (default: all)
set -euo pipefail
arcus=$(realpath "${1:?usage: render_benchmark.sh ARCUS [NAME...]}")
shift
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/arcus_benchmark.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"

seconds() {  # seconds COMMAND...: wall time
  local begin end
  begin=$(date +%s.%N)
  "$@" >&2
  end=$(date +%s.%N)
  echo "$begin $end" | awk '{printf "%.1f", $2 - $1}'
}

table() {  # table TITLE LINES...: computes a recipe's table
  local title=$1 time angles
  shift
  printf '%s\n' "$@" >recipe.toml
  rm -rf cache
  time=$(seconds "$arcus" phase compute recipe.toml --cache cache -o table.nc --quiet)
  angles=$("$arcus" info table.nc | sed -n 's/^scattering_angles: //p')
  echo "| $title | $time s | $angles angles, error between them at most $("$arcus" info table.nc | sed -n 's/^angle_error: //p') |"
}

# render SCENE: twice with different seeds; the difference is the noise.
demo() {
  bash "$root/scenes/author.sh" "$arcus" rain_shower >&2
  "$arcus" render "$root/scenes/rain_shower.toml" --spp 1 -o warm.exr --no-png --quiet --cache "$work/demo_cache"
  local time=$(seconds "$arcus" render "$root/scenes/rain_shower.toml" -o one.exr --no-png --quiet --cache "$work/demo_cache")
  "$arcus" render "$root/scenes/rain_shower.toml" -o two.exr --no-png --quiet --cache "$work/demo_cache" --seed 2
  # Both pictures are noisy: half of the squared difference is one picture's.
  local noise=$("$arcus" compare one.exr two.exr | awk '$1 == "G" {print $6 / 2}')
  echo "| demo render, table cached | $time s | relMSE of green $noise |"
}

names=("$@")
[ $# -gt 0 ] || names=(rain_table narrow_table cloud_table demo)
echo "| what | wall time | result |"
echo "| --- | --- | --- |"
for name in "${names[@]}"; do
  case $name in
    rain_table) table 'rain of Marshall and Palmer, 11 sizes, 41 wavelengths' 'type = "rain"' ;;
    narrow_table) table 'rain, 100 to 3000 um narrow (variance 0.03), 19 sizes' 'type = "rain"' \
      'size_um = { min = 100, max = 3000, nodes = 19 }' 'distribution = { type = "gamma", variance = 0.03 }' ;;
    cloud_table) table 'cloud, 4 to 20 um, 18 sizes, 41 wavelengths' 'type = "mie"' ;;
    demo) demo ;;
    *) echo "render_benchmark.sh: no benchmark '$name'" >&2; exit 2 ;;
  esac
done
