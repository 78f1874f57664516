/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests riis place: files of landmarks, the placed valve for other commands, and refusals. The landmarks are made from known
 * sizes. */
#include <riis/riis_vtk.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

static const double R = 1.1, Rc = 1.05, height = 1.4;
static const char *const names[6] = {"nadir_right",         "commissure_right_left", "nadir_left",
                                     "commissure_left_non", "nadir_non_coronary",    "commissure_right_non"};

/* Writes landmark i of a trileaflet valve that is turned by 90 degrees about y and moved. The unit of length is a centimetre
 * divided by `scale`. */
static void landmark(int i, double scale, double *p) {
  const double angle = 60 * i * acos(-1.0) / 180, radius = i % 2 ? Rc : R, z = i % 2 ? height : 0;
  p[0] = scale * (z + 0.2), p[1] = scale * (radius * sin(angle) + 0.1), p[2] = scale * (-radius * cos(angle) - 0.3);
}

/* Writes a JSON file of landmarks with the given unit and axes. `sign` multiplies x and y. `more` has further keys, or is "". */
static const char *json_of(const char *name, const char *unit, double scale, const char *axes, double sign,
                           const char *more) {
  char text[4096];
  int n = snprintf(text, sizeof text, "{\"unit\": \"%s\", \"axes\": \"%s\", %s\"landmarks\": {", unit, axes, more);
  for (int i = 0; i < 6; ++i) {
    double p[3];
    landmark(i, scale, p);
    n += snprintf(text + n, sizeof text - (size_t)n, "%s\"%s\": [%.17g, %.17g, %.17g]", i ? ", " : "", names[i],
                  sign * p[0], sign * p[1], p[2]);
  }
  snprintf(text + n, sizeof text - (size_t)n, "}}");
  scratch_write_text(name, text);
  return scratch_path(name);
}

static void expect_sizes(const char *json) {
  if (fabs(json_number(json, "root_radius") - R) > 1e-9 || fabs(json_number(json, "leaflet_radius_out") - Rc) > 1e-9 ||
      fabs(json_number(json, "leaflet_height") - height) > 1e-9 ||
      fabs(json_number(json, "bending_height") - 0.7) > 1e-9)
    fail_msg("other sizes: %s", json);
}

TEST(every_format_gives_the_same) {
  static char first[longest_output];
  RUN_FINE("place", json_of("a.json", "mm", 10, "LPS", 1, "\"valve\": \"trileaflet\", "), "--output", "-");
  expect_sizes(program_out);
  assert_true(strstr(program_out, "\"unit\": \"mm\"") && strstr(program_out, "\"axes\": \"LPS\""));
  if (fabs(json_number(program_out, "rms")) > 1e-8) fail_msg("residuals: %s", program_out);
  strcpy(first, strstr(program_out, "\"rotate\""));
  /* The landmarks are given in metres and RAS, and the options convert them. */
  RUN_FINE("place", json_of("b.json", "m", 0.01, "RAS", -1, ""), "--valve", "trileaflet", "--unit", "mm", "--axes",
           "LPS", "--output", "-");
  expect_sizes(program_out);
  char text[4096], slicer[4096];
  int n = snprintf(text, sizeof text,
                   "\xef\xbb\xbf# a comment\n# unit = cm;;;\n# axes = mesh\n# valve = trileaflet\n# flow = 1, 0, 0\n"
                   "name,x,y,z\n");
  int m = snprintf(slicer, sizeof slicer,
                   "{\"markups\": [{\"coordinateSystem\": \"LPS\", \"coordinateUnits\": \"mm\", "
                   "\"locked\": true, \"controlPoints\": [");
  for (int i = 0; i < 6; ++i) {
    double p[3];
    landmark(i, 1, p);
    n += snprintf(text + n, sizeof text - (size_t)n,
                  i % 2 ? "%s;%.17g;%.17g;%.17g\r\n" : "\"%s \",%.17g,\"%.17g\",%.17g\n", names[i], p[0], p[1], p[2]);
    landmark(i, 10, p);
    m += snprintf(slicer + m, sizeof slicer - (size_t)m,
                  "{\"label\": \"%s\", \"position\": [%.17g, %.17g, %.17g], \"positionStatus\": \"defined\"}, ",
                  names[i], p[0], p[1], p[2]);
  }
  snprintf(
      slicer + m, sizeof slicer - (size_t)m,
      "{\"label\": \"flow-from\", \"position\": [0, 0, 0]}, {\"label\": \"flow-to\", \"position\": [9, 1, 0]}]}]}");
  scratch_write_text("c.csv", text);
  scratch_write_text("d.mrk.json", slicer);
  RUN_FINE("place", scratch_path("c.csv"), "--output", "-");
  expect_sizes(program_out);
  RUN_FINE("place", scratch_path("d.mrk.json"), "--valve", "trileaflet", "--output", "-");
  expect_sizes(program_out);
  /* In 3D Slicer's schema, the unit may also be an array whose first entry is the unit. The default is mm. */
  char *unit = strstr(slicer, "\"coordinateUnits\": \"mm\", ");
  for (const char *const *other =
           (const char *const[]){"\"coordinateUnits\":[\"mm\"],", "\"description\": \"none.\",", NULL};
       *other; ++other) {
    memset(unit, ' ', strlen("\"coordinateUnits\": \"mm\", "));
    memcpy(unit, *other, strlen(*other));
    scratch_write_text("d.mrk.json", slicer);
    RUN_FINE("place", scratch_path("d.mrk.json"), "--valve", "trileaflet", "--output", "-");
    expect_sizes(program_out);
  }
}

/* Files of earlier versions of 3D Slicer have other columns, and give the axes as numbers. */
TEST(fcsv_gives_the_same) {
  const struct {
    const char *heading, *row;
    double sign;
  } versions[] = {
      {"# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n# columns = "
       "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n",
       "vtkMRMLMarkupsFiducialNode_%d,%.17g,%.17g,%.17g,0,0,0,1,1,1,0,%s,,\n", 1},
      {"# Markups fiducial file version = 4.6\n# CoordinateSystem = 0\n# columns = "
       "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label\n",
       "node_%d,%.17g,%.17g,%.17g,0,0,0,1,1,1,0,%s\n", -1},
      {"# CoordinateSystem = LPS\n", "vtkMRMLMarkupsFiducialNode_%d,%.17g,%.17g,%.17g,0,0,0,1,1,1,0,%s,,\n", 1},
      {"# Markups fiducial file version = 5.6\n# CoordinateSystem = LPS\n# columns = "
       "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n",
       "%d,%.17g,%.17g,%.17g,0,0,0,1,1,1,0,%s,,,2,0\n", 1}};
  for (size_t version = 0; version < sizeof versions / sizeof *versions; ++version) {
    char text[4096];
    int n = snprintf(text, sizeof text, "%s", versions[version].heading);
    for (int i = 0; i < 8; ++i) {
      double p[3] = {i == 7 ? 9 : 0, i == 7 ? 1 : 0, 0};
      if (i < 6) landmark(i, 10, p);
      n += snprintf(text + n, sizeof text - (size_t)n, versions[version].row, i, versions[version].sign * p[0],
                    versions[version].sign * p[1], p[2],
                    i < 6    ? names[i]
                    : i == 6 ? "flow_from"
                             : "flow_to");
    }
    scratch_write_text("a.fcsv", text);
    RUN_FINE("place", scratch_path("a.fcsv"), "--valve", "trileaflet", "--axes", "LPS", "--output", "-");
    expect_sizes(program_out);
    assert_non_null(strstr(program_out, "\"unit\": \"mm\""));
  }
}

