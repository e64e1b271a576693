#!/usr/bin/env bash
# A picture of 206 MiB is merged in less memory than it takes; interrupted or met with damage late, nothing of it stays.
# Usage: merge_test.sh ARCUS
ARCUS=$1
source "$(dirname "${BASH_SOURCE[0]}")/shell_kit.sh"
flip_last_byte() { printf '\x5a' | dd of="$1" bs=1 seek=$(($(stat -c %s "$1") - 2)) conv=notrunc status=none; }

printf '[render]\nsamples_per_pixel = 1\n[camera]\nresolution = [512, 1024]\n[sky]\ntype = "constant"\nradiance = 0.1\n[film]\nchannels = ["rgb", "spectral"]\nspectral_bins = 100\n' >s.toml
must "$ARCUS" tile s.toml --tiles 0-511/512 --out d --quiet

# start: a merge in the background, which Ctrl-C reaches.
start() {
  env --default-signal=INT "$ARCUS" merge d -o m.exr 2>"$work/.stderr" &
  merge=$!
}

# The libraries take 140 MiB of it.
start
peak=0
while kill -0 "$merge" 2>/dev/null; do
  now=$(awk '/^VmHWM:/ {print $2}' "/proc/$merge/status" 2>/dev/null || true)
  [ "${now:-0}" -gt "$peak" ] && peak=$now
  sleep 0.02
done
wait "$merge" || complain 'merge failed'
checks=$((checks + 1))
echo "merged in $((peak / 1024)) MiB"
[ "$peak" -gt 0 ] && [ "$peak" -lt $((300 * 1024)) ] || complain "merging took $((peak / 1024)) MiB"
rm m.exr m.png

for signal in INT TERM; do
  checks=$((checks + 1))
  start
  tries=0
  until [ -n "$(find . -name '.m.part*.exr' -size +1M)" ] || ! kill -0 "$merge" 2>/dev/null || [ $((tries++)) -gt 600 ]; do sleep 0.02; done
  kill "-$signal" "$merge"
  wait "$merge"
  found=$?
  [ "$signal:$found" = INT:130 ] || [ "$signal:$found" = TERM:143 ] || complain "SIG$signal ended a merge with $found"
  [ -z "$(find . -name '*m.*exr')" ] || complain "SIG$signal leaves a picture"
done
absent m.exr m.png

flip_last_byte d/tile_511_of_512.tile
expect 4 'not complete: damaged 511 ' "$ARCUS" merge d -o m.exr
absent m.exr m.png
finish
