# SPDX-License-Identifier: Apache-2.0
# Doxygen's filter for riis.hpp: comments before a declaration become ///, comments behind one become ///<. The program in the
# file's head becomes a block of code.
/^\/\/ SPDX/ { print "/** @file"; in_head = 1; next }
in_head && /^\/\// {
  sub(/^\/\/ ?/, "")
  sub(/^riis\.hpp - /, "")
  if (/^  / != in_code) { in_code = !in_code; print(in_code ? "@code{.cpp}" : "@endcode") }
  print
  next
}
in_head { print "*/"; in_head = 0 }
/^ *\/\/ / { sub(/\/\/ /, "/// ") }
/[;{] +\/\/ / { sub(/ \/\/ /, " ///< ") }
{ print }
