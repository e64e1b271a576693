# What the tests of the command line share; to be sourced. Needs: ARCUS, the program.
# Works in a folder of its own with a phase cache of its own; both are removed at the end.

set -u
work=$(mktemp -d "${TMPDIR:-/tmp}/arcus_test.XXXXXX")
trap 'rm -rf "$work"' EXIT
export XDG_CACHE_HOME="$work/cache"
cd "$work" || exit 1
failures=0
checks=0

complain() {
  failures=$((failures + 1))
  echo "FAILED: $*"
  sed 's/^/    /' "$work/.stderr" | head -5
}

# expect CODE REGEX COMMAND...: the command ends with CODE and its stderr (with stdout) matches the extended REGEX.
# Nothing half-written may stay: no temporary file, whatever happens.
expect() {
  local code=$1 regex=$2 found
  shift 2
  checks=$((checks + 1))
  "$@" >"$work/.stdout" 2>"$work/.stderr"
  found=$?
  [ "$found" -eq "$code" ] || complain "'$*' ended with $found, not $code"
  cat "$work/.stdout" "$work/.stderr" | grep -qE -- "$regex" || complain "'$*' did not say /$regex/"
  if find "$work" -name '.*.part*' | grep -q .; then complain "'$*' left a temporary file"; rm -f "$work"/.*.part*; fi
}

# must COMMAND...: the command succeeds.
must() {
  checks=$((checks + 1))
  "$@" >"$work/.stdout" 2>"$work/.stderr" || complain "'$*' ended with $?"
}

# check WHAT COMMAND...: the command succeeds; its own output is of no interest.
check() {
  local what=$1
  shift
  checks=$((checks + 1))
  "$@" >"$work/.stdout" 2>"$work/.stderr" || complain "$what"
}

are_equal() { "$ARCUS" compare "$1" "$2" | grep -q 'pixels compared; equal'; }

# until_true SECONDS COMMAND...: tries a command until it succeeds.
until_true() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ "$SECONDS" -lt "$end" ] || return 1
    sleep 0.05
  done
}

# Workers on a folder of tiles, by process id: those of `arcus tile`, not the shells that started them.
workers() { pgrep -f "^$ARCUS tile .*--out $1( |\$)"; }
has_worker() { [ -n "$(workers "$1")" ]; }
is_checkpointed() { [ -n "$(find "$1" -name '*.checkpoint')" ]; }

# absent FILE...: none of the files exists.
absent() {
  checks=$((checks + 1))
  local file
  for file in "$@"; do [ ! -e "$file" ] || complain "$file exists"; done
}

finish() {
  echo "$checks checks, $failures failed"
  [ "$failures" -eq 0 ]
}
