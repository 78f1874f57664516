/* SPDX-License-Identifier: Apache-2.0
 * Tests sizes with a surgeon's names, and parameters that follow from others until they are set (docs/theory/sizes.md). Random
 * calls are compared with a model of the rules. The last tests look for crossings of random valves. RIIS_TEST_LONG=1 tries as
 * many valves as docs/theory/sizes.md states. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "patch_folds.h"

static random_source rng;

static int64_t random_integer(int64_t low, int64_t high) {
  return low + (int64_t)(random_bits(&rng) % (uint64_t)(high - low + 1));
}
static int one_in(int64_t n) { return random_integer(1, n) == 1; }

static riis_parameter parameter_of(const riis_valve *valve, int64_t id) {
  riis_parameter parameter;
  CHECK_OK(riis_valve_get_parameter(valve, id, &parameter, sizeof parameter));
  return parameter;
}

static int64_t n_parameters_of(const riis_valve *valve) {
  int64_t n;
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  return n;
}

static double value_of(const riis_valve *valve, const char *name) {
  double value = 0;
  CHECK_OK(riis_valve_get(valve, name, 1, &value));
  return value;
}

static int is_set(const riis_valve *valve, const char *name) {
  int32_t found = -1;
  CHECK_OK(riis_valve_is_set(valve, name, &found));
  assert_in_range(found, 0, 1);
  return found;
}

static riis_valve *copy_of(const riis_valve *valve) {
  riis_valve *copy = NULL;
  CHECK_OK(riis_valve_copy(valve, &copy));
  return own(copy);
}

/* --- The model ---------------------------------------------------------------------------------------------------------- */

enum { max_parameters = 128 };

/* The values that were set, from which the expected values of a valve follow. */
typedef struct model {
  const char *kind;
  int64_t n;
  riis_parameter parameters[max_parameters];
  int is_set[max_parameters];
  double values[max_parameters][3];
} model;

static model new_model(const char *kind) {
  model made = {.kind = kind};
  riis_valve *valve = new_valve(kind);
  made.n = n_parameters_of(valve);
  assert_in_range(made.n, 1, max_parameters);
  for (int64_t i = 0; i < made.n; ++i) made.parameters[i] = parameter_of(valve, i);
  free_one_owned(valve);
  return made;
}

static int64_t position_in(const model *of, const char *name) {
  for (int64_t i = 0; i < of->n; ++i)
    if (strcmp(of->parameters[i].name, name) == 0) return i;
  fail_msg("%s has no parameter %s", of->kind, name);
  return -1;
}

static const double *expected(const model *of, int64_t id);

static const char *const cusps[] = {"right", "left", "non_coronary"};

static const char *of_cusp(int cusp, const char *name) {
  static char full[8][64];
  static int next;
  char *made = full[next++ % 8];
  snprintf(made, sizeof full[0], "%s.%s", cusps[cusp], name);
  return made;
}

/* Returns the exponent p with which the profile x = in + (end - in) (y / y_end)^p points at its end towards the axis. For this
 * exponent, p (end - in) equals end. The sizes are the radii `in` and `end`, and the angle. */
static double largest_power(const double *sizes) {
  const double end = sizes[1] * cos(sizes[2] * acos(-1) / 180);
  return end > sizes[0] ? end / (end - sizes[0]) : INFINITY;
}

static double first_expected(const model *of, const char *name) { return expected(of, position_in(of, name))[0]; }

/* Writes the value that the parameter's rule gives. Returns 0 if the parameter has no rule. */
static int rule_value(const model *of, const char *name, double *value) {
  value[0] = value[1] = value[2] = 0;
  if (strcmp(of->kind, "aortic") == 0) {
    for (int k = 0; k < 3; ++k) {
      if (strcmp(name, of_cusp(k, "leaflet_power")) != 0) continue;
      /* Limits the exponent so that the profile's end is at most as steep as the plane there. The exponents of the paper are
       * lowered in proportion. */
      static const double paper[3][4] = {{0.24, 1.365, 61, 1.58}, {0.49, 1.495, 58.5, 2.77}, {0.2, 1.38, 60.5, 1.19}};
      const double now[3] = {first_expected(of, of_cusp(k, "leaflet_radius_in")),
                             first_expected(of, of_cusp(k, "leaflet_radius_out")),
                             first_expected(of, of_cusp(k, "leaflet_angle"))};
      const double here = largest_power(now), there = fmax(1, paper[k][3] / largest_power(paper[k])) * here;
      value[0] = fmin(paper[k][3], there);
      return 1;
    }
    const int is_left = strcmp(name, "left.rotation") == 0;
    if (!is_left && strcmp(name, "non_coronary.rotation") != 0) return 0;
    /* Together, the cusps and three equal gaps take 360 degrees round the axis. */
    const double right = first_expected(of, "right.leaflet_angle"), left = first_expected(of, "left.leaflet_angle"),
                 non_coronary = first_expected(of, "non_coronary.leaflet_angle"),
                 gap = (360 - 2 * right - 2 * left - 2 * non_coronary) / 3;
    value[2] = is_left ? right + gap + left : -(right + gap + non_coronary);
    return 1;
  }
  if (strcmp(of->kind, "trileaflet") != 0) return 0;
  const char *const names[] = {"bending_height", "bending_radius_in", "bending_radius_out", "t0_bending", "t3_bending"};
  for (int k = 0; k < 5; ++k) {
    if (strcmp(name, names[k]) != 0) continue;
    const double R = first_expected(of, "root_radius"), Rc = first_expected(of, "leaflet_radius_out");
    value[0] = k == 0   ? first_expected(of, "leaflet_height") / 2
               : k == 1 ? 0.32 * R
               : k == 2 ? 1.02 * (R + Rc) / 2
                        : 0.2 * R;
    return 1;
  }
  return 0;
}

