/* SPDX-License-Identifier: Apache-2.0
 * Laws of opening are compared with values computed by hand and with closed forms, and their order of accuracy is checked. A
 * restart continues with the same bits. */
#include <riis/riis.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "test_support.h"

static random_source rng;

/* Makes a law from a table of keys. */

static riis_opening_table table_of(int64_t n, const double *time, const double *opening) {
  riis_opening_table table;
  CHECK_OK(riis_opening_table_init(&table, sizeof table));
  table.n_keys = n;
  table.time = time;
  table.opening = opening;
  return table;
}

static void check_table(const riis_opening_table *table, double time, double opening, double rate) {
  double got = -1, got_rate = -1;
  CHECK_OK(riis_opening_from_table(table, time, &got, &got_rate));
  CHECK_NEAR(got, opening, 1e-14);
  CHECK_NEAR(got_rate, rate, 1e-12);
}

TEST(a_linear_table_has_its_keys_and_right_hand_rates) {
  const double time[] = {1, 2, 4}, opening[] = {0, 1, 0.5};
  const riis_opening_table table = table_of(3, time, opening);
  check_table(&table, 0, 0, 0);
  check_table(&table, 1, 0, 1);
  check_table(&table, 1.25, 0.25, 1);
  check_table(&table, 2, 1, -0.25);
  check_table(&table, 3, 0.75, -0.25);
  check_table(&table, 4, 0.5, 0);
  check_table(&table, 9, 0.5, 0);
  CHECK_OK(riis_opening_from_table(&table, 3, NULL, NULL));
}

TEST(a_periodic_table_repeats) {
  const double time[] = {0, 0.25, 1}, opening[] = {0.2, 1, 0.2};
  for (int64_t n = 2; n <= 3; ++n) { /* with and without the last key, which repeats the first */
    for (int32_t interpolation = 0; interpolation <= 1; ++interpolation) {
      riis_opening_table table = table_of(n, time, opening);
      table.period = 1;
      table.interpolation = interpolation;
      for (int i = 0; i < 200; ++i) {
        const double t = random_between(&rng, 0, 1);
        double a, b, c, rate_a, rate_b;
        CHECK_OK(riis_opening_from_table(&table, t, &a, &rate_a));
        CHECK_OK(riis_opening_from_table(&table, t + 3, &b, &rate_b));
        CHECK_OK(riis_opening_from_table(&table, t - 5, &c, NULL));
        CHECK_NEAR(a, b, 1e-13);
        CHECK_NEAR(a, c, 1e-13);
        CHECK_NEAR(rate_a, rate_b, 1e-10);
        if (interpolation == RIIS_INTERPOLATION_LINEAR)
          CHECK_NEAR(a, t < 0.25 ? 0.2 + 3.2 * t : 1 - (t - 0.25) * 0.8 / 0.75, 1e-13);
      }
    }
  }
}

/* 0.1 + 0.7 is below 0.8 in double precision. */
TEST(rounding_of_a_period_does_not_matter) {
  const double time[] = {0.1, 0.4, 0.8}, opening[] = {0, 1, 0};
  riis_opening_table table = table_of(3, time, opening);
  table.period = 0.7;
  check_table(&table, 0.8 + 0.15, 0.5, 1 / 0.3);
}

/* Returns the distance of a time from a key's repetition n_periods later. The unit is the rounding error of the largest number
 * among the time, the key and the period. */
static double units_from_key(double time, double key, double period, int n_periods) {
  const long double distance = fabsl((long double)time - key - (long double)period * n_periods);
  return (double)(distance / (DBL_EPSILON * fmaxl(fmaxl(fabsl(time), fabsl(key)), period)));
}

/* Checks the doubles around each key in the periods -2 to 1000. A time within 8 units of rounding of a key has exactly the key's
 * opening and the rate after the key. Returns the number of such times. */