/* Tests the tables that 3D Slicer exports, and .csv files that a spreadsheet has saved. Spreadsheets quote cells, add empty
 * cells, and end lines with a carriage return. */
TEST(tables_give_the_same) {
  const struct {
    const char *heading, *row;
    double sign;
  } tables[] = {{"label,r,a,s,defined,selected,visible,locked,description\n", "%s,%.17g,%.17g,%.17g,1,1,1,0,\n", -1},
                {"label,l,p,s\n", "%s,%.17g,%.17g,%.17g\n", 1},
                {"\"# unit = mm\",,,,\r\n\"# axes = LPS\",,,,\r\n", "\"%s\",\"%.17g\",\"%.17g\",\"%.17g\",\r\n", 1},
                {"# unit = mm\r# axes = LPS\r", "%s,%.17g,%.17g,%.17g,,\r", 1}};
  for (size_t k = 0; k < sizeof tables / sizeof *tables; ++k) {
    char text[4096];
    int n = snprintf(text, sizeof text, "%s", tables[k].heading);
    for (int i = 0; i < 6; ++i) {
      double p[3];
      landmark(i, 10, p);
      n += snprintf(text + n, sizeof text - (size_t)n, tables[k].row, names[i], tables[k].sign * p[0],
                    tables[k].sign * p[1], p[2]);
    }
    scratch_write_text("t.csv", text);
    RUN_FINE("place", scratch_path("t.csv"), "--valve", "trileaflet", "--axes", "LPS", "--output", "-");
    expect_sizes(program_out);
    assert_non_null(strstr(program_out, "\"unit\": \"mm\""));
  }
}

/* 3D Slicer's files have keys that are nested more deeply than any file of riis. */
TEST(other_keys_may_be_deep) {
  char text[4096], deep[256] = "{\"markups\": [{\"measurements\": ";
  for (int i = 0; i < 20; ++i) strcat(deep, "[");
  for (int i = 0; i < 20; ++i) strcat(deep, "]");
  int n = snprintf(text, sizeof text, "%s, \"coordinateSystem\": \"LPS\", \"controlPoints\": [", deep);
  for (int i = 0; i < 6; ++i) {
    double p[3];
    landmark(i, 10, p);
    n += snprintf(text + n, sizeof text - (size_t)n, "%s{\"label\": \"%s\", \"position\": [%.17g, %.17g, %.17g]}",
                  i ? ", " : "", names[i], p[0], p[1], p[2]);
  }
  snprintf(text + n, sizeof text - (size_t)n, "]}]}");
  scratch_write_text("deep.mrk.json", text);
  RUN_FINE("place", scratch_path("deep.mrk.json"), "--valve", "trileaflet", "--output", "-");
  expect_sizes(program_out);
}

TEST(closed_curve_is_an_annulus) {
  static const double annulus[8][3] = {{15, 0, 0},  {10, 12, 1},   {0, 17, 2},  {-10, 12, 1},
                                       {-15, 0, 0}, {-10, -12, 1}, {0, -17, 2}, {10, -12, 1}};
  static char by_name[longest_output];
  char json[2048], curve[4096];
  int n = snprintf(json, sizeof json, "{\"unit\": \"mm\", \"axes\": \"LPS\", \"landmarks\": {\"annulus\": [");
  int m = snprintf(curve, sizeof curve,
                   "{\"markups\": [{\"type\": \"ClosedCurve\", \"coordinateSystem\": \"LPS\", \"controlPoints\": [");
  for (int i = 0; i < 8; ++i) {
    n += snprintf(json + n, sizeof json - (size_t)n, "%s[%g, %g, %g]", i ? ", " : "", annulus[i][0], annulus[i][1],
                  annulus[i][2]);
    m += snprintf(curve + m, sizeof curve - (size_t)m, "%s{\"label\": \"%s%d\", \"position\": [%g, %g, %g]}",
                  i ? ", " : "", i % 2 ? "MV-" : "trigone_", i, annulus[i][0], annulus[i][1], annulus[i][2]);
  }
  snprintf(json + n, sizeof json - (size_t)n,
           "], \"anterior_horn\": [0, 17, 2], \"flow_from\": [0, 0, 9], \"flow_to\": [0, 0, 0]}}");
  snprintf(
      curve + m, sizeof curve - (size_t)m,
      "]}, {\"coordinateSystem\": \"LPS\", \"controlPoints\": ["
      "{\"label\": \"anterior_horn\", \"position\": [0, 17, 2]}, {\"label\": \"flow_from\", \"position\": [0, 0, 9]}, "
      "{\"label\": \"flow_to\", \"position\": [0, 0, 0]}]}]}");
  scratch_write_text("a.json", json);
  scratch_write_text("curve.mrk.json", curve);
  RUN_FINE("place", scratch_path("a.json"), "--valve", "mitral", "--output", "-");
  strcpy(by_name, program_out);
  RUN_FINE("place", scratch_path("curve.mrk.json"), "--valve", "mitral", "--output", "-");
  assert_string_equal(program_out, by_name);
  /* The curves of two valves are no annulus. */
  static char two[8192];
  const char *const end = "{\"coordinateSystem\"", *const rest = strstr(curve, end);
  snprintf(two, sizeof two, "%.*s%s", (int)(rest - curve), curve, strchr(curve, '[') + 1);
  scratch_write_text("two.mrk.json", two);
  RUN_REFUSED(1, "markups 1 is a second curve of an annulus, after markups 0: save the curves of one valve only",
              "place", scratch_path("two.mrk.json"), "--valve", "mitral");
  /* Eight points do not determine all sizes. */
  RUN_FINE("place", scratch_path("a.json"), "--valve", "mitral");
  assert_non_null(strstr(program_out, "\nThe landmarks do not determine "));
  assert_non_null(
      strstr(program_out, "The table has guesses of these sizes, from the usual proportions of this kind of valve."));
  assert_non_null(strstr(program_out, "Add landmarks, or give known sizes in cm, for example by --set "));
  /* In an open curve, a label that names no landmark makes a point of the annulus. Other labels keep their meaning. */
  m = snprintf(curve, sizeof curve,
               "{\"markups\": [{\"type\": \"Curve\", \"coordinateSystem\": \"LPS\", \"controlPoints\": [");
  for (int i = 0; i < 8; ++i)
    m += snprintf(curve + m, sizeof curve - (size_t)m, "{\"label\": \"MV-%d\", \"position\": [%g, %g, %g]}, ", i,
                  annulus[i][0], annulus[i][1], annulus[i][2]);
  snprintf(curve + m, sizeof curve - (size_t)m,
           "{\"label\": \"anterior_horn\", \"position\": [0, 17, 2]}, {\"label\": \"flow_from\", \"position\": "
           "[0, 0, 9]}, {\"label\": \"flow_to\", \"position\": [0, 0, 0]}]}]}");
  scratch_write_text("curve.mrk.json", curve);
  RUN_FINE("place", scratch_path("curve.mrk.json"), "--valve", "mitral", "--output", "-");
  assert_string_equal(program_out, by_name);
}

