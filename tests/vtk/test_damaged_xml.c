/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests XML files of meshes and surfaces that claim more data than they contain. The files are refused before memory is allocated
 * for the claimed data. Files with random damage are read or refused. Each file is read in a separate process with limited
 * memory. */
#include <riis/riis_vtk.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../support/test_support.h"

#include "../support/sanitized.h"
#include "expect.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { most_kilobytes = 400 * 1024 }; /* enough for a process that reads a file of a few hundred kilobytes */

static int is_surface(const char *name) { return strstr(name, ".vtp") != NULL; }

static riis_status read_any(const char *name) {
  riis_vtk_mesh *mesh = NULL;
  riis_vtk_surface *surface = NULL;
  const char *path = scratch_path(name);
  const riis_status status =
      is_surface(name) ? riis_vtk_surface_read(path, NULL, &surface) : riis_vtk_mesh_read(path, &mesh);
  riis_vtk_mesh_destroy(&mesh);
  riis_vtk_surface_destroy(&surface);
  return status;
}

/* Reads a file in another process with little memory. The file must be read, or refused with a message that names it. Returns 1
 * if the file was read. */
static int read_apart(const char *name, const char *what) {
  fflush(NULL);
  const pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    const struct rlimit limit = {(rlim_t)3 << 30, (rlim_t)3 << 30};
    if (!is_sanitized()) setrlimit(RLIMIT_AS, &limit);
    const riis_status status = read_any(name);
    const int is_refused = status == RIIS_FILE_ERROR || status == RIIS_OUT_OF_MEMORY;
    if (is_refused && !strstr(riis_last_error(), name)) fprintf(stderr, "%s\n", riis_last_error());
    _exit(status == RIIS_OK ? 0 : is_refused && strstr(riis_last_error(), name) ? 1 : 2);
  }
  int ended = 0;
  struct rusage used;
  assert_true(wait4(child, &ended, 0, &used) == child);
  if (!WIFEXITED(ended) || WEXITSTATUS(ended) > 1) fail_msg("%s: the process ends with %#x", what, (unsigned)ended);
  if (!is_short_test() && used.ru_maxrss > most_kilobytes) fail_msg("%s: %ld kB", what, used.ru_maxrss);
  return WEXITSTATUS(ended) == 0;
}

/* Copies a file, and replaces a part of the copy's text. */
static void replace_text(const char *name, const char *from, const char *to, const char *as) {
  size_t size = 0;
  char *text = scratch_read(scratch_path(name), &size), *at = strstr(text, from);
  if (!at) fail_msg("%s has no '%s'", name, from);
  char *made = malloc(size + strlen(to) + 1);
  const size_t before = (size_t)(at - text), after = before + strlen(from);
  memcpy(made, text, before);
  memcpy(made + before, to, strlen(to));
  memcpy(made + before + strlen(to), text + after, size - after);
  scratch_write(as, made, size - strlen(from) + strlen(to));
  free(made);
  free(text);
}

