#!/usr/bin/env bash
# Tiles of a photon map, whose photons all workers send together: killed, stopped, raced for, damaged, of another job. Usage: photon_tiles_test.sh ARCUS
ARCUS=$1
source "$(dirname "${BASH_SOURCE[0]}")/shell_kit.sh"

flip_bit() { printf "\\x$(printf %02x $(($(od -An -tu1 -j "$2" -N 1 "$1") ^ 4)))" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none; }
# ranges_in FILE: how many ranges its worker says that it has sent
ranges_in() { grep -c '^photons, range' "$1"; }

# The flask of scenes/descartes_flask.toml with fewer photons and pixels: 3 ranges, two passes to be relaxed.
cat >s.toml <<'TOML'
[render]
integrator = "photon_map"
photons = 230000
neighbours = 20
iterations = 2
passes = 2
samples_per_pixel = 2
[camera]
position_m = [1.2, 5.2, 0.7]
look_at_m = [0, 0, 0]
fov_deg = 52
resolution = [40, 35]
[sun]
azimuth_deg = 180
elevation_deg = 0
[[surface]]
name = "screen"
shape = { type = "disc", centre_m = [0, 0, 0], radius_m = 2.5, normal = [0, 1, 0], inner_radius_m = 0.12 }
material = { type = "matte", albedo = 0.8 }
[[surface]]
name = "globe"
shape = { type = "sphere", centre_m = [0, 1.6, 0], radius_m = 0.1 }
material = { type = "dielectric", index = "water" }
TOML
must "$ARCUS" render s.toml -o whole.exr --no-png

