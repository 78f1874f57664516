# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Checks shell scripts, for tests that source this file. `failed` is 1 after a problem.
failed=0

problem() {
  printf 'problem: %s\n' "$*" >&2
  failed=1
}

# ends STATUS TEXT COMMAND...: checks that the command ends with STATUS, and that its output contains TEXT.
ends() {
  local status=0 wanted=$1 text=$2 output
  shift 2
  output=$("$@" 2>&1) || status=$?
  if ((status != wanted)) || [[ $output != *"$text"* ]]; then
    problem "$*: expected the status $wanted and '$text', got $status and: $output"
  fi
}

# tree_of FOLDER: prints the SHA-256 and the path of each file of the folder, and the target of each link.
tree_of() {
  (cd "$1" && find . -type f -print0 | sort -z | xargs -0 -r sha256sum && find . -type l -printf '%p -> %l\n' | sort)
}

# keeps FOLDER COMMAND...: checks that the command succeeds and changes no file of the folder.
keeps() {
  local folder=$1 before after
  shift
  before=$(tree_of "$folder")
  "$@" >/dev/null 2>&1 || problem "$*: it ends with the status $?"
  after=$(tree_of "$folder")
  [[ $before == "$after" ]] || problem "$*: it changes files of $folder:"$'\n'"$(diff <(echo "$before") <(echo "$after"))"
}

# made_up ROOT PATH...: makes a tree of files. Each file has one line, which is its path.
made_up() {
  local root=$1 path
  shift
  for path in "$@"; do
    mkdir -p "$(dirname "$root/$path")"
    printf '%s\n' "$path" >"$root/$path"
  done
}
