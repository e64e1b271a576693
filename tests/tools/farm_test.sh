#!/usr/bin/env bash
# Farms by GNU parallel and by printed commands: planned, killed, interrupted, changed, animated. Usage: farm_test.sh ARCUS
# slurm_test.sh has those by Slurm.
ARCUS=$1
source "$(dirname "${BASH_SOURCE[0]}")/shell_kit.sh"

must "$ARCUS" author box --optical-depth 1 --phase-type hg -o box.vdb
printf '[render]\nsamples_per_pixel = 8\n[camera]\nresolution = [48, 32]\nposition_m = [0, -2000, 0]\n[film]\nchannels = ["rgb", "variance"]\n[[medium]]\nvdb = "box.vdb"\n' >s.toml
must "$ARCUS" render s.toml -o whole.exr --no-png
tiles='--tiles 6 --tiles-per-task 2'

# What is wrong is said before anything is made.
expect 2 'A:B expected' "$ARCUS" farm s.toml --out d --frames 3
expect 2 'no --set that changes' "$ARCUS" farm s.toml --out d --frames 1:3
expect 2 'elevation_deg' "$ARCUS" farm s.toml --out d --frames 1:3 --set sun.elevation_deg=0..200
expect 2 'exr expected' "$ARCUS" farm s.toml --out d -o d.png
expect 2 '1 to 1536 expected' "$ARCUS" farm s.toml --out d --tiles 1537
sed 's/box.vdb/gone.vdb/' s.toml >gone.toml
expect 2 'gone.vdb' "$ARCUS" farm gone.toml --out d
absent d
mkdir none
expect 1 'GNU parallel' env PATH="$work/none:/bin/none" "$ARCUS" farm s.toml --out d
absent d

# One command: plan, tiles, picture. Another time there is nothing to do, and what is missing is made.
expect 0 'd/s.exr and .png' "$ARCUS" farm s.toml --out d --jobs 2 $tiles
check 'farm and render make different pictures' are_equal d/s.exr whole.exr
check 'farm makes no PNG' test -s d/s.png
check 'there is no job log' grep -q 'task.sh 2$' d/joblog.tsv
expect 0 'all tiles are there' "$ARCUS" farm s.toml --out d --jobs 2
rm d/tile_3_of_6.tile
truncate -s 3000 d/tile_4_of_6.tile
must "$ARCUS" farm s.toml --out d --jobs 2 --quiet
check 'a repaired picture differs' are_equal d/s.exr whole.exr
must "$ARCUS" farm s.toml --out planned --quiet
check 'a planned picture differs' are_equal planned/s.exr whole.exr

# Another scene in the same folder.
expect 3 '\-\-set is .* there' "$ARCUS" farm s.toml --out d --set render.seed=2
expect 3 'tiles is 6 there and 7 here' "$ARCUS" farm s.toml --out d --tiles 7
sed 's/= 8/= 9/' s.toml >kept.toml
cp s.toml s.kept
cp kept.toml s.toml
expect 3 'samples_per_pixel is 8 there and 9 here' "$ARCUS" farm s.toml --out d
mv s.kept s.toml
echo '{' >d/farm.json
expect 3 'farm.json: is damaged' "$ARCUS" farm s.toml --out d
rm d/farm.json
expect 0 'all tiles are there' "$ARCUS" farm s.toml --out d

# Printed commands, and the scripts that other engines start by a number.
"$ARCUS" farm s.toml --out 'p q' --engine print $tiles >commands.txt 2>"$work/.stderr"
check 'not one command a task' test "$(wc -l <commands.txt)" -eq 3
check 'a printed command fails' sh -c "$(head -n 1 commands.txt)"
check 'task.sh with an argument' sh 'p q/task.sh' 1
check 'task.sh in an indexed job of Kubernetes' env JOB_COMPLETION_INDEX=2 sh 'p q/task.sh'
check 'task.sh under Grid Engine' env SGE_TASK_ID=1 sh 'p q/task.sh'
check 'task.sh under LSF' env LSB_JOBINDEX=1 sh 'p q/task.sh'
check 'task.sh under PBS' env PBS_ARRAY_INDEX=1 sh 'p q/task.sh'
expect 2 'no task 3' sh 'p q/task.sh' 3
expect 2 'no number' sh 'p q/task.sh'
expect 2 'no number' sh 'p q/task.sh' 1x
expect 2 'where .arcus farm. was called' sh -c 'cd none && sh "../p q/task.sh" 1'
must sh 'p q/merge.sh'
check 'the picture of printed commands differs' are_equal 'p q/s.exr' whole.exr
check 'commands are printed for tiles that are there' test -z "$("$ARCUS" farm s.toml --out 'p q' --engine print 2>/dev/null)"

