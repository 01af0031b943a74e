#!/usr/bin/env bash
# Plants one fault at a time in a copy of the sources and asks the nets that have to catch it. A fault is a file of patches/:
#
#   # what is wrong
#   file: generator/…          where
#   old: text                  in exactly one line of it
#   new: text
#   refused: ARGUMENTS         `jourdain compile ARGUMENTS` must refuse to write: exit 70; any number of these two
#   test: TARGET FILTER        a test of that target must fail, or a model that it is built with is refused
#
# Every net of a fault must catch it, and none may fail without a fault.
set -uo pipefail
cd "$(dirname "$0")/../.."

source=${JOURDAIN_MUTATE:-build/mutate}  # laid out as this tree is: beside it, a compiler cache with relative paths knows most of it
build=$source/build/release
log=$source/build/log
patches=tests/mutants/patches
failures=0

value() { sed -n "s/^$2: //p" "$1"; }

fail() {
  echo "error: $*"
  failures=$((failures + 1))
}

copy_tree() {
  mkdir -p "$source/build"
  git ls-files --cached --others --exclude-standard | while read -r file; do
    [ -f "$file" ] || continue
    cmp -s "$file" "$source/$file" && continue
    mkdir -p "$source/$(dirname "$file")"
    cp "$file" "$source/$file"
  done
  (cd "$source" && find generator runtime templates models tests -type f) | while read -r file; do
    [ -f "$file" ] || rm "$source/$file"  # gone here since
  done
  (cd "$source" && cmake --preset release >/dev/null)
}

compile() { cmake --build "$build" -- --quiet "$@" >"$log" 2>&1; }

# net KIND ARGUMENTS: 0 where it notices nothing, 1 where it catches the fault, 2 where it is broken.
net() {
  local kind=$1 target filter
  read -r target filter <<<"$2"
  if [ "$kind" = refused ]; then
    compile jourdain || return 2
    # shellcheck disable=SC2086
    (cd "$source" && build/release/jourdain compile $2 -o build/written) >"$log" 2>&1
    case $? in
      0) return 0 ;;
      70) return 1 ;;
      *) return 2 ;;
    esac
  fi
  compile "$target" || { grep -q 'error: refused to emit' "$log" && return 1; return 2; }
  local list
  list=$("$build/$target" --gtest_list_tests --gtest_filter="$filter" 2>/dev/null | grep -c '^  ')
  [ "$list" -gt 0 ] || return 2
  "$build/$target" --gtest_brief=1 --gtest_filter="$filter" >"$log" 2>&1 && return 0
  return 1
}

# nets FILE: its nets, one a line.
nets() { sed -n 's/^\(refused\|test\): \(.*\)/\1 \2/p' "$1"; }

plant() {  # plant FAULT: changes the copy, or complains
  local file old new count
  file=$(value "$1" file) old=$(value "$1" old) new=$(value "$1" new)
  count=$(grep -cF -- "$old" "$file" 2>/dev/null)
  [ "$count" = 1 ] || { fail "$1 is stale: $count lines of $file have '$old'"; return 1; }
  local text
  text=$(cat "$file"; echo .)
  text=${text%.}
  printf '%s' "${text/"$old"/"$new"}" >"$source/$file"
  cmp -s "$file" "$source/$file" && { fail "$1 changes nothing"; return 1; }
  return 0
}

ask() {  # ask FAULT: one line of the table
  local fault=$1 caught="" missed="" kind arguments
  while read -r kind arguments; do
    net "$kind" "$arguments"
    case $? in
      0) missed+=" $kind $arguments;" ;;
      1) caught+=" $kind $arguments;" ;;
      *) fail "$fault: '$kind $arguments' does not run; see $log"; cp "$log" "$source/build/$(basename "$fault").log" ;;
    esac
  done < <(nets "$fault")
  printf '%-36s |%s%s\n' "$(basename "$fault" .patch)" "${caught:- nothing}" "${missed:+ | NOT by$missed}"
  [ -z "$missed" ] || failures=$((failures + 1))
}

faults=()
for name in "$@"; do faults+=("$patches/$name.patch"); done
[ ${#faults[@]} -gt 0 ] || faults=("$patches"/*.patch)

copy_tree
while read -r kind arguments; do
  net "$kind" "$arguments"
  [ $? = 0 ] || { fail "without a fault '$kind $arguments' fails; see $log"; cp "$log" "$source/build/sound.log"; }
done < <(for fault in "${faults[@]}"; do nets "$fault"; done | sort -u)
[ $failures = 0 ] || exit 1

printf '%-36s | caught by\n' "fault of ${#faults[@]}"
for fault in "${faults[@]}"; do
  plant "$fault" && ask "$fault"
  file=$(value "$fault" file)
  cmp -s "$file" "$source/$file" || cp "$file" "$source/$file"
done
echo "$failures of ${#faults[@]} went wrong"
[ $failures = 0 ]