static int64_t check_keys_of_periods(const riis_opening_table *table) {
  const int64_t n = table->n_keys;
  int64_t n_at_keys = 0;
  for (int64_t i = 0; i < n; ++i) {
    const int64_t next = (i + 1) % n, before = (i + n - 1) % n;
    const double width = table->time[next] - table->time[i] + (next == 0 ? table->period : 0);
    const double width_before = table->time[i] - table->time[before] + (i == 0 ? table->period : 0);
    const double rate = (table->opening[next] - table->opening[i]) / width,
                 rate_before = (table->opening[i] - table->opening[before]) / width_before;
    assert_true(fabs(rate - rate_before) > 1e-3 * fabs(rate));
    for (int n_periods = -2; n_periods <= 1000; ++n_periods) {
      double time = table->time[i] + n_periods * table->period;
      for (int k = 0; k < 12; ++k) time = nextafter(time, -INFINITY);
      for (int k = -12; k <= 12; ++k, time = nextafter(time, INFINITY)) {
        const double units = units_from_key(time, table->time[i], table->period, n_periods);
        double opening, got_rate;
        CHECK_OK(riis_opening_from_table(table, time, &opening, &got_rate));
        if (units < 7.999) {
          ++n_at_keys;
          CHECK_NEAR(opening, table->opening[i], 0);
          CHECK_NEAR(got_rate, rate, 1e-12 * fabs(rate));
        } else if (units > 8.001) {
          CHECK_NEAR(got_rate, k < 0 ? rate_before : rate, 1e-12 * fabs(k < 0 ? rate_before : rate));
        }
      }
    }
  }
  return n_at_keys;
}

TEST(a_key_has_the_rate_after_it_in_every_period) {
  enum { n_keys = 7, n_periods = 1003 };
  const double heart[] = {-0.08, -0.01, 0.15, 0.24, 0.42, 0.51, 0.65}, opening[] = {0, 0.1, 1, 0.7, 0.9, 0.3, 0.2};
  riis_opening_table table = table_of(n_keys, heart, opening);
  table.period = 0.83;
  assert_true(check_keys_of_periods(&table) >= 9 * n_keys * n_periods);
  for (int trial = 0; trial < 20; ++trial) {
    double time[n_keys], size = pow(10, random_between(&rng, -6, 6));
    time[0] = random_between(&rng, -5, 5) * size;
    for (int i = 1; i < n_keys; ++i) time[i] = time[i - 1] + random_between(&rng, 0.01, 0.2) * size;
    table.time = time;
    table.period = time[n_keys - 1] - time[0] + random_between(&rng, 0.01, 0.2) * size;
    assert_true(check_keys_of_periods(&table) >= 5 * n_keys * n_periods);
  }
}

/* The last key counts as the first key of the next period. The last key may even miss the period's end by a billionth. */
TEST(a_last_key_is_the_first_one_of_the_next_period) {
  const double opening[] = {0.5, 1, 0.5};
  for (int sign = -1; sign <= 1; ++sign) {
    const double time[] = {0.25, 0.5, 1.25 + sign * 5e-10};
    riis_opening_table table = table_of(3, time, opening);
    table.period = 1;
    for (int i = -2; i <= 1000; ++i) {
      check_table(&table, time[2] + i, 0.5, 2);
      check_table(&table, time[0] + i, 0.5, 2);
    }
  }
}

TEST(a_table_that_ends_has_its_keys_within_rounding) {
  const double time[] = {0.3, 0.7, 1.1}, opening[] = {0, 1, 0.5};
  const riis_opening_table table = table_of(3, time, opening);
  check_table(&table, nextafter(0.3, 0), 0, 2.5);
  check_table(&table, nextafter(0.7, 0), 1, -1.25);
  check_table(&table, nextafter(1.1, 0), 0.5, 0);
  check_table(&table, 0.3 - 1e-15, 0, 0);
  check_table(&table, 0.7 - 2e-15, 1, 2.5);
}

TEST(a_cubic_table_is_monotone_and_its_rate_is_its_derivative) {
  for (int trial = 0; trial < 100; ++trial) {
    double time[12], opening[12];
    const int64_t n = 2 + (int64_t)(random_bits(&rng) % 11);
    for (int64_t i = 0; i < n; ++i) {
      time[i] = (i ? time[i - 1] : 0) + random_between(&rng, 0.01, 1);
      opening[i] = random_between(&rng, 0, 1);
    }
    riis_opening_table table = table_of(n, time, opening);
    table.interpolation = RIIS_INTERPOLATION_CUBIC;
    for (int64_t i = 0; i + 1 < n; ++i) {
      double last = opening[i];
      for (int k = 1; k <= 50; ++k) {
        const double width = time[i + 1] - time[i], t = time[i] + k / 50.0 * width, h = 1e-6 * width;
        double now, before, after, rate;
        CHECK_OK(riis_opening_from_table(&table, t, &now, &rate));
        if (k == 50) CHECK_NEAR(now, opening[i + 1], 1e-14);
        assert_true(opening[i + 1] > opening[i] ? now >= last - 1e-14 : now <= last + 1e-14);
        last = now;
        if (k == 50) continue;
        CHECK_OK(riis_opening_from_table(&table, t - h, &before, NULL));
        CHECK_OK(riis_opening_from_table(&table, t + h, &after, NULL));
        CHECK_NEAR(rate, (after - before) / (2 * h), 1e-5 / width);
      }
    }
  }
}

