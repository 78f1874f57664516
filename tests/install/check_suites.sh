#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_suites.sh CTEST SOURCE_DIR BUILD_DIR SCRATCH_FOLDER
# ./run test must omit the slow tests and no others. ./run quick must contain no slow test, and continuous integration must run
# every part. CTest adds the fixtures of a chosen test, so only a slow test may have a slow fixture.
set -euo pipefail
ctest=$1 source=$2 build=$3 scratch=$4

problem() {
  echo "problem: $*" >&2
  exit 1
}
names() { # arguments: options of ctest
  "$ctest" --test-dir "$build" -N "$@" | sed -nE 's/^ *Test +#[0-9]+: ([^ ]+).*/\1/p' | sort
}

all=$(names) slow=$(names -L slow) plain=$(names -LE slow) quick=$(names -L quick)
[[ $slow && $plain && $quick ]] || problem "a suite is empty"
both=$(comm -12 <(cat <<<"$slow") <(cat <<<"$plain"))
[[ ! $both ]] || problem "slow, and yet in ./run test: $both"
[[ $(sort <<<"$slow"$'\n'"$plain") == "$all" ]] || problem "the two suites are not all tests"
both=$(comm -23 <(cat <<<"$quick") <(cat <<<"$plain"))
[[ ! $both ]] || problem "in ./run quick and not in ./run test: $both"

# A fake `run` tests continuous integration. This fake records its arguments, and fails for a chosen argument.
rm -rf "$scratch"
mkdir -p "$scratch/.ci"
cp "$source/.ci/run" "$scratch/.ci/run"
cat >"$scratch/run" <<'STUB'
#!/bin/bash
echo "$*" >>said
[[ $1 != "${FAILING:-}" ]]
STUB
chmod +x "$scratch/run"
for failing in '' lint test sanitize fuzz; do
  rm -f "$scratch/said"
  status=0
  FAILING=$failing "$scratch/.ci/run" || status=$?
  diff <(printf '%s\n' lint 'test --all' sanitize 'fuzz 15') "$scratch/said" || problem ".ci/run does not run every part"
  [[ ($failing && $status != 0) || (! $failing && $status == 0) ]] || problem ".ci/run ends with $status where '$failing' fails"
done
rm -rf "$scratch"
