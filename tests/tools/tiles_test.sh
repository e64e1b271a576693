#!/usr/bin/env bash
# A picture in tiles: made again, killed, stopped, raced for, mixed up, damaged, out of space. Usage: tiles_test.sh ARCUS
ARCUS=$1
source "$(dirname "${BASH_SOURCE[0]}")/shell_kit.sh"

flip_last_byte() { printf '\x5a' | dd of="$1" bs=1 seek=$(($(stat -c %s "$1") - 2)) conv=notrunc status=none; }

must "$ARCUS" author box --optical-depth 1 --phase-type hg -o box.vdb
printf '[render]\nsamples_per_pixel = 8\n[camera]\nresolution = [48, 32]\nposition_m = [0, -2000, 0]\n[film]\nchannels = ["rgb", "variance"]\n[[medium]]\nvdb = "box.vdb"\n' >s.toml
must "$ARCUS" render s.toml -o whole.exr --no-png

# Wrong lists, folders and inputs.
expect 2 'K/N' "$ARCUS" tile s.toml --tiles 3 --out d
expect 2 'below N' "$ARCUS" tile s.toml --tiles 7/7 --out d
expect 2 '1 to 1536 expected' "$ARCUS" tile s.toml --tiles 0/1537 --out d
expect 2 'out.*required' "$ARCUS" tile s.toml --tiles 0/7
expect 2 'none' "$ARCUS" merge none -o m.exr
expect 2 'none' "$ARCUS" status none
absent d m.exr
sed 's/box.vdb/gone.vdb/' s.toml >gone.toml
expect 2 'gone.vdb' "$ARCUS" tile gone.toml --tiles 0/7 --out d
absent d
touch file
expect 1 'folder' "$ARCUS" tile s.toml --tiles 0/7 --out file
expect 2 'exr expected' "$ARCUS" merge d -o m.png