TEST(bad_tables_are_refused) {
  double time[] = {0, 1, 2}, opening[] = {0, 1, 0}, got = 7;
  riis_opening_table table = table_of(3, time, opening);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table", riis_opening_from_table(NULL, 0, &got, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "time|nan", riis_opening_from_table(&table, NAN, &got, NULL));
  table.n_keys = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.n_keys is 0", riis_opening_from_table(&table, 0, &got, NULL));
  table.n_keys = 1000001;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.n_keys is 1000001", riis_opening_from_table(&table, 0, &got, NULL));
  table = table_of(3, NULL, opening);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.time", riis_opening_from_table(&table, 0, &got, NULL));
  table = table_of(3, time, NULL);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.opening", riis_opening_from_table(&table, 0, &got, NULL));
  table = table_of(3, time, opening);
  time[1] = 2;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.time of key 2 is 2|above",
                riis_opening_from_table(&table, 0, &got, NULL));
  time[1] = INFINITY;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.time of key 1 is inf", riis_opening_from_table(&table, 0, &got, NULL));
  time[1] = 1;
  opening[1] = 1.25;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.opening of key 1 is 1.25",
                riis_opening_from_table(&table, 0, &got, NULL));
  opening[1] = NAN;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.opening of key 1 is nan", riis_opening_from_table(&table, 0, &got, NULL));
  opening[1] = 1;
  table.period = 1.5;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.time of key 2 is 2|period of 1.5",
                riis_opening_from_table(&table, 0, &got, NULL));
  table.period = 2;
  opening[2] = 0.5;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "last key|0.5", riis_opening_from_table(&table, 0, &got, NULL));
  table.period = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.period is -1", riis_opening_from_table(&table, 0, &got, NULL));
  table.period = 0;
  table.interpolation = 2;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "table.interpolation is 2", riis_opening_from_table(&table, 0, &got, NULL));
  CHECK_NEAR(got, 7, 0);
}

/* Makes a law from times. */

static riis_opening_times some_times(void) {
  riis_opening_times times;
  CHECK_OK(riis_opening_times_init(&times, sizeof times));
  times.opening_start = 0.45;
  times.opening_duration = 0.05;
  times.closing_start = 0.9;
  times.closing_duration = 0.1;
  return times;
}

TEST(a_valve_opens_and_closes_at_its_times) {
  riis_opening_times times = some_times();
  const struct {
    double time, opening, rate;
  } expected[] = {{0.45, 0, 0}, {0.475, 0.5, 1.875 / 0.05}, {0.5, 1, 0},
                  {0.7, 1, 0},  {0.95, 0.5, -1.875 / 0.1},  {1.0, 0, 0},
                  {1.2, 0, 0}};
  for (int repeat = 0; repeat < 2; ++repeat) {
    times.period = repeat ? 1 : 0;
    for (size_t i = 0; i < sizeof expected / sizeof *expected; ++i) {
      double opening, rate;
      CHECK_OK(riis_opening_from_times(&times, expected[i].time + 4 * repeat, &opening, &rate));
      CHECK_NEAR(opening, expected[i].opening, 1e-12);
      CHECK_NEAR(rate, expected[i].rate, 1e-9);
    }
  }
  double opening;
  CHECK_OK(riis_opening_from_times(&times, -0.5, &opening, NULL)); /* one period earlier, when the valve is open */
  CHECK_NEAR(opening, 1, 1e-12);
  times.period = 0;
  times.closed = 0.1;
  times.open = 0.8;
  CHECK_OK(riis_opening_from_times(&times, 0.475, &opening, NULL));
  CHECK_NEAR(opening, 0.45, 1e-12);
  CHECK_OK(riis_opening_from_times(&times, -3, &opening, NULL));
  CHECK_NEAR(opening, 0.1, 0);
}