static const double *expected(const model *of, int64_t id) {
  static double values[8][3];
  static int next;
  double *value = values[next++ % 8];
  if (of->is_set[id]) return memcpy(value, of->values[id], 3 * sizeof *value);
  if (rule_value(of, of->parameters[id].name, value)) return value;
  return memcpy(value, of->parameters[id].default_values, 3 * sizeof *value);
}

/* Compares every parameter of the valve. Values that follow a rule may differ by rounding, because the model uses other
 * formulas. */
static void check_is_as(const riis_valve *valve, const model *of) {
  for (int64_t i = 0; i < of->n; ++i) {
    const riis_parameter *parameter = &of->parameters[i];
    double got[3] = {0, 0, 0}, rule[3];
    CHECK_OK(riis_valve_get(valve, parameter->name, parameter->n_values, got));
    assert_int_equal(is_set(valve, parameter->name), of->is_set[i]);
    const double *value = expected(of, i), error = !of->is_set[i] && rule_value(of, parameter->name, rule) ? 4e-15 : 0;
    for (int64_t k = 0; k < parameter->n_values; ++k) CHECK_NEAR(got[k], value[k], error * fabs(value[k]));
  }
}

/* A call that sets a parameter by one of its names. */
typedef struct setting {
  int64_t id;
  char name[80];
  double values[3];
} setting;

static setting random_setting(const model *of) {
  setting made = {.id = random_integer(0, of->n - 1)};
  const riis_parameter *parameter = &of->parameters[made.id];
  for (int64_t k = 0; k < parameter->n_values; ++k) {
    const double value = parameter->default_values[k] * random_between(&rng, 0.8, 1.25);
    made.values[k] =
        fmin(parameter->maximum, fmax(parameter->minimum, value == 0 ? random_between(&rng, 0, 0.2) : value));
  }
  const char *dot = strrchr(parameter->name, '.');
  if (*parameter->other_name && one_in(2)) {
    snprintf(made.name, sizeof made.name, "%.*s%s", dot ? (int)(dot + 1 - parameter->name) : 0, parameter->name,
             parameter->other_name);
  } else {
    snprintf(made.name, sizeof made.name, "%s", parameter->name);
  }
  return made;
}

static void set_both(riis_valve *valve, model *of, const setting *call) {
  const riis_parameter *parameter = &of->parameters[call->id];
  const double factor = strcmp(call->name, parameter->name) == 0 ? 1 : parameter->other_factor;
  double values[3];
  for (int k = 0; k < 3; ++k) values[k] = factor * call->values[k];
  CHECK_OK(riis_valve_set(valve, call->name, parameter->n_values, values));
  double got[3];
  CHECK_OK(riis_valve_get(valve, call->name, parameter->n_values, got));
  assert_memory_equal(got, values, (size_t)parameter->n_values * sizeof *got);
  of->is_set[call->id] = 1;
  memcpy(of->values[call->id], call->values, sizeof call->values);
}

static const char *const kinds[] = {"trileaflet", "aortic", "mitral", "bileaflet"};

/* --- Rules -------------------------------------------------------------------------------------------------------------- */

/* If the caller sets nothing or sets the defaults, all values have the bits of the defaults. */
TEST(rules_give_the_defaults) {
  for (int k = 0; k < 4; ++k) {
    const model of = new_model(kinds[k]);
    riis_valve *valve = new_valve(kinds[k]);
    int n_rules = 0;
    for (int step = 0; step < 2; ++step) {
      for (int64_t i = 0; i < of.n; ++i) {
        const riis_parameter *parameter = &of.parameters[i];
        double value[3] = {0, 0, 0}, rule[3];
        CHECK_OK(riis_valve_get(valve, parameter->name, parameter->n_values, value));
        assert_memory_equal(value, parameter->default_values, sizeof value);
        const int has_rule = rule_value(&of, parameter->name, rule);
        assert_int_equal(has_rule, *parameter->rule != 0);
        assert_int_equal(is_set(valve, parameter->name), step == 1 && !has_rule);
        n_rules += has_rule;
      }
      for (int64_t i = 0; i < of.n; ++i)
        if (!*of.parameters[i].rule)
          CHECK_OK(
              riis_valve_set(valve, of.parameters[i].name, of.parameters[i].n_values, of.parameters[i].default_values));
    }
    assert_int_equal(n_rules, k == 0 ? 10 : k == 1 ? 10 : 0);
    assert_true(is_same_content(new_surface(valve, NULL), surface_of_kind(kinds[k], NULL)));
  }
}

