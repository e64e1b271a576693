#!/usr/bin/env bash
# A farm on a Slurm of two nodes: what becomes of it when tasks, nodes, the controller, disks, tiles and scenes fail. Usage: slurm_test.sh ARCUS
# Needs root and Slurm's daemons; ends with 77 (skipped) where they are not there.
ARCUS=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if [ "$(id -u)" -ne 0 ] || ! command -v slurmctld slurmd munged sbatch >/dev/null; then
  echo "skipped: needs root, slurmctld, slurmd, slurm-client and munge"
  exit 77
fi
source "$here/shell_kit.sh"
slurm() { bash "$here/slurm_local.sh" "$@"; }
cluster=$work/slurm
trap 'slurm stop "$cluster"; cd /; sleep 0.5; rm -rf "$work"' EXIT

has_tiles() { [ "$(find "$1" -name 'tile_*.tile' | wc -l)" -ge "$2" ]; }

# begin FOLDER [OPTIONS]: a farm of seven tiles of the scene in the background, said into FOLDER.txt.
begin() {
  local folder=$1
  shift
  timeout 300 "$ARCUS" farm "$scene" --out "$folder" --engine slurm --tiles 7 --tiles-per-task 1 --checkpoint-seconds 0.2 "$@" >"$folder.txt" 2>&1 &
  farm=$!
}
# end FOLDER CODE: it ends with that.
end() {
  checks=$((checks + 1))
  wait "$farm"
  local found=$?
  cp "$1.txt" "$work/.stderr"
  [ "$found" -eq "$2" ] || complain "the farm $1 ended with $found, not $2"
}
says() { check "the farm $1 does not say /$2/" grep -qE -- "$2" "$1.txt"; }
is_whole_picture() { check "the picture of $1 differs" are_equal "$1/${scene%.toml}.exr" "whole_$scene.exr"; }

must "$ARCUS" author box --optical-depth 1 --phase-type hg -o box.vdb
# Tiles of some seconds, to be met while they are rendered, and of an instant.
cat >long.toml <<'SCENE'
[render]
samples_per_pixel = 3000
[camera]
resolution = [48, 32]
position_m = [0, -2000, 0]
[film]
channels = ["rgb", "variance"]
[[medium]]
vdb = "box.vdb"
SCENE
sed 's/3000/100/' long.toml >short.toml
sed 's/3000/20000/' long.toml >longest.toml
must "$ARCUS" render long.toml -o whole_long.toml.exr --no-png
must "$ARCUS" render short.toml -o whole_short.toml.exr --no-png
scene=short.toml

expect 1 'Slurm does not answer|cannot be started' env SLURM_CONF="$work/none.conf" "$ARCUS" farm short.toml --out none --engine slurm
absent none

# Without RequeueExit: tasks put themselves back.
REQUEUE_EXIT='' slurm start "$cluster" 2 1 || exit 1
export SLURM_CONF=$cluster/slurm.conf
set +m

# Two nodes; one process makes the same bits. A second time nothing is submitted.
begin plain
end plain 0
says plain 'submitted: job array'
is_whole_picture plain
check 'the dependent merge says what it should not' test ! -s plain/log/merge.txt
stat -c '%n %Y %i' plain/tile* >before.txt
expect 0 'all tiles are there' "$ARCUS" farm short.toml --out plain --engine slurm
stat -c '%n %Y %i' plain/tile* >after.txt
check 'tiles that are there were made again' cmp before.txt after.txt

scene=long.toml

# A task killed, twice: it goes on from its checkpoint.
begin killed
for _ in 1 2; do
  check 'no checkpoint is written' until_true 60 is_checkpointed killed
  for process in $(workers killed); do kill -9 "$process"; done
  sleep 1
done
end killed 0
is_whole_picture killed
check 'the log does not say that a task was killed' grep -rq 'killed (137)' killed/log

# Interrupted watching: the queue goes on, and so does the same command.
begin watched
check 'no worker starts' until_true 60 has_worker watched
kill -TERM "$farm"
end watched 143
says watched 'goes on: job array'
begin watched
end watched 0
says watched 'going on with what is in the queue'
is_whole_picture watched

# A node lost with its daemon and its task.
begin lost
check 'no worker starts' until_true 60 has_worker lost
daemon=$(cat "$cluster/slurmd-n1.pid")
kill -9 "$daemon"
parent_of() { ps -o ppid= -p "$1" | tr -d ' '; }
for process in $(workers lost); do
  tr '\0' '\n' 2>/dev/null <"/proc/$process/environ" | grep -qx 'SLURMD_NODENAME=n1' || continue
  shell=$(parent_of "$process")
  kill -9 "$(parent_of "$shell")" "$shell" "$process"  # the step's daemon first: nobody is left to report