TEST(bad_times_are_refused) {
  double got;
  riis_opening_times times;
  CHECK_OK(riis_opening_times_init(&times, sizeof times));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "times.opening_start is nan", riis_opening_from_times(&times, 0, &got, NULL));
  times = some_times();
  times.opening_duration = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "times.opening_duration is 0", riis_opening_from_times(&times, 0, &got, NULL));
  times = some_times();
  times.closing_start = 0.47;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "times.closing_start is 0.47", riis_opening_from_times(&times, 0, &got, NULL));
  times = some_times();
  times.closing_duration = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "times.closing_duration is -1", riis_opening_from_times(&times, 0, &got, NULL));
  times = some_times();
  times.period = 0.5;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "times.period is 0.5|0.55", riis_opening_from_times(&times, 0, &got, NULL));
  times = some_times();
  times.open = 1.5;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "times.open is 1.5", riis_opening_from_times(&times, 0, &got, NULL));
}

/* Makes a law with a switch. */

static riis_opening_switch some_switch(void) {
  riis_opening_switch law;
  CHECK_OK(riis_opening_switch_init(&law, sizeof law));
  law.opening_duration = 0.04;
  law.closing_duration = 0.08;
  return law;
}

static riis_opening_switch_state closed_switch(void) {
  riis_opening_switch_state state;
  CHECK_OK(riis_opening_switch_state_init(&state, sizeof state));
  return state;
}

TEST(a_switch_opens_by_pressure_and_closes_by_flow) {
  const riis_opening_switch law = some_switch();
  riis_opening_switch_state now = closed_switch();
  CHECK_OK(riis_opening_switch_advance(&law, &now, 0.01, -1, 5, &now));
  assert_int_equal(now.phase, RIIS_PHASE_CLOSING);
  CHECK_OK(riis_opening_switch_advance(&law, &now, 0.02, 1, 0, &now));
  assert_int_equal(now.phase, RIIS_PHASE_OPENING);
  CHECK_NEAR(now.turn_time, 0.02, 0);
  CHECK_NEAR(now.opening, 0, 0);
  CHECK_OK(riis_opening_switch_advance(&law, &now, 0.04, 1, 3, &now));
  CHECK_NEAR(now.opening, 0.5, 1e-12);
  CHECK_NEAR(now.rate, 1.875 / 0.04, 1e-9);
  /* The pressure alone does not close the valve. */
  CHECK_OK(riis_opening_switch_advance(&law, &now, 0.30, -1, 3, &now));
  assert_int_equal(now.phase, RIIS_PHASE_OPENING);
  CHECK_NEAR(now.opening, 1, 0);
  CHECK_OK(riis_opening_switch_advance(&law, &now, 0.31, -1, -0.1, &now));
  assert_int_equal(now.phase, RIIS_PHASE_CLOSING);
  CHECK_OK(riis_opening_switch_advance(&law, &now, 0.35, -1, -0.1, &now));
  CHECK_NEAR(now.opening, 0.5, 1e-12);
  /* Half way, the valve reverses without a jump. */
  CHECK_OK(riis_opening_switch_advance(&law, &now, 0.36, 2, 0, &now));
  const double where = now.opening;
  CHECK_OK(riis_opening_switch_advance(&law, &now, 0.36 + 1e-9, 2, 0, &now));
  CHECK_NEAR(now.opening, where, 1e-6);
}

/* The steps of a solver may miss the ramp's end by rounding: the sum of steps of 2 ms is slightly less than 0.04 s. */
TEST(an_opening_rounds_to_at_most_one) {
  const riis_opening_switch law = some_switch();
  for (int i = 0; i < 4096; ++i) {
    riis_opening_switch_state now = closed_switch();
    now.phase = RIIS_PHASE_OPENING;
    now.progress = 1 - 0x1p-53 * (i < 2048 ? i : ldexp(1, i % 32));
    CHECK_OK(riis_opening_switch_advance(&law, &now, 0, 1, 1, &now));
    assert_true(now.opening > 0.9 && now.opening <= 1);
  }
}