/* A list under the name of a single landmark may have only one point. */
TEST(lists_of_one_point_are_points) {
  const char *one = json_of("a.json", "mm", 10, "LPS", 1, "\"valve\": \"trileaflet\", ");
  static char expected[longest_output], text[4096];
  for (int with_middle = 0; with_middle < 2; ++with_middle) {
    for (int as_list = 0; as_list < 2; ++as_list) {
      int n = snprintf(text, sizeof text,
                       "{\"valve\": \"trileaflet\", \"unit\": \"mm\", \"axes\": \"LPS\", "
                       "\"landmarks\": {");
      for (int i = 0; i < 6 + with_middle; ++i) {
        double p[3] = {10, 2, -2};
        if (i < 6) landmark(i, 10, p);
        n += snprintf(text + n, sizeof text - (size_t)n, "%s\"%s\": %s[%.17g, %.17g, %.17g]%s", i ? ", " : "",
                      i < 6 ? names[i] : "coaptation", as_list ? "[" : "", p[0], p[1], p[2], as_list ? "]" : "");
      }
      snprintf(text + n, sizeof text - (size_t)n, "}}");
      scratch_write_text("a.json", text);
      RUN_FINE("place", one, "--output", "-");
      if (!as_list) strcpy(expected, program_out);
    }
    assert_string_equal(program_out, expected);
  }
  for (const char *const *name = (const char *const[]){"coaptation", "nadir_left", "annulus_3", "flow_to", NULL}; *name;
       ++name) {
    snprintf(text, sizeof text,
             "{\"unit\": \"mm\", \"axes\": \"LPS\", \"landmarks\": {\"%s\": [[0, 0, 1], [0, 0, 2]]}}", *name);
    scratch_write_text("a.json", text);
    snprintf(text, sizeof text, "\"%s\" is given twice", *name);
    RUN_REFUSED(1, text, "place", one, "--valve", "trileaflet");
  }
}

TEST(report_has_sizes_and_residuals) {
  RUN_FINE("place", json_of("a.json", "mm", 10, "LPS", 1, "\"parameters\": {\"leaflet_height\": 1.5}, "), "--valve",
           "trileaflet", "--noise", "0.5");
  for (const char *const *words =
           (const char *const[]){"trileaflet valve from 6 landmarks", "noise 0.5 mm", "root_radius", "1.1 cm",
                                 "landmarks", "proportion", "residual mm", "nadir_right", "rms 0.5", "scale 10,",
                                 "determine all sizes", NULL};
       *words; ++words)
    if (!strstr(program_out, *words)) fail_msg("no %s in %s", *words, program_out);
  if (strstr(program_out, "leaflet_height")) fail_msg("a held size is in the report: %s", program_out);
  /* Residuals are in millimetres in every unit. */
  RUN_FINE("place", json_of("a.json", "m", 0.01, "LPS", 1, "\"parameters\": {\"leaflet_height\": 1.5}, "), "--valve",
           "trileaflet", "--noise", "0.0005");
  if (!strstr(program_out, "residual mm") || !strstr(program_out, "\nrms 0.5"))
    fail_msg("the residuals in metres: %s", program_out);
}

/* Landmarks of a patient with unequal cusps, in millimetres. */
static void patient_landmark(int i, double *p) {
  landmark(i, 10, p);
  p[0] += 1.5 * sin(1.7 * i), p[1] += 1.2 * cos(2.3 * i), p[2] += 0.9 * sin(3.1 * i + 1);
}

static const char *patient_json(const char *name) {
  char text[4096];
  int n = snprintf(text, sizeof text, "{\"unit\": \"mm\", \"axes\": \"LPS\", \"landmarks\": {");
  for (int i = 0; i < 6; ++i) {
    double p[3];
    patient_landmark(i, p);
    n += snprintf(text + n, sizeof text - (size_t)n, "%s\"%s\": [%.17g, %.17g, %.17g]", i ? ", " : "", names[i], p[0],
                  p[1], p[2]);
  }
  snprintf(text + n, sizeof text - (size_t)n, "}}");
  scratch_write_text(name, text);
  return scratch_path(name);
}

/* Returns the largest distance of the patient's landmarks from a surface, in millimetres. */
static double farthest_landmark(const char *vtp) {
  riis_vtk_surface *file = NULL;
  riis_surface_arrays arrays;
  riis_surface *surface = NULL;
  if (riis_vtk_surface_read(vtp, NULL, &file) || riis_vtk_surface_get_arrays(file, &arrays, sizeof arrays) ||
      riis_surface_create_from_arrays(&arrays, NULL, &surface))
    fail_msg("%s", riis_last_error());
  double farthest = 0;
  for (int i = 0; i < 6; ++i) {
    double p[3];
    riis_closest closest;
    patient_landmark(i, p);
    if (riis_closest_point(surface, p, &closest, sizeof closest)) fail_msg("%s", riis_last_error());
    farthest = fmax(farthest, closest.distance);
  }
  riis_surface_destroy(&surface);
  riis_vtk_surface_destroy(&file);
  return farthest;
}