/* The same settings in any order give the same values, and therefore the same surface or the same refusal. */
TEST(order_does_not_matter) {
  int n_surfaces = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int owned_before = n_owned();
    model of = new_model(kinds[trial % 4]), reordered = of;
    setting calls[12];
    int n = 0;
    for (int tries = 0; tries < 12; ++tries) {
      const setting call = random_setting(&of);
      int is_new = 1;
      for (int i = 0; i < n; ++i) is_new &= calls[i].id != call.id;
      if (is_new) calls[n++] = call;
    }
    riis_valve *valve = new_valve(of.kind), *other = new_valve(of.kind);
    for (int i = 0; i < n; ++i) set_both(valve, &of, &calls[i]);
    for (int i = n - 1; i > 0; --i) {
      const int64_t j = random_integer(0, i);
      const setting kept = calls[i];
      calls[i] = calls[j], calls[j] = kept;
    }
    for (int i = 0; i < n; ++i) {
      if (one_in(4)) { /* a value that is overwritten has no effect */
        const setting first = calls[i];
        for (int64_t k = 0; k < of.parameters[first.id].n_values; ++k)
          calls[i].values[k] = of.parameters[first.id].maximum;
        set_both(other, &reordered, &calls[i]);
        calls[i] = first;
      }
      set_both(other, &reordered, &calls[i]);
    }
    check_is_as(valve, &of);
    check_is_as(other, &of);
    for (int64_t i = 0; i < of.n; ++i) {
      double a[3] = {0, 0, 0}, b[3] = {0, 0, 0};
      CHECK_OK(riis_valve_get(valve, of.parameters[i].name, of.parameters[i].n_values, a));
      CHECK_OK(riis_valve_get(other, of.parameters[i].name, of.parameters[i].n_values, b));
      assert_memory_equal(a, b, sizeof a);
    }
    if (trial % 10 < 4) {
      riis_surface *one = NULL, *two = NULL;
      char text[512];
      const riis_status status = riis_surface_create(valve, NULL, &one);
      snprintf(text, sizeof text, "%s", riis_last_error());
      assert_int_equal(riis_surface_create(other, NULL, &two), status);
      if (status == RIIS_OK) {
        assert_true(is_same_content(own(one), own(two)));
        ++n_surfaces;
      } else {
        assert_string_equal(riis_last_error(), text);
      }
    }
    free_owned_after(owned_before);
  }
  assert_true(n_surfaces > 40);
}

/* Values are set, unset, and set for all cusps. The valve is copied. A failed call changes nothing. */
TEST(random_calls_are_as_the_model) {
  for (int trial = 0; trial < 40; ++trial) {
    const int owned_before = n_owned();
    model of = new_model(kinds[trial % 4]);
    riis_valve *valve = new_valve(of.kind);
    for (int step = 0; step < 60; ++step) {
      setting call = random_setting(&of);
      const riis_parameter *parameter = &of.parameters[call.id];
      const char *dot = strrchr(parameter->name, '.');
      if (one_in(3)) {
        CHECK_OK(riis_valve_unset(valve, call.name));
        of.is_set[call.id] = 0;
      } else if (dot && one_in(2)) {
        const int unsets = one_in(2);
        if (unsets)
          CHECK_OK(riis_valve_unset(valve, strrchr(call.name, '.') + 1));
        else {
          for (int k = 0; k < 3; ++k)
            call.values[k] *= strcmp(call.name, parameter->name) == 0 ? 1 : parameter->other_factor;
          CHECK_OK(riis_valve_set(valve, strrchr(call.name, '.') + 1, parameter->n_values, call.values));
          for (int k = 0; k < 3; ++k)
            call.values[k] /= strcmp(call.name, parameter->name) == 0 ? 1 : parameter->other_factor;
        }
        for (int64_t i = 0; i < of.n; ++i) {
          const char *end = strrchr(of.parameters[i].name, '.');
          if (!end || strcmp(end, dot) != 0) continue;
          of.is_set[i] = !unsets;
          memcpy(of.values[i], call.values, sizeof call.values);
        }
      } else if (one_in(4)) {
        double values[3];
        for (int k = 0; k < 3; ++k) values[k] = 3e9;
        CHECK_REFUSED(RIIS_INVALID_PARAMETER, call.name, riis_valve_set(valve, call.name, parameter->n_values, values));
      } else {
        set_both(valve, &of, &call);
      }
      if (one_in(10)) valve = copy_of(valve);
      check_is_as(valve, &of);
    }
    free_owned_after(owned_before);
  }
}

/* A valve that gets all values of another valve has the other's shape. The valve's parameters no longer follow rules. */
TEST(all_values_are_set_when_read_back) {
  riis_valve *valve = new_valve("trileaflet"), *back = new_valve("trileaflet");
  CHECK_OK(riis_valve_set_scalar(valve, "annulus", 2.3));
  CHECK_OK(riis_valve_set_scalar(valve, "effective_height", 1.1));
  for (int64_t i = 0; i < n_parameters_of(valve); ++i) {
    const riis_parameter parameter = parameter_of(valve, i);
    double values[3];
    CHECK_OK(riis_valve_get(valve, parameter.name, parameter.n_values, values));
    CHECK_OK(riis_valve_set(back, parameter.name, parameter.n_values, values));
  }
  riis_surface_options options = surface_options();
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  riis_surface *surface = new_surface(valve, &options);
  assert_true(is_same_content(surface, new_surface(back, &options)));
  /* A fixed triangulation accepts a valve with equal values, whether the values were set or follow rules. */
  CHECK_OK(riis_surface_update(surface, back, NULL));
  for (int k = 0; k < 2; ++k) CHECK_OK(riis_valve_set_scalar(k ? back : valve, "leaflet_height", 1.3));
  CHECK_NEAR(value_of(valve, "bending_height"), 0.65, 1e-15);
  CHECK_NEAR(value_of(back, "bending_height"), 0.55, 1e-15);
  CHECK_OK(riis_valve_unset(back, "bending_height"));
  CHECK_SAME(value_of(back, "bending_height"), value_of(valve, "bending_height"));
}