done
rm -f "$cluster/slurmd-n1.pid"
check 'the node is not given up' until_true 60 sh -c 'sinfo -h -N -n n1 -o %t | grep -q down'
end lost 0
is_whole_picture lost
slurm node "$cluster" 1
check 'the node does not come back' until_true 30 sh -c '[ "$(sinfo -h -N -n n1 -o %t)" = idle ]'

# The controller restarted while tasks run. What it has not saved yet, which takes it up to eight seconds, it forgets, and then gives up the node.
scene=longest.toml
must "$ARCUS" render longest.toml -o whole_longest.toml.exr --no-png
begin controller
check 'no worker starts' until_true 60 has_worker controller
sleep 10
check 'tasks are too short to be met' test ! -e controller/tile_6_of_7.tile
kill -9 "$(cat "$cluster/slurmctld.pid")"
sleep 2
slurm controller "$cluster"
end controller 0
is_whole_picture controller

scene=short.toml

# Tiles damaged on the disk, after the fact and before the merge.
truncate -s 3000 plain/tile_2_of_7.tile
printf '\x5a' | dd of=plain/tile_4_of_7.tile bs=1 seek=3000 conv=notrunc status=none
expect 0 'damaged_tiles: 2,4' "$ARCUS" status plain
begin plain
end plain 0
says plain 'submitted'
is_whole_picture plain

# Two workers for every tile.
begin raced --no-wait
end raced 0
sbatch --parsable --array=0-6 -o raced/log/again_%a.txt raced/task.sh >"$work/.stdout"
begin raced
end raced 0
check 'the second array does not end' until_true 60 sh -c '[ -z "$(squeue -h)" ]'
check 'one of the workers failed' sh -c 'cat raced/log/again_*.txt | (! grep -q .)'
is_whole_picture raced

scene=long.toml

# The scene edited in the middle, and mended.
begin edited
check 'no tile is made' until_true 60 has_tiles edited 1
cp long.toml kept.toml
sed -i 's/samples_per_pixel = 3000/samples_per_pixel = 3001/' long.toml
end edited 4
says edited 'samples_per_pixel is 3000 there and 3001 here'
says edited 'tasks are not done'
expect 3 'samples_per_pixel is 3000 there and 3001 here' "$ARCUS" farm long.toml --out edited --engine slurm
cp kept.toml long.toml
begin edited
end edited 0
is_whole_picture edited

# A medium that the workers do not find.
begin gone
check 'no tile is made' until_true 60 has_tiles gone 1
mv box.vdb kept.vdb
end gone 4
says gone 'box.vdb'
mv kept.vdb box.vdb
begin gone
end gone 0
is_whole_picture gone

scene=short.toml

# A disk that is full: a small one where it can be mounted, or else files that may not grow.
mkdir full
cat >small <<SMALL
#!/bin/sh
if [ -e "$work/is_full" ]; then trap '' XFSZ; ulimit -f 4; fi
exec "$ARCUS" "\$@"
SMALL
chmod +x small
if mount -t tmpfs -o size=150k none full 2>/dev/null; then
  trap 'slurm stop "$cluster"; cd /; sleep 0.5; umount "$work/full" 2>/dev/null; rm -rf "$work"' EXIT
  begin full
  end full 4
  mount -o remount,size=10m full
else
  touch is_full
  begin full --program "$work/small"
  end full 4
  rm is_full
fi
says full 'cannot|could not|full'
begin full --program "$work/small"
end full 0
is_whole_picture full
umount full 2>/dev/null

# Clocks that differ: a node an hour late, and one an hour early.
begin clocks --no-wait
end clocks 0
check 'the array does not end' until_true 60 sh -c '[ -z "$(squeue -h)" ]'
is_whole_picture clocks
touch -d '1 hour ago' clocks/tile_0_of_7.tile clocks/tile_1_of_7.tile
touch -d 'now + 1 hour' clocks/tile_2_of_7.tile
rm clocks/tile_3_of_7.tile
expect 0 'seconds_left: [0-9]' "$ARCUS" status clocks
begin clocks
end clocks 0
is_whole_picture clocks

# With RequeueExit=75, as clusters may have it.
slurm stop "$cluster"
check 'the daemons do not end' until_true 30 sh -c "! pgrep -f 'slurm(ctld|d -N)' | xargs -r -I{} grep -lz '^SLURM_CONF=$cluster/' /proc/{}/environ 2>/dev/null | grep -q ."
cluster=$work/slurm2
slurm start "$cluster" 2 1 || exit 1
export SLURM_CONF=$cluster/slurm.conf
scene=long.toml
begin engine
check 'no checkpoint is written' until_true 60 is_checkpointed engine
for process in $(workers engine); do kill -9 "$process"; done
end engine 0
is_whole_picture engine

finish