# One process after the other: the first sends, the next finds it all.
expect 0 'range 2 of 3' "$ARCUS" tile s.toml --tiles 0/3 --out d --threads 1
check 'passes are not relaxed once each' test "$(grep -c 'relaxed' "$work/.stderr")" -eq 2
stat -c '%n %Y %i' d/photons/* >before.txt
must "$ARCUS" tile s.toml --tiles 1,2/3 --out d
check 'photons that are there were sent again' test "$(ranges_in "$work/.stderr")" -eq 0
stat -c '%n %Y %i' d/photons/* >after.txt
check 'photons that are there were written again' cmp before.txt after.txt
must "$ARCUS" merge d -o m.exr --no-png
check 'merged and rendered pictures differ' are_equal m.exr whole.exr
expect 0 'photon_ranges_done: 3' "$ARCUS" status d
expect 0 '"photon_passes_relaxed": 2' "$ARCUS" status d --json

# Of another job: with the record, and with photons alone that came from elsewhere.
expect 3 'the seed is 1 there and 2 here' "$ARCUS" tile s.toml --tiles 0/3 --out d --set render.seed=2
must "$ARCUS" tile s.toml --tiles 0/3 --out other --set render.seed=2 --quiet
mkdir -p mixed && cp -r d/photons mixed/ && cp other/photons/range_2_of_3.photons mixed/photons/
expect 3 'range_2_of_3.photons: .*the seed is 2 there and 1 here' "$ARCUS" tile s.toml --tiles 0/3 --out mixed
absent mixed/tile_0_of_3.tile mixed/job.json
expect 0 'range 2 of 3' "$ARCUS" tile s.toml --tiles 0-2/3 --out mixed --force
must "$ARCUS" merge mixed -o mixed.exr --no-png
check 'the picture differs where foreign photons were overwritten' are_equal mixed.exr whole.exr

# One bit of a range and of relaxed photons, and a file cut off.
rm d/tile_0_of_3.tile
cp d/photons/range_1_of_3.photons d/photons/relaxed_1_of_2.photons .
flip_bit d/photons/range_1_of_3.photons 1000000
flip_bit d/photons/relaxed_1_of_2.photons 1000000
expect 0 'photon_ranges_done: 2' "$ARCUS" status d
expect 0 'range_1_of_3.photons: the file is damaged.* made again' "$ARCUS" tile s.toml --tiles 0/3 --out d
cp .stderr damaged.txt
expect 0 'relaxed_1_of_2.photons: the file is damaged.* made again' cat damaged.txt
check 'a range made again differs' cmp range_1_of_3.photons d/photons/range_1_of_3.photons
check 'relaxed photons made again differ' cmp relaxed_1_of_2.photons d/photons/relaxed_1_of_2.photons
rm d/tile_0_of_3.tile
truncate -s 100000 d/photons/range_0_of_3.photons
expect 0 'it ends early.* made again' "$ARCUS" tile s.toml --tiles 0/3 --out d
must "$ARCUS" merge d -o m.exr --no-png
check 'the picture after damage differs' are_equal m.exr whole.exr

# More photons on one thread, so that workers can be killed, stopped and raced in the middle: 5 ranges.
more='--set render.photons=500000 --set render.iterations=1 --threads 1'
"$ARCUS" render s.toml -o more.exr --no-png $more 2>/dev/null
start() {  # start FOLDER: a worker, and waits until it has sent a range
  env --default-signal=INT "$ARCUS" tile s.toml --tiles 1/2 --out "$1" $more 2>"$1.txt" &
  worker=$!
  local tries=0
  until grep -qs '^photons, range' "$1.txt" || ! kill -0 "$worker" 2>/dev/null || [ $((tries++)) -gt 600 ]; do sleep 0.02; done
}
set +m
start killed
kill -9 "$worker"
wait "$worker" 2>/dev/null
for signal in TERM INT; do
  checks=$((checks + 1))
  start "stopped_$signal"
  kill "-$signal" "$worker"
  wait "$worker"
  found=$?
  [ "$signal:$found" = TERM:75 ] || [ "$signal:$found" = INT:130 ] || complain "SIG$signal ended the sending with $found"
  check 'a stopped worker has sent everything' test ! -e "stopped_$signal/photons/relaxed_0_of_2.photons"
  check 'a stopped worker leaves no range' bash -c "ls stopped_$signal/photons/range_*.photons"
  check 'a stopped worker leaves half a range' bash -c "! ls -A stopped_$signal/photons | grep -q part"
done
sent_before=$(ls killed/photons/range_*.photons | wc -l)
must "$ARCUS" tile s.toml --tiles 0,1/2 --out killed $more
check 'what a killed worker had sent was sent again' test "$(ranges_in "$work/.stderr")" -eq $((5 - sent_before))
check 'the next run does not clear away what a killed one has left' bash -c '! ls -A killed/photons | grep -q part'
expect 4 'missing 0,1' "$ARCUS" merge stopped_TERM -o n.exr
"$ARCUS" tile s.toml --tiles 0/2 --out raced $more 2>race_0.txt &
first=$!
"$ARCUS" tile s.toml --tiles 1/2 --out raced $more 2>race_1.txt
check 'one of two workers on the photons failed' test $? -eq 0
wait "$first"
check 'the other of two workers on the photons failed' test $? -eq 0
# Two may list the folder at the same moment; all else is sent once.
check 'two workers do not share the sending' test $(($(ranges_in race_0.txt) + $(ranges_in race_1.txt))) -le 7
check 'two workers relax the same passes' test "$(cat race_?.txt | grep -c relaxed)" -le 3
for folder in killed raced; do
  must "$ARCUS" merge "$folder" -o "$folder.exr" --no-png
  check "the picture of $folder differs" are_equal "$folder.exr" more.exr
done
# One process is stopped while it sends, too: a picture of what is there, nothing, and soon.
checks=$((checks + 1))
"$ARCUS" render s.toml -o stopped.exr --no-png --quiet --threads 1 --set render.photons=100000000 2>/dev/null &
worker=$!
sleep 0.5
kill -TERM "$worker"
begin=$(date +%s%N)
wait "$worker"
found=$?
[ "$found" -eq 143 ] || complain "SIGTERM ended a render that sends photons with $found"
check 'a render that sends photons ends late' test $((($(date +%s%N) - begin) / 1000000)) -lt 5000

finish
