/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests meshes in pieces. Random meshes are cut at random, with and without global ids and ghost cells. The program marks the
 * pieces and the joined mesh. Pieces and joined mesh must give the same marks, counts, leaks, regions and passages. A refusal
 * names the broken list or piece. */
#include <ctype.h>
#include <math.h>
#include <riis/riis_vtk.h>

#include "plain_mesh.h"
#include "program.h"
#include "random_pieces.h"
#include "scratch.h"
#include "test_support.h"
#include "vtk_shim.h"

static char *read_text(const char *name) {
  size_t n = 0;
  char *text = scratch_read(scratch_path(name), &n);
  assert_non_null(text);
  return text;
}

/* Checks that a key has the same number, or null, in both texts. Numbers may differ by 1e-12 of their size. */
static void expect_same(const char *key, const char *a, const char *b) {
  char quoted[64];
  snprintf(quoted, sizeof quoted, "\"%s\": ", key);
  const char *p = strstr(a, quoted), *q = strstr(b, quoted);
  if (!p || !q) {
    if (p || q) fail_msg("only one has %s: %s %s", key, a, b);
    return;
  }
  p += strlen(quoted), q += strlen(quoted);
  if (*p == '{') p = strchr(p, '}'), q = strchr(q, '}');
  if (!isdigit((unsigned char)*p) && *p != '-') {
    assert_memory_equal(p, q, 4);
    return;
  }
  const double x = strtod(p, NULL), y = strtod(q, NULL);
  if (!(fabs(x - y) <= 1e-12 * fabs(x))) fail_msg("%s is %.17g in the whole and %.17g in pieces", key, x, y);
}

static void expect_same_numbers(const char *a, const char *b) {
  static const char *const keys[] = {"n_nodes",
                                     "n_cells",
                                     "n_marked",
                                     "n_within_limit",
                                     "complete",
                                     "n_leaking_edges",
                                     "longest_leaking_edge",
                                     "closing_half_thickness",
                                     "n_volume_cells",
                                     "n_cells_without_known_edges",
                                     "n_open_regions",
                                     "least",
                                     "mean",
                                     "most",
                                     "mean_edge",
                                     "n_edges",
                                     "effective_area",
                                     "share"};
  for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) expect_same(keys[i], a, b);
}

static void expect_same_array(const char *name) {
  char type[32];
  int64_t n_components = 0, n = 0;
  double *all = malloc(sizeof *all * (size_t)whole.n_nodes), *part = malloc(sizeof *part * (size_t)whole.n_nodes);
  assert_int_equal(shim_read_array(scratch_path("joined_out.vtu"), 'p', name, type, &n_components, &n, all), 1);
  for (int piece = 0; piece < n_pieces; ++piece) {
    char path[64];
    if (n_nodes_of[piece] == 0) continue;
    snprintf(path, sizeof path, "out/out_%04d.vtu", piece);
    assert_int_equal(shim_read_array(scratch_path(path), 'p', name, type, &n_components, &n, part), 1);
    assert_int_equal(n, n_nodes_of[piece]);
    for (int i = 0; i < n; ++i) CHECK_SAME(part[i], all[nodes_of[piece][i]]);
  }
  free(all);
  free(part);
}

#ifdef RIIS_MPIEXEC

