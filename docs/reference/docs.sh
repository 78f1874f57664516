# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# ./run docs, which reads this file. It uses $build and functions of `run` and of python/python.sh.

# Packages that ./run docs needs. The last one is for the Python package. FORD (for the Fortran pages), pdoc (for the
# Python pages) and latex2mathml (for the formulas) come from PyPI.
docs_packages=(doxygen python3-venv libjs-bootstrap5 fonts-lmodern
  g++ cmake ninja-build libembree-dev libtbb-dev nlohmann-json3-dev python3-dev)
ford_version=7.0.13
pdoc_version=16.0.0
latex2mathml_version=3.81.1

# ./run docs
#   Makes the documentation as one site, out/docs/index.html: the C, C++, Fortran and Python interfaces, the pages, the figures,
#   and a search through all of them. It fails if a public name lacks a comment, or if a page needs a file that is missing. The
#   first run needs a network.
#
# Doxygen reads the C headers and the pages. FORD reads the Fortran modules, because Doxygen leaves out the arguments of generic
# procedures. pdoc reads the installed Python package with its stubs.
run_docs() {
  local reference=$build/reference venv=$build/docs-$ford_version-$pdoc_version-$latex2mathml_version source
  local site_tools=("ford==$ford_version" "pdoc==$pdoc_version" "latex2mathml==$latex2mathml_version" "numpy>=1.24,<3")
  packages=("${docs_packages[@]}")
  install_missing
  rm -rf out/docs "$reference"
  mkdir -p out "$reference/fortran"
  if [[ ! -e $venv/complete ]]; then
    rm -rf "$venv"
    step "an environment for the tools" "$(python_of_packages)" -m venv "$venv"
    step "FORD, pdoc and latex2mathml from PyPI" "$venv/bin/pip" install "${site_tools[@]}"
    touch "$venv/complete" # an installation that was cut off leaves a part
  fi
  # In the folder of ./run python and ./run view --check, so that the package is compiled once for all of them.
  step "build tools from PyPI" python_tools "$(python_of_packages)"
  step "build the Python package" python_wheel
  step "install it" "$venv/bin/pip" install --force-reinstall --no-deps "$(echo "$python_folder"/built/riis-*.whl)"
  # Formulas are checked first, because Doxygen continues even if its filter fails.
  step "check that every formula can be shown" "$venv/bin/python" docs/reference/markdown_pages.py ./*.md docs/*.md \
    docs/{theory,design}/*.md
  "$venv/bin/python" -B docs/reference/figures_page.py README.md docs/*.md docs/theory/*.md >"$reference/figures.md"
  step "C and pages (Doxygen)" env RIIS_DOCS_PYTHON="$venv/bin/python" doxygen docs/reference/Doxyfile
  # Copies the files to which pages link and which are not pages themselves.
  cp --parents examples/*.c examples/*.cpp examples/*.f90 examples/*.f examples/*.json examples/python/*.ipynb \
    examples/cluster/mark_pieces.sh examples/flow_fortran/{source,membrane}.f90 examples/nek5000/riis_nek.f \
    tests/marking/test_{resistance,empty_mesh}.c tests/process/test_restart.c CITATION.cff LICENSE docs/*_parameters.png out/docs
  cp /usr/share/texmf/fonts/opentype/public/lm-math/latinmodern-math.otf out/docs
  sed -i 's/( <math/(<math/g' out/docs/*.html # Doxygen inserts a blank before tags that it does not know
  step "check that every C name is documented" tests/docs/check_documented.sh doxygen . "$reference/checked"
  for source in fortran/*.f90 fortran/generated/*.f90; do
    # riis_support and riis_calls are used only by the modules themselves. riisf repeats subroutines that are documented
    # elsewhere.
    [[ $source != */riis_support.f90 && $source != */riis_calls.f90 && $source != */riisf.f90 ]] || continue
    awk -f docs/reference/fortran_comments.awk "$reference/c.tag" "$source" >"$reference/fortran/$(basename "$source")"
  done
  step "Fortran (FORD)" "$venv/bin/ford" docs/reference/ford.md
  step "make the Fortran pages independent of a network" "$venv/bin/python" docs/reference/fortran_pages.py out/docs/fortran \
    /usr/share/javascript/bootstrap5
  step "check that every Fortran name is documented" "$venv/bin/python" docs/reference/check_fortran.py docs/reference/ford.md
  step "Python (pdoc)" "$venv/bin/python" -B docs/reference/python_pages.py out/docs/python
  step "one site of all parts" "$venv/bin/python" -B docs/reference/site.py out/docs
  step "check that no file of a page is missing" "$venv/bin/python" tests/docs/check_pages.py out/docs
  say "wrote out/docs/index.html"
}
