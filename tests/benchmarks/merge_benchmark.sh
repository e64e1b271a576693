#!/usr/bin/env bash
# 10,000 tiles of 7680 x 4320 pixels with RGB and 20 spectral bins: seconds and memory to look at them and to merge them. Prints a
# Markdown table. Takes five minutes, half of them to write the tiles, and 10 GB under FOLDER, where the tiles stay for another run.
# Usage: merge_benchmark.sh ARCUS FOLDER   (build the target write_noisy_tiles first)
set -euo pipefail
usage="usage: merge_benchmark.sh ARCUS FOLDER"
arcus=$(realpath "${1:?$usage}")
write_tiles=$(dirname "$arcus")/tests/write_noisy_tiles
mkdir -p "${2:?$usage}"
cd "$2"
cat >scene.toml <<'END'
[render]
samples_per_pixel = 16
[camera]
resolution = [7680, 4320]
[film]
channels = ["rgb", "spectral"]
END
[ -e tiles/tile_9999_of_10000.tile ] && [ "$("$arcus" status tiles --missing)" = "" ] || "$write_tiles" scene.toml 10000 tiles

measure() {  # measure TITLE COMMAND...
  local title=$1 begin end program peak=0 now
  shift
  begin=$(date +%s.%N)
  "$@" >log 2>&1 &
  program=$!
  while kill -0 $program 2>/dev/null; do
    now=$(awk '/^VmHWM:/ {print $2}' /proc/$program/status 2>/dev/null || true)
    [ "${now:-0}" -gt $peak ] && peak=$now
    sleep 0.1
  done
  wait $program || { cat log >&2; exit 1; }
  end=$(date +%s.%N)
  awk -v title="$title" -v b="$begin" -v e="$end" -v p="$peak" 'BEGIN {printf "| %s | %.1f s | %.2f GiB |\n", title, e - b, p / 1048576}'
}

echo "| | time | most memory |"
echo "| --- | --- | --- |"
measure "headers of all tiles" "$arcus" status tiles --headers-only
measure "all of all tiles" "$arcus" status tiles
measure "merged, EXR alone" "$arcus" merge tiles -o merged.exr --no-png
measure "merged, EXR and PNG" "$arcus" merge tiles -o merged.exr
ls -l merged.exr merged.png | awk '{printf "%s: %.2f GB\n", $NF, $5 / 1e9}'
rm merged.exr merged.png