/* Sets Open MPI as tests/install/check_mpi_example.sh does. */
static void use_mpi(void) {
  static const char *const settings[][2] = {{"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                                            {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                                            {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
                                            {"OMPI_MCA_hwloc_base_binding_policy", "none"},
                                            {"OMPI_MCA_mpi_yield_when_idle", "1"},
                                            {"OMPI_MCA_plm", "isolated"},
                                            {"OMPI_MCA_pml", "ob1"},
                                            {"OMPI_MCA_btl", "self,vader"},
                                            {"OMPI_MCA_btl_vader_single_copy_mechanism", "none"},
                                            {"PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe"},
                                            {"PRTE_MCA_hwloc_default_binding_policy", "none"}};
  for (size_t i = 0; i < sizeof settings / sizeof *settings; ++i) setenv(settings[i][0], settings[i][1], 1);
  program_file = RIIS_MPIEXEC;
}

/* Runs the program on this number of ranks. */
#define RUN_RANKS(n, ...) \
  (use_mpi(), run_program("-n", n, RIIS_MPI_PROGRAM, __VA_ARGS__, NULL), (void)(program_file = NULL))

/* Checks that several ranks give the files, numbers and exit code that one process has just given. */
static void expect_same_by_ranks(const char *n_ranks, const char *valve, const char *opening,
                                 const char *half_thickness, const char *from, const char *to) {
  const int code = program_exit_code;
  char *const one = code == 0 || code == 3 ? read_text("pieces.json") : NULL;
  RUN_RANKS(n_ranks, "check", "leaks", scratch_path("mesh.pvtu"), "--between", from, to, "--valve", valve, "--opening",
            opening, "--half-thickness", half_thickness, "--threads", "1", "--stats", scratch_path("ranks.json"),
            "--quiet");
  if (code != program_exit_code)
    fail_msg("%d on one and %d on several ranks: %s", code, program_exit_code, program_err);
  if (!one) return;
  char *const several = read_text("ranks.json");
  expect_same_numbers(one, several);
  expect_same("distance", strstr(one, "\"passage\""), strstr(several, "\"passage\""));
  free(several);
  RUN_RANKS(n_ranks, "mark", scratch_path("mesh.pvtu"), "--valve", valve, "--opening", opening, "--half-thickness",
            half_thickness, "--threads", "1", "--output", scratch_path("ranks.pvtu"), "--stats",
            scratch_path("ranks.json"), "--quiet");
  run_program("mark", scratch_path("mesh.pvtu"), "--valve", valve, "--opening", opening, "--half-thickness",
              half_thickness, "--output", scratch_path("out.pvtu"), "--stats", scratch_path("pieces.json"), "--quiet",
              NULL);
  free(one);
  char *const marked = read_text("pieces.json"), *const by_ranks = read_text("ranks.json");
  expect_same_numbers(marked, by_ranks);
  free(marked);
  free(by_ranks);
  for (int i = 0; i < n_pieces; ++i) {
    char a[64], b[64];
    snprintf(a, sizeof a, "out/out_%04d.vtu", i);
    snprintf(b, sizeof b, "ranks/ranks_%04d.vtu", i);
    assert_true(scratch_is_same(a, b));
  }
}

#endif

TEST(marks_are_those_of_the_joined_mesh) {
  static const char *const valves[] = {"aortic", "coapting", "mitral", "trileaflet", "bileaflet"};
  rng = random_start("marks_are_those_of_the_joined_mesh");
  int n_leaking = 0, n_several = 0, n_open = 0, n_closed = 0;
  for (int trial = 0; trial < (is_long_test() ? 100 : 4); ++trial) {
    char half_thickness[32], limit[32], opening[32], from[96], to[96];
    const char *const valve = valves[trial % 5];
    has_ids = below(2), has_attribute = below(2), has_ghosts = below(2);
    const int is_tube = below(3) > 0;
    make_whole(is_tube ? 8 + below(5) : 6 + below(4), trial % 3);
    if (is_tube) keep_tube(1.25);
    cut();
    write_joined();
    write_pieces();
    const double eps = below(3) ? random_between(&rng, 0.05, 0.3) : random_between(&rng, 0.3, 0.5);
    snprintf(half_thickness, sizeof half_thickness, "%.3f", eps);
    snprintf(limit, sizeof limit, "%.3f", 2 * eps);
    snprintf(opening, sizeof opening, "%.2f", below(2) ? 0 : random_between(&rng, 0, 0.3));
    snprintf(from, sizeof from, "%.3f,%.3f,%.3f", random_between(&rng, -0.3, 0.3), random_between(&rng, -0.3, 0.3),
             -1.75);
    snprintf(to, sizeof to, "%.3f,%.3f,%.3f", random_between(&rng, -0.3, 0.3), random_between(&rng, -0.3, 0.3), 1.1);
    run_program("mark", scratch_path("joined.vtu"), "--valve", valve, "--opening", opening, "--half-thickness",
                half_thickness, "--distance-limit", limit, "--resistance", "1e4", "--output",
                scratch_path("joined_out.vtu"), "--stats", scratch_path("joined.json"), "--quiet", NULL);
    const int code = program_exit_code;
    run_program("mark", scratch_path("mesh.pvtu"), "--valve", valve, "--opening", opening, "--half-thickness",
                half_thickness, "--distance-limit", limit, "--resistance", "1e4", "--output", scratch_path("out.pvtu"),
                "--stats", scratch_path("pieces.json"), "--quiet", NULL);
    if (code != program_exit_code) fail_msg("exit codes %d and %d: %s", code, program_exit_code, program_err);
    char *joined = read_text("joined.json"), *pieces = read_text("pieces.json");
    expect_same_numbers(joined, pieces);
    n_leaking += json_number(joined, "n_leaking_edges") > 0;
    n_several += n_pieces > 1 && json_number(joined, "n_open_regions") > 1;
    expect_same_array("riis_marked");
    expect_same_array("riis_distance");
    expect_same_array("riis_leaflet");
    expect_same_array("riis_K");
    expect_same_array("pressure");
    free(pieces);
    /* The written pieces form a mesh with the same marks. */
    run_program("mark", scratch_path("out.pvtu"), "--valve", valve, "--opening", opening, "--half-thickness",
                half_thickness, "--distance-limit", limit, "--stats", scratch_path("pieces.json"), "--quiet", NULL);
    assert_int_equal(program_exit_code, code);
    pieces = read_text("pieces.json");
    expect_same_numbers(joined, pieces);
    free(joined);
    free(pieces);
    const char *const first = trial % 10 == 0 ? "--first-passage" : "--quiet"; /* reads the pieces for many openings */
    run_program("check", "leaks", scratch_path("joined.vtu"), first, "--between", from, to, "--valve", valve,
                "--opening", opening, "--half-thickness", half_thickness, "--stats", scratch_path("joined.json"),
                "--quiet", NULL);
    const int checked = program_exit_code;
    char refusal[longest_output];
    memcpy(refusal, program_err, sizeof refusal);
    run_program("check", "leaks", scratch_path("mesh.pvtu"), first, "--between", from, to, "--valve", valve,
                "--opening", opening, "--half-thickness", half_thickness, "--stats", scratch_path("pieces.json"),
                "--quiet", NULL);
    if (checked != program_exit_code) fail_msg("%d: %s and %d: %s", checked, refusal, program_exit_code, program_err);
    if (checked == 0 || checked == 3) {
      joined = read_text("joined.json"), pieces = read_text("pieces.json");
      expect_same_numbers(joined, pieces);
      expect_same("distance", strstr(joined, "\"passage\""), strstr(pieces, "\"passage\""));
      if (has_ids) expect_same("node_id", joined, pieces);
      const char *const p = strstr(joined, "\"first_passage\""), *const q = strstr(pieces, "\"first_passage\"");
      assert_int_equal(p != NULL, q != NULL);
      for (int i = 0; p && i < 4; ++i)
        expect_same((const char *const[]){"opening", "closed_opening", "distance", "n_openings"}[i], p, q);
      const char *const states[] = {"\"open", "\"closed", "\"none"};
      for (int i = 0; i < 3; ++i)
        assert_int_equal(json_has_text(joined, "state", states[i]), json_has_text(pieces, "state", states[i]));
      n_open += json_has_text(joined, "state", "\"open");
      n_closed += json_has_text(joined, "state", "\"closed");
      expect_same("closing_half_thickness", strstr(joined, "\"passage\""), strstr(pieces, "\"passage\""));
      free(joined);
      free(pieces);
    }
#ifdef RIIS_MPIEXEC
    if (trial < 2 || is_long_test())
      expect_same_by_ranks(trial % 3 == 0 ? "4" : trial % 3 == 1 ? "2" : "1", valve, opening, half_thickness, from, to);
#endif
    forget_whole();
  }
  printf("%d trials with leaks, %d with several regions, %d open and %d closed passages\n", n_leaking, n_several,
         n_open, n_closed);
}

static void make_random_mesh(int mode) {
  has_ids = below(2), has_attribute = below(2), has_ghosts = below(2);
  make_whole(8 + below(3), mode);
  keep_tube(1.25);
  cut();
  write_joined();
  write_pieces();
}

/* With an offset, the check orders the nodes by the half thickness that marks each node. */
TEST(passages_with_an_offset_are_those_of_the_joined_mesh) {
  static const char *const valves[] = {"coapting", "trileaflet", "mitral", "bileaflet", "aortic"};
  static const char *const offsets[] = {"0.5", "-0.3"};
  rng = random_start("passages_with_an_offset_are_those_of_the_joined_mesh");
  int n_open = 0, n_closed = 0, n_moved = 0;
  for (int trial = 0; trial < (is_long_test() ? 100 : 10); ++trial) {
    char eps[32], opening[32];
    const char *const valve = valves[trial % 5], *const offset = offsets[trial / 5 % 2];
    make_random_mesh(trial % 3);
    /* Thick bands of closed valves close most passages. */
    const int is_thick = trial % 2;
    snprintf(eps, sizeof eps, "%.3f", is_thick ? random_between(&rng, 0.3, 0.45) : random_between(&rng, 0.05, 0.35));
    snprintf(opening, sizeof opening, "%.2f", is_thick || below(2) ? 0 : random_between(&rng, 0, 0.5));
    const char *const first = trial % 5 == 0 ? "--first-passage" : "--quiet";
    const char *const meshes[] = {"joined.vtu", "mesh.pvtu"};
    int code[2];
    char *text[2], refusal[longest_output];
    for (int i = 0; i < 2; ++i) {
      run_program("check", "leaks", scratch_path(meshes[i]), first, "--between", "0.1,0.1,-1.75", "0.1,0.1,1.1",
                  "--valve", valve, "--opening", opening, "--half-thickness", eps, "--offset", offset, "--stats",
                  scratch_path("check.json"), "--quiet", NULL);
      code[i] = program_exit_code;
      if (i == 0) memcpy(refusal, program_err, sizeof refusal);
      text[i] = code[i] == 0 || code[i] == 3 ? read_text("check.json") : NULL;
    }
    if (code[0] != code[1]) fail_msg("%d: %s and %d: %s", code[0], refusal, code[1], program_err);
    if (!text[0]) {
      /* Both runs refuse an end in the band, and name the half thickness that marks it. */
      assert_non_null(strstr(refusal, "in the band: the half thickness that marks it, "));
      assert_non_null(strstr(program_err, "in the band: the half thickness that marks it, "));
      forget_whole();
      continue;
    }
    const char *const p = strstr(text[0], "\"passage\""), *const q = strstr(text[1], "\"passage\"");
    expect_same("distance", p, q);
    expect_same("closing_half_thickness", p, q);
    if (has_ids) expect_same("node_id", text[0], text[1]);
    const char *const first_joined = strstr(text[0], "\"first_passage\""), *const first_pieces =
                                                                               strstr(text[1], "\"first_passage\"");
    assert_int_equal(first_joined != NULL, first_pieces != NULL);
    for (int i = 0; first_joined && i < 4; ++i)
      expect_same((const char *const[]){"opening", "closed_opening", "distance", "n_openings"}[i], first_joined,
                  first_pieces);
    const int is_open = json_has_text(text[0], "state", "\"open");
    assert_int_equal(is_open, json_has_text(text[1], "state", "\"open"));
    n_open += is_open, n_closed += !is_open;
    /* The passage differs from the passage without an offset. */
    run_program("check", "leaks", scratch_path("mesh.pvtu"), "--between", "0.1,0.1,-1.75", "0.1,0.1,1.1", "--valve",
                valve, "--opening", opening, "--half-thickness", eps, "--stats", scratch_path("plain.json"), "--quiet",
                NULL);
    if (program_exit_code == 0 || program_exit_code == 3) {
      char *const without = read_text("plain.json");
      n_moved += fabs(json_number(strstr(without, "\"passage\""), "distance") - json_number(p, "distance")) > 1e-6;
      free(without);
    }
    free(text[0]);
    free(text[1]);
    forget_whole();
  }
  printf("%d open and %d closed passages with an offset, %d differ from those without\n", n_open, n_closed, n_moved);
  assert_true(n_moved > 0);
}

/* Checks that the written parts of the pieces have the values of the joined mesh's written part. */
static void expect_same_parts(int step, const char *const *names, int n_names) {
  char path[64], type[32];
  int64_t n_components = 0, n = 0, n_part = 0;
  int n_files = 0;
  double *all[8], *part = malloc(sizeof *part * 3 * (size_t)whole.n_nodes),
                  *id = malloc(sizeof *id * (size_t)whole.n_nodes);
  int *at = malloc(sizeof(int) * (size_t)whole.n_nodes);
  const size_t n_bytes = sizeof *part * 3 * (size_t)whole.n_nodes;
  snprintf(path, sizeof path, "joined/joined_%04d.vtu", step);
  assert_int_equal(shim_read_array(scratch_path(path), 'p', "riis_node_id", type, &n_components, &n, id), 1);
  for (int i = 0; i < whole.n_nodes; ++i) at[i] = -1;
  for (int i = 0; i < n; ++i) at[(int)id[i]] = i;
  for (int k = 0; k < n_names; ++k) {
    all[k] = malloc(n_bytes);
    assert_int_equal(shim_read_array(scratch_path(path), 'p', names[k], type, &n_components, &n, all[k]), 1);
  }
  for (int piece = 0; piece < n_pieces; ++piece) {
    char name[64];
    snprintf(name, sizeof name, "series/series_p%04d_%04d.vtu", piece, step);
    if (!scratch_exists(name)) continue;
    ++n_files;
    assert_int_equal(shim_read_array(scratch_path(name), 'p', "riis_node_id", type, &n_components, &n_part, id), 1);
    for (int k = 0; k < n_names; ++k) {
      assert_int_equal(shim_read_array(scratch_path(name), 'p', names[k], type, &n_components, &n_part, part), 1);
      for (int i = 0; i < n_part; ++i) {
        const int node = at[nodes_of[piece][(int)id[i]]];
        assert_true(node >= 0);
        for (int c = 0; c < n_components; ++c) CHECK_SAME(part[n_components * i + c], all[k][n_components * node + c]);
      }
    }
  }
  /* The list of the step names the files of the pieces. */
  snprintf(path, sizeof path, "series/series_%04d.pvtu", step);
  riis_vtk_pieces *list = NULL;
  int64_t n_listed = 0;
  if (riis_vtk_pieces_read(scratch_path(path), &list) != RIIS_OK) fail_msg("%s", riis_last_error());
  assert_int_equal(riis_vtk_pieces_get_files(list, &n_listed, NULL), RIIS_OK);
  assert_int_equal(n_listed, n_files);
  for (int64_t i = 0; i < n_listed; ++i) {
    riis_vtk_mesh *mesh = NULL;
    if (riis_vtk_pieces_read_mesh(list, i, &mesh) != RIIS_OK) fail_msg("%s", riis_last_error());
    riis_vtk_mesh_destroy(&mesh);
  }
  riis_vtk_pieces_destroy(&list);
  for (int k = 0; k < n_names; ++k) free(all[k]);
  free(part);
  free(id);
  free(at);
}

/* Checks that two tables differ only in their last column, the seconds. */
static void expect_same_table(const char *a, const char *b) {
  char *const first = read_text(a), *const second = read_text(b);
  const char *p = first, *q = second;
  while (*p && *q) {
    const size_t n = strcspn(p, "\n"), m = strcspn(q, "\n");
    size_t kept = n;
    while (kept > 0 && p[kept] != ',') --kept;
    if (strncmp(p, q, kept) != 0) fail_msg("%.*s and %.*s", (int)n, p, (int)m, q);
    p += n + 1, q += m + 1;
  }
  assert_int_equal(*p, *q);
  free(first);
  free(second);
}

TEST(series_are_those_of_the_joined_mesh) {
  static const char *const names[] = {"riis_marked", "riis_distance", "riis_normal",
                                      "riis_side",   "riis_velocity", "riis_K"};
  rng = random_start("series_are_those_of_the_joined_mesh");
  for (int trial = 0; trial < (is_long_test() ? 20 : 1); ++trial) {
    make_random_mesh(below(3));
    scratch_write_text("beat.csv", "0,0\n0.2,1\n");
    for (int in_pieces = 0; in_pieces < 2; ++in_pieces)
      run_program("mark", scratch_path(in_pieces ? "mesh.pvtu" : "joined.vtu"), "--valve", "mitral", "--cycle",
                  scratch_path("beat.csv"), "--times", "0,0.1,0.2", "--resistance", "1e4", "--output",
                  scratch_path(in_pieces ? "series.pvd" : "joined.pvd"), "--surface-output",
                  scratch_path(in_pieces ? "series_surface.pvd" : "joined_surface.pvd"), "--series-table",
                  scratch_path(in_pieces ? "series.csv" : "joined.csv"), "--quiet", NULL);
    assert_int_equal(program_exit_code, 0);
    expect_same_table("joined.csv", "series.csv");
    for (int step = 0; step < 3; ++step) expect_same_parts(step, names, 6);
    assert_true(scratch_is_same("joined_surface/joined_surface_0001.vtp", "series_surface/series_surface_0001.vtp"));
#ifdef RIIS_MPIEXEC
    RUN_RANKS("2", "mark", scratch_path("mesh.pvtu"), "--valve", "mitral", "--cycle", scratch_path("beat.csv"),
              "--times", "0,0.1,0.2", "--resistance", "1e4", "--output", scratch_path("ranks.pvd"), "--series-table",
              scratch_path("ranks.csv"), "--threads", "1", "--quiet");
    if (program_exit_code != 0) fail_msg("%s", program_err);
    expect_same_table("joined.csv", "ranks.csv");
    for (int piece = 0; piece < n_pieces; ++piece) {
      char a[64], b[64];
      snprintf(a, sizeof a, "series/series_p%04d_0001.vtu", piece);
      snprintf(b, sizeof b, "ranks/ranks_p%04d_0001.vtu", piece);
      assert_int_equal(scratch_exists(a), scratch_exists(b));
      if (scratch_exists(a)) assert_true(scratch_is_same(a, b));
    }
    assert_true(scratch_exists("ranks/ranks_0002.pvtu"));
#endif
    forget_whole();
  }
}

/* Several valves at one time give equal numbers and arrays for the pieces and the joined mesh. */
TEST(cases_are_those_of_the_joined_mesh) {
  rng = random_start("cases_are_those_of_the_joined_mesh");
  make_random_mesh(2);
  scratch_write_text("case.json",
                     "{\"resistance\": 3, \"valves\": [{\"name\": \"a\", \"valve\": \"mitral\", \"opening\": 0.25},"
                     "{\"name\": \"b\", \"valve\": \"aortic\", \"translate\": [0, 0, 0.3]}]}");
  run_program("mark", scratch_path("joined.vtu"), "--case", scratch_path("case.json"), "--search", "exhaustive",
              "--threads", "1", "--output", scratch_path("joined_out.vtu"), NULL);
  char joined[longest_output];
  const char *const lines = strstr(program_out, " nodes, "), *const end = strstr(program_out, "seconds");
  if (!lines || !end) fail_msg("%s%s", program_out, program_err);
  snprintf(joined, sizeof joined, "%.*s", (int)(end - lines), lines);
  const int code = program_exit_code;
  run_program("mark", scratch_path("mesh.pvtu"), "--case", scratch_path("case.json"), "--search", "exhaustive",
              "--threads", "1", "--output", scratch_path("out.pvtu"), NULL);
  assert_int_equal(program_exit_code, code);
  if (!strstr(program_out, joined)) fail_msg("%s and %s", joined, program_out);
  expect_same_array("a_marked");
  expect_same_array("b_distance");
  expect_same_array("riis_K");
  forget_whole();
}

/* VTK's parallel writer and reader agree with riis. The writer makes equal pieces of the whole mesh, and the reader reads the
 * marked pieces. */
TEST(vtk_reads_and_writes_pieces) {
  rng = random_start("vtk_reads_and_writes_pieces");
  make_random_mesh(1);
  assert_int_equal(shim_write_pieces(scratch_path("mesh.pvtu"), scratch_path("by_vtk.pvtu"), n_pieces), 1);
  run_program("mark", scratch_path("joined.vtu"), "--half-thickness", "0.3", "--stats", scratch_path("joined.json"),
              "--quiet", NULL);
  const int code = program_exit_code;
  run_program("mark", scratch_path("by_vtk.pvtu"), "--half-thickness", "0.3", "--stats", scratch_path("pieces.json"),
              "--output", scratch_path("by_riis.pvtu"), "--quiet", NULL);
  if (program_exit_code != code) fail_msg("%s", program_err);
  char *const joined = read_text("joined.json"), *const pieces = read_text("pieces.json");
  expect_same_numbers(joined, pieces);
  double sum = 0, all = 0;
  int64_t n_cells = 0, n_points = 0;
  for (int piece = 0; piece < n_pieces; ++piece) {
    char path[64], type[32];
    static double marked[12 * 12 * 12];
    int64_t n_components = 0, n = 0;
    snprintf(path, sizeof path, "by_riis/by_riis_%04d.vtu", piece);
    if (!scratch_exists(path)) continue; /* VTK leaves out empty pieces */
    assert_int_equal(shim_read_array(scratch_path(path), 'p', "riis_marked", type, &n_components, &n, marked), 1);
    for (int64_t i = 0; i < n; ++i) all += marked[i];
    n_points += n;
  }
  assert_int_equal(shim_read_pieces(scratch_path("by_riis.pvtu"), "riis_marked", &sum, &n_cells), n_points);
  if (n_cells < whole.n_cells) fail_msg("VTK reads %d of %d cells", (int)n_cells, whole.n_cells);
  if (!(sum > 4 && sum == all)) fail_msg("VTK reads %g marks, and the pieces have %g", sum, all);
  free(joined);
  free(pieces);
  forget_whole();
  /* Each piece here has the points of all pieces, so every point would count several times. */
  plain_mesh box = plain_hexahedra(5, (double[3]){-1.7, -1.6, -1.3}, (double[3]){1.5, 1.6, 0.5});
  plain_write("parts.vtu", &box, PLAIN_CELLS, 2);
  assert_int_equal(shim_write_pieces(scratch_path("parts.vtu"), scratch_path("full.pvtu"), 2), 1);
  run_program("mark", scratch_path("full.pvtu"), "--half-thickness", "0.8", "--quiet", "--output",
              scratch_path("full_out.pvtu"), NULL);
  assert_int_equal(program_exit_code, 1);
  assert_non_null(strstr(program_err, "points are inside one piece, and in another piece they have no cell"));
  assert_false(scratch_exists("full_out.pvtu"));
  plain_free(&box);
}

/* ---- Refusals ---- */

static const char *const good_arrays =
    "<PPointData><PDataArray type=\"Float64\" Name=\"pressure\"/></PPointData><PPoints><PDataArray type=\"Float64\" "
    "NumberOfComponents=\"3\"/></PPoints>";

/* Writes bad.pvtu, with this text in place of its arrays and pieces. */
static void write_bad(const char *content) {
  char text[2048];
  snprintf(text, sizeof text,
           "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\"><PUnstructuredGrid>%s</PUnstructuredGrid></VTKFile>",
           content);
  scratch_write_text("bad.pvtu", text);
}

static void expect_bad(const char *pieces, const char *part_of_text) {
  char content[1536];
  snprintf(content, sizeof content, "%s%s", good_arrays, pieces);
  write_bad(content);
  RUN_REFUSED(1, part_of_text, "mark", scratch_path("bad.pvtu"), "--output", scratch_path("bad_out.pvtu"));
  assert_false(scratch_exists("bad_out.pvtu"));
}

/* Writes a piece of a function as dolfinx does: a tetrahedron whose nodes have the numbers of all ranks. */
static void write_piece_of_dolfinx(const char *name, const char *points, const char *ids) {
  char text[2048];
  snprintf(text, sizeof text,
           "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"2.2\">\n<UnstructuredGrid>\n"
           "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<Points><DataArray type=\"Float64\" "
           "NumberOfComponents=\"3\" format=\"ascii\">%s</DataArray></Points>\n<Cells>"
           "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
           "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
           "<DataArray type=\"Int8\" Name=\"types\" format=\"ascii\">71</DataArray></Cells>\n<PointData>"
           "<DataArray type=\"Int64\" Name=\"vtkOriginalPointIds\" IdType=\"1\" format=\"ascii\">%s</DataArray>"
           "</PointData></Piece>\n</UnstructuredGrid></VTKFile>\n",
           points, ids);
  scratch_write_text(name, text);
}

/* In files of a function, the coordinates of a node differ in their last bits between dolfinx's ranks. The list is therefore
 * refused, and the refusal names the call that writes the mesh. A list that states the order of bytes comes from VTK. The ids in
 * VTK's list may have another meaning, so this list is accepted. */
TEST(functions_of_dolfinx_are_refused) {
  write_piece_of_dolfinx("u_p0_000000.vtu", "0 0 0 1 0 0 0 1 0 0 0 0.1", "0 1 2 3");
  write_piece_of_dolfinx("u_p1_000000.vtu", "1 1 1 1 1e-17 0 0 1 0 0 0 0.10000000000000002", "4 1 2 3");
  for (int is_of_vtk = 0; is_of_vtk < 2; ++is_of_vtk) {
    char text[1024];
    snprintf(text, sizeof text,
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\"%s>\n"
             "<PUnstructuredGrid GhostLevel=\"1\"><PPointData><PDataArray type=\"Int64\" "
             "Name=\"vtkOriginalPointIds\" IdType=\"1\"/></PPointData><PPoints><PDataArray type=\"Float64\" "
             "NumberOfComponents=\"3\"/></PPoints>\n<Piece Source=\"u_p0_000000.vtu\"/>"
             "<Piece Source=\"u_p1_000000.vtu\"/></PUnstructuredGrid></VTKFile>\n",
             is_of_vtk ? " byte_order=\"LittleEndian\"" : "");
    scratch_write_text("u000000.pvtu", text);
    if (is_of_vtk) {
      run_program("mark", scratch_path("u000000.pvtu"), "--allow-none", "--stats", "-", NULL);
      assert_int_equal(program_exit_code, 0);
      assert_true(json_number(program_out, "n_nodes") == 7);
    } else {
      RUN_REFUSED(
          1, "; on each rank, dolfinx writes the nodes of a function with other last digits: use VTKFile.write_mesh\n",
          "mark", scratch_path("u000000.pvtu"), "--allow-none");
    }
  }
}

TEST(broken_pieces_are_refused) {
  rng = random_start("broken_pieces_are_refused");
  has_ids = has_ghosts = has_attribute = 0;
  make_whole(6, 0);
  n_pieces = 2;
  for (int i = 0; i < whole.n_cells; ++i) whole.piece[i] = i % 2;
  write_pieces();
  char mesh[512];
  snprintf(mesh, sizeof mesh, "%s", scratch_path("mesh.pvtu"));
  /* Lists. */
  expect_bad("", "bad.pvtu: names no pieces");
  expect_bad("<Piece/>", "bad.pvtu: Piece 0 names no file");
  expect_bad("<Piece Source=\"piece0.vtu\"/><Piece Source=\"\"/>", "bad.pvtu: Piece 1 names no file");
  expect_bad("<Piece Source=\"piece0.vtu\"/><Piece Source=\"gone.vtu\"/>", "gone.vtu");
  expect_bad("<Piece Source=\"piece0.vtk\"/>", "Piece 0 is");
  expect_bad("<Piece Source=\"bad.pvtu\"/>", "a piece must be a .vtu file");
  expect_bad("<Piece Source=\"piece0.vtu\"/><Piece Source=\"./piece0.vtu\"/>", "Piece 1 is the same file as Piece 0");
  expect_bad("<Piece Source=\".\"/>", "a piece must be a .vtu file");
  scratch_write_text("bad.pvtu", "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid></VTKFile>");
  RUN_REFUSED(1, "bad.pvtu: ", "mark", scratch_path("bad.pvtu"));
  scratch_write_text("bad.pvtu", "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>");
  RUN_REFUSED(1, "bad.pvtu: is truncated", "mark", scratch_path("bad.pvtu"));
  scratch_write_text("bad.pvtu", "<VTKFile type=\"UnstructuredGrid\"></VTKFile>");
  RUN_REFUSED(1, "holds UnstructuredGrid, not PUnstructuredGrid", "mark", scratch_path("bad.pvtu"));
  RUN_REFUSED(1, "gone.pvtu", "mark", scratch_path("gone.pvtu"));
  /* Three pieces are refused: a file that is not a grid, a truncated file, and a piece without an array that the others have. */
  scratch_write_text("text.vtu", "no grid");
  expect_bad("<Piece Source=\"piece0.vtu\"/><Piece Source=\"text.vtu\"/>", "text.vtu: is not a VTK XML file");
  size_t n = 0;
  char *const bytes = scratch_read(scratch_path("piece1.vtu"), &n);
  scratch_write("short.vtu", bytes, n / 2);
  expect_bad("<Piece Source=\"piece0.vtu\"/><Piece Source=\"short.vtu\"/>", "short.vtu: is truncated");
  free(bytes);
  const int cells[2] = {0, 1},
            nodes[16] = {whole.corners[0][0], whole.corners[0][1], whole.corners[0][2], whole.corners[0][3],
                         whole.corners[0][4], whole.corners[0][5], whole.corners[0][6], whole.corners[0][7]};
  write_grid(scratch_path("plain.vtu"), 8, nodes, 1, cells, NULL, "pressure");
  expect_bad("<Piece Source=\"piece0.vtu\"/><Piece Source=\"plain.vtu\"/>",
             "plain.vtu: has no point array pressure, which");
  write_bad("<PPoints/><Piece Source=\"piece0.vtu\"/>");
  RUN_REFUSED(1, "piece0.vtu: has the point array pressure, which", "mark", scratch_path("bad.pvtu"));
  write_bad("<PPointData><PDataArray type=\"Float32\" Name=\"pressure\"/></PPointData><Piece Source=\"piece0.vtu\"/>");
  RUN_REFUSED(1, "pressure is Float64; ", "mark", scratch_path("bad.pvtu"));
  write_bad(
      "<PPointData><PDataArray type=\"Float64\" Name=\"pressure\" NumberOfComponents=\"3\"/></PPointData>"
      "<Piece Source=\"piece0.vtu\"/>");
  RUN_REFUSED(1, "pressure has 1 components; ", "mark", scratch_path("bad.pvtu"));
  write_grid(scratch_path("empty.vtu"), 0, nodes, 0, cells, NULL, "");
  expect_bad("<Piece Source=\"empty.vtu\"/>", "bad.pvtu: no piece holds points");
  /* One global id occurs at two places. */
  has_ids = 1;
  write_grid(scratch_path("one.vtu"), 8, nodes, 1, cells, NULL, "");
  whole.xyz[3 * nodes[3]] += 0.01;
  write_grid(scratch_path("two.vtu"), 8, nodes, 1, cells, NULL, "");
  write_list("ids.pvtu", 2, (const char *const[]){"one.vtu", "two.vtu"});
  char text[64];
  snprintf(text, sizeof text, "the node with the global id %d is at one place in", nodes[3]);
  run_program("mark", scratch_path("ids.pvtu"), NULL);
  assert_int_equal(program_exit_code, 1);
  assert_non_null(strstr(program_err, text));
  /* Without global ids, coordinates that differ by rounding cause a warning. */
  has_ids = 0;
  for (int i = 0; i < 3 * whole.n_nodes; ++i) whole.xyz[i] += 1e-9;
  write_grid(scratch_path("one.vtu"), 8, nodes, 1, cells, NULL, "");
  for (int i = 0; i < 3 * whole.n_nodes; ++i) whole.xyz[i] -= 2e-9;
  write_grid(scratch_path("two.vtu"), 8, nodes, 1, cells, NULL, "");
  write_list("apart.pvtu", 2, (const char *const[]){"one.vtu", "two.vtu"});
  run_program("mark", scratch_path("apart.pvtu"), NULL);
  assert_non_null(strstr(program_err, "apart.pvtu share no node, so nothing passes from one to another"));
  /* Options. */
  RUN_REFUSED(2, "--output: ", "mark", mesh, "--output", scratch_path("out.vtu"));
  RUN_REFUSED(2, "must end in .pvtu", "mark", mesh, "--output", scratch_path("out.vtu"));
  RUN_REFUSED(2, "must end in .vtu", "mark", scratch_path("piece0.vtu"), "--output", scratch_path("out.pvtu"));
  RUN_REFUSED(2, "--picture: a picture needs the whole mesh", "mark", mesh, "--picture", scratch_path("a.png"));
  RUN_REFUSED(2, "--steps: ", "mark", mesh, "--steps", "3");
  RUN_REFUSED(2, "--search paper: ", "mark", mesh, "--search", "paper");
  RUN_REFUSED(2, "--between: FROM, 9 9 9, is outside the mesh", "check", "leaks", mesh, "--between", "9,9,9", "0,0,1",
              "--half-thickness", "0.4");
  RUN_REFUSED(2, "is also the file of MESH", "mark", mesh, "--output", mesh);
#ifdef RIIS_MPIEXEC
  /* Each rank has one piece. The second rank cannot read its piece, and both ranks end. */
  write_bad(
      "<PPointData><PDataArray type=\"Float64\" Name=\"pressure\"/></PPointData><Piece Source=\"piece0.vtu\"/>"
      "<Piece Source=\"short.vtu\"/>");
  RUN_RANKS("2", "mark", scratch_path("bad.pvtu"), "--output", scratch_path("bad_out.pvtu"));
  assert_int_equal(program_exit_code, 1);
  const char *const said = strstr(program_err, "riis: ");
  assert_non_null(said);
  assert_non_null(strstr(said, "short.vtu: is truncated"));
  assert_null(strstr(said + 1, "riis: "));
  assert_false(scratch_exists("bad_out.pvtu"));
#endif
  forget_whole();
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