/* An open state keeps the values that its rules gave when the state was set, as if the caller had set all values. */
TEST(open_states_follow_their_own_rules) {
  riis_valve *valves[2], *open = new_valve("trileaflet"), *all_set = new_valve("trileaflet");
  CHECK_OK(riis_valve_set_scalar(open, "annulus", 2.6));
  for (int64_t i = 0; i < n_parameters_of(open); ++i) {
    const riis_parameter parameter = parameter_of(open, i);
    double values[3];
    CHECK_OK(riis_valve_get(open, parameter.name, parameter.n_values, values));
    CHECK_OK(riis_valve_set(all_set, parameter.name, parameter.n_values, values));
  }
  for (int k = 0; k < 2; ++k) {
    valves[k] = new_valve("trileaflet");
    if (k == 1) CHECK_OK(riis_valve_set_scalar(valves[k], "annulus", 2.4));
    CHECK_OK(riis_valve_set_open_state(valves[k], k ? all_set : open));
    CHECK_OK(riis_valve_set_scalar(valves[k], "annulus", 2.4));
    CHECK_OK(riis_valve_set_scalar(valves[k], "opening", 0.6));
  }
  CHECK_OK(riis_valve_set_scalar(open, "annulus", 2.2)); /* the valve has a copy */
  riis_surface *surface = new_surface(valves[1], NULL);
  assert_true(is_same_content(new_surface(valves[0], NULL), surface));
  assert_true(is_same_content(new_surface(copy_of(valves[0]), NULL), surface));
}

/* --- Names -------------------------------------------------------------------------------------------------------------- */

TEST(names_of_surgeons) {
  static const struct {
    const char *kind, *name, *parameter;
    double factor;
  } table[] = {{"trileaflet", "annulus", "root_radius", 2},
               {"trileaflet", "stj", "leaflet_radius_out", 2},
               {"trileaflet", "effective_height", "leaflet_height", 1},
               {"aortic", "annulus", "root_radius", 2},
               {"aortic", "right.stj", "right.leaflet_radius_out", 2},
               {"aortic", "left.stj", "left.leaflet_radius_out", 2},
               {"aortic", "non_coronary.stj", "non_coronary.leaflet_radius_out", 2},
               {"aortic", "effective_height", "leaflet_height", 1},
               {"bileaflet", "annulus", "radius", 2}};
  const int n = sizeof table / sizeof *table;
  int n_named = 0;
  for (int k = 0; k < 4; ++k) {
    const model of = new_model(kinds[k]);
    for (int64_t i = 0; i < of.n; ++i) {
      const riis_parameter *parameter = &of.parameters[i];
      int found = -1;
      for (int row = 0; row < n; ++row)
        if (strcmp(table[row].kind, of.kind) == 0 && strcmp(table[row].parameter, parameter->name) == 0) found = row;
      assert_int_equal(found >= 0, *parameter->other_name != 0);
      CHECK_SAME(parameter->other_factor, found >= 0 ? table[found].factor : 0);
      if (found < 0) continue;
      const char *dot = strrchr(table[found].name, '.');
      assert_string_equal(parameter->other_name, dot ? dot + 1 : table[found].name);
      ++n_named;
      riis_valve *valve = new_valve(of.kind);
      const double size = parameter->default_values[0] * random_between(&rng, 0.5, 2), factor = table[found].factor;
      CHECK_SAME(value_of(valve, table[found].name), factor * parameter->default_values[0]);
      CHECK_OK(riis_valve_set_scalar(valve, table[found].name, factor * size));
      CHECK_SAME(value_of(valve, parameter->name), size);
      assert_true(is_set(valve, parameter->name) && is_set(valve, table[found].name));
      CHECK_OK(riis_valve_set_scalar(valve, parameter->name, 1.25 * size)); /* the later call wins, by any name */
      CHECK_SAME(value_of(valve, table[found].name), factor * (1.25 * size));
      CHECK_OK(riis_valve_unset(valve, table[found].name));
      assert_false(is_set(valve, parameter->name));
      CHECK_SAME(value_of(valve, parameter->name), parameter->default_values[0]);
      char text[128];
      snprintf(text, sizeof text, "parameter '%s' is -1; it must be from %g to %g", table[found].name,
               factor * parameter->minimum, factor * parameter->maximum);
      CHECK_REFUSED(RIIS_INVALID_PARAMETER, text, riis_valve_set_scalar(valve, table[found].name, -1));
      CHECK_OK(riis_valve_set_scalar(valve, table[found].name, factor * parameter->minimum));
      CHECK_OK(riis_valve_set_scalar(valve, table[found].name, factor * parameter->maximum));
      CHECK_REFUSED(RIIS_INVALID_PARAMETER, table[found].name,
                    riis_valve_set_scalar(valve, table[found].name, nextafter(factor * parameter->maximum, INFINITY)));
    }
  }
  assert_int_equal(n_named, n);
}

TEST(names_of_all_cusps) {
  riis_valve *valve = new_valve("aortic");
  double value = 7;
  int32_t found = 7;
  CHECK_OK(riis_valve_set_scalar(valve, "stj", 2.8));
  for (int k = 0; k < 3; ++k) {
    const char *const names[] = {"right.stj", "left.stj", "non_coronary.leaflet_radius_out"};
    CHECK_SAME(value_of(valve, names[k]), k < 2 ? 2.8 : 1.4);
  }
  CHECK_REFUSED(RIIS_INVALID_PARAMETER,
                "parameter 'stj' exists for each leaflet separately: name a leaflet, as in 'right.stj'",
                riis_valve_get(valve, "stj", 1, &value));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "parameter 'rotation' exists for each|as in 'right.rotation'",
                riis_valve_is_set(valve, "rotation", &found));
  CHECK_SAME(value, 7);
  assert_int_equal(found, 7);
  CHECK_OK(riis_valve_unset(valve, "stj"));
  CHECK_SAME(value_of(valve, "left.leaflet_radius_out"), 1.495);
}