TEST(a_filter_and_a_dwell_keep_noise_out) {
  riis_opening_switch law = some_switch();
  law.filter_time = 0.01;
  riis_opening_switch_state now = closed_switch();
  CHECK_OK(riis_opening_switch_advance(&law, &now, 0, -1, 0, &now));
  CHECK_OK(riis_opening_switch_advance(&law, &now, 0.01, 1, 0, &now));
  CHECK_NEAR(now.pressure_difference, -1 + (1 - exp(-1)) * 2, 1e-14);
  law.filter_time = 0;
  law.dwell_time = 0.1;
  now = closed_switch();
  int turns = 0;
  for (int i = 1; i <= 1000; ++i) {
    const int32_t phase = now.phase;
    CHECK_OK(riis_opening_switch_advance(&law, &now, 0.001 * i, random_between(&rng, -1, 1),
                                         random_between(&rng, -1, 1), &now));
    turns += phase != now.phase;
  }
  assert_true(turns >= 5 && turns <= 10);
}

/* Advances a valve by random pressures and flows. Counts the reversals in the middle of a motion. */
static int n_turns_in_motion(double opening, double closing, double dwell, int *n_turns) {
  riis_opening_switch law = some_switch();
  law.opening_duration = opening;
  law.closing_duration = closing;
  law.dwell_time = dwell;
  riis_opening_switch_state now = closed_switch();
  int in_motion = 0;
  while (now.time < 20) {
    const int32_t phase = now.phase;
    CHECK_OK(riis_opening_switch_advance(&law, &now, now.time + random_between(&rng, 0.0005, 0.004),
                                         random_between(&rng, -1, 1), random_between(&rng, -1, 1), &now));
    if (phase == now.phase) continue;
    ++*n_turns;
    in_motion += now.progress > 1e-12 && now.progress < 1 - 1e-12;
  }
  return in_motion;
}

TEST(a_dwell_as_long_as_a_motion_lets_it_end) {
  for (int trial = 0; trial < 20; ++trial) {
    const double opening = random_between(&rng, 0.01, 0.1), closing = random_between(&rng, 0.01, 0.1);
    int n_turns = 0;
    assert_int_equal(n_turns_in_motion(opening, closing, fmax(opening, closing), &n_turns), 0);
    assert_true(n_turns > 50);
    assert_true(n_turns_in_motion(opening, closing, 0.5 * fmin(opening, closing), &n_turns) > 50);
  }
}

/* Input: the pressure difference and the flow of a mitral valve in a flow solver. Leaflets that close push blood back. The
 * pressure before the leaflets therefore exceeds the pressure behind the leaflets from 5 to 30 ms after the flow reverses. */
TEST(closing_leaflets_do_not_open_the_valve_again) {
  for (int i = 0; i < 2; ++i) {
    riis_opening_switch law = some_switch();
    law.opening_duration = law.closing_duration = 0.04;
    law.open_above = 50;
    law.filter_time = 0.002;
    law.dwell_time = i == 0 ? 0.02 : 0.04;
    riis_opening_switch_state now = closed_switch();
    now.phase = RIIS_PHASE_OPENING;
    now.progress = now.opening = 1;
    double lowest = 1;
    int turns_back = 0;
    for (int step = 1; step <= 50; ++step) {
      const double time = 0.002 * step, since = time - now.turn_time; /* NaN before the turn */
      const double pressure = since > 0.005 && since < 0.03 ? 1900 : -1000;
      const int32_t phase = now.phase;
      CHECK_OK(riis_opening_switch_advance(&law, &now, time, pressure, -1e-4, &now));
      turns_back += phase == RIIS_PHASE_CLOSING && now.phase == RIIS_PHASE_OPENING;
      lowest = fmin(lowest, now.opening);
    }
    assert_int_equal(turns_back > 0, i == 0);
    assert_true(i == 0 ? lowest > 0.3 : now.opening == 0);
  }
}

/* Advances a law to a time, with pressures and flows that are functions of time. */
typedef void driven_step(void *state, double time);

/* Half way, the law's state is copied, and a law continues from the copy, as after a restart. At the end, this law has the same
 * bits as the law without a restart. */
static void check_restart(driven_step *advance, void *state, void *kept, size_t size) {
  enum { n_steps = 600, half = n_steps / 2 };
  for (int i = 1; i <= n_steps; ++i) {
    advance(state, 0.001 * i);
    if (i == half) memcpy(kept, state, size);
  }
  assert_memory_not_equal(state, kept, size);
  for (int i = half + 1; i <= n_steps; ++i) advance(kept, 0.001 * i);
  assert_memory_equal(state, kept, size);
}

static void step_of_the_switch(void *state, double time) {
  riis_opening_switch law = some_switch();
  law.filter_time = 0.003;
  CHECK_OK(riis_opening_switch_advance(&law, state, time, sin(20 * time), cos(21 * time), state));
}

