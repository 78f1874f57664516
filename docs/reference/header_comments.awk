# SPDX-License-Identifier: Apache-2.0
# Doxygen's filter for the C headers, which are written for readers of the headers: plain comments become Doxygen's.
#   comment before a declaration -> /**;  after a field or value -> /**<;  banner of a section -> a group;
#   the first -> the file's
#   "  `name`: text" in a function's comment -> @param;  "Errors: " -> a paragraph;  other indented lines -> verbatim
function verbatim(on) {
  if (on != in_verbatim) print(on ? " * @verbatim" : "@endverbatim")
  in_verbatim = on
}

# One line of text inside a comment before a declaration, without its " * ".
function text_line(text) {
  if (text ~ /^- /) in_list = 1
  else if (text !~ /^  /) in_list = 0
  if (kind == "file" && text ~ /^  / && !in_list) {
    verbatim(1)
    print text
    return
  }
  verbatim(0)
  if (!in_list && match(text, /^  `[a-z][a-z_0-9]*`(, `[a-z][a-z_0-9]*`)*:? /)) {
    names = substr(text, 3, RLENGTH - 3)
    gsub(/[ `:]/, "", names)
    print " * @param " names substr(text, RLENGTH)
    in_parameters = 1
    return
  }
  if (in_parameters && text !~ /^  /) {
    print " *" # ends the last parameter
    in_parameters = 0
  }
  if (sub(/^Errors: /, "", text)) print " * @par Errors"
  print " * " text
}

BEGIN { kind = ""; n_sections = 0 }
{ closes = /\*\// }

kind == "" && /^\/\* SPDX/ { kind = "file"; print "/** @file"; next }
kind == "" && /^\/\* ---- / {
  print(n_sections++ ? "/** @} */" : "")
  sub(/^\/\* ---- /, "")
  sub(/ -* ?\*\/$/, "")
  word = tolower($1)
  gsub(/[^a-z]/, "", word)
  file = FILENAME
  gsub(/^.*\/|\.h$/, "", file)
  print "/** @defgroup " file "_h_" word " " $0
  print " * @{ */"
  next
}
kind == "" && /^\/\* clang-format/ { print ""; next }
kind == "" && /^\/\* / {
  kind = "before"
  in_list = in_parameters = 0
  print "/**"
  sub(/^\/\* /, " * ")
}
kind == "" && match($0, /[^ ] *\/\* /) {
  kind = "after"
  declaration = substr($0, 1, RSTART)
  sub(/\/\* /, "/**< ")
  # Doxygen gives the text to the last of "int32_t width, height;" alone: to each its own declaration.
  n_names = declaration ~ /^ .*, .*;$/ ? split(declaration, names_of, /, |;/) - 1 : 0
  text_after = ""
}

kind == "file" || kind == "before" {
  text = $0
  sub(/ *\*\/ *$/, "", text)
  sub(/^ \* ?/, "", text)
  if (kind == "file") if (sub(/^[a-z_]+\.h - /, "", text)) text = toupper(substr(text, 1, 1)) substr(text, 2)
  if (!closes || text !~ /^ *$/) text_line(text)
  if (closes) {
    verbatim(0)
    print " */"
    kind = ""
  }
  next
}
kind == "after" && n_names > 1 {
  text_after = text_after (text_after == "" ? substr($0, index($0, "/**<")) : "\n" $0)
  if (!closes) next
  type = names_of[1]
  sub(/[*]*[a-z_]+(\[[0-9]*\])?$/, "", type)
  for (i = 1; i <= n_names; ++i) print(i == 1 ? "" : type) names_of[i] "; " text_after
  kind = ""
  next
}
{ print }
kind == "after" && closes { kind = "" }
END { if (n_sections) print "/** @} */" }
