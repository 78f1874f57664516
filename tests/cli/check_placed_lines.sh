#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_placed_lines.sh RIIS FOLDER INCLUDE LIBRARY CC [FC MODULES FORTRAN_LIBRARY]
# The lines of C and Fortran that riis place writes must compile and run. The lines must make the surface that the command's JSON
# makes. LIBRARY is the file libriis.so. Without FC only C is checked.
set -euo pipefail
riis=$1 folder=$2 include=$3 library=$4 cc=$5 fc=${6-} modules=${7-} fortran_library=${8-}
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
cat > aortic.json << 'END'
{"valve": "aortic", "unit": "mm", "axes": "LPS",
 "landmarks": {"nadir_right": [2.7, 40.8, 103.2], "nadir_left": [-8.8, 20.6, 102.7], "nadir_non": [14.3, 20.1, 103.8],
               "commissure_right_left": [-8.7, 35.5, 115.6], "commissure_left_non": [2.9, 13.9, 115.9],
               "commissure_right_non": [15.4, 34.5, 116.1]}}
END
for warp in none smoothed; do
  "$riis" place aortic.json --quiet --warp "$warp" --output placed.json --c lines.c --fortran lines.f90
  "$riis" surface --valve placed.json --output placed.vtp > report.txt
  read -r n_json area_json < <(sed -n 's/^surface .*: \([0-9,]*\) triangles, area \(.*\)$/\1 \2/p' report.txt | tr -d ,)
  {
    printf '#include <riis/riis.h>\n#include <stdio.h>\nint main(void) {\n'
    cat lines.c
    printf 'riis_surface_info info;\nif (riis_surface_get_info(surface, &info, sizeof info)) return puts(riis_last_error()), 1;\n'
    printf 'printf("%%lld %%.12g %%.12g %%.12g\\n", (long long)info.n_triangles, info.area, info.lower[0], info.upper[2]);\n'
    printf 'riis_surface_destroy(&surface);\nriis_valve_destroy(&valve);\nreturn 0;\n}\n'
  } > main.c
  "$cc" -std=c11 -Wall -Wextra -Werror -I"$include" main.c -o by_c "$library" "-Wl,-rpath,$(dirname "$library")"
  ./by_c > by_c.txt
  echo "C: $(< by_c.txt)"
  read -r n_triangles area lower upper < by_c.txt
  areas+=("$area")
  # The area equals the area of the JSON's surface, and the surface passes through the landmarks.
  awk -v n="$n_triangles" -v m="$n_json" -v a="$area" -v b="$area_json" -v l="$lower" -v u="$upper" 'BEGIN {
    if (n != m || (a - b) ^ 2 > 1e-10 * a * a) { print "the JSON has " m " triangles, area " b; exit 1 }
    if (l > -8 || l < -14 || u < 114 || u > 118) { print "the surface is elsewhere: " l " " u; exit 1 }
  }'
  [[ -n $fc ]] || continue
  {
    printf 'program main\n  use riis\n  implicit none\n  type(riis_valve) :: valve\n  type(riis_surface) :: surface\n'
    [[ $warp = none ]] || printf '  type(riis_warp) :: warp\n'
    printf '  type(riis_surface_info) :: info\n'
    cat lines.f90
    printf '  call surface%%get_info(info)\n'
    printf '  print "(i0, 3(1x, es22.14))", info%%n_triangles, info%%area, info%%lower(1), info%%upper(3)\n'
    printf '  call surface%%destroy()\n  call valve%%destroy()\nend program main\n'
  } > main.f90
  "$fc" -I"$modules" main.f90 -o by_fortran "$fortran_library" "$library" "-Wl,-rpath,$(dirname "$library")"
  ./by_fortran > by_fortran.txt
  echo "Fortran: $(< by_fortran.txt)"
  paste -d ' ' by_c.txt by_fortran.txt | awk '{
    for (i = 1; i <= 4; ++i) if (($i - $(i + 4)) ^ 2 > 1e-20 * $i * $i) { print "C and Fortran differ"; exit 1 }
  }'
done
[[ ${areas[0]} != "${areas[1]}" ]] || { echo "the warp changes nothing"; exit 1; }