TEST(absent_names_are_refused) {
  static const struct {
    const char *kind, *name, *text;
  } table[] = {
      {"mitral", "annulus",
       "'annulus' is not a parameter of the mitral valve: its annulus is not round|set AP_diameter and ALPM"},
      {"mitral", "stj", "'stj' is not a parameter of the mitral valve: it has no sinotubular junction"},
      {"mitral", "effective_height",
       "'effective_height' is not a parameter of the mitral valve: only cusps have an effective height"},
      {"bileaflet", "stj", "'stj' is not a parameter of the bileaflet valve: its housing has only one radius"},
      {"bileaflet", "effective_height",
       "'effective_height' is not a parameter of the bileaflet valve: only cusps have an effective height"},
      {"patches", "annulus",
       "'annulus' is not a parameter of the patches valve: the control points of its curves determine its size"},
      {"patches", "stj", "'stj' is not a parameter of the patches valve: the control points"},
      {"patches", "effective_height", "'effective_height' is not a parameter of the patches valve: the control points"},
      {"aortic", "right.annulus", "'right.annulus' is not a parameter of the aortic valve"},
      {"trileaflet", "right.stj", "'right.stj' is not a parameter of the trileaflet valve"},
      {"trileaflet", "anulus", "'anulus' is not a parameter of the trileaflet valve; did you mean 'annulus'?"},
  };
  const int32_t degree[4] = {1, 1, 1, 1}, curve_id[4] = {0, 1, 2, 3};
  const double control[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
  riis_patches patches;
  CHECK_OK(riis_patches_init(&patches, sizeof patches));
  patches.n_curves = 4, patches.n_patches = 1;
  patches.degree = degree, patches.control = control, patches.curve_id = curve_id;
  for (size_t i = 0; i < sizeof table / sizeof *table; ++i) {
    riis_valve *valve = NULL;
    double value = 7;
    int32_t found = 7;
    if (strcmp(table[i].kind, "patches") == 0)
      CHECK_OK(riis_valve_create_from_patches(&patches, &valve));
    else
      CHECK_OK(riis_valve_create(table[i].kind, &valve));
    own(valve);
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, table[i].text, riis_valve_set_scalar(valve, table[i].name, 2.5));
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, table[i].text, riis_valve_get(valve, table[i].name, 1, &value));
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, table[i].text, riis_valve_unset(valve, table[i].name));
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, table[i].text, riis_valve_is_set(valve, table[i].name, &found));
    CHECK_SAME(value, 7);
    assert_int_equal(found, 7);
  }
}

TEST(other_refusals) {
  riis_valve *valve = new_valve("trileaflet"), *open = new_valve("trileaflet");
  riis_surface *surface = NULL;
  const double two[2] = {1, 1};
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "parameter 'annulus' has 1 value, not 2",
                riis_valve_set(valve, "annulus", 2, two));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "parameter 'annulus' is nan", riis_valve_set_scalar(valve, "annulus", NAN));
  /* A rule may give a value outside the range of its parameter. */
  for (int k = 0; k < 2; ++k) {
    riis_valve *large = k ? open : valve;
    for (int size = 0; size < 3; ++size)
      CHECK_OK(riis_valve_set_scalar(large,
                                     size == 0   ? "root_radius"
                                     : size == 1 ? "leaflet_radius_out"
                                                 : "leaflet_height",
                                     1e9));
    CHECK_REFUSED(
        RIIS_INVALID_PARAMETER,
        "bending_radius_out was not set and is 0.51 (root_radius + leaflet_radius_out), which is 1.02e+09; it must",
        riis_surface_create(large, NULL, &surface));
  }
  CHECK_OK(riis_valve_set_open_state(valve, open));
  for (int size = 0; size < 3; ++size)
    CHECK_OK(riis_valve_unset(valve, size == 0 ? "root_radius" : size == 1 ? "leaflet_radius_out" : "leaflet_height"));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "in the open state: bending_radius_out was not set and is",
                riis_surface_create(valve, NULL, &surface));
  assert_null(surface);
  /* A caller that was compiled before the fields existed gets no new field. */
  riis_parameter parameter;
  memset(&parameter, 0x5a, sizeof parameter);
  const riis_parameter before = parameter;
  CHECK_OK(riis_valve_get_parameter(valve, 0, &parameter, offsetof(riis_parameter, rule)));
  assert_memory_equal(&parameter.rule, &before.rule, sizeof parameter - offsetof(riis_parameter, rule));
  assert_string_equal(parameter.name, "root_radius");
}

/* --- Crossings ---------------------------------------------------------------------------------------------------------- */

typedef struct crossing {
  int64_t n_pairs;
  double opening, point[3];
  int32_t patches[2];
} crossing;

/* Returns the crossings of the opening with the most crossings, out of 0, 0.1, ..., 1. */
static crossing worst_crossing(riis_valve *valve, const riis_surface_options *options) {
  crossing worst = {0};
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  own(crossings);
  for (int tenth = 0; tenth <= 10; ++tenth) {
    riis_crossing_list list;
    CHECK_OK(riis_valve_set_scalar(valve, "opening", tenth / 10.0));
    riis_surface *surface = new_surface(valve, options);
    CHECK_OK(riis_find_crossings(surface, NULL, crossings));
    CHECK_OK(riis_crossings_get_list(crossings, &list, sizeof list));
    if (list.n_pairs > worst.n_pairs) {
      const riis_triangles all = triangles_of(surface);
      worst.n_pairs = list.n_pairs;
      worst.opening = tenth / 10.0;
      memcpy(worst.point, list.deepest_point, sizeof worst.point);
      for (int k = 0; k < 2; ++k) worst.patches[k] = all.patch_id[list.deepest_triangle_id[k]];
    }
    free_one_owned(surface);
  }
  return worst;
}

/* The ranges contain the sizes of all sources in docs/theory/trileaflet.md. Half of the valves are placed obliquely and have
 * another unit. */
