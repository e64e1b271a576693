#!/usr/bin/env bash
# Times what a user waits for: phase tables without a cache, and whole renders with their noise. Prints a Markdown table.
# Usage: render_benchmark.sh ARCUS [NAME...]   names: rain_table narrow_table cloud_table demo sky (default: all)
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

# What a sky costs: processor time of sixteen samples a pixel of a small cumulus, whose start (the medium, the table of the sky) is taken off by the
# difference of two renders; the skies take turns, so that a disturbance meets all of them; medians of three rounds.
sky() {
  bash "$root/scenes/author.sh" "$arcus" cumulus >&2
  local -A options=([constant]='--set sky={type="constant",radiance=0.06}' [clear]='--set sky={type="clear"}'
    [haze]='--set sky={type="clear",haze="continental",haze_optical_depth=0.1}')
  local name spp round TIMEFORMAT='%U'
  for round in 0 1 2 3; do  # the first makes the tables of the phase functions
    for name in constant clear haze; do
      for spp in 8 24; do
        { time "$arcus" render "$root/scenes/cumulus.toml" ${options[$name]} --set 'camera.resolution=[200,112]' --spp "$spp" -o sky.exr --no-png \
          --quiet --cache "$work/sky_cache" >&2 2>error.txt; } 2>time.txt || { cat error.txt >&2; return 1; }
        [ "$round" = 0 ] || echo "$name $round $spp $(cat time.txt)" >>sky.txt
      done
    done
  done
  awk '{t[$1, $2, $3] = $4} END {
    n = split("constant clear haze", names)
    for (i = 1; i <= n; i++) {
      for (r = 1; r <= 3; r++) d[r] = t[names[i], r, 24] - t[names[i], r, 8]
      if (d[1] > d[2]) { x = d[1]; d[1] = d[2]; d[2] = x }
      m = d[3] < d[1] ? d[1] : d[3] > d[2] ? d[2] : d[3]
      if (i == 1) constant = m
      printf "| cumulus, sky %s | %.1f s of a core | %.2f times the constant sky |\n", names[i], m, m / constant
    }
  }' sky.txt
}

names=("$@")
[ $# -gt 0 ] || names=(rain_table narrow_table cloud_table demo sky)
echo "| what | wall time | result |"
echo "| --- | --- | --- |"
for name in "${names[@]}"; do
  case $name in
    rain_table) table 'rain of Marshall and Palmer, 11 sizes, 41 wavelengths' 'type = "rain"' ;;
    narrow_table) table 'rain, 100 to 3000 um narrow (variance 0.03), 19 sizes' 'type = "rain"' \
      'size_um = { min = 100, max = 3000, nodes = 19 }' 'distribution = { type = "gamma", variance = 0.03 }' ;;
    cloud_table) table 'cloud, 4 to 20 um, 18 sizes, 41 wavelengths' 'type = "mie"' ;;
    demo) demo ;;
    sky) sky ;;
    *) echo "render_benchmark.sh: no benchmark '$name'" >&2; exit 2 ;;
  esac
done