TEST(warps_meet_the_landmarks) {
  static const char *const kinds[] = {"trileaflet", "coapting"};
  char placed[256], surface[256], csv[256];
  snprintf(surface, sizeof surface, "%s", scratch_path("warped.vtp"));
  /* At a commissure of the paper's valve, two cusps end beside each other. One of these two ends is at the landmark. */
  snprintf(placed, sizeof placed, "%s", scratch_path("aortic.json"));
  RUN_FINE("place", patient_json("w.json"), "--valve", "aortic", "--warp", "exact", "--output", placed);
  RUN_FINE("surface", "--valve", placed, "--quiet", "--output", surface);
  if (farthest_landmark(surface) > 0.01) fail_msg("aortic: off by %g", farthest_landmark(surface));
  for (int kind = 0; kind < 2; ++kind) {
    snprintf(placed, sizeof placed, "%s", scratch_path("exact.json"));
    RUN_FINE("place", patient_json("w.json"), "--valve", kinds[kind], "--warp", "exact", "--output", placed);
    assert_true(strstr(program_out, "warped mm") && strstr(program_out, "warped, rms 0, worst 0"));
    RUN_FINE("surface", "--valve", placed, "--quiet", "--output", surface);
    if (farthest_landmark(surface) > 1e-9) fail_msg("%s: off by %g", kinds[kind], farthest_landmark(surface));
    /* In another unit, the placed valve is the same. */
    RUN_FINE("mark", scratch_path("in.vtu"), "--valve", placed, "--unit", "cm", "--allow-none", "--stats", "-");
    const double in_cm = json_number(program_out, "area");
    RUN_FINE("mark", scratch_path("in.vtu"), "--valve", placed, "--allow-none", "--stats", "-");
    const double in_mm = json_number(program_out, "area");
    if (fabs(in_mm - 100 * in_cm) > 1e-9 * in_mm) fail_msg("areas %g mm2, %g cm2", in_mm, in_cm);
    RUN_REFUSED(2, "which has a warp", "surface", "--valve", placed, "--warp", placed, "--output", surface);
    /* With smoothing, the file gives the valve's distance from the landmarks, and this distance is right. */
    RUN_FINE("place", patient_json("w.json"), "--valve", kinds[kind], "--warp", "smoothed", "--noise", "0.3",
             "--output", "-");
    const double rms = json_number(program_out, "warped_rms"), worst = json_number(program_out, "warped_worst");
    if (!(rms > 0.02 && rms < 0.6)) fail_msg("rms %g at a noise of 0.3", rms);
    scratch_write_text("smoothed.json", program_out);
    RUN_FINE("surface", "--valve", scratch_path("smoothed.json"), "--quiet", "--output", surface);
    if (fabs(farthest_landmark(surface) - worst) > 0.05)
      fail_msg("off by %g, stated %g", farthest_landmark(surface), worst);
  }
  /* OpenFOAM's dictionary has the landmarks in metres. Its sources are the landmarks' places on the valve, and its targets are
   * the patient's landmarks. */
  RUN_FINE("place", patient_json("w.json"), "--valve", "coapting", "--warp", "smoothed", "--noise", "0.3", "--quiet",
           "--foam", "-");
  const char *const warp = strstr(program_out, "\nwarp\n{\n    sources\n    ("),
                    *at = warp ? strstr(warp, "\n    targets\n    (\n") : NULL;
  const char *const noise = at ? strstr(at, "\n    noise           ") : NULL;
  /* The residuals show a larger noise than was stated. */
  if (!noise || !(strtod(noise + 11, NULL) > 2e-4 && strtod(noise + 11, NULL) < 3e-3))
    fail_msg("no warp, or no noise in metres: %s", noise ? noise : program_out);
  at = strstr(at, "        (");
  for (int i = 0; i < 6; ++i, at = strchr(at, '\n') + 1) {
    double p[3], q[3];
    patient_landmark(i, p);
    if (sscanf(at, "        (%lf %lf %lf)\n", q, q + 1, q + 2) != 3) fail_msg("no landmark %d: %s", i, program_out);
    for (int c = 0; c < 3; ++c)
      if (fabs(q[c] - 1e-3 * p[c]) > 1e-12) fail_msg("landmark %d: %g is not %g mm", i, q[c], p[c]);
  }
  /* A file of pairs acts like the key of the placed valve. The targets of the pairs are the landmarks shifted by 1 mm. */
  RUN_FINE("place", patient_json("w.json"), "--valve", "trileaflet", "--quiet", "--output", scratch_path("bare.json"));
  char text[2048] = "# noise = 0\nsx,sy,sz,tx,ty,tz\n";
  for (int i = 0; i < 6; ++i) {
    double p[3];
    patient_landmark(i, p);
    snprintf(text + strlen(text), sizeof text - strlen(text), "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", p[0], p[1], p[2],
             p[0] + 1, p[1], p[2]);
  }
  scratch_write_text("pairs.csv", text);
  snprintf(csv, sizeof csv, "%s", scratch_path("pairs.csv"));
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", scratch_path("bare.json"), "--allow-none", "--stats", "-");
  const double area = json_number(program_out, "area");
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", scratch_path("bare.json"), "--warp", csv, "--allow-none",
           "--stats", "-");
  if (fabs(json_number(program_out, "area") - area) > 1e-9 * area) fail_msg("a shift changes the area %g", area);
  RUN_FINE("check", "crossings", "--valve", scratch_path("bare.json"), "--warp", csv);
  RUN_FINE("states", scratch_path("states.csv"), "--valve", scratch_path("bare.json"), "--warp", csv, "--count", "2",
           "--quiet");
}

TEST(wrong_warps_are_refused) {
  const char *const to = scratch_path("x.vtp");
  char out[256], file[256];
  snprintf(out, sizeof out, "%s", to);
  scratch_write_text("pairs.csv", "0,0,0,0,0,0\n1,0,0,1,0,0\n0,1,0,0,1\n");
  snprintf(file, sizeof file, "%s", scratch_path("pairs.csv"));
  RUN_REFUSED(1, "line 3 must be SX,SY,SZ,TX,TY,TZ", "surface", "--warp", file, "--output", out);
  scratch_write_text("pairs.csv", "# axes = LPS\n0,0,0,0,0,0\n");
  RUN_REFUSED(1, "line 1: \"axes\" is unknown", "surface", "--warp", file, "--output", out);
  scratch_write_text("pairs.csv", "0,0,0,0,0,0\n1,0,0,1,0,0\n2,0,0,2,0,0\n3,0,0,3,0,0\n");
  RUN_REFUSED(1, "landmarks lie on a line", "surface", "--warp", file, "--output", out);
  scratch_write_text("pairs.csv", "0,0,0,0,0,0\n0,0,0,1,0,0\n2,0,1,2,0,1\n3,2,0,3,2,0\n");
  RUN_REFUSED(1, "are in one place", "surface", "--warp", file, "--output", out);
  scratch_write_text("pairs.csv", "0,0,0,0,0,0\n1,0,0,-1,0,0\n0,1,0,0,1,0\n0,0,1,0,0,1\n");
  RUN_REFUSED(1, "the warp folds", "surface", "--warp", file, "--output", out);
  RUN_REFUSED(2, "must end in .json or .csv", "surface", "--warp", scratch_path("in.vtu"), "--output", out);
  scratch_write_text("pairs.csv", "0,0,0,0,0,0\n1,0,0,1,0,0\n0,1,0,0,1,0\n0,0,1,0,0,1\n");
  RUN_REFUSED(1, "bileaflet valve cannot be warped", "surface", "--valve", "bileaflet", "--warp", file, "--output",
              out);
  RUN_REFUSED(2, "--warp excludes --surface", "surface", "--surface", out, "--warp", file, "--output",
              scratch_path("y.vtp"));
  scratch_write_text("moving.json",
                     "{\"sources\": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], \"times\": [0, 1], \"targets\": "
                     "[[[0,0,0],[1,0,0],[0,1,0],[0,0,1]], [[0,0,0],[1.1,0,0],[0,1,0],[0,0,1]]]}");
  RUN_REFUSED(2, "landmarks that move need --times", "surface", "--warp", scratch_path("moving.json"), "--output", out);
}