TEST(trileaflet_cusps_do_not_cross) {
  const int n = trials(10, 350);
  int n_crossing = 0;
  for (int trial = 0; trial < n; ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = new_valve("trileaflet");
    riis_surface_options options = surface_options();
    options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    if (trial % 4 >= 2) {
      options.scale = random_power_of_ten(&rng, -2, 2);
      options.rotation_angle = random_between(&rng, -180, 180);
      for (int c = 0; c < 3; ++c) options.rotation_axis[c] = random_between(&rng, 0.1, 1);
      for (int c = 0; c < 3; ++c) options.translation[c] = options.scale * random_between(&rng, -1, 1);
    }
    CHECK_OK(riis_valve_set_scalar(valve, "annulus", random_between(&rng, 1.8, 3)));
    CHECK_OK(riis_valve_set_scalar(valve, "stj", random_between(&rng, 1.6, 2.8)));
    CHECK_OK(riis_valve_set_scalar(valve, "effective_height", random_between(&rng, 1, 2.2)));
    const crossing found = worst_crossing(valve, &options);
    if (found.n_pairs > 0)
      printf("crosses: annulus %.17g, stj %.17g, effective_height %.17g: %d pairs at opening %g\n",
             value_of(valve, "annulus"), value_of(valve, "stj"), value_of(valve, "effective_height"),
             (int)found.n_pairs, found.opening);
    n_crossing += found.n_pairs > 0;
    free_owned_after(owned_before);
  }
  printf("trileaflet: %d of %d valves cross at 11 openings\n", n_crossing, n);
  assert_int_equal(n_crossing, 0);
}

/* If the sizes do not follow rules, a tall valve crosses. Such a valve shows that the search finds crossings. */
TEST(sizes_that_do_not_follow_cross) {
  riis_valve *valve = new_valve("trileaflet");
  CHECK_OK(riis_valve_set_scalar(valve, "leaflet_height", 1.3));
  assert_int_equal(worst_crossing(valve, NULL).n_pairs, 0);
  CHECK_OK(riis_valve_set_scalar(valve, "bending_height", 0.6));
  assert_true(worst_crossing(valve, NULL).n_pairs > 0);
}

/* The ways to choose the exponents of the free edges. */
enum { follows, bounded, any_power };
static const char *const power_names[] = {"not set", "at most the bound", "any"};

static double bound_of_power(const riis_valve *valve, int k) {
  return largest_power((const double[]){value_of(valve, of_cusp(k, "leaflet_radius_in")),
                                        value_of(valve, of_cusp(k, "leaflet_radius_out")),
                                        value_of(valve, of_cusp(k, "leaflet_angle"))});
}

/* Makes an aortic valve whose sizes, angles and exponents vary by at most `share`. The sum of the angles stays 180 degrees. */
static riis_valve *random_aortic(double share, int power) {
  riis_valve *valve = new_valve("aortic");
  double sum = 0;
  for (int64_t i = 0; i < n_parameters_of(valve); ++i) {
    const riis_parameter parameter = parameter_of(valve, i);
    double values[3];
    if (strcmp(parameter.name, "opening") == 0 || strstr(parameter.name, "rotation") ||
        strstr(parameter.name, "translation"))
      continue;
    for (int k = 0; k < 3; ++k)
      values[k] = fmin(parameter.maximum, fmax(parameter.minimum, parameter.default_values[k] *
                                                                      random_between(&rng, 1 - share, 1 + share)));
    if (power == follows && strstr(parameter.name, "leaflet_power")) continue;
    CHECK_OK(riis_valve_set(valve, parameter.name, parameter.n_values, values));
  }
  for (int k = 0; k < 3; ++k) sum += value_of(valve, of_cusp(k, "leaflet_angle"));
  for (int k = 0; k < 3; ++k)
    CHECK_OK(riis_valve_set_scalar(valve, of_cusp(k, "leaflet_angle"),
                                   value_of(valve, of_cusp(k, "leaflet_angle")) * 180 / sum));
  for (int k = 0; power == bounded && k < 3; ++k)
    if (value_of(valve, of_cusp(k, "leaflet_power")) > bound_of_power(valve, k))
      CHECK_OK(riis_valve_set_scalar(valve, of_cusp(k, "leaflet_power"), bound_of_power(valve, k)));
  return valve;
}

static int power_is_above(const riis_valve *valve) {
  int is_above = 0;
  for (int k = 0; k < 3; ++k)
    is_above |= value_of(valve, of_cusp(k, "leaflet_power")) > (1 + 1e-9) * bound_of_power(valve, k);
  return is_above;
}

/* Writes points of a cusp's closed free edge. The first coordinate lies along the plane through the axis and the commissure. The
 * second coordinate is the distance beyond this plane. Both halves of the edge have the same coordinates. */
enum { n_edge_points = 300 };
static void free_edge(const riis_valve *valve, int k, double (*points)[2]) {
  double starts[3], ends[3];
  CHECK_OK(riis_valve_get(valve, "t0_leaflet", 3, starts));
  CHECK_OK(riis_valve_get(valve, "t3_leaflet", 3, ends));
  const double in = value_of(valve, of_cusp(k, "leaflet_radius_in")), p = value_of(valve, of_cusp(k, "leaflet_power"));
  const double out = value_of(valve, of_cusp(k, "leaflet_radius_out"));
  const double a = value_of(valve, of_cusp(k, "leaflet_angle")) * acos(-1) / 180, end[2] = {out * cos(a), out * sin(a)};
  const double slope = (end[0] - in) / end[1];
  const double q[4][2] = {{in, 0},
                          {in + (p > 1 ? 0 : starts[k] * slope), starts[k]},
                          {end[0] - ends[k] * p * slope, end[1] - ends[k]},
                          {end[0], end[1]}};
  for (int i = 0; i < n_edge_points; ++i) {
    const double t = i / (n_edge_points - 1.0), s = 1 - t;
    double x[2];
    for (int c = 0; c < 2; ++c)
      x[c] = s * s * s * q[0][c] + 3 * s * s * t * q[1][c] + 3 * s * t * t * q[2][c] + t * t * t * q[3][c];
    points[i][0] = x[0] * cos(a) + x[1] * sin(a), points[i][1] = x[1] * cos(a) - x[0] * sin(a);
  }
}