/* Changes the numbers of points, cells, faces, components and tuples in the text. */
TEST(test_promised_numbers) {
  static const struct {
    const char *name, *from, *to, *text;
  } cases[] = {
      {"f.vtu", "NumberOfPoints=\"125\"", "NumberOfPoints=\"1000000000\"",
       "array pressure must have 1000000000 values and has "},
      {"f.vtu", "NumberOfPoints=\"125\"", "NumberOfPoints=\"-125\"", "is damaged: NumberOfPoints is -125"},
      {"f.vtu", "NumberOfCells=\"389\"", "NumberOfCells=\"100000000000\"", "must have 100000000000 values and has "},
      {"f.vtu", "Name=\"Points\" NumberOfComponents=\"3\"", "Name=\"Points\" NumberOfComponents=\"3000\"",
       "array Points must have 375000 values and has "},
      {"f.vtu", "Name=\"time\"", "Name=\"time\" NumberOfComponents=\"2147483647\"",
       "has an array of 2147483647 components, more than it has bits"},
      {"f.vtu", "Name=\"velocity\" NumberOfComponents=\"3\"", "Name=\"velocity\" NumberOfComponents=\"2147483647\"",
       "has an array of 2147483647 components, more than it has bits"},
      {"f.vtu", "Name=\"velocity\" NumberOfComponents=\"3\"", "Name=\"velocity\" NumberOfComponents=\"-5\"",
       "array velocity claims -5 components"},
      {"f.vtu", "NumberOfTuples=\"2\"", "NumberOfTuples=\"5000000000\"",
       "array time must have 5000000000 values and has "},
      {"f.vtu", "Name=\"offsets\"", "Name=\"offset\"", "promises 389 cells and has no array of their offsets"},
      {"f.vtu", "Name=\"types\"", "Name=\"type\"", "promises 389 cells and has no array of their types"},
      {"f.vtp", "NumberOfPoints=\"104\"", "NumberOfPoints=\"1000000000\"", "must have 1000000000 values and has "},
      {"f.vtp", "NumberOfPolys=\"212\"", "NumberOfPolys=\"1000000000000\"", "must have 1000000000000 values and has "},
      {"f.vtp", "NumberOfVerts=\"0\"", "NumberOfVerts=\"30000000000\"", "must have 30000000000 values and has "},
      {"f.vtp", "NumberOfStrips=\"0\"", "NumberOfStrips=\"-1\"", "is damaged: NumberOfStrips is -1"},
      {"f.vtp", "NumberOfPolys=\"212\"", "NumberOfPolys=\"9223372036854775807\"",
       "must have 9223372036854775807 values"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    for (int encoding = SHIM_ASCII; encoding <= SHIM_RAW; ++encoding) {
      assert_int_equal(shim_write_blocks(scratch_path(cases[i].name), encoding, 0, 64), 1);
      char name[32];
      snprintf(name, sizeof name, "damaged%s", cases[i].name + 1);
      replace_text(cases[i].name, cases[i].from, cases[i].to, name);
      assert_int_equal(read_apart(cases[i].name, cases[i].name), 1);
      assert_int_equal(read_apart(name, cases[i].text), 0);
      const riis_status status = read_any(name);
      expect_refused(status, RIIS_FILE_ERROR, cases[i].text);
      expect_refused(status, RIIS_FILE_ERROR, name);
    }
}

static int base64_value(char c) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const char *const found = c ? strchr(digits, c) : NULL;
  return found ? (int)(found - digits) : -1;
}

/* Returns the position at which the data of one of the file's arrays begins. */
static size_t place_of(const char *text, size_t size, const char *array) {
  char name[64], *end;
  snprintf(name, sizeof name, "Name=\"%s\"", array);
  const char *element = strstr(text, name), *close = element ? strchr(element, '>') : NULL;
  assert_non_null(close);
  const char *offset = strstr(element, "offset=\"");
  if (!offset || offset > close) return (size_t)(close + 1 + strspn(close + 1, " \n") - text);
  const char *appended = strstr(text, "<AppendedData"), *start = strchr(appended, '_');
  const size_t place = (size_t)(start + 1 - text) + strtoul(offset + 8, &end, 10);
  assert_true(place < size);
  return place;
}

/* Writes a number of 4 or 8 bytes into base64 or raw data, n_bytes after the data's beginning. */
static void put_number(char *data, size_t n_bytes, int width, uint64_t number, int is_raw) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (int i = 0; i < width; ++i, ++n_bytes, number >>= 8) {
    if (is_raw) {
      data[n_bytes] = (char)(number & 255);
      continue;
    }
    char *const four = data + n_bytes / 3 * 4;
    const int shift = 16 - 8 * (int)(n_bytes % 3);
    int bits = 0;
    for (int k = 0; k < 4; ++k) bits = bits << 6 | (base64_value(four[k]) < 0 ? 0 : base64_value(four[k]));
    bits = (bits & ~(255 << shift)) | (int)(number & 255) << shift;
    for (int k = 0; k < 4; ++k)
      if (four[k] != '=') four[k] = digits[bits >> (18 - 6 * k) & 63];
  }
}

/* Writes a valid file, changes a number in the data of one array, and expects the refusal. */
static void expect_number_refused(int encoding, int compressor, int bits, const char *array, size_t n_bytes, int width,
                                  uint64_t number, const char *text) {
  size_t size = 0;
  assert_int_equal(shim_write_blocks(scratch_path("whole.vtu"), encoding, compressor, bits), 1);
  char *bytes = scratch_read(scratch_path("whole.vtu"), &size);
  put_number(bytes + place_of(bytes, size, array), n_bytes, width, number, encoding == SHIM_RAW);
  scratch_write("damaged.vtu", bytes, size);
  free(bytes);
  assert_int_equal(read_apart("damaged.vtu", text), 0);
  const riis_status status = read_any("damaged.vtu");
  expect_refused(status, RIIS_FILE_ERROR, text);
  expect_refused(status, RIIS_FILE_ERROR, "damaged.vtu: ");
}

/* Changes the numbers that precede the data of an array. The points have 125 * 24 bytes: two blocks of 1024 bytes, and one block
 * of 952 bytes. */