TEST(other_commands_take_the_placed_valve) {
  char placed[256];
  snprintf(placed, sizeof placed, "%s", scratch_path("placed.json"));
  RUN_FINE("place", json_of("a.json", "mm", 10, "LPS", 1, ""), "--valve", "trileaflet", "--quiet", "--output", placed,
           "--foam", scratch_path("foam"), "--c", scratch_path("lines.c"), "--fortran", scratch_path("lines.f90"));
  assert_int_equal(program_out[0], 0);
  size_t n;
  char *foam = scratch_read(scratch_path("foam"), &n);
  if (!strstr(foam, "scale           0.01;") || !strstr(foam, "kind            trileaflet;") ||
      !strstr(foam, "translation     ("))
    fail_msg("OpenFOAM: %s", foam);
  /* The skirt ends at the mesh's wall. The skirt's longest length is in metres, and the landmarks are in millimetres. A kind
   * without a skirt gets none, and a valve that has a skirt keeps it. */
  assert_non_null(strstr(foam, "skirt\n{\n    patch           wall;\n    longest         0.006;\n}\n"));
  free(foam);
  const char *const landmarks = json_of("a.json", "mm", 10, "LPS", 1, "");
  RUN_FINE("place", landmarks, "--valve", "trileaflet", "--foam", "-", "--skirt", "4", "--quiet");
  assert_non_null(strstr(program_out, "    longest         0.004;\n"));
  RUN_FINE("place", landmarks, "--valve", "trileaflet", "--foam", "-", "--set", "skirt_length=0.3", "--quiet");
  assert_non_null(strstr(program_out, "    skirt_length 0.3;\n"));
  assert_null(strstr(program_out, "longest"));
  RUN_REFUSED(2, "--skirt requires --foam", "place", landmarks, "--valve", "trileaflet", "--skirt", "4");
  RUN_FINE("params", "--valve", placed);
  expect_sizes(program_out);
  RUN_FINE("check", "crossings", "--valve", placed);
  RUN_FINE("states", scratch_path("states.csv"), "--valve", placed, "--count", "2", "--quiet");
  /* The box is in centimetres, so the program converts the unit of the placement. */
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", placed, "--unit", "cm", "--set", "xq=-0.2", "--stats", "-",
           "--output", scratch_path("by_options.vtu"));
  const double n_marked = json_number(program_out, "n_marked"), area = json_number(program_out, "area");
  if (n_marked < 20 || area < 4 || area > 12) fail_msg("%g nodes, area %g", n_marked, area);
  if (fabs(json_number(program_out, "half_thickness") - 0.1) > 1e-12) fail_msg("half thickness: %s", program_out);
  scratch_write_text("case.json",
                     "{\"mesh\": \"in.vtu\", \"unit\": \"cm\", \"valves\": [{\"valve\": \"placed.json\", "
                     "\"parameters\": {\"xq\": -0.2}}]}");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", scratch_path("by_case.vtu"));
  assert_true(scratch_is_same("by_options.vtu", "by_case.vtu"));
  scratch_write_text("case.json",
                     "{\"unit\": \"cm\", \"valves\": [{\"valve\": \"placed.json\", \"opening\": 0, "
                     "\"parameters\": {\"skirt_length\": 0.2}}]}");
  RUN_FINE("size-field", scratch_path("by_case.dat"), "--case", scratch_path("case.json"), "--spacing", "0.2");
  RUN_FINE("size-field", scratch_path("by_options.dat"), "--valve", placed, "--unit", "cm", "--opening", "0", "--skirt",
           "0.2", "--spacing", "0.2");
  assert_true(scratch_is_same("by_options.dat", "by_case.dat"));
  scratch_write_text("case.json",
                     "{\"mesh\": \"in.vtu\", \"valves\": [{\"valve\": \"placed.json\", \"translate\": [1, 0, 0]}]}");
  RUN_REFUSED(1, "translate: it has no effect, because the placement is in", "mark", "--case",
              scratch_path("case.json"), "--output", scratch_path("by_case.vtu"));
  RUN_REFUSED(2, "--scale has no effect with --valve", "mark", scratch_path("in.vtu"), "--valve", placed, "--scale",
              "2");
  RUN_REFUSED(2, "--rotate and --translate have no effect", "mark", scratch_path("in.vtu"), "--valve", placed,
              "--translate", "1,0,0");
  RUN_REFUSED(2, "--surface-unit has no effect", "mark", scratch_path("in.vtu"), "--valve", placed, "--unit", "cm",
              "--surface-unit", "mm");
  RUN_REFUSED(2, "is also the file of --valve", "surface", "--valve", placed, "--output", placed);
  scratch_write_text("bad.json", "{\"valve\": \"trileaflet\", \"rotate\": [0, 0, 1, 0], \"translate\": [0, 0, 0]}");
  RUN_REFUSED(1, "unit: it is missing", "params", "--valve", scratch_path("bad.json"));
}

TEST(landmarks_must_be_at_the_mesh) {
  RUN_FINE("place", json_of("a.json", "cm", 1, "LPS", 1, ""), "--valve", "trileaflet", "--quiet", "--mesh",
           scratch_path("in.vtu"));
  RUN_REFUSED(1, "in centimetres, they are", "place", json_of("a.json", "mm", 10, "LPS", 1, ""), "--valve",
              "trileaflet", "--quiet", "--mesh", scratch_path("in.vtu"));
  assert_non_null(strstr(program_err, "give --unit cm"));
  RUN_FINE("place", scratch_path("a.json"), "--valve", "trileaflet", "--quiet", "--mesh", scratch_path("in.vtu"),
           "--unit", "cm");
}

static void refuse_text(const char *name, const char *text, const char *words) {
  scratch_write_text(name, text);
  RUN_REFUSED(1, words, "place", scratch_path(name), "--valve", "trileaflet");
}