# Lists and ranges; made once; what is missing.
expect 0 'tile 6 of 7' "$ARCUS" tile s.toml --tiles 0-3,6/7 --out d
stat -c '%n %Y %i' d/* >before.txt
expect 0 '5 of 5 tiles are there' "$ARCUS" tile s.toml --tiles 0-3,6/7 --out d
stat -c '%n %Y %i' d/* >after.txt
check 'tiles that are there were made again' cmp before.txt after.txt
expect 0 '^4,5$' "$ARCUS" status d --missing
expect 0 'missing_tiles: 4,5' "$ARCUS" status d
expect 4 'missing 4,5\. .*--tiles 4,5/7' "$ARCUS" merge d -o m.exr
absent m.exr m.png
expect 0 'not complete: missing 4,5' "$ARCUS" merge d -o preview.exr --allow-partial
check 'a partial merge makes no picture' test -s preview.png
must "$ARCUS" tile s.toml --tiles "$("$ARCUS" status d --missing)/7" --out d --quiet
check '--quiet is quiet' test ! -s "$work/.stderr"
must "$ARCUS" merge d -o m.exr
check 'merged and rendered pictures differ' are_equal m.exr whole.exr
check 'merge writes no PNG' test -s m.png
check 'a complete job has missing tiles' test -z "$("$ARCUS" status d --missing)"
expect 0 'done: 7' "$ARCUS" status d --png map.png
check 'status --png makes no PNG' test -s map.png
expect 0 '"samples_per_second"' "$ARCUS" status d --json

# Another scene, seed, number of samples, cut or medium is refused and overwrites nothing.
expect 3 'the seed is 1 there and 2 here' "$ARCUS" tile s.toml --tiles 0/7 --out d --set render.seed=2
expect 3 'samples_per_pixel is 8 there' "$ARCUS" tile s.toml --tiles 0/7 --out d --set render.samples_per_pixel=9
expect 3 "sun.elevation_deg = 20' there" "$ARCUS" tile s.toml --tiles 0/7 --out d --set sun.elevation_deg=30
expect 3 'number of tiles is 7 there' "$ARCUS" tile s.toml --tiles 0/8 --out d
cp box.vdb kept.vdb
must "$ARCUS" author box --optical-depth 2 --phase-type hg -o box.vdb
expect 3 'content of box.vdb was another' "$ARCUS" tile s.toml --tiles 0/7 --out d
mv kept.vdb box.vdb
must "$ARCUS" merge d -o m.exr --no-png
must "$ARCUS" tile s.toml --tiles 0/7 --out other --set render.seed=2 --quiet
cp other/tile_0_of_7.tile d/
expect 3 'something else: 0 .*the seed is 2 there and 1 here' "$ARCUS" merge d -o m.exr
expect 3 'the seed is 2 there' "$ARCUS" tile s.toml --tiles 0/7 --out d
expect 0 'foreign_tiles: 0' "$ARCUS" status d
must "$ARCUS" tile s.toml --tiles 0/7 --out d --force
touch d/tile_1_of_9.tile
expect 3 'tile_1_of_9.tile' "$ARCUS" merge d -o m.exr
rm d/tile_1_of_9.tile

# Cut off, and one byte changed.
truncate -s 5000 d/tile_2_of_7.tile
flip_last_byte d/tile_5_of_7.tile
expect 0 'damaged_tiles: 2,5' "$ARCUS" status d
expect 4 'damaged 2,5' "$ARCUS" merge d -o n.exr
absent n.exr
check 'merge without --repair deletes' test -e d/tile_2_of_7.tile
expect 0 'it is made again' "$ARCUS" tile s.toml --tiles 2/7 --out d
expect 4 'damaged and deleted 5' "$ARCUS" merge d -o n.exr --repair
absent d/tile_5_of_7.tile
must "$ARCUS" tile s.toml --tiles 0-6/7 --out d
must "$ARCUS" merge d -o n.exr --no-png
check 'a repaired picture differs' are_equal n.exr whole.exr

# A tile that takes a few seconds on one thread: killed, stopped, raced for.
long='--set render.samples_per_pixel=1500 --checkpoint-seconds 0.1 --threads 1'
start() {  # start FOLDER: a worker, and waits until it renders
  env --default-signal=INT "$ARCUS" tile s.toml --tiles 1/2 --out "$1" $long --progress json 2>"$work/.stderr" &
  worker=$!
  local tries=0
  until grep -q '^{' "$work/.stderr" || ! kill -0 "$worker" 2>/dev/null || [ $((tries++)) -gt 300 ]; do sleep 0.05; done
}
set +m
for _ in 1 2 3 4 5; do
  start killed
  sleep "0.0$((RANDOM % 8 + 1))"
  kill -9 "$worker" 2>/dev/null
  wait "$worker" 2>/dev/null
done
check 'what five kills have left is not seen' bash -c "'$ARCUS' status killed | grep -qE '^(partial|done): 1'"
must "$ARCUS" tile s.toml --tiles 0,1/2 --out killed $long --quiet
check 'the next run does not clear away what killed ones have left' bash -c '! ls -A killed | grep -q part'
for signal in TERM INT; do
  checks=$((checks + 1))
  start "stopped_$signal"
  kill "-$signal" "$worker"
  wait "$worker"
  found=$?
  [ "$signal:$found" = TERM:75 ] || [ "$signal:$found" = INT:130 ] || complain "SIG$signal ended a tile with $found"
  check 'a stopped worker leaves a checkpoint' test -s "stopped_$signal/tile_1_of_2.checkpoint"
  expect 0 'partial: 1' "$ARCUS" status "stopped_$signal"
done
expect 0 'missing 0,1' "$ARCUS" merge stopped_TERM -o preview.exr --allow-partial --no-png
"$ARCUS" tile s.toml --tiles 1/2 --out raced $long --quiet 2>race.txt &
first=$!
"$ARCUS" tile s.toml --tiles 1/2 --out raced $long --quiet 2>>race.txt
check 'one of two workers on a tile failed' test $? -eq 0
wait "$first"
check 'the other of two workers on a tile failed' test $? -eq 0
must "$ARCUS" render s.toml -o long.exr --no-png --set render.samples_per_pixel=1500
for folder in killed stopped_TERM raced; do
  must "$ARCUS" tile s.toml --tiles 0,1/2 --out "$folder" $long --quiet
  expect 0 'long.exr' "$ARCUS" merge "$folder" -o "$folder/long.exr" --no-png
  check "the picture of $folder differs" are_equal "$folder/long.exr" long.exr
  absent "$folder/tile_1_of_2.checkpoint"
done

# No space: files that may not grow, and a full disk where one can be mounted. What was there stays.
expect 1 'cannot|could not' bash -c "trap '' XFSZ; ulimit -f 4; exec '$ARCUS' tile s.toml --tiles 0/2 --out full"
absent full/tile_0_of_2.tile
if unshare -rm true 2>/dev/null; then
  mkdir disk
  expect 1 'cannot|could not|disk full' unshare -rm bash -c "mount -t tmpfs -o size=32k none disk && '$ARCUS' tile s.toml --tiles 0/2 --out disk; code=\$?; ls -A disk | grep -q part && exit 9; exit \$code"
fi
touch "full/.tile_0_of_2.part$(uname -n)-4194305-0.tile"  # of a process that cannot be
must "$ARCUS" tile s.toml --tiles 0,1/2 --out full --quiet
absent full/.tile_0_of_2.part*
must "$ARCUS" merge full -o full.exr --no-png
check 'the picture after a full disk differs' are_equal full.exr whole.exr

finish