TEST(test_sizes_of_blocks) {
  static const char *const arrays[3] = {"Points", "velocity", "time"};
  static const char *const texts[4] = {"claims 268435457 compressed blocks, and the file holds ",
                                       "claims a block of 268435457 bytes, compressed to ",
                                       "claims compressed blocks of 1024 bytes, the last of 268435457",
                                       "claims a compressed block of 268435457 bytes, and the file holds "};
  for (int encoding = SHIM_BINARY; encoding <= SHIM_RAW; ++encoding)
    for (int bits = 32; bits <= 64; bits += 32) {
      char text[256];
      for (int i = 0; i < 3; ++i) {
        snprintf(text, sizeof text, "array %s claims 268435457 bytes, and the file holds ", arrays[i]);
        expect_number_refused(encoding, 0, bits, arrays[i], 0, bits / 8, 268435457, text);
      }
      for (int compressor = 1; compressor <= 3; ++compressor)
        for (int i = 0; i < 4; ++i) {
          snprintf(text, sizeof text, "array Points %s", texts[i]);
          expect_number_refused(encoding, compressor, bits, "Points", (size_t)(i * bits / 8), bits / 8, 268435457,
                                text);
        }
      expect_number_refused(encoding, 1, bits, "Points", (size_t)(bits / 8), bits / 8, 0,
                            "array Points claims compressed blocks of 0 bytes");
    }
  expect_number_refused(SHIM_RAW, 0, 64, "Points", 0, 8, UINT64_MAX, "array Points claims 18446744073709551615 bytes");
  expect_number_refused(SHIM_RAW, 1, 64, "Points", 0, 8, UINT64_MAX,
                        "array Points claims 18446744073709551615 compressed");
}

/* The last offset must equal the number of values of another array. The file has 389 cells: 384 tetrahedra and 5 polyhedra. */
TEST(test_last_offsets) {
  const uint64_t many = 1000000000000;
  expect_number_refused(SHIM_RAW, 0, 64, "offsets", 8 + 8 * 388, 8, many,
                        "array connectivity must have 1000000000000 values and has 1556");
  expect_number_refused(SHIM_BINARY, 0, 32, "offsets", 4 + 8 * 388, 8, many,
                        "array connectivity must have 1000000000000 values and has 1556");
  expect_number_refused(SHIM_RAW, 0, 64, "faceoffsets", 8 + 8 * 388, 8, many,
                        "array faces must have 1000000000000 values and has 85");
  expect_number_refused(SHIM_RAW, 0, 64, "faces", 8, 8, many, "cell 384 has broken polyhedron faces");
  expect_number_refused(SHIM_RAW, 0, 64, "faces", 16, 8, many, "cell 384 has broken polyhedron faces");
  assert_int_equal(shim_write_blocks(scratch_path("f.vtp"), SHIM_ASCII, 0, 64), 1);
  replace_text("f.vtp", "636\n", "1000000000000\n", "damaged.vtp");
  assert_int_equal(read_apart("damaged.vtp", "offsets of faces"), 0);
  /* VTK 9.3 refuses this file before the library compares the numbers. */
  const riis_status status = read_any("damaged.vtp");
  const int by_vtk = strstr(riis_last_error(), "the \"offsets\" array is not long enough") != NULL;
  expect_refused(status, RIIS_FILE_ERROR,
                 by_vtk ? "damaged.vtp: Cannot read cell offsets from Polys"
                        : "array connectivity must have 1000000000000 values and has at most ");
}

/* Damages a file as a bad disk or a bad transfer would. Some bytes get other values, which are mostly characters of base64 and
 * digits. */
static void damage(random_source *random, char *bytes, size_t size) {
  const int n = 1 + (int)(random_bits(random) % 3);
  for (int i = 0; i < n; ++i) {
    const size_t at = random_bits(random) % size;
    char *const c = &bytes[at];
    if (*c >= '0' && *c <= '9' && random_bits(random) % 4 > 0)
      *c = (char)('0' + random_bits(random) % 10);
    else if (base64_value(*c) >= 0)
      *c = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"[random_bits(random) % 64];
    else
      *c = (char)random_bits(random);
  }
}

TEST(test_random_damage) {
  random_source random = random_start("test_damaged_xml");
  const int n_trials = trials(9, 2000);
  int n_read = 0, n_all = 0;
  for (int form = 0; form < 2 * 2 * 4 * 3; ++form) {
    const int surface = form % 2, bits = form / 2 % 2 ? 64 : 32, compressor = form / 4 % 4,
              encoding = SHIM_BINARY + form / 16;
    const char *const whole = surface ? "whole.vtp" : "whole.vtu", *const damaged =
                                                                       surface ? "damaged.vtp" : "damaged.vtu";
    char what[128];
    size_t size = 0;
    assert_int_equal(shim_write_blocks(scratch_path(whole), encoding, compressor, bits), 1);
    assert_int_equal(read_apart(whole, whole), 1);
    char *bytes = scratch_read(scratch_path(whole), &size), *copy = malloc(size);
    for (int trial = 0; trial < n_trials; ++trial) {
      memcpy(copy, bytes, size);
      const unsigned long long seed = random.state;
      damage(&random, copy, size);
      scratch_write(damaged, copy, size);
      snprintf(what, sizeof what, "%s, encoding %d, compressor %d, header %d, seed %llu", damaged, encoding, compressor,
               bits, seed);
      n_read += read_apart(damaged, what);
      ++n_all;
    }
    free(copy);
    free(bytes);
  }
  printf("%d of %d damaged files were read\n", n_read, n_all);
  assert_in_range(n_read, n_all / 20, n_all * 19 / 20);
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