TEST(files_are_refused_by_name) {
  const char *csv = "# unit = mm\n# axes = LPS\n";
  char text[512];
  refuse_text("a.txt", "x", "landmarks must be a .json, .mrk.json, .fcsv or .csv file");
  refuse_text("a.fcsv", "# columns = id,x,y,z,label\n", "states no axes: a line # CoordinateSystem = LPS is missing");
  refuse_text("a.fcsv", "# CoordinateSystem = IJK\n", "CoordinateSystem is \"IJK\"; it must be LPS or 1, or RAS or 0");
  refuse_text("a.fcsv", "# CoordinateSystem = 1\n# columns = id,x,y,z\n", "the line # columns names no column label");
  refuse_text("a.fcsv", "# CoordinateSystem = 1\nnadir,1,2\n", "line 2 has 3 of the 4 columns");
  refuse_text("a.fcsv", "# CoordinateSystem = 1\nnadir,1,2,x3\n", "line 2");
  refuse_text("a.fcsv", "# CoordinateSystem = 1\n", "holds no landmarks");
  refuse_text("a.fcsv", "# CoordinateSystem = LPS\n1,0,0,0,0,0,0,1,1,1,0,nadir_left,,,0,0\n",
              "line 2: \"nadir_left\" is not placed, because its status is \"0\"; place the point or delete it");
  refuse_text("a.csv", "label,r,a,s,defined\nnadir_left,0,0,0,0\n",
              "line 2: \"nadir_left\" is not placed, because defined is \"0\"; place the point or delete it");
  refuse_text("a.csv", "label,l,p,s\nnadir_left,0,0\n", "line 2 has fewer than the 4 cells label,l,p,s");
  refuse_text("a.csv", "# unit = mm\nnadir,1,2,3\n", "states no axes: a line such as # axes = LPS is missing");
  refuse_text("a.csv", "# unit = mm\n# axes = LPI\nnadir,1,2,3\n",
              "the axes are \"LPI\"; they must be LPS, RAS or mesh; mesh stands for the axes");
  refuse_text("a.csv", "# axes = LPS\nnadir,1,2,3\n", "states no unit: a line such as # unit = mm is missing");
  refuse_text("a.csv", "nadir,1,2,3\n",
              "a line such as # unit = mm is missing; it must be m, cm or mm; and states no axes: a line "
              "such as # axes = LPS is missing; they must be LPS, RAS or mesh; mesh stands for the axes");
  refuse_text("a.json", "{\"landmarks\": {}}",
              "unit: it is missing; it must be m, cm or mm; and the axes are missing; they must");
  refuse_text("a.csv", "# unit = inch\n# axes = LPS\nnadir,1,2,3\n", "the unit is \"inch\"; it must be m, cm or mm");
  refuse_text("a.csv", "# axis = LPS\n", "line 1: \"axis\" is unknown");
  refuse_text("a.csv", "# unit = mm\n# unit = mm\n", "line 2: the unit is given twice");
  const struct {
    const char *line, *words;
  } lines[] = {
      {"nadir,1,2\n", "line 3 must be NAME,X,Y,Z, not \"nadir,1,2\""},
      {"nadir,1,2,x3\n", "line 3"},
      {"nadir,1,2,nan\n", "nan"},
      {"nadire,1,2,3\n", "\"nadire\" is not the name of a landmark, did you mean \"nadir\"?"},
      {"nadir_left,1,2,3\nNadir-Left,1,2,4\n", "\"Nadir-Left\" is given twice"},
      {"commissure_left_right,1,2,3\ncommissure_right_left,1,2,4\n", "\"commissure_right_left\" is given twice"},
      {"coaptation,1,2,3\ncoaptation,1,2,4\n", "\"coaptation\" is given twice"},
      {"annulus_1,1,2,3\nannulus_1,1,2,4\n", "\"annulus_1\" is given twice"},
      {"nadir,1,2,3\nflow_to,1,2,4\n", "flow_to is given without flow_from"},
      {"flow_from,1,2,3\nflow_from,1,2,4\n", "\"flow_from\" is given twice"},
      {"# noise = -1\nnadir,1,2,3\n", "noise: -1 is below 0"},
      {"# flow = 1,2\nnadir,1,2,3\n", "flow: \"1,2\" is not X,Y,Z"},
      {"", "holds no landmarks"}};
  for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i) {
    snprintf(text, sizeof text, "%s%s", csv, lines[i].line);
    refuse_text("a.csv", text, lines[i].words);
  }
  refuse_text("a.json", "{\"unit\": \"mm\", \"landmarks\": {}}", "axes: they are missing");
  refuse_text("a.json", "{\"axes\": \"LPS\", \"landmarks\": {}}", "unit: it is missing");
  refuse_text("a.json", "{\"unit\": \"mm\", \"axes\": \"LPS\", \"landmark\": {}}", "did you mean \"landmarks\"?");
  refuse_text("a.json", "{\"unit\": \"mm\", \"axes\": \"LPS\", \"landmarks\": {\"nadir\": [1, 2]}}",
              "must be three numbers");
  refuse_text("a.json", "{\"unit\": \"mm\", \"axes\": \"LPS\", \"landmarks\": []}", "landmarks: it must be an object");
  refuse_text("a.json", "{\"markups\": []}", "markups must be an array");
  refuse_text("a.json", "{\"markups\": [{\"coordinateSystem\": \"LPI\"}]}",
              "coordinateSystem is \"LPI\"; it must be LPS or RAS");
  refuse_text("a.json", "{\"markups\": [{\"coordinateSystem\": \"LPS\", \"coordinateUnits\": []}]}",
              "markups 0: coordinateUnits is []; it must be a text");
  refuse_text("a.json", "{\"markups\": [{\"coordinateUnits\": \"mm\"}]}", "has no text \"coordinateSystem\"");
  refuse_text("a.json",
              "{\"markups\": [{\"coordinateSystem\": \"LPS\", \"coordinateUnits\": \"mm\", \"controlPoints\": "
              "[{\"label\": \"nadir-1\", \"position\": [0, 0, 0], \"positionStatus\": \"undefined\"}]}]}",
              "\"nadir-1\" has the positionStatus");
}

TEST(fits_are_refused_in_words_of_the_file) {
  const char *path = json_of("a.json", "cm", 10, "LPS", 1, "");
  RUN_REFUSED(1, "a.json: the unit is centimetres: the landmarks' mean distance", "place", path, "--valve",
              "trileaflet");
  assert_non_null(strstr(program_err, "in millimetres, scale 10, this would be"));
  json_of("a.json", "mm", 10, "LPS", 1, "");
  RUN_REFUSED(1, "a.json: flow is at 180 degrees", "place", path, "--valve", "trileaflet", "--flow", "-1,0,0");
  RUN_REFUSED(1, "\"nadir_right\" has a role that the mitral valve lacks", "place", path, "--valve", "mitral");
  RUN_REFUSED(2, "--valve is needed, because", "place", path);
  RUN_REFUSED(1, "'pulmonary' is not a kind of valve", "place", path, "--valve", "pulmonary");
  RUN_REFUSED(2, "is a file; landmarks place a kind of valve", "place", path, "--valve", "own.json");
  RUN_REFUSED(2, "must end in .json", "place", path, "--valve", "trileaflet", "--output", scratch_path("placed.txt"));
  RUN_REFUSED(2, "cannot both be on standard output", "place", path, "--valve", "trileaflet", "--output", "-", "--c",
              "-");
  RUN_REFUSED(2, "is also the file of LANDMARKS", "place", path, "--valve", "trileaflet", "--output", path);
  RUN_REFUSED(2, "--noise: -1 is below 0", "place", path, "--valve", "trileaflet", "--noise", "-1");
  json_of("a.json", "mm", 10, "LPS", 1, "\"valve\": \"aortic\", ");
  RUN_REFUSED(2, "trileaflet is not the valve of", "place", path, "--valve", "trileaflet");
}

/* Writes a JSON of landmarks in millimetres, with their names. */
static const char *json_of_points(int n, const char *const *labels, double (*points)[3]) {
  char text[8192];
  int size = snprintf(text, sizeof text, "{\"unit\": \"mm\", \"axes\": \"LPS\", \"landmarks\": {");
  for (int i = 0; i < n; ++i)
    size += snprintf(text + size, sizeof text - (size_t)size, "%s\"%s\": [%.17g, %.17g, %.17g]", i ? ", " : "",
                     labels[i], points[i][0], points[i][1], points[i][2]);
  snprintf(text + size, sizeof text - (size_t)size, "}}");
  scratch_write_text("points.json", text);
  return scratch_path("points.json");
}

