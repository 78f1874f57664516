#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_script.sh SOURCE WORK
# Checks the steps of ./run cans and patch.py on made-up trees. The cases are missing sources, another version, a second call and
# an undo.
set -euo pipefail
source=$1 work=$2
# shellcheck source=tests/support/script_checks.sh
. "$source/tests/support/script_checks.sh"
rm -rf "$work"
mkdir -p "$work"
# shellcheck source=examples/cans/cans.sh
. "$source/examples/cans/cans.sh"
patch=("$(command -v python3)" -B "$cans_here/patch.py")

ends 77 "must hold CaNS 245a233 as CaNS and its fork of 2decomp-fft as 2decomp-fft" cans_check_sources ""
made_up "$work/folder" CaNS/src/main.f90 CaNS/src/bound.f90
ends 77 "must hold CaNS" cans_check_sources "$work/folder"
made_up "$work/folder" 2decomp-fft/src/decomp_2d.f90
ends 0 "" cans_check_sources "$work/folder"

# Another version is refused, and nothing changes.
cans=$work/folder/CaNS
before=$(tree_of "$work/folder")
ends 1 "known is CaNS 245a233" "${patch[@]}" "$cans"
ends 1 "known is CaNS 245a233" "${patch[@]}" "$cans" --undo
ends 1 "cannot read $work/none/src/main.f90" "${patch[@]}" "$work/none"
[[ $before == "$(tree_of "$work/folder")" ]] || problem "a refusal changed the tree"

# A file that contains the lines around the calls, and a byte that is not valid UTF-8.
cat >"$cans/src/main.f90" <<END
program cans
  use mod_updatep        , only: updatep
! $(printf '\351')
                  lambdaxyp,['c','c','c'],ap,bp,cp,arrplanp,normfftp,rhsbp%x,rhsbp%y,rhsbp%z)
      call bounduvw(cbcvel,n,bcvel,nb,is_bound,dl,dzc,dzf,u,v,w,.false.,-1)
    dpdl(:)     = -dpdl(:)*dti
end program
END
before=$(tree_of "$work/folder")
hash=$(sha256sum "$cans/src/main.f90") hash=${hash%% *}
ends 0 "has 4 calls" "${patch[@]}" "$cans" --sha256 "$hash"
(($(grep -c '! riis$' "$cans/src/main.f90") == 4)) || problem "there are not four calls: $(<"$cans/src/main.f90")"
grep -q -B 1 'call bounduvw' "$cans/src/main.f90" || problem "the call of CaNS is gone"
[[ $(grep -B 1 'call bounduvw' "$cans/src/main.f90") == *riis_valve_apply* ]] || problem "the valve comes after the boundaries"
cmp "$cans/src/riis_valve.f90" "$cans_here/riis_valve.f90" || problem "riis_valve.f90 is not in src"
keeps "$work/folder" "${patch[@]}" "$cans" --sha256 "$hash"
echo '! mine' >>"$cans/src/riis_valve.f90"
keeps "$work/folder" "${patch[@]}" "$cans" --sha256 "$hash"
ends 1 "was edited" "${patch[@]}" "$cans" --sha256 "$hash" --undo
cp "$cans_here/riis_valve.f90" "$cans/src"
ends 0 "has no call" "${patch[@]}" "$cans" --sha256 "$hash" --undo
[[ $before == "$(tree_of "$work/folder")" ]] || problem "undo left another tree"
keeps "$work/folder" "${patch[@]}" "$cans" --sha256 "$hash" --undo

# A tree is refused if an expected line is missing or occurs twice.
sed -i '/dpdl/d' "$cans/src/main.f90"
hash=$(sha256sum "$cans/src/main.f90") hash=${hash%% *}
ends 1 "0 times, not once" "${patch[@]}" "$cans" --sha256 "$hash"

# The copy is patched and built once, and the folder of the sources stays as it is.
python_of_packages() { command -v python3; }
cans_work=$work/build
ends 1 "known is CaNS 245a233" cans_copy "$work/folder"
[[ ! -e $cans_work/CaNS ]] || problem "a copy of an unknown version is kept"
mkdir -p "$cans_work/CaNS/src"
echo compiled >"$cans_work/CaNS/cans"
cans_copy "$work/folder"
keeps "$work" cans_copy "$work/folder"
ends 2 "'--shrot' is not an option" run_cans "$work/folder" --shrot
((failed)) || echo "the scripts refuse what they do not know, and undo what they did"
exit "$failed"