static double turn_of(const double *a, const double *b, const double *c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Returns whether the closed free edges of two neighbours go through each other. The edges of both neighbours lie in one
 * plane. */
static int free_edges_meet(const riis_valve *valve) {
  static double points[3][n_edge_points][2];
  for (int k = 0; k < 3; ++k) free_edge(valve, k, points[k]);
  for (int k = 0; k < 3; ++k) {
    const double(*a)[2] = points[k];
    double other[n_edge_points][2];
    for (int i = 0; i < n_edge_points; ++i)
      other[i][0] = points[(k + 1) % 3][i][0], other[i][1] = -points[(k + 1) % 3][i][1];
    for (int i = 0; i + 1 < n_edge_points; ++i)
      for (int j = 0; j + 1 < n_edge_points; ++j)
        if (turn_of(a[i], a[i + 1], other[j]) * turn_of(a[i], a[i + 1], other[j + 1]) < 0 &&
            turn_of(other[j], other[j + 1], a[i]) * turn_of(other[j], other[j + 1], a[i + 1]) < 0)
          return 1;
  }
  return 0;
}

/* Returns whether a cusp's attachment turns back behind the cusp's symmetry plane near the root, in the closed or the open state.
 * The halves of the cusp then go through each other. The attachment is a parabola through three points: the root with y = 0, the
 * bending curve's end at s, and the commissure at 1. The parabola's slope y'(0) is therefore (y(s) - s^2 y(1)) / (s - s^2). */
static int attachment_turns_back(const riis_valve *valve) {
  int turns_back = 0;
  const double s = value_of(valve, "bending_height") / value_of(valve, "leaflet_height"), degree = acos(-1) / 180;
  for (int k = 0; k < 3; ++k)
    for (int is_open = 0; is_open < 2; ++is_open) {
      const double e = is_open * value_of(valve, "commissure_expansion");
      const double y_s = (1 + s * e) * value_of(valve, of_cusp(k, "bending_radius_out")) *
                         sin(degree * value_of(valve, of_cusp(k, "bending_angle")));
      const double y_1 = (1 + e) * value_of(valve, of_cusp(k, "leaflet_radius_out")) *
                         sin(degree * value_of(valve, of_cusp(k, "leaflet_angle")));
      turns_back |= y_s < s * s * y_1;
    }
  return turns_back;
}

/* Returns whether the attachments of two closed neighbours pass each other below their commissure. At every height, the parameter
 * t is equal on both attachments. The distance of a cusp beyond the plane through the axis and the commissure is (1 - t) (c0 + c1
 * t). The distance is -R sin(a) at t = 0, and -b sin(a - a_b) at s. If the sum of both (c0 + c1) is positive, the sum of both
 * distances is positive at some height. Opening moves the attachments apart. */
static int attachments_pass(const riis_valve *valve) {
  const double s = value_of(valve, "bending_height") / value_of(valve, "leaflet_height"), degree = acos(-1) / 180;
  double beyond[3];
  for (int k = 0; k < 3; ++k) {
    const double a = degree * value_of(valve, of_cusp(k, "leaflet_angle"));
    beyond[k] = (1 - s) * (1 - s) * value_of(valve, "root_radius") * sin(a) -
                value_of(valve, of_cusp(k, "bending_radius_out")) *
                    sin(a - degree * value_of(valve, of_cusp(k, "bending_angle")));
  }
  return beyond[0] + beyond[1] > 0 || beyond[1] + beyond[2] > 0 || beyond[2] + beyond[0] > 0;
}

/* Returns whether a cusp folds near its root, at openings in steps of a twentieth. Triangles may cross at openings up to a tenth
 * before the smooth cusp folds. */
static int cusp_folds(riis_valve *valve) {
  int folds = 0;
  for (int i = 0; i <= 20 && !folds; ++i) {
    CHECK_OK(riis_valve_set_scalar(valve, "opening", i / 20.0));
    folds = a_lower_patch_folds(valve);
  }
  return folds;
}

/* At the root, the attachment of this left cusp hardly leaves the symmetry plane, but does not turn back. The open cusp folds
 * near its attachment, and triangles of any fineness cross. */
TEST(an_open_cusp_may_fold) {
  static const struct {
    const char *name;
    double value;
  } values[] = {{"root_radius", 1.40682523},
                {"leaflet_height", 1.03637599},
                {"bending_height", 0.77135977},
                {"xq", -0.21959563},
                {"zq", -0.21852237},
                {"right.leaflet_radius_in", 0.25105253},
                {"right.leaflet_radius_out", 1.39439955},
                {"right.leaflet_angle", 58.47123230},
                {"right.leaflet_power", 1.52508698},
                {"right.bending_radius_in", 0.36087307},
                {"right.bending_radius_out", 1.33338649},
                {"right.bending_angle", 50.04866130},
                {"right.bending_power", 1.84338850},
                {"left.leaflet_radius_in", 0.52677822},
                {"left.leaflet_radius_out", 1.59126213},
                {"left.leaflet_angle", 62.10125110},
                {"left.leaflet_power", 2.94576865},
                {"left.bending_radius_in", 0.72901550},
                {"left.bending_radius_out", 1.22284749},
                {"left.bending_angle", 40.43075697},
                {"left.bending_power", 4.45305177},
                {"non_coronary.leaflet_radius_in", 0.20415977},
                {"non_coronary.leaflet_radius_out", 1.36129908},
                {"non_coronary.leaflet_angle", 59.42751660},
                {"non_coronary.leaflet_power", 1.20097009},
                {"non_coronary.bending_radius_in", 0.67563520},
                {"non_coronary.bending_radius_out", 1.52246747},
                {"non_coronary.bending_angle", 41.50179486},
                {"non_coronary.bending_power", 2.30239241},
                {"open_radius_ratio", 0.78834307},
                {"commissure_expansion", 0.05397387}};
  riis_valve *valve = new_valve("aortic");
  riis_surface_options options = surface_options();
  assert_false(cusp_folds(valve));
  for (size_t i = 0; i < sizeof values / sizeof *values; ++i)
    CHECK_OK(riis_valve_set_scalar(valve, values[i].name, values[i].value));
  CHECK_OK(riis_valve_set(valve, "t3_leaflet", 3, (const double[]){0.53368071, 0.45396442, 0.65065534}));
  CHECK_OK(riis_valve_set(valve, "t3_bending", 3, (const double[]){0.53855824, 0.21505589, 0.37284372}));
  CHECK_OK(riis_valve_set(valve, "t0_leaflet", 3, (const double[]){0.02311546, 0.09853458, 0.10072784}));
  CHECK_OK(riis_valve_set(valve, "t0_bending", 3, (const double[]){0.09562423, 0.09546685, 0.10286060}));
  assert_false(attachment_turns_back(valve));
  assert_true(cusp_folds(valve));
  for (int i = 0; i < 2; ++i, options.tolerance = 0.01) {
    const crossing found = worst_crossing(valve, &options);
    assert_true(found.n_pairs > 0);
    for (int k = 0; k < 2; ++k) assert_int_equal(found.patches[k] / 4, 1); /* the left cusp */
    CHECK_SAME(found.opening, 1);
  }
}

/* With some bending angles, the attachments of the right and the left cusp pass each other. Nothing else is wrong. */
TEST(passing_attachments_cross) {
  riis_valve *valve = new_valve("aortic");
  for (int passes = 0; passes < 2; ++passes) {
    const double angles[2] = {passes ? 62 : 54, passes ? 57 : 53};
    CHECK_OK(riis_valve_set_scalar(valve, "right.bending_angle", angles[0]));
    CHECK_OK(riis_valve_set_scalar(valve, "left.bending_angle", angles[1]));
    assert_int_equal(attachments_pass(valve), passes);
    assert_false(attachment_turns_back(valve) || free_edges_meet(valve) || cusp_folds(valve));
    const crossing found = worst_crossing(valve, NULL);
    assert_int_equal(found.n_pairs > 0, passes);
    if (!passes) continue;
    CHECK_SAME(found.opening, 0);
    for (int k = 0; k < 2; ++k)
      assert_true(found.patches[k] == 1 || found.patches[k] == 7); /* the upper patches of both cusps */
  }
}

/* Four causes explain every valve that crosses. If leaflet_power is not set, all four causes are rare. */
TEST(aortic_cusps_rarely_cross) {
  const int n = trials(6, 300);
  for (int power = follows; power <= any_power; ++power)
    for (int percent = 10; percent <= (is_long_test() ? 20 : 10); percent += 10) {
      enum { above, meet, back, folds, pass, n_causes };
      static const char *const causes[] = {"leaflet_power above the bound", "free edges meet", "attachment turns back",
                                           "cusp folds", "attachments pass each other"};
      int n_valves = 0, n_crossing = 0, n_unexplained = 0, n_with[n_causes] = {0}, n_crossing_with[n_causes] = {0};
      for (int trial = 0; trial < n; ++trial) {
        const int owned_before = n_owned();
        riis_valve *valve = random_aortic(0.01 * percent, power);
        riis_surface *surface = NULL;
        CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5));
        if (riis_surface_create(valve, NULL, &surface) != RIIS_OK) { /* values of a state that do not fit together */
          free_owned_after(owned_before);
          continue;
        }
        riis_surface_destroy(&surface);
        ++n_valves;
        const int crosses = worst_crossing(valve, NULL).n_pairs > 0;
        const int has[n_causes] = {power_is_above(valve), free_edges_meet(valve), attachment_turns_back(valve),
                                   cusp_folds(valve), attachments_pass(valve)};
        for (int cause = 0; cause < n_causes; ++cause)
          n_with[cause] += has[cause], n_crossing_with[cause] += crosses && has[cause];
        assert_true(!has[meet] || has[above]); /* edges that stay within their sectors do not meet */
        n_crossing += crosses;
        n_unexplained += crosses && !has[meet] && !has[back] && !has[folds] && !has[pass];
        free_owned_after(owned_before);
      }
      printf("aortic, +-%d %%, leaflet_power %s: %d of %d valves cross at 11 openings, %d without a cause\n", percent,
             power_names[power], n_crossing, n_valves, n_unexplained);
      for (int cause = 0; cause < n_causes; ++cause)
        printf("  %s: %d valves, of which %d cross\n", causes[cause], n_with[cause], n_crossing_with[cause]);
      assert_true(n_unexplained <=
                  (percent == 10 ? 0 : n / 100)); /* no cause was found; a fold may hide between openings */
      if (is_long_test() && power != any_power && percent == 10) assert_true(20 * n_crossing <= n);
    }
}

int main(void) {
  rng = random_start("test_sizes");
  return run_cases(NULL, NULL);
}