# An animation.
expect 0 'f/s.0011.exr' "$ARCUS" farm s.toml --out f --frames 9:11 --set sun.elevation_deg=10..30 --set 'render.seed={frame}' --tiles 2 --tiles-per-task 2
must "$ARCUS" render s.toml -o frame.exr --no-png --set sun.elevation_deg=20 --set render.seed=10
check 'a frame differs' are_equal f/s.0010.exr frame.exr
expect 0 'done: 2' "$ARCUS" status f/frame_0009
expect 0 'frames_done: 3' "$ARCUS" status f
rm f/frame_0010/tile_1_of_2.tile
expect 0 'frames_to_make: 10' "$ARCUS" status f
expect 2 'one frame.s folder expected' "$ARCUS" status f --missing
must "$ARCUS" farm s.toml --out f --frames 9:11 --set sun.elevation_deg=10..30 --set 'render.seed={frame}' --quiet
check 'a frame that was made again differs' are_equal f/s.0010.exr frame.exr

# A host with ssh, played by a script that runs the command here.
printf '#!/bin/sh\nwhile [ "$1" != host ]; do shift; done\nshift\n[ "$1" != -- ] || shift\nexport SHELL=/bin/sh\necho used >>"%s/ssh.txt"\nexec sh -c "$*"\n' "$work" >ssh
chmod +x ssh
must env PARALLEL_SSH="$work/ssh" "$ARCUS" farm s.toml --out h --hosts 2/host $tiles --quiet
check 'no host was asked' test -s ssh.txt
check 'the picture of a host differs' are_equal h/s.exr whole.exr

# Tasks that take some seconds: killed, they are begun again; interrupted, the same command goes on.
sed -i 's/= 8/= 1000/' s.toml
must "$ARCUS" render s.toml -o whole.exr --no-png
set +m
begin() {
  "$ARCUS" farm s.toml --out "$1" --jobs 2 --tiles 4 --tiles-per-task 1 --checkpoint-seconds 0.1 >"$1.txt" 2>&1 &
  farm=$!
}
begin killed
check 'no checkpoint is written' until_true 30 is_checkpointed killed
for process in $(workers killed); do kill -9 "$process"; done
wait "$farm"
check 'a farm with killed tasks failed' test $? -eq 0
check 'the log says nothing of a killed task' grep -rq 'killed (137)' killed/log
check 'the picture of killed tasks differs' are_equal killed/s.exr whole.exr
for signal in TERM INT; do
  checks=$((checks + 1))
  env --default-signal=INT "$ARCUS" farm s.toml --out "$signal" --jobs 2 --tiles 4 --tiles-per-task 1 >"$signal.txt" 2>&1 &
  farm=$!
  until_true 30 has_worker "$signal"
  sleep 0.3
  kill "-$signal" "$farm"
  wait "$farm"
  found=$?
  [ "$signal:$found" = TERM:143 ] || [ "$signal:$found" = INT:130 ] || complain "SIG$signal ended a farm with $found"
  check 'workers of a farm outlive it' sh -c "! pgrep -f '^$ARCUS tile .*--out $signal( |\$)'"
  check 'workers of a farm leave no checkpoint' is_checkpointed "$signal"
  must "$ARCUS" farm s.toml --out "$signal" --jobs 2 --quiet
  check 'an interrupted picture differs' are_equal "$signal/s.exr" whole.exr
done

# 64 tiles have the bits of one process.
must "$ARCUS" farm s.toml --out many --jobs 2 --tiles 64 --tiles-per-task 16 --quiet
check 'the picture of 64 tiles differs' are_equal many/s.exr whole.exr

# A task that cannot be done: what it said is repeated, and the same command goes on.
printf '#!/bin/sh\necho "small: no space" >&2\nexit 1\n' >small
chmod +x small
expect 4 'task 0: small: no space' "$ARCUS" farm s.toml --out small_disk --tiles 2 --tiles-per-task 1 --program "$work/small" --retries 0
must "$ARCUS" farm s.toml --out small_disk --quiet
check 'the picture after failures differs' are_equal small_disk/s.exr whole.exr

finish
