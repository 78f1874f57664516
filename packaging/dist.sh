#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# dist.sh [archive | files]: makes a release from the last commit in out/dist: the source archive, its checksum and the release
# notes. It first checks that all versions agree, then makes the archive twice, in different surroundings, and compares the bytes.
# Without the word `archive` it also makes Python's wheels and the archive of the program, from the working tree, and tests them
# (wheels.sh, program.sh). Without a word it then unpacks the source archive, and runs ./run test from it in a bare Debian 12 and
# a bare Debian 13.
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")/.."
# shellcheck source=packaging/steps.sh
. packaging/steps.sh
case $* in
  '' | archive | files) ;;
  *)
    echo "./run dist: '$*' is not an argument of this command" >&2
    exit 2
    ;;
esac
[[ -e .git ]] || { echo "./run dist: the archive is made from a commit, and this is no git work tree" >&2; exit 2; }
out=$PWD/out/dist scratch=$PWD/build/dist roots=$(realpath -m -- "${RIIS_ROOTS:-.}")/build-dist

# archive_of REPOSITORY FILE: writes the last commit's archive. All times in it are the commit's time. Neither the user's umask
# nor git's settings matter.
archive_of() {
  git -C "$1" -c tar.umask=0022 -c core.autocrlf=false archive --format=tar --prefix="riis-$version/" HEAD |
    xz -6 --threads=1 >"$2"
}

# section: prints the part of CHANGELOG.md on this version.
section() { awk -v heading="## $version" 'index($0, "## ") == 1 { inside = index($0, heading) == 1; next } inside' CHANGELOG.md; }

# notes: prints the release notes.
notes() {
  local heading
  heading=$(grep -m 1 -F "## $version" CHANGELOG.md)
  printf '# riis %s\n' "${heading:3}"
  section
  # shellcheck disable=SC2016 # code of the page
  printf '\n## The archive\n\n| file | bytes | SHA-256 |\n|---|---|---|\n| %s | %s | `%s` |\n' \
    "${archive##*/}" "$(stat -c %s "$archive")" "$(sha256sum <"$archive" | cut -d ' ' -f 1)"
  # shellcheck disable=SC2016
  printf '\n`./run dist archive` makes the same bytes from commit `%s`.\n' "$(git rev-parse HEAD)"
}

git diff --quiet HEAD || say "uncommitted changes are left out of the archive"
say "the places that have the version"
packaging/check_versions.sh .
version=$(git show HEAD:CITATION.cff | sed -n 's/^version: //p')
archive=$out/riis-$version.tar.xz
[[ $(section) ]] || { echo "CHANGELOG.md: nothing about $version" >&2; exit 1; }
! grep -q "^## $version (unreleased)" CHANGELOG.md || say "CHANGELOG.md: $version is unreleased, so this is a rehearsal"

rm -rf "$out" "$scratch"
mkdir -p "$out" "$scratch"
archive_of . "$archive"
# The second archive comes from another clone, with another user's settings.
git clone --quiet --depth 1 --no-checkout "file://$PWD" "$scratch/clone"
[[ $(git -C "$scratch/clone" rev-parse HEAD) == "$(git rev-parse HEAD)" ]]
(umask 077 && TZ=XYZ-13 LC_ALL=C HOME=$scratch GIT_CONFIG_NOSYSTEM=1 archive_of "$scratch/clone" "$scratch/again.tar.xz")
cmp "$archive" "$scratch/again.tar.xz"
(cd "$out" && sha256sum "${archive##*/}" >"${archive##*/}.sha256")
notes >"$out/release-notes-$version.md"
say "made twice with the same bytes: out/dist/${archive##*/}, $(size "$archive")"
say "the release notes: out/dist/release-notes-$version.md"
[[ ${1:-} != archive ]] || exit 0

rows=$scratch/rows.tsv
for part in wheels program; do
  "packaging/$part.sh" "$rows"
done
cp out/packages/wheels/riis-*.whl out/packages/program/riis-*.tar.xz "$out"
(cd "$out" && for file in riis-*.whl riis-*-linux-"$(uname -m)".tar.xz; do sha256sum "$file" >"$file.sha256"; done)
say "for users without a compiler, in out/dist:"
(cd "$out" && ls -s --si riis-*.whl riis-*-linux-"$(uname -m)".tar.xz)
[[ ${1:-} != files ]] || exit 0

# Only these tests use these roots. In another root ninja would keep the objects of other sources, because the archive's files are
# older than those objects.
for debian in 12 13; do
  rm -rf "$scratch/tree"
  mkdir -p "$scratch/tree"
  tar -xJf "$archive" -C "$scratch/tree"
  say "./run test from the archive, in a bare Debian $debian"
  (cd "$scratch/tree/riis-$version" && RIIS_ROOTS=$roots ./run "debian$debian" "test")
done