TEST(a_restart_of_the_switch_has_the_same_bits) {
  riis_opening_switch_state one = closed_switch(), kept;
  check_restart(step_of_the_switch, &one, &kept, sizeof one);
}

/* Makes the angle law of an aortic valve. */

static riis_opening_angle aortic_angle(void) {
  riis_opening_angle law;
  CHECK_OK(riis_opening_angle_init(&law, sizeof law));
  law.pressure_gain = 5500;
  law.flow_gain = 2;
  law.friction = 50;
  law.vortex_gain = 7;
  return law;
}

static riis_opening_angle_state angle_at_rest(void) {
  riis_opening_angle_state state;
  CHECK_OK(riis_opening_angle_state_init(&state, sizeof state));
  return state;
}

TEST(without_a_drive_friction_stops_the_leaflet) {
  const riis_opening_angle law = aortic_angle();
  riis_opening_angle_state now = angle_at_rest();
  now.angle = 10;
  now.angle_rate = 400;
  for (int i = 1; i <= 100; ++i) CHECK_OK(riis_opening_angle_advance(&law, &now, 0.001 * i, 0, 0, &now));
  CHECK_NEAR(now.angle_rate, 400 * exp(-50 * 0.1), 1e-5);
  CHECK_NEAR(now.angle, 10 + 400 / 50.0 * (1 - exp(-50 * 0.1)), 1e-5);
  CHECK_NEAR(now.opening, now.angle / 75, 1e-15);
  CHECK_NEAR(now.rate, now.angle_rate / 75, 1e-15);
}

/* The pressure and the flow are constant. Explicit Euler with small steps in long double gives an independent answer. This answer
 * is accurate to first order. */
TEST(the_angle_follows_the_published_equation) {
  for (int trial = 0; trial < 6; ++trial) {
    const riis_opening_angle law = aortic_angle();
    const double pressure = random_between(&rng, -0.4, 0.4), flow = random_between(&rng, -100, 200);
    riis_opening_angle_state now = angle_at_rest();
    now.angle = 40;
    const double end = 0.01;
    const int n = 400000;
    long double angle = 40.0L * acosl(-1) / 180, rate = 0;
    for (int i = 0; i < n; ++i) {
      const long double second = -50 * rate + (5500 * (long double)pressure + 2 * (long double)flow) * cosl(angle) -
                                 7 * (flow > 0 ? (long double)flow : 0) * sinl(2 * angle);
      angle += rate * (end / n);
      rate += second * (end / n);
    }
    CHECK_OK(riis_opening_angle_advance(&law, &now, end, pressure, flow, &now));
    CHECK_NEAR(now.angle, (double)(angle * 180 / acosl(-1)), 1e-3);
  }
}

static double driven(int n) {
  const riis_opening_angle law = aortic_angle();
  riis_opening_angle_state now = angle_at_rest();
  now.angle = 30;
  now.pressure_difference = 0.05;
  now.flow = 20;
  const double end = 0.02;
  for (int i = 1; i <= n; ++i) {
    const double t = end * i / n;
    CHECK_OK(riis_opening_angle_advance(&law, &now, t, 0.05 * cos(200 * t), 20 + 30 * sin(250 * t), &now));
  }
  assert_true(now.angle > 1 && now.angle < 74); /* the leaflet has reached no stop */
  return now.angle;
}

TEST(the_angle_is_second_order_in_the_step) {
  const double exact = driven(20000);
  double last = fabs(driven(10) - exact);
  for (int n = 20; n <= 160; n *= 2) {
    const double error = fabs(driven(n) - exact);
    print_message("%d steps: off by %.3g degrees, order %.2f\n", n, error, log2(last / error));
    assert_true(last / error > 3.4 && last / error < 4.6);
    last = error;
  }
}

TEST(the_angle_stays_between_its_stops) {
  riis_opening_angle law = aortic_angle();
  law.angle_min = 5;
  law.angle_max = 70;
  riis_opening_angle_state now = angle_at_rest();
  now.angle = 5;
  CHECK_OK(riis_opening_angle_advance(&law, &now, 0.3, 10, 100, &now));
  CHECK_NEAR(now.angle, 70, 0);
  CHECK_NEAR(now.angle_rate, 0, 0);
  CHECK_NEAR(now.opening, 1, 0);
  CHECK_OK(riis_opening_angle_advance(&law, &now, 0.6, -10, -10, &now));
  CHECK_NEAR(now.angle, 5, 0);
  CHECK_NEAR(now.opening, 0, 0);
}