/* Two cusps have sectors of 150 and 210 degrees. The report omits sizes of a cusp that follow the valve's sizes. */
TEST(cusps_of_any_number_have_names) {
  static const char *const labels[4] = {"nadir_cusp_0", "commissure_1", "nadir_cusp_1", "commissure_2"};
  double points[4][3];
  for (int i = 0; i < 4; ++i) {
    const double angle = (double[]){0, 75, 180, 285}[i] * acos(-1.0) / 180;
    points[i][0] = 13 * cos(angle), points[i][1] = 13 * sin(angle), points[i][2] = i % 2 ? 18 : 0;
  }
  const char *path = json_of_points(4, labels, points);
  RUN_FINE("place", path, "--valve", "bicuspid", "--output", "-");
  const char *const first = strstr(program_out, "\"cusp_0\""), *const second = strstr(program_out, "\"cusp_1\"");
  assert_true(first && second);
  if (fabs(json_number(first, "sector") - 150) > 1e-6 || fabs(json_number(second, "sector") - 210) > 1e-6 ||
      fabs(json_number(program_out, "commissure_height") - 1.8) > 1e-9)
    fail_msg("other sizes: %s", program_out);
  RUN_FINE("place", path, "--valve", "bicuspid");
  assert_non_null(strstr(program_out, "\ncusp_1.sector "));
  assert_null(strstr(program_out, "cusp_1.effective_height"));
  assert_null(strstr(program_out, "commissure_0.height"));
  RUN_FINE("place", path, "--valve", "bicuspid", "--foam", "-");
  assert_non_null(strstr(program_out, "    cusp_0.sector "));
  assert_null(strstr(program_out, "effective_height 0.8\n    cusp"));
  RUN_REFUSED(1, "it has the commissure 2 times; the quadricuspid valve needs 4", "place", path, "--valve",
              "quadricuspid");
}

TEST(tricuspid_leaflets_have_names) {
  enum { n = 15 };
  static const char *const commissures[3] = {"commissure_anterior_septal", "commissure_posterior_septal",
                                             "commissure_anterior_posterior"};
  static const double degrees[3] = {215, 325, 75};
  char annulus[12][16];
  const char *labels[n];
  double points[n][3];
  for (int i = 0; i < n; ++i) {
    if (i < 12) snprintf(annulus[i], sizeof annulus[i], "annulus_%d", i);
    labels[i] = i < 12 ? annulus[i] : commissures[i - 12];
    const double angle = (i < 12 ? 30 * i : degrees[i - 12]) * acos(-1.0) / 180;
    points[i][0] = 19 * cos(angle), points[i][1] = 15 * sin(angle), points[i][2] = -2 * cos(2 * angle);
  }
  const char *path = json_of_points(n, labels, points);
  RUN_FINE("place", path, "--valve", "tricuspid");
  assert_non_null(strstr(program_out, "\nSL_diameter "));
  RUN_FINE("place", path, "--valve", "tricuspid", "--set", "anterior_length=2.6", "--output", "-");
  if (fabs(json_number(program_out, "AP_diameter") - 3.8) > 0.1 ||
      fabs(json_number(program_out, "anterior_length") - 2.6) > 0)
    fail_msg("other sizes: %s", program_out);
  RUN_REFUSED(1, "but they must follow counter-clockwise", "place", path, "--valve", "tricuspid", "--flow", "0,0,1");
}

/* Tests faults in landmarks that are usual at a first try. */
TEST(wrong_landmarks_are_refused) {
  double points[6][3];
#define CHANGED(words, ...)                                                                               \
  do {                                                                                                    \
    for (int i = 0; i < 6; ++i) landmark(i, 10, points[i]);                                               \
    __VA_ARGS__;                                                                                          \
    RUN_REFUSED(1, words, "place", json_of_points(6, names, points), "--valve", "trileaflet", "--quiet"); \
  } while (0)
  CHANGED("points.json: \"nadir_right\" and \"nadir_left\" are in one place",
          for (int k = 0; k < 3; ++k) points[2][k] = points[0][k] + 0.01);
  CHANGED(
      "points.json: the landmarks lie along a line", for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < 3; ++k) points[i][k] = 3 * i * (k + 1);
      });
  CHANGED("mirrored", for (int i = 0; i < 6; ++i) points[i][1] *= -1);
  CHANGED(
      "the landmarks' mean distance from their middle", for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < 3; ++k) points[i][k] /= 10;
      });

  enum { n = 13 };
  const char *labels[n] = {"anterior_horn"};
  char annulus_names[n][16];
  double annulus[n][3];
  for (int i = 0; i < n; ++i) {
    const double angle = acos(-1.0) * (i - 1) / 6;
    annulus[i][0] = 18 * sin(angle), annulus[i][1] = 12 * cos(angle), annulus[i][2] = 4 * cos(2 * angle);
    if (i > 0) snprintf(annulus_names[i], sizeof annulus_names[i], "annulus_%d", i), labels[i] = annulus_names[i];
  }
  memcpy(annulus[0], annulus[1], sizeof annulus[0]);
  RUN_FINE("place", json_of_points(n, labels, annulus), "--valve", "mitral", "--flow", "0,0,-1", "--quiet");
  for (int k = 0; k < 3; ++k) {
    const double kept = annulus[4][k];
    annulus[4][k] = annulus[6][k], annulus[6][k] = kept;
  }
  RUN_REFUSED(1,
              "the annulus crosses itself: the line from \"annulus_3\" to \"annulus_4\" crosses the line from "
              "\"annulus_6\" to \"annulus_7\"; give the annulus points in their order around it",
              "place", json_of_points(n, labels, annulus), "--valve", "mitral", "--flow", "0,0,-1", "--quiet");
}

/* Two landmarks of one cusp's attachment are far apart, and every smooth map through both of them folds the valve. */
TEST(folds_are_refused) {
  const char *labels[8] = {0};
  memcpy(labels, names, sizeof names);
  labels[6] = "attachment_right_1", labels[7] = "attachment_right_2";
  double points[8][3];
  for (int i = 0; i < 6; ++i) landmark(i, 10, points[i]);
  for (int i = 0; i < 2; ++i) {
    const double out = i ? -10 : 10, aside = i ? -2 : 2;
    points[6 + i][0] = 1 + 2, points[6 + i][1] = aside + 1, points[6 + i][2] = -(10 * R + out) - 3;
  }
  RUN_REFUSED(1, "points.json: the warp folds near \"", "place", json_of_points(8, labels, points), "--valve",
              "coapting", "--warp", "exact", "--quiet");
  assert_non_null(strstr(program_err, "its determinant is -"));
  assert_non_null(strstr(program_err, "; --warp smoothed folds too: look for a misplaced landmark"));
  for (int i = 0; i < 2; ++i) {
    const double angle = (i ? 24 : 20) * acos(-1.0) / 180, radius = 10 * R - (i ? 6 : 0);
    points[6 + i][0] = 3 + 2, points[6 + i][1] = radius * sin(angle) + 1, points[6 + i][2] = -radius * cos(angle) - 3;
  }
  RUN_REFUSED(1, "points.json: the warp turns a part of patch", "place", json_of_points(8, labels, points), "--valve",
              "coapting", "--warp", "exact", "--quiet");
  RUN_FINE("place", json_of_points(6, labels, points), "--valve", "coapting", "--warp", "exact", "--quiet");
}

