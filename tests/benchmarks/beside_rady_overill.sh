#!/usr/bin/env bash
# Tables 2 and 3 and figures 6 to 13 of M. Rady and R. Overill, "Towards Rendering Optical Phenomena" (2010), with this program: seconds from the
# command to the picture, 400 x 400 pixels. Table 2: a box of 10 to 10^6 explicit drops, with a hierarchy of boxes, without any (for a
# minute at most, then extrapolated and marked with ~), and as a medium. Prints Markdown tables; the pictures and a plot go to OUT.
# Needs a quarter of an hour on an idle machine, most of it for figure 7. Usage: beside_rady_overill.sh ARCUS OUT
set -euo pipefail
usage="usage: beside_rady_overill.sh ARCUS OUT"
arcus=$(realpath "${1:?$usage}")
mkdir -p "${2:?$usage}"
out=$(realpath "$2")
scenes=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../scenes" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/arcus_beside.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
size='camera.resolution=[400, 400]'

seconds() { local TIMEFORMAT=%R; { time "$@" >"$work/log" 2>&1; } 2>&1 || { cat "$work/log" >&2; false; }; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { printf a / b < 10 ? "%.1f" : "%.0f", a / b }'; }

# Table 2. The box is so thin (optical depth 0.025 by geometric optics) that ten drops which take as much light have room in it.
scene() {  # scene INTEGRATOR [DROPS]: one path a pixel
  printf '[render]\nintegrator = "%s"\nsamples_per_pixel = 1\nmax_bounces = 50\n' "$1"
  printf '[camera]\nposition_m = [0, 0, 1.7]\nelevation_deg = 12\nfov_deg = 80\nresolution = [400, 400]\n'
  printf '[sun]\nazimuth_deg = 180\nelevation_deg = 20\n[[medium]]\nname = "rain"\nvdb = "rain.vdb"\n'
  [ $# -lt 2 ] || printf '[[droplets]]\nmedium = "rain"\ncount = %s\n' "$2"
}
"$arcus" author box -o rain.vdb --name rain --extinction-per-m 0.005 --centre-m 0,25,10 --size-m 60,10,40 --voxels 60,10,40 --size-um 500 \
  --phase-type mie --phase-size-um 500 --phase-distribution-variance 0.01 --quiet
scene volume_path >medium.toml
"$arcus" render medium.toml -o medium.exr --cache cache --no-png --quiet --spp 1  # makes the phase table
medium=$(seconds "$arcus" render medium.toml -o medium.exr --cache cache)
echo "| spheres | medium | hierarchy | exhaustive | speed-up | paper: grid | paper: exhaustive | paper's speed-up |"
echo "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
: >"$out/times.csv"
while read -r drops paper_grid paper_none; do
  scene path "$drops" >drops.toml
  with=$(seconds "$arcus" render drops.toml -o drops.exr --cache cache)
  # What it takes until the rays start: the same with a single pixel.
  start=$(seconds "$arcus" render drops.toml -o start.exr --cache cache --set 'camera.resolution=[1, 1]' --set render.intersector=exhaustive)
  "$arcus" render drops.toml -o none.exr --cache cache --no-png --set render.intersector=exhaustive --time-limit 60 2>log
  read -r without mark < <(awk -v start="$start" '/million samples/ {
      for (i = 1; i < NF; ++i) if ($(i + 1) ~ /^million/) rate = $i * 1e6
      print start + 160000 / rate, /stopped/ ? "~" : "" }' log)
  printf '| %s | %.2f s | %.2f s | %s%.3g s | %s | %s s | %s s | %s |\n' "$drops" "$medium" "$with" "$mark" "$without" "$(ratio "$without" "$with")" \
    "$paper_grid" "$paper_none" "$(ratio "$paper_none" "$paper_grid")"
  echo "$drops,$medium,$with,$without,$paper_grid,$paper_none" >>"$out/times.csv"
done <<'ROWS'
10 1.5 2.5
100 2.0 16
1000 2.7 164
10000 3.8 2041
100000 4.7 22169
1000000 5.2 240796
ROWS
if command -v gnuplot >/dev/null; then
  gnuplot <<PLOT
set terminal pngcairo size 900,600
set output "$out/times.png"
set datafile separator ","
set logscale xy
set format xy "10^{%L}"
set xlabel "spheres"
set ylabel "seconds, 400 x 400 pixels"
set key top left
set grid
plot "$out/times.csv" using 1:2 with linespoints lw 2 title "medium", "" using 1:3 with linespoints lw 2 title "hierarchy", \
  "" using 1:4 with linespoints lw 2 title "exhaustive (beyond a minute: extrapolated)", \
  "" using 1:5 with linespoints dt 2 title "2010: grid", "" using 1:6 with linespoints dt 2 title "2010: exhaustive"
PLOT
fi

# Table 3 and figures 8 to 11: one sphere each, of simple transparency and of a dielectric.
echo
echo "| figure | material, index | seconds | paper |"
echo "| --- | --- | ---: | ---: |"
paper=(216 253 213 253)
figure=8
for index in 1.0 1.33; do
  for kind in transparent dielectric; do
    sphere=1; other=2
    [ $kind = transparent ] || { sphere=2; other=1; }
    time=$(seconds "$arcus" render "$scenes/dielectric_spheres.toml" -o "$out/figure_$figure.exr" --set "$size" --set camera.fov_deg=30 \
      --set "surface.$sphere.material.index={ n = $index }" --set "surface.$sphere.shape.centre_m=[0, 0, 1]" --set "surface.$other.shape.centre_m=[0, -50, 1]")
    echo "| $figure | $kind, $index | $time | ${paper[figure - 8]} |"
    figure=$((figure + 1))
  done
done

# Figures 6 and 7: matte surfaces; 12 and 13: the gasket, whole and from near.
echo
echo "| figure | what | seconds | paper |"
echo "| --- | --- | ---: | ---: |"
echo "| 6 | matte, 400 samples, depth 7 | $(seconds "$arcus" render "$scenes/matte.toml" -o "$out/figure_6.exr" --set "$size" --spp 400) | 434 |"
echo "| 12 | gasket | $(seconds "$arcus" render "$scenes/gasket.toml" -o "$out/figure_12.exr" --set "$size" --spp 64) | |"
echo "| 13 | gasket, from near | $(seconds "$arcus" render "$scenes/gasket.toml" -o "$out/figure_13.exr" --set "$size" --spp 64 --set camera.fov_deg=7) | |"
echo "| 7 | matte, 4000 samples, depth 7 | $(seconds "$arcus" render "$scenes/matte.toml" -o "$out/figure_7.exr" --set "$size" --spp 4000) | 10697 |"