/* One pair of pressure and flow closes the valve, and another pair opens it. */
TEST(a_first_state_is_closed_whatever_the_law) {
  for (int sign = -1; sign <= 1; sign += 2) {
    riis_opening_angle law = aortic_angle();
    law.angle_min = 5;
    riis_opening_angle_state first = angle_at_rest(), closed = angle_at_rest(), from_first, from_closed;
    closed.angle = 5;
    CHECK_OK(riis_opening_angle_advance(&law, &first, 0.01, 0.1 * sign, 10 * sign, &from_first));
    CHECK_OK(riis_opening_angle_advance(&law, &closed, 0.01, 0.1 * sign, 10 * sign, &from_closed));
    assert_memory_equal(&from_first, &from_closed, sizeof from_first);
    assert_true(sign < 0 ? from_first.angle == 5 : from_first.angle > 5);
    CHECK_OK(riis_opening_angle_advance(&law, &first, 0, 0, 0, &from_first)); /* a step of length 0 */
    CHECK_NEAR(from_first.angle, 5, 0);
    CHECK_NEAR(from_first.opening, 0, 0);
  }
}

static void step_of_the_angle(void *state, double time) {
  const riis_opening_angle law = aortic_angle();
  CHECK_OK(riis_opening_angle_advance(&law, state, time, sin(20 * time), 100 * cos(21 * time), state));
}

TEST(a_restart_of_the_angle_has_the_same_bits) {
  riis_opening_angle_state one = angle_at_rest(), kept;
  check_restart(step_of_the_angle, &one, &kept, sizeof one);
}

TEST(bad_laws_and_states_are_refused) {
  riis_opening_switch law;
  CHECK_OK(riis_opening_switch_init(&law, sizeof law));
  riis_opening_switch_state before = closed_switch(), now = closed_switch();
  now.time = 42;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "law.opening_duration is nan",
                riis_opening_switch_advance(&law, &before, 1, 0, 0, &now));
  law = some_switch();
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "law", riis_opening_switch_advance(NULL, &before, 1, 0, 0, &now));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "before", riis_opening_switch_advance(&law, NULL, 1, 0, 0, &now));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "now", riis_opening_switch_advance(&law, &before, 1, 0, 0, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "time is -1", riis_opening_switch_advance(&law, &before, -1, 0, 0, &now));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "pressure_difference is nan",
                riis_opening_switch_advance(&law, &before, 1, NAN, 0, &now));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "flow is inf", riis_opening_switch_advance(&law, &before, 1, 0, INFINITY, &now));
  before.progress = 2;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "before.progress is 2",
                riis_opening_switch_advance(&law, &before, 1, 0, 0, &now));
  before = closed_switch();
  before.phase = 5;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "before.phase is 5", riis_opening_switch_advance(&law, &before, 1, 0, 0, &now));
  law.dwell_time = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "law.dwell_time is -1",
                riis_opening_switch_advance(&law, &before, 1, 0, 0, &now));
  CHECK_NEAR(now.time, 42, 0);

  riis_opening_angle angle;
  CHECK_OK(riis_opening_angle_init(&angle, sizeof angle));
  riis_opening_angle_state at = angle_at_rest(), then = angle_at_rest();
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "law.pressure_gain is nan",
                riis_opening_angle_advance(&angle, &at, 1, 0, 0, &then));
  angle = aortic_angle();
  angle.angle_max = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "law.angle_max is 0", riis_opening_angle_advance(&angle, &at, 1, 0, 0, &then));
  angle = aortic_angle();
  angle.angle_min = 5;
  at.angle = 4;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "before.angle is 4", riis_opening_angle_advance(&angle, &at, 1, 0, 0, &then));
  at.angle = at.pressure_difference = at.flow = 0; /* a state that was never initialized */
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "before.angle is 0", riis_opening_angle_advance(&angle, &at, 1, 0, 0, &then));
  at = angle_at_rest();
  angle = aortic_angle();
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "time is 1e+06", riis_opening_angle_advance(&angle, &at, 1e6, 1, 0, &then));
}

int main(void) {
  rng = random_start("test_opening_laws");
  return run_cases(NULL, NULL);
}