/* Two landmarks in one place may have equal targets, like an annulus point at the anterior horn. Two landmarks in one place
 * contradict each other if their targets differ. */
TEST(landmarks_in_one_place_are_met_or_refused) {
  enum { n = 18 };
  const char *labels[n] = {"anterior_horn"};
  char annulus_names[n][16];
  double annulus[n][3];
  for (int i = 0; i < n; ++i) {
    const double angle = acos(-1.0) * (i - 1) / 8;
    annulus[i][0] = 18 * sin(angle), annulus[i][1] = (cos(angle) > 0 ? 12.5 : 15) * cos(angle);
    annulus[i][2] = 1.5 + 1.5 * cos(2 * angle);
    if (i > 0) snprintf(annulus_names[i], sizeof annulus_names[i], "annulus_%d", i), labels[i] = annulus_names[i];
  }
  memcpy(annulus[0], annulus[1], sizeof annulus[0]);
  memcpy(annulus[n - 1], annulus[n - 2], sizeof annulus[0]);
  RUN_FINE("place", json_of_points(n, labels, annulus), "--valve", "mitral", "--flow", "0,0,-1", "--warp", "exact",
           "--output", "-");
  if (!(json_number(program_out, "worst") > 0.1 && json_number(program_out, "warped_worst") < 0.02))
    fail_msg("residuals %g and %g mm", json_number(program_out, "worst"), json_number(program_out, "warped_worst"));
  const char *sources = strstr(program_out, "\"sources\": ["),
             *end = sources ? strstr(sources, "\"targets\": [") : NULL;
  int n_brackets = 0;
  for (const char *c = sources; c && c < end; ++c) n_brackets += *c == '[';
  assert_int_equal(n_brackets - 1, n - 2);
  scratch_write_text("met.json", program_out);
  RUN_FINE("surface", "--valve", scratch_path("met.json"), "--quiet", "--output", scratch_path("met.vtp"));
  RUN_FINE("place", json_of_points(n, labels, annulus), "--valve", "mitral", "--flow", "0,0,-1", "--warp", "exact",
           "--quiet", "--c", "-");
  assert_non_null(strstr(program_out, "sources.n_points = 16;"));
  /* The valve's trigones are next to its horn. */
  labels[n - 1] = "trigone";
  memcpy(annulus[n - 1], annulus[0], sizeof annulus[0]);
  RUN_REFUSED(1, "points.json: \"anterior_horn\" and \"trigone\" are in one place, but on the valve they are ", "place",
              json_of_points(n, labels, annulus), "--valve", "mitral", "--flow", "0,0,-1", "--warp", "exact",
              "--quiet");
  assert_non_null(
      strstr(program_err, " mm apart, so no warp takes the valve to both landmarks: leave one of them out"));
  RUN_FINE("place", json_of_points(n, labels, annulus), "--valve", "mitral", "--flow", "0,0,-1", "--quiet");
}

/* Sizes from landmarks may be invalid together with the other sizes. */
TEST(sizes_that_do_not_go_together_are_named) {
  const char *path = json_of("a.json", "mm", 10, "LPS", 1, "");
  RUN_REFUSED(1,
              "a.json: the landmarks give root_radius 1.1, commissure_radius 1.05, commissure_height 1.4, and then "
              "coaptation_height is 2; it must be from 0.02 to 0.9 times effective_height",
              "place", path, "--valve", "coapting", "--set", "coaptation_height=2");
  assert_non_null(strstr(program_err, "--set sets sizes that do not follow from landmarks, in centimetres"));
  RUN_REFUSED(1, "and then effective_height is 1.39; it must be from 0.1 to 0.97 times commissure_height", "place",
              path, "--valve", "coapting", "--set", "effective_height=1.39");
  RUN_FINE("place", path, "--valve", "coapting", "--set", "coaptation_height=0.2", "--output", "-");
  if (fabs(json_number(program_out, "coaptation_height") - 0.2) > 1e-15) fail_msg("it is not held: %s", program_out);
  /* A disease gives the kind and a bump, and landmarks give the sizes. */
  RUN_FINE("place", path, "--valve", "aortic_regurgitation_commissural", "--output", "-");
  assert_true(json_number(program_out, "closed") > 0);
  assert_true(fabs(json_number(program_out, "root_radius") - 1.1) < 1e-3);
  /* Low commissures leave less room for the coaptation zone. A rule gives the zone's height. */
  double points[6][3];
  for (int i = 0; i < 6; ++i) {
    landmark(i, 10, points[i]);
    if (i % 2) points[i][0] -= 10 * (height - 1.02 * Rc);
  }
  RUN_FINE("place", json_of_points(6, names, points), "--valve", "coapting", "--output", "-");
  const double h_e = json_number(program_out, "effective_height"), h_co = json_number(program_out, "coaptation_height");
  if (!(h_co < 0.3 * Rc && h_co <= 0.9 * h_e)) fail_msg("coaptation_height %g, effective_height %g", h_co, h_e);
  /* Even lower commissures leave no room for any zone. */
  for (int i = 1; i < 6; i += 2) points[i][0] -= 9;
  RUN_REFUSED(1, "and then", "place", json_of_points(6, names, points), "--valve", "coapting");
  assert_non_null(strstr(program_err, "commissure_height"));
}

/* The box is away from the z axis. A turn by 180 degrees about z therefore takes landmarks out of the box. */
TEST(wrong_axes_are_named) {
  const double lower[3] = {8, 8, -2}, upper[3] = {12, 12, 2};
  assert_int_equal(shim_write_box(scratch_path("far.vtu"), SHIM_RAW, n_box_side, lower, upper, 1), 1);
  char text[1024];
  int n = snprintf(text, sizeof text, "# unit = cm\n# axes = RAS\n# valve = trileaflet\n");
  for (int i = 0; i < 6; ++i) {
    double p[3];
    landmark(i, 1, p);
    n += snprintf(text + n, sizeof text - (size_t)n, "%s,%.17g,%.17g,%.17g\n", names[i], -p[0] - 9.5, -p[1] - 10, p[2]);
  }
  scratch_write_text("far.csv", text);
  RUN_REFUSED(1, "with the signs of x and y reversed, as between LPS and RAS, they are", "place",
              scratch_path("far.csv"), "--mesh", scratch_path("far.vtu"), "--quiet");
  assert_non_null(strstr(program_err, "give --axes LPS"));
  RUN_FINE("place", scratch_path("far.csv"), "--mesh", scratch_path("far.vtu"), "--quiet", "--axes", "LPS");
  RUN_REFUSED(2, "states the axes mesh", "place", json_of("a.json", "cm", 1, "mesh", 1, ""), "--mesh",
              scratch_path("far.vtu"), "--valve", "trileaflet", "--axes", "LPS");
}

int main(void) { return run_cases(make_box, scratch_teardown); }
