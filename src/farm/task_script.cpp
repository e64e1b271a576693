#include "src/farm/task_script.h"

#include "src/farm/farm_job.h"

namespace arcus::farm {
namespace {

// Notes for what is not plain:
// - a command runs beside the shell, so that the shell can pass a signal on; without `exec` it would be the child of another shell;
// - `wait` comes back at once where a signal is caught, hence the loop;
// - a task that the engine itself ends (TERM: cancelled, preempted) is not put back here, or nobody could cancel it; Slurm puts preempted ones back;
// - USR1 comes a minute before a time limit (sbatch --signal).
constexpr const char* task_text = R"sh(#!/bin/sh
# One task of this farm: sh task.sh NUMBER, from 0. Without a number it is the one that the engine gives. Written by `arcus farm`; start it in
# the folder where that was called.
set -f
folder=@FOLDER@
number=${1:-${SLURM_ARRAY_TASK_ID:-${PBS_ARRAY_INDEX:-$JOB_COMPLETION_INDEX}}}
# These count from 1.
[ -z "$number" ] && [ "${SGE_TASK_ID:-undefined}" != undefined ] && number=$((SGE_TASK_ID - 1))
[ -z "$number" ] && [ "${LSB_JOBINDEX:-0}" -gt 0 ] && number=$((LSB_JOBINDEX - 1))
fail() {
  echo "task.sh: $1" >&2
  exit 2
}
case $number in '' | *[!0-9]*) fail "no number of a task but '$number' found" ;; esac
[ -f "$folder/tasks.txt" ] || fail "no file $folder/tasks.txt found; start this where \`arcus farm\` was called"
tab=$(printf '\t')
grep -q "^$number$tab" "$folder/tasks.txt" || fail "no task $number in $folder/tasks.txt; they count from 0"
stopped= limit=
trap 'stopped=1; kill -TERM "$child" 2>/dev/null' TERM INT
trap 'limit=1; kill -TERM "$child" 2>/dev/null' USR1
code=0
IFS='
'
for command in $(sed -n "s/^$number$tab//p" "$folder/tasks.txt"); do
  [ -z "$stopped$limit" ] || { code=75; break; }
  unset IFS
  eval "exec $command" 2>>"$folder/log/task_$number.txt" &
  child=$!
  while :; do
    wait "$child"
    code=$?
    kill -0 "$child" 2>/dev/null || break
  done
  [ "$code" -eq 0 ] || break
done
[ "$code" -lt 128 ] || { echo "task.sh: killed ($code)" >>"$folder/log/task_$number.txt"; code=75; }
if [ "$code" -eq 75 ] && [ -z "$stopped" ] && [ -n "$SLURM_ARRAY_TASK_ID" ] && [ "${SLURM_RESTART_COUNT:-0}" -lt @RETRIES@ ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID" && sleep 60  # it ends us
fi
exit "$code"
)sh";

std::string replaced(std::string text, const std::string& name, const std::string& value) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + value.size())) text.replace(at, name.size(), value);
  return text;
}

}  // namespace

std::string task_script(const std::string& folder, int retries) {
  return replaced(replaced(task_text, "@FOLDER@", shell_quoted(folder)), "@RETRIES@", std::to_string(retries));
}

std::string merge_script(const std::vector<std::string>& commands) {
  std::string text = "#!/bin/sh\n# Joins the tiles of this farm. Written by `arcus farm`; start it in the folder where that was called.\ncode=0\n";
  for (const std::string& command : commands) text += command + " || { one=$?; [ $code -ne 0 ] || code=$one; }\n";
  return text + "exit $code\n";
}

}  // namespace arcus::farm
