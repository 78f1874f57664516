# SPDX-License-Identifier: Apache-2.0
"""Tests fortran/bindings/generate.py with planted changes in copies of riis.h and bindings.table. The generator must write the
right lines, or refuse. A refusal names the line and changes no files. check_keywords.py is also tested with planted changes."""

import contextlib
import glob
import io
import os
import shutil
import sys
import tempfile
import unittest

SOURCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(SOURCES, "fortran", "bindings"))
import calls
import check_keywords
import generate
from header import with_included

HEADER, TABLE, SUBROUTINES = generate.HEADER, generate.TABLE, generate.SUBROUTINES
HEADERS = [os.path.relpath(path, SOURCES) for path in with_included(os.path.join(SOURCES, HEADER))]
MODULE, FIXED, EXTERNAL, INTERFACES, PUBLISHED = generate.WIDTHS
BEFORE_FUNCTION = "/* Destroys the valve. Surfaces"  # a comment of a header; functions are planted before it
IN_LAST_HEADER = "/* The phases of a valve that riis_opening_switch opens and closes. */"
FUNCTION = "RIIS_API riis_status riis_valve_planted(const riis_valve *valve, {});\n"


class Planted(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name
        for path in (*HEADERS, TABLE, SUBROUTINES, *generate.WIDTHS, *map(generate.template_of, generate.WIDTHS)):
            os.makedirs(os.path.dirname(os.path.join(self.root, path)), exist_ok=True)
            shutil.copy(os.path.join(SOURCES, path), os.path.join(self.root, path))
        self.before = self.generated()

    def text(self, path):
        with open(os.path.join(self.root, path), encoding="utf-8") as file:
            return file.read()

    def generated(self):
        return [self.text(path) for path in generate.WIDTHS]

    def plant(self, path, old, new):
        """Replaces the only occurrence of the old text. Returns its line number. HEADER stands for the header that contains the
        text. self.planted gets the path of this header."""
        if path == HEADER:
            path = next((header for header in HEADERS if old in self.text(header)), HEADER)
            self.planted = path
        text = self.text(path)
        self.assertEqual(text.count(old), 1, f"{path} does not have {old!r} once: this test is out of date")
        with open(os.path.join(self.root, path), "w", encoding="utf-8") as file:
            file.write(text.replace(old, new))
        return text.count("\n", 0, text.index(old)) + 1

    def plant_function(self, arguments, entry=""):
        """Plants a function with these arguments, and its entry in the table. Returns its line number."""
        if entry:
            self.plant(TABLE, "riis_valve_get\n", f"{entry}\nriis_valve_get\n")
        return self.plant(HEADER, BEFORE_FUNCTION, FUNCTION.format(arguments) + BEFORE_FUNCTION)

    def run_it(self, *words):
        """Returns the exit status and the output."""
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            status = generate.main(["--root", self.root, *words])
        return status, out.getvalue()

    def writes(self):
        """First the generator must report outdated files without writing them. Then the function lets the generator write the
        files."""
        status, text = self.run_it("--check")
        self.assertEqual(status, 1, text)
        self.assertIn("; ./run bindings writes it anew", text)
        self.assertEqual(self.generated(), self.before)
        status, text = self.run_it()
        self.assertEqual(status, 0, text)
        status, text = self.run_it("--check")
        self.assertEqual(status, 0, text)

    def refuses(self, *messages):
        status, text = self.run_it()
        self.assertEqual(status, 1, text)
        for message in messages:
            self.assertIn(message, text)
        self.assertEqual(self.generated(), self.before)

    def function(self, name):
        """Returns the written interface of a function."""
        text = self.text(MODULE)
        end = text.index(f"    end function {name}\n")
        return text[text.rindex("\n\n", 0, end) + 2:end]


class Committed(Planted):
    def test_is_what_is_generated(self):
        status, text = self.run_it("--check")
        self.assertEqual((status, text), (0, "5 of 5 files were as they should be\n"))

    def test_a_line_by_hand_is_seen_and_shown(self):
        for path, line in ((MODULE, "    integer(c_int64_t) :: n_curves\n"), (FIXED, "      PARAMETER (RIIS_OK = 0)\n"),
                           (EXTERNAL, "subroutine riisf_valve_copy(valve, copy, status)\n"),
                           (INTERFACES, "    subroutine riisf_valve_copy(valve, copy, status)\n")):
            self.setUp()
            text = self.text(path)
            place = text.index(line)
            with open(os.path.join(self.root, path), "w", encoding="utf-8") as file:
                file.write(text[:place] + text[place + len(line):])
            status, text = self.run_it("--check")
            self.assertEqual(status, 1)
            self.assertIn(f"{path} is not what", text)
            self.assertRegex(text, r"(?m)^\+.*" + line.strip().split("(")[0])

    def test_a_missing_file_is_written(self):
        for path in generate.WIDTHS:
            os.remove(os.path.join(self.root, path))
        self.assertEqual(self.run_it("--check")[0], 1)
        self.assertEqual(self.run_it()[0], 0)
        self.assertEqual(self.generated(), self.before)


class Fields(Planted):
    def test_numbers_need_no_words(self):
        self.plant(HEADER, "} riis_mark_options;",
                   "  double planted[2], other; /* a text */\n  int32_t last;\n} riis_mark_options;")
        self.writes()
        self.assertIn("    integer(c_int32_t) :: instructions\n    real(c_double) :: planted(2), other\n"
                      "    integer(c_int32_t) :: last\n  end type riis_mark_options\n", self.text(MODULE))

    def test_the_order_is_that_of_the_header(self):
        field = "  int64_t n_curves;          /* the number"
        self.plant(HEADER, field, "  int64_t planted;\n" + field)
        self.writes()
        self.assertIn(":: struct_size\n    integer(c_int64_t) :: planted\n    integer(c_int64_t) :: n_curves\n",
                      self.text(MODULE))

    def test_a_pointer_needs_its_shape(self):
        line = self.plant(HEADER, "} riis_patches;", "  const double *planted;\n} riis_patches;")
        place = f"{self.planted}:{line}"
        self.refuses(f"{place}: riis_patches: {TABLE} does not say of 'const double *planted': the shape of the array",
                     "\nriis_patches\n  planted  ...")
        self.plant(TABLE, "riis_patches\n", "riis_patches\n  planted  (4, n_patches)  or c_null_ptr\n")
        self.writes()
        self.assertRegex(self.text(MODULE),
                         r"    type\(c_ptr\) :: planted +!< real\(c_double\), \(4, n_patches\), or c_null_ptr\n")

    def test_a_shape_of_the_header(self):
        self.plant(HEADER, "} riis_patches;", "  const double *planted; /* (4, n_patches). NULL: none */\n} riis_patches;")
        self.writes()
        self.assertRegex(self.text(MODULE),
                         r"    type\(c_ptr\) :: planted +!< real\(c_double\), \(4, n_patches\), or c_null_ptr\n")

    def test_pointers_to_texts_and_to_anything(self):
        self.plant(HEADER, "} riis_csr;", "  const char *text;\n  const void *planted;\n} riis_csr;")
        self.plant(TABLE, "riis_csr\n", "riis_csr\n  planted  (n_rows)\n")
        self.writes()
        self.assertRegex(self.text(MODULE),
                         r"    type\(c_ptr\) :: text +!< for riis_c_text\n"
                         r"    type\(c_ptr\) :: planted +!< integer\(c_int32_t\) or \(c_int64_t\), \(n_rows\)\n")

    def test_comments_of_the_header(self):
        self.plant(HEADER, "/* Counts and times of the last marking. */", "/* Planted for\n * the struct. */")
        self.plant(HEADER, "} riis_mark_stats;",
                   "  double a, b; /* planted for\n         the fields */\n  double c;\n} riis_mark_stats;")
        self.plant(TABLE, "riis_csr\n", "riis_mark_stats\n  seconds  -  planted here\n\nriis_csr\n")
        self.writes()
        self.assertIn("\n  !> Planted for the struct.\n  type, bind(c) :: riis_mark_stats\n", self.text(MODULE))
        self.assertRegex(self.text(MODULE),
                         r"    real\(c_double\) :: a, b +!< planted for the fields\n    real\(c_double\) :: c\n")
        self.assertRegex(self.text(MODULE), r"    real\(c_double\) :: seconds +!< planted here\n")

    def test_not_understood(self):
        for field in ("float planted;", "uint16_t planted;", "long planted;", "unsigned long planted;", "riis_closest planted;",
                      "double **planted;", "riis_surface *planted;", "double planted[2][3];", "double planted[N];",
                      "int32_t planted : 1;", "void (*planted)(void);", "struct { double x; } planted;",
                      "struct riis_csr *planted;"):
            self.setUp()
            line = self.plant(HEADER, "} riis_csr;", f"  {field}\n}} riis_csr;")
            self.refuses(f"{self.planted}:{line}: riis_csr: ", "lanted", "is not understood")

    def test_a_new_struct(self):
        self.plant(
            HEADER,
            "/* Options of a marking. */",
            "typedef struct riis_planted {\n  int32_t a, b; /* text */\n} riis_planted;\n" "/* Options of a marking. */",
        )
        self.writes()
        self.assertIn("  type, bind(c) :: riis_planted\n    integer(c_int32_t) :: a, b\n  end type riis_planted\n",
                      self.text(MODULE))


class Constants(Planted):
    def test_a_status(self):
        self.plant(HEADER, "  RIIS_UNAVAILABLE = 9, ", "  RIIS_PLANTED = -2,\n  RIIS_UNAVAILABLE = 9, ")
        self.writes()
        self.assertIn("\n  integer(riis_status), parameter :: RIIS_PLANTED = -2\n"
                      "  integer(riis_status), parameter :: RIIS_UNAVAILABLE = 9\n", self.text(MODULE))
        self.assertIn("\n      INTEGER(SELECTED_INT_KIND(9)) RIIS_PLANTED\n      PARAMETER (RIIS_PLANTED = -2)\n",
                      self.text(FIXED))
        self.assertIn(", RIIS_PLANTED, ", self.text(PUBLISHED))

    def test_an_enum_of_its_own(self):
        self.plant(HEADER, "/* Options of a marking. */", "enum {\n  RIIS_PLANTED_A = 0, /* , */\n  RIIS_PLANTED_B = 12\n};\n"
                                                          "/* Options of a marking. */")
        self.writes()
        self.assertIn("\n\n  integer(c_int32_t), parameter :: RIIS_PLANTED_A = 0\n"
                      "  integer(c_int32_t), parameter :: RIIS_PLANTED_B = 12\n\n", self.text(MODULE))
        self.assertIn("      PARAMETER (RIIS_PLANTED_B = 12)\n", self.text(FIXED))

    def test_what_fixed_form_has_not(self):
        self.plant(HEADER, "  RIIS_LOG_INFO = 0, ", "  RIIS_LOG_PLANTED = 5,\n  RIIS_LOG_INFO = 0, ")
        self.writes()
        self.assertIn(" RIIS_LOG_PLANTED = 5\n", self.text(MODULE))
        self.assertEqual(self.text(FIXED), self.before[1])

    def test_macros(self):
        self.plant(HEADER, "#define RIIS_FAR_DISTANCE 1.0e30", "#define RIIS_FAR_DISTANCE 1.5e-3\n#define RIIS_PLANTED (-7)")
        self.writes()
        self.assertIn("  real(c_double), parameter :: RIIS_FAR_DISTANCE = 1.5e-3_c_double\n"
                      "  integer(c_int32_t), parameter :: RIIS_PLANTED = -7\n", self.text(MODULE))
        self.assertIn("      PARAMETER (RIIS_FAR_DISTANCE = REAL(1.5D-3, KIND(RIIS_AUTO)))\n", self.text(FIXED))

    def test_a_value_that_changes(self):
        self.plant(HEADER, "RIIS_SEARCH_PAPER = 3,", "RIIS_SEARCH_PAPER = 33,")
        self.writes()
        self.assertIn(" RIIS_SEARCH_PAPER = 33\n", self.text(MODULE))
        self.assertIn("(RIIS_SEARCH_PAPER = 33)", self.text(FIXED))

    def test_not_understood(self):
        for old, new in (("  RIIS_OK = 0, ", "  RIIS_PLANTED, RIIS_OK = 0, "),
                         ("  RIIS_OK = 0, ", "  RIIS_PLANTED = 1 << 3, RIIS_OK = 0, "),
                         ("#define RIIS_AUTO (-1.0)", '#define RIIS_PLANTED "text"\n#define RIIS_AUTO (-1.0)'),
                         ("#define RIIS_AUTO (-1.0)", "#define RIIS_PLANTED(x) x\n#define RIIS_AUTO (-1.0)"),
                         ("#define RIIS_AUTO (-1.0)", "#ifdef RIIS_PLANTED\n#endif\n#define RIIS_AUTO (-1.0)")):
            self.setUp()
            self.plant(HEADER, old, new)
            self.refuses(f"{self.planted}:", "RIIS_PLANTED", "is not understood")

    def test_a_name_too_long_for_fixed_form(self):
        name = "RIIS_PLANTED_" + 30 * "X"
        self.plant(HEADER, "  RIIS_OK = 0, ", f"  {name} = 20,\n  RIIS_OK = 0, ")
        self.refuses(FIXED, "72 are allowed", name)


class Functions(Planted):
    def test_without_open_questions_no_words_are_needed(self):
        self.plant_function("riis_mesh **mesh, double a,\n    uint8_t b, int64_t c, int64_t d, riis_status e, const char *name,\n"
                            "    riis_csr *csr, int64_t struct_size")
        self.writes()
        self.assertEqual(self.function("riis_valve_planted"), """\
    !>   struct_size  c_sizeof(csr)
    function riis_valve_planted(valve, mesh, a, b, c, d, e, name, csr, struct_size) result(status) &
        bind(c, name='riis_valve_planted')
      import :: c_char, c_double, c_int8_t, c_int64_t, c_ptr, riis_csr, riis_status
      implicit none
      type(c_ptr), value :: valve
      type(c_ptr), intent(inout) :: mesh
      real(c_double), value :: a
      integer(c_int8_t), value :: b
      integer(c_int64_t), value :: c, d
      integer(riis_status), value :: e
      character(kind=c_char), intent(in) :: name(*)
      type(riis_csr), intent(inout) :: csr
      integer(c_int64_t), value :: struct_size
      integer(riis_status) :: status
""")
        self.assertRegex(self.text(MODULE), r"(?s)end function riis_valve_create\n.* riis_valve_planted.* riis_valve_destroy\(")

    def test_the_last_header_is_read(self):
        self.assertIn(IN_LAST_HEADER, self.text(HEADERS[-1]))
        line = self.plant(HEADER, IN_LAST_HEADER, "RIIS_API riis_status riis_planted(int64_t *n);\n" + IN_LAST_HEADER)
        self.refuses(f"{HEADERS[-1]}:{line}: riis_planted: {TABLE} does not say of 'int64_t *n'")
        self.plant(TABLE, "riis_valve_get\n", "riis_planted\n  n  required scalar\n\nriis_valve_get\n")
        self.writes()
        self.assertIn("function riis_planted(n)", self.text(MODULE))

    def test_what_c_leaves_open_is_asked_for(self):
        """If riis.h does not determine a binding, the refusal lists all gaps at once, with the lines to fill in."""
        line = self.plant_function("int64_t *n, const double *x,\n    const int64_t **ids, const riis_csr *csr, int32_t k")
        place = f"{self.planted}:{line}: riis_valve_planted: {TABLE} does not say of"
        pointer = "'required', or 'optional' where it may be NULL, with 'scalar', (*) or (3); or else 'borrowed'"
        self.refuses(f"{place} 'int64_t *n': {pointer}", f"{place} 'const double *x': {pointer}",
                     f"{place} 'const int64_t **ids': 'required', or 'optional' where it may be NULL, with the array's shape",
                     f"{place} 'const riis_csr *csr': 'required', or 'optional' where it may be NULL",
                     f"Needed in {TABLE}, whose head says how:\nriis_valve_planted\n  n  ...\n  x  ...\n  ids  ...\n  csr  ...\n")

    def test_what_the_comment_says(self):
        self.plant(HEADER, BEFORE_FUNCTION, "/* Planted.\n *   `x` (2, n), planted.\n *   `y` (n): planted. NULL: none.\n"
                   " *   `csr`: NULL stands for no rows. */\nRIIS_API riis_status riis_planted(const double *x, double *y,\n"
                   "const riis_csr *csr, const riis_grid *grid);\n" + BEFORE_FUNCTION)
        self.writes()
        self.assertIn("""\
    !>   x    (2, n)
    !!   y    (n), if left out: none
    !!   csr  if left out: no rows
    function riis_planted(x, y, csr, grid) result(status) bind(c, name='riis_planted')
      import :: c_double, riis_csr, riis_grid, riis_status
      implicit none
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(inout), optional :: y(*)
      type(riis_csr), intent(in), optional :: csr
      type(riis_grid), intent(in) :: grid
""", self.text(MODULE))

    def test_with_words(self):
        self.plant_function("int64_t *n, int32_t *m, const double *x, const double *y, double *z,\n    const double *w,"
                            " const int64_t **ids, const riis_csr *csr, riis_valve **made", """\
riis_valve_planted  What it does not say elsewhere.
  n     optional scalar
  m     required scalar out
  x, y  borrowed  c_loc of
                  something
  z     optional (*)
  w     required (3)  a point
  ids   required (2, n)  from 0
  csr   optional
  made  optional
""")
        self.writes()
        self.assertEqual(self.function("riis_valve_planted"), """\
    !> What it does not say elsewhere.
    !!   x, y  c_loc of something
    !!   w     a point
    !!   ids   integer(c_int64_t), (2, n), from 0
    function riis_valve_planted(valve, n, m, x, y, z, w, ids, csr, made) result(status) &
        bind(c, name='riis_valve_planted')
      import :: c_double, c_int32_t, c_int64_t, c_ptr, riis_csr, riis_status
      implicit none
      type(c_ptr), value :: valve
      integer(c_int64_t), intent(inout), optional :: n
      integer(c_int32_t), intent(out) :: m
      type(c_ptr), value :: x, y
      real(c_double), intent(inout), optional :: z(*)
      real(c_double), intent(in) :: w(3)
      type(c_ptr), intent(inout) :: ids
      type(riis_csr), intent(in), optional :: csr
      type(c_ptr), intent(inout), optional :: made
      integer(riis_status) :: status
""")

    def test_results(self):
        self.plant(HEADER, BEFORE_FUNCTION, "RIIS_API const char *riis_planted(void);\nRIIS_API void riis_other(int32_t a);\n"
                   + BEFORE_FUNCTION)
        self.writes()
        self.assertIn("    !> For riis_c_text.\n    function riis_planted() result(text) bind(c, name='riis_planted')\n"
                      "      import :: c_ptr\n      implicit none\n      type(c_ptr) :: text\n    end function",
                      self.text(MODULE))
        self.assertIn("    subroutine riis_other(a) bind(c, name='riis_other')\n      import :: c_int32_t\n      implicit none\n"
                      "      integer(c_int32_t), value :: a\n    end subroutine", self.text(MODULE))

    def test_a_renamed_argument(self):
        self.plant(SUBROUTINES, "  status  Any value.\n", "  status = planted  Any value.\n")
        self.plant(HEADER, "riis_status_name(riis_status status)", "riis_status_name(riis_status planted)")
        self.writes()
        self.assertIn("function riis_status_name(planted)", self.text(MODULE))
        self.assertIn("integer(riis_status), value :: planted\n", self.text(MODULE))

    def test_not_understood(self):
        for argument in ("float planted", "size_t planted", "int planted", "double **planted", "const double ***planted",
                         "char *planted", "const char **planted", "riis_csr planted", "riis_csr **planted",
                         "riis_mesh ***planted", "void **planted", "riis_unknown *planted", "double planted[3]",
                         "void (*planted)(void)", "const double *const planted",
                         "double *restrict planted", "double Planted", "double *"):
            self.setUp()
            line = self.plant_function(argument)
            self.refuses(f"{self.planted}:{line}: riis_valve_planted: ", argument[:6], "is not understood")
        for declaration in ("RIIS_API int riis_planted(void);", "RIIS_API double *riis_planted(void);", "int riis_planted(void);",
                            "static inline int riis_planted(void) { return 0; }",
                            "typedef union riis_planted { int a; } riis_planted;",
                            "typedef enum { RIIS_PLANTED = 0 } riis_planted;", 
                            "typedef int64_t riis_planted;",
                            "typedef int (*riis_planted)(int32_t a);", "RIIS_API extern const int riis_planted;"):
            self.setUp()
            line = self.plant(HEADER, BEFORE_FUNCTION, declaration + "\n" + BEFORE_FUNCTION)
            self.refuses(f"{self.planted}:{line}: ", "lanted", "is not understood")

    def test_an_argument_named_as_the_result(self):
        self.plant_function("int32_t status")
        self.refuses("riis_valve_planted: no argument can have the name of the result, status")

    def test_no_semicolon(self):
        self.plant(HEADER, "_state *now);\n\n#ifdef __cplusplus", "_state *now)\n\n#ifdef __cplusplus")
        self.refuses("no semicolon ends what begins here")


class Words(Planted):
    """Tests faulty entries of the table."""

    def refused(self, old, new, *messages):
        self.setUp()
        line = self.plant(TABLE, old, new)
        self.refuses(*(message.replace("TABLE", f"{TABLE}:{line}") for message in messages))

    def test_names_that_the_header_lacks(self):
        entry = "riis_valve_get\n"
        self.refused(entry, "riis_planted  text\n\n" + entry, f"TABLE: {HEADER} has no riis_planted")
        self.refused(entry, f"{entry}  planted  required (*)\n", f"riis_valve_get of {HEADER} has no planted")
        self.refused("  RIIS_LOG_*  ", "  RIIS_PLANTED_*  ", f"TABLE: omit from riisf.h of {HEADER} has no RIIS_PLANTED_*")
        self.refused("  xyz          real (3, ", "  planted      real (3, ", f"riis_keyframe_arrays of {HEADER} has no planted")

    def test_words_that_do_not_suit(self):
        csr = "  csr      optional  "
        for words in ("optional scalar", "borrowed", "optional out", "-"):
            self.refused(csr, f"  csr      {words}  ", "riis_mesh_set_adjacency: ",
                         "'const riis_csr *csr': 'required', or 'optional'")
        for words in ("optional", "(*)", "scalar", "optional borrowed", "required optional (*)", "required scalar (*)"):
            self.refused("  values        required (*)  (n_values)", f"  values        {words}  (n_values)",
                         "riis_valve_get: ", "'double *values': 'required', or 'optional'")
        self.refused("  kind          -", "  kind          scalar",
                     "TABLE: riis_valve_create: 'scalar' does not suit 'const char *kind'")
        self.refused(
            "  parameter_id  -",
            "  parameter_id  optional",
            "TABLE: riis_valve_get_parameter: 'optional' does not suit 'int64_t parameter_id': nothing but '-' and a text",
        )
        self.refused("  weight       -", "  weight       (2)", "TABLE: riis_band_sums: 'double weight' points to no")
        self.refused("  user_data  -  the pointer", "  user_data  scalar  the pointer",
                     "TABLE: riis_log_function: only a text is wanted")
        self.refused("riis_csr\n", "riis_parameter\n  unit  (3)\n\nriis_csr\n",
                     "riis_parameter: 'const char *unit' points to no array")
        self.refused("  xyz          real (3, n_vertices, n_keys)", "  xyz          real optional",
                     "'const void *xyz': the shape of the array")
        self.refused("  x, y, z      real (n_vertices)", "  x, y         real (n_vertices)",
                     "riis_surface_arrays: x, y, z belong into one line")

    def test_types_that_share_a_line(self):
        self.plant_function("const int64_t **planted, const int32_t **other")
        line = self.plant(
            TABLE, "riis_valve_get\n", "riis_valve_planted\n  planted, other  optional (n_values)\n\nriis_valve_get\n"
        )
        self.refuses(f"{TABLE}:{line + 1}: riis_valve_planted: planted, other are of several types, "
                     "so each needs a line of its own")

    def test_lines_that_are_not_understood(self):
        entry = "  csr      optional  "
        for words in ("maybe", "optional,", "(3", "optional optional", "(3) (4)"):
            self.refused(entry, f"  csr      {words}  ", f"TABLE: '{words}' is not understood; the second column is '-' or")
        self.refused(entry, "  csr\n", "TABLE: there is no second column; the second column is")
        self.refused(entry, " csr      optional  ", "TABLE: nothing is above that this line could belong to")
        self.refused("riis_valve_get\n", "riis_csr\n\nriis_valve_get\n", "TABLE: riis_csr is in ", "already")
        self.refused("  point_ids    (n_point_ids)", "  point_ids  (n_point_ids)\n  point_ids  (n_point_ids)",
                     "riis_closest_options: point_ids is in ", "already")


class Subroutines(Planted):
    """Tests the table of the external subroutines."""

    ENTRY = "riisf_mesh_prepare: mesh, n_threads\n"

    def test_an_entry_makes_a_subroutine_and_its_interface(self):
        self.plant(SUBROUTINES, self.ENTRY, "riisf_planted, _64 = riis_warp_set_targets\n  ! Planted.\n  warp  A warp.\n"
                   "  n = n_points, x(*), y(*), z(*), stride\n  > targets%real_bits = 64\n\n" + self.ENTRY)
        self.writes()
        for path, indent in ((EXTERNAL, ""), (INTERFACES, "    ")):
            text = self.text(path)
            self.assertIn(f"{indent}subroutine riisf_planted(warp, n, x, y, z, stride, status)\n", text)
            self.assertRegex(text.partition("subroutine riisf_planted_64(")[2], r"\n +integer\(int64\), intent\(in\) :: n[ \n]")
        self.assertIn("  targets%n_points = n\n  targets%x = location_of(x)\n", self.text(EXTERNAL))
        self.assertIn("  targets%real_bits = 64\n  status = riis_warp_set_targets(c_handle_of(warp), targets)\n",
                      self.text(EXTERNAL))
        self.assertIn("\n!> Planted. Errors: RIIS_INVALID_ARGUMENT for a bad point; the message names the point.",
                      self.text(EXTERNAL))

    def test_a_text_of_the_header(self):
        self.plant(HEADER, "double depth;", "double depth; /* planted, default 3. NULL: none */ double other_depth;")
        self.writes()
        self.assertRegex(self.text(EXTERNAL), r"real\(c_double\), intent\(in\) :: depth +!< Planted, usually 3\.\n")

    def test_a_comment_of_the_header(self):
        """The comment of a function serves its subroutine, with the subroutine's names and without sentences about pointers."""
        comment = "/* Destroys the handle. The caller's coordinates and all marks stay. */\nRIIS_API void riis_mesh_destroy"
        self.plant(HEADER, comment, comment.replace("stay. */", "stay. NULL is allowed. Planted \"for\" riis_valve_get. */"))
        self.plant(HEADER, "*   `reach`: 1e-50 to 1e50.", "*   `reach`: planted *here. NULL: none.")
        self.writes()
        self.assertIn("all marks stay. Planted 'for' riisf_valve_get. The handle becomes 0.",
                      " ".join(self.text(EXTERNAL).replace("!!", "").split()))
        self.assertRegex(self.text(EXTERNAL), r"intent\(in\) :: reach +!< Planted here\. RIIS_AUTO")

    def test_a_function_without_a_comment(self):
        self.plant(HEADER, "/* Gives the number of leaflets of the surface. */\n", "")
        self.refuses("riisf_surface_n_leaflets: riis_surface_get_n_leaflets has no comment")

    def test_a_function_that_is_gone(self):
        self.plant(HEADER, "RIIS_API riis_status riis_mesh_prepare(riis_mesh *mesh, int32_t n_threads);\n", "")
        self.refuses(f"{SUBROUTINES}:", "riisf_mesh_prepare: riis.h has no riis_mesh_prepare\n")

    def test_faulty_entries(self):
        for old, new, message in (
                ("riisf_mesh_prepare: mesh, n_threads", "riisf_mesh_prepare =: mesh", "'riisf_mesh_prepare =' is not understood"),
                ("prepare: mesh, n_threads", "prepare: mesh, (3)", "the argument '(3)' is not understood"),
                ("prepare: mesh, n_threads", "prepare: mesh, planted", "riisf_mesh_prepare: riis.h has no planted"),
                ("prepare: mesh, n_threads", "prepare: mesh, n_threads = csr%planted",
                 "riisf_mesh_prepare: riis.h has no csr%planted"),
                ("prepare: mesh, n_threads", "prepare: mesh", "riisf_mesh_prepare: no argument gives n_threads"),
                ("prepare: mesh, n_threads", "prepare: mesh, planted = n_threads", "riisf_mesh_prepare: planted has no text"),
                ("riisf_mesh_prepare: mesh, n_threads", "riisf_mesh_prepared: mesh, n_threads",
                 "riisf_mesh_prepared: riis.h has no riis_mesh_prepared"),
                ("riisf_mesh_destroy\n", "riisf_mesh_destroy\n    mesh\n",
                 "nothing is above that the second line could belong to")):
            self.setUp()
            self.plant(SUBROUTINES, old, new)
            self.refuses(f"{SUBROUTINES}:", message)


class Page(Planted):
    """Tests the page of all calls in Fortran, by calls.py."""

    def setUp(self):
        super().setUp()
        for path in calls.SOURCES:
            for source in glob.glob(os.path.join(SOURCES, path)):
                target = os.path.join(self.root, os.path.relpath(source, SOURCES))
                os.makedirs(os.path.dirname(target), exist_ok=True)
                shutil.copy(source, target)
        os.makedirs(os.path.join(self.root, "docs"))
        for path in (calls.TABLE, calls.PAGE):
            shutil.copy(os.path.join(SOURCES, path), os.path.join(self.root, path))

    def judge(self, *words):
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            return calls.main(["--root", self.root, *words]), out.getvalue()

    def says(self, *messages):
        status, text = self.judge("--check")
        self.assertEqual(status, 1, text)
        for message in messages:
            self.assertIn(message, text)

    def test_a_call_in_the_last_header_needs_a_line(self):
        self.assertEqual(self.judge("--check")[0], 0)
        self.plant(HEADER, IN_LAST_HEADER, "RIIS_API riis_status riis_planted(int32_t n);\n" + IN_LAST_HEADER)
        self.says("its contents are not the calls of the headers", "-riis_planted",
                  f"{calls.TABLE}: there is no line for riis_planted")

    def test_a_procedure_needs_a_call(self):
        before = "    subroutine riisf_warp_destroy("
        self.plant(INTERFACES, before, "    subroutine riisf_planted(n)\n    end subroutine riisf_planted\n" + before)
        self.says(f"{calls.TABLE}: riisf_planted belongs to no call")

    def test_names_that_nothing_has(self):
        self.plant(calls.TABLE, "riis_mesh%clear_adjacency", "riis_mesh%planted")
        self.says("the Fortran sources have no riis_mesh%planted", "riis_mesh%clear_adjacency belongs to no call")

    def test_a_call_of_one_language(self):
        self.plant(SUBROUTINES, "riisf_mesh_prepare: mesh, n_threads\n", "")
        self.says(f"{calls.TABLE}: riis_mesh_prepare needs procedures of both languages, or '-' and a reason",
                  f"{calls.TABLE}: riisf_mesh_prepare belongs to no call")

    def test_a_line_that_changes(self):
        self.plant(INTERFACES, "    subroutine riisf_valve_unset(valve, name,",
                   "    subroutine riisf_valve_unset(valve, planted,")
        self.says("+CALL RIISF_VALVE_UNSET(VALVE, PLANTED, STATUS)", "./run bindings writes it anew")
        self.assertEqual(self.judge()[0], 0)
        self.assertEqual(self.judge("--check")[0], 0)

    def test_every_form_of_a_generic_name(self):
        source = "fortran/generated/riis_meshes.f90"
        head = "subroutine mesh_create_x_y_z(this, x, y, z, status)"
        self.plant(source, head, "subroutine mesh_create_x_y_z(this, x, y, planted, status)")
        self.says("-call mesh%create(x, y, z [, status])", "+call mesh%create(x, y, planted [, status])")
        self.setUp()
        self.plant(source, head, "subroutine mesh_create_x_y_z(this, xyz, status)")
        status, text = self.judge("--check")
        self.assertEqual((status, text.count("+call")), (1, 0), text)


class Keywords(Planted):
    def judge(self):
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            return check_keywords.main(self.root), out.getvalue()

    def setUp(self):
        super().setUp()
        shutil.copytree(os.path.join(SOURCES, "abi"), os.path.join(self.root, "abi"))

    def test_what_was_released_keeps_its_names(self):
        self.assertEqual(self.judge()[0], 0)
        self.plant(HEADER, "riis_mesh_prepare(riis_mesh *mesh, int32_t n_threads)",
                   "riis_mesh_prepare(riis_mesh *mesh, int32_t threads)")
        status, text = self.judge()
        self.assertEqual(status, 1)
        self.assertIn("riis_mesh_prepare has the arguments mesh, threads, but was released with mesh, n_threads\n", text)

    def test_new_functions_are_free(self):
        self.plant_function("int32_t planted")
        self.assertEqual(self.judge()[0], 0)

    def test_nothing_to_compare_with(self):
        shutil.rmtree(os.path.join(self.root, "abi"))
        self.assertEqual(self.judge(), (1, "0 functions\n"))


if __name__ == "__main__":
    unittest.main()
