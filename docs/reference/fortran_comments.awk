# SPDX-License-Identifier: Apache-2.0
# awk -f fortran_comments.awk c.tag SOURCE.f90: the Fortran sources as FORD reads them, from how they are written for their
# readers. A text after its name, !<, becomes !!. In riis_c, which says only what differs from riis.h, every name gets a link to
# what riis.h says: where that is, Doxygen's c.tag tells.
FILENAME ~ /\.tag$/ {
  tag = $0
  gsub(/^ *<[a-z]*>|<\/[a-z]*> *$/, "", tag)
  if (/<compound /) struct = ""
  if (/<compound kind="struct"/) in_struct = 1
  if (/<compound kind="(file|group)"/) in_struct = 0
  if (/^    <name>/ && in_struct) struct = tag
  if (/^    <filename>/ && in_struct) place[struct] = tag
  if (/^      <name>/) name = (in_struct ? struct "." : "") tag
  if (/<anchorfile>/) file = tag
  if (/<anchor>/ && (!(name in place) || file ~ /^group/)) place[name] = file "#" tag
  next
}

# A line of a comment with a list of arguments as Markdown.
function as_markdown(text) {
  if (match(text, /^  [a-z_]+(, [a-z_]+)*  +[^ ]/)) {
    split(substr(text, 3), word, /  +/)
    return "- `" word[1] "` " substr(text, RLENGTH)
  }
  return text
}
function link(name, text) {
  if (!(name in place)) {
    print "fortran_comments.awk: riis.h has no " name > "/dev/stderr"
    exit failed = 1
  }
  return "[" text "](../../" place[name] ")"
}
function flush_comment(mark, i) {
  for (i = 1; i <= n_comment; ++i) print(mark == "" ? comment[i] : mark " " as_markdown(text_of[i]))
  n_comment = 0
}

FNR == 1 { plain = FILENAME ~ /riis_c\.f90$/ }
!plain {
  sub(/!</, "!!")
  if (match($0, /(^|[^!])! *[A-Za-z0-9_]+:/) == 0 && match($0, /![!>] *[A-Za-z0-9_-]+:/)) # else FORD takes the word for a setting
    $0 = substr($0, 1, RSTART + RLENGTH - 2) "&#58;" substr($0, RSTART + RLENGTH)
  if ($0 ~ /^ *!! +> /) sub(/> /, "\\> ") # no quotation
  if ($0 !~ /^ *![!>]     /) { # nor emphasis, but in code
    gsub(/\*_/, "\\*_")
    gsub(/_\*/, "_\\*")
    gsub(/INTEGER\*/, "INTEGER\\*")
  }
  print
  next
}

struct != "" && /^ *!!/ { print; next } # more of the field above
/^ *![>!]/ { sub(/![>!]/, "!") }
/!</ { sub(/!</, "!") }
/^ *! SPDX/ || /^ *! Written by/ || /^ *! ---/ { flush_comment(""); print; next }
/^ *!( |$)/ {
  gsub(/\*_/, "\\*_")
  comment[++n_comment] = $0
  text_of[n_comment] = $0
  sub(/^ *! ?/, "", text_of[n_comment])
  next
}
/^module riis_c$/ {
  sub(/^riis_c - /, "", text_of[1])
  for (i = 1; i <= n_comment; ++i) {
    if (text_of[i] ~ /^- /) in_list = 1
    if (text_of[i] ~ /^  / && !in_list) text_of[i] = "    " text_of[i]
    comment[i] = "!> " text_of[i]
  }
  flush_comment("")
}
match($0, /^ *(function|subroutine) riis_[a-z_]*/) && !in_code {
  name = substr($0, RSTART, RLENGTH)
  sub(/^ *[a-z]* /, "", name)
  print "!> " link(name, name) " of riis.h."
  print "!>"
  flush_comment("!>")
}
/^contains$/ { in_code = 1 }
in_code && / function riis_c_/ { flush_comment("!>") }
/^ *type, bind\(c\) :: / {
  struct = $4
  print "!> " link(struct, struct) " of riis.h."
  flush_comment("!>")
}
/^ *end type/ { struct = "" }
match($0, /parameter :: RIIS_[A-Z_0-9]*/) {
  print $0 " !! " link(substr($0, RSTART + 13, RLENGTH - 13), "riis.h")
  next
}
/^ *integer, parameter :: riis_status/ { flush_comment("!>") }
struct != "" && / :: / && !/bind\(c\)/ {
  text = ""
  if (match($0, /!.*/)) {
    text = substr($0, RSTART + 1)
    $0 = substr($0, 1, RSTART - 1)
  }
  fields = $0
  sub(/^.*:: */, "", fields)
  sub(/[^A-Za-z_].*/, "", fields)
  flush_comment("!>")
  print $0 " !! " link(struct "." fields, "riis.h") (text != "" ? ":" text : "")
  next
}
{ flush_comment(""); print }
END { if (failed) exit 1 }
