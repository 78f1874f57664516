// SPDX-License-Identifier: Apache-2.0
// Calls riis_marks_add_*, riis_marks_get_band_sums, riis_loads_*, riis_opening_* and riis_keyframes_*.
#include <cmath>

#include "api_state.hpp"

namespace fuzz {
namespace {

bool are_equal(const std::vector<double> &a, const std::vector<double> &b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

// Spreads forces over a few nodes of tissue. A refusal must leave the arrays as they were.
void spread_loads(Input &in) {
  constexpr std::size_t n = 5, n_leaflets = 2;
  std::vector<double> places(3 * n), weights(n, in.number()), forces(3 * n_leaflets, in.number()), edges(12);
  for (double &place : places) place = in.place();
  for (double &end : edges) end = in.one_in(8) ? in.number() : in.sound_place();
  const std::int32_t leaflets[2] = {in.mostly(0), in.mostly(1)};
  riis_loads loads = initialised(in, riis_loads_init);
  loads.radius = in.one_in(2) ? 2 : in.number();
  loads.about[in.below(3)] = in.number();
  loads.n_leaflets = n_leaflets;
  loads.leaflet_force = mostly(in, forces.data());
  loads.leaflet_moment = mostly(in, forces.data());
  loads.n_edges = in.below(3);
  loads.edges = mostly(in, edges.data());
  if (in.one_in(2)) loads.edge_leaflet_id = leaflets;
  riis_points nodes = initialised(in, riis_points_init);
  nodes.n_points = n;
  nodes.x = places.data(), nodes.y = places.data() + 1, nodes.z = places.data() + 2;
  nodes.stride = 3;
  const double *const weight = in.one_in(2) ? weights.data() : nullptr;
  std::vector<double> sums(11 * n_leaflets, 0), added(3 * n, 6.5);
  const std::vector<double> sums_before = sums, added_before = added;
  riis_status status =
      call(in, [&] { return riis_loads_add_sums(mostly(in, &loads), &nodes, weight, mostly(in, sums.data())); });
  if (status != RIIS_OK) EXPECT(are_equal(sums, sums_before), "refused, but added");
  for (const double sum : sums) EXPECT(std::isfinite(sum), "a sum is %g", sum);
  status = call(in, [&] {
    return riis_loads_add_forces(mostly(in, &loads), &nodes, weight, sums.data(), mostly(in, added.data()));
  });
  if (status != RIIS_OK) EXPECT(are_equal(added, added_before), "refused, but added");
}

}  // namespace

// Adds forces. A refusal must leave the arrays as they were.
void add_forces(Input &in, State &state) {
  ResultSlot &slot = state.results[in.slot()];
  const Given<riis_marks> result = given(in, state, State::result, slot.handle);
  riis_mark_stats stats{};
  if (slot.handle) EXPECT_OK(riis_marks_get_stats(slot.handle, &stats, sizeof stats));
  const auto n = static_cast<std::size_t>(stats.n_nodes);
  const std::int64_t n_given = in.mostly(stats.n_nodes);
  riis_resistance resistance = initialised(in, riis_resistance_init);
  resistance.R = in.number();
  if (in.one_in(4)) resistance.half_thickness = in.number();
  resistance.rim = in.mostly(in.below(2));
  resistance.reserved = in.one_in(64) ? 1 : 0;

  const std::vector<double> values(3 * n, in.sound_place()), weights(n, in.sound_place());
  std::vector<double> coefficient(n, 1.5), momentum(3 * n, 2.5), force(3, 3.5);
  const std::vector<double> coefficient_before = coefficient, momentum_before = momentum, force_before = force;
  double *const k = mostly(in, coefficient.data()), *const ku = in.one_in(2) ? momentum.data() : nullptr;
  riis_status status =
      call(in, [&] { return add_resistance_to(result.handle, mostly(in, &resistance), n_given, k, ku); });
  if (!result.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK)
    EXPECT(are_equal(coefficient, coefficient_before) && are_equal(momentum, momentum_before), "refused, but added");
  else
    for (const double sum : coefficient) EXPECT(sum >= 1.5, "K is %g", sum - 1.5);

  status = call(in, [&] {
    return add_reaction_to(result.handle, mostly(in, &resistance), n_given, mostly(in, values.data()),
                           mostly(in, weights.data()), mostly(in, force.data()));
  });
  if (status != RIIS_OK) EXPECT(are_equal(force, force_before), "refused, but added");

  std::vector<double> sums_of_parts(30, 4.5);
  const std::vector<double> parts_before = sums_of_parts, edges{in.number(), 0, 1, 2, in.sound_place(), 3};
  riis_flow_arrays flow = initialised(in, riis_flow_arrays_init);
  flow.n_nodes = n_given;
  for (std::size_t c = 0; c < 3 && n > 0; ++c) flow.velocity[c] = values.data() + c;
  flow.velocity_stride = 3;
  flow.weight = weights.data();
  riis_reaction reaction = initialised(in, riis_reaction_init);
  reaction.about[in.below(3)] = in.number();
  reaction.moment = mostly(in, sums_of_parts.data());
  reaction.n_leaflets = in.mostly<std::int64_t>(3);
  if (reaction.n_leaflets <= 3) reaction.leaflet_force = mostly(in, sums_of_parts.data() + 3);
  reaction.n_edges = in.mostly<std::int64_t>(1);
  reaction.edges = mostly(in, edges.data());
  if (reaction.n_edges <= 1) reaction.edge_moment = mostly(in, sums_of_parts.data() + 12);
  if (n > 0)
    status =
        call(in, [&] { return riis_marks_add_reaction(result.handle, mostly(in, &resistance), &flow, &reaction); });
  if (status != RIIS_OK) EXPECT(are_equal(sums_of_parts, parts_before), "refused, but added");

  riis_band_sums sums;
  std::memset(static_cast<void *>(&sums), 0x5a, sizeof sums);
  const double inner = in.one_in(2) ? in.number() : 0, outer = in.one_in(2) ? in.number() : slot.distance_limit;
  const std::int64_t size = in.mostly<std::int64_t>(sizeof sums);
  status = call(in, [&] {
    return band_sums_of(result.handle, inner, outer, n_given, mostly(in, values.data()), mostly(in, weights.data()),
                        mostly(in, &sums), size);
  });
  if (status != RIIS_OK)
    EXPECT(sums.n_nodes[0] == 0x5a5a5a5a5a5a5a5a, "refused sums were written");
  else
    EXPECT(sums.n_nodes[0] >= 0 && sums.n_nodes[1] >= 0 && sums.n_nodes[0] + sums.n_nodes[1] <= stats.n_within_limit,
           "%lld nodes", static_cast<long long>(sums.n_nodes[0]));
  spread_loads(in);
}

namespace {

void expect_opening(double opening, double rate) {
  EXPECT(opening >= 0 && opening <= 1 && !std::isnan(rate), "opening %g, rate %g", opening, rate);
}

void read_table(Input &in) {
  riis_opening_table table = initialised(in, riis_opening_table_init);
  const int n = 1 + in.below(6);
  std::vector<double> time(static_cast<std::size_t>(n)), opening(static_cast<std::size_t>(n));
  double last = in.sound_place();
  for (double &t : time) t = in.one_in(16) ? in.number() : last += 0.125 * (1 + in.below(4));
  for (double &o : opening) o = in.one_in(16) ? in.number() : in.below(9) / 8.0;
  table.n_keys = in.one_in(16) ? in.below(n + 1) - 1 : n;
  table.time = mostly(in, time.data());
  table.opening = mostly(in, opening.data());
  if (in.one_in(2)) table.period = in.number();
  table.interpolation = in.mostly(in.below(2));
  double got = -7, rate = -7;
  const double at = in.number();
  if (call(in, [&] { return riis_opening_from_table(mostly(in, &table), at, &got, mostly(in, &rate)); }) == RIIS_OK)
    expect_opening(got, rate);
  else
    EXPECT(got == -7 && rate == -7, "refused, but written");
}

void read_times(Input &in) {
  riis_opening_times times = initialised(in, riis_opening_times_init);
  times.opening_start = in.number();
  times.opening_duration = in.one_in(4) ? in.number() : 0.25;
  times.closing_start = in.one_in(4) ? in.number() : times.opening_start + 0.5;
  times.closing_duration = in.one_in(4) ? in.number() : 0.5;
  if (in.one_in(2)) times.period = in.number();
  if (in.one_in(4)) times.open = in.number();
  double got = -7, rate = -7;
  const double at = in.number();
  if (call(in, [&] { return riis_opening_from_times(&times, at, &got, &rate); }) == RIIS_OK) expect_opening(got, rate);
}

void advance_switch(Input &in) {
  riis_opening_switch law = initialised(in, riis_opening_switch_init);
  law.opening_duration = in.one_in(8) ? in.number() : 0.25;
  law.closing_duration = in.one_in(8) ? in.number() : 0.5;
  if (in.one_in(2)) law.filter_time = in.number();
  if (in.one_in(4)) law.dwell_time = in.number();
  riis_opening_switch_state state = initialised(in, riis_opening_switch_state_init);
  if (in.one_in(16)) state.progress = in.number();
  if (in.one_in(16)) state.phase = in.raw<std::int32_t>();
  double time = 0;
  for (int step = in.below(6); step >= 0; --step) {
    time += in.one_in(16) ? in.number() : 0.125;
    const double pressure = in.number(), flow = in.number();
    const riis_opening_switch_state before = state;
    if (call(in, [&] { return riis_opening_switch_advance(&law, &state, time, pressure, flow, &state); }) == RIIS_OK)
      expect_opening(state.opening, state.rate);
    else
      EXPECT(std::memcmp(&before, &state, sizeof state) == 0, "refused, but advanced");
  }
}

void advance_angle(Input &in) {
  riis_opening_angle law = initialised(in, riis_opening_angle_init);
  for (double *gain : {&law.pressure_gain, &law.flow_gain, &law.friction, &law.vortex_gain})
    *gain = in.one_in(32) ? in.number() : in.below(64);
  if (in.one_in(8)) law.angle_min = in.number();
  if (in.one_in(8)) law.angle_max = in.number();
  riis_opening_angle_state state = initialised(in, riis_opening_angle_state_init);
  if (in.one_in(8)) state.angle = in.number();
  if (in.one_in(8)) state.angle_rate = in.number();
  double time = 0;
  for (int step = in.below(4); step >= 0; --step) {
    time += in.one_in(32) ? in.number() : 0.0625;
    const double pressure = in.sound_place(), flow = in.sound_place();
    const riis_opening_angle_state before = state;
    if (call(in, [&] { return riis_opening_angle_advance(&law, &state, time, pressure, flow, &state); }) == RIIS_OK)
      expect_opening(state.opening, state.rate);
    else
      EXPECT(std::memcmp(&before, &state, sizeof state) == 0, "refused, but advanced");
  }
}

}  // namespace

void advance_laws(Input &in, State &) {
  switch (in.below(4)) {
    case 0:
      return read_table(in);
    case 1:
      return read_times(in);
    case 2:
      return advance_switch(in);
    default:
      return advance_angle(in);
  }
}

void move_by_keyframes(Input &in, State &state) {
  riis_surface *&slot = state.surfaces[in.slot()];
  const int n = 3 + in.below(4), n_keys = 1 + in.below(4), n_faces = 1 + in.below(4);
  riis_surface_arrays faces = initialised(in, riis_surface_arrays_init);
  riis_keyframe_arrays frames = initialised(in, riis_keyframe_arrays_init);
  std::vector<double> xyz(static_cast<std::size_t>(3 * n * n_keys)), time(static_cast<std::size_t>(n_keys));
  for (double &x : xyz) x = in.place();
  double last = in.sound_place();
  for (double &t : time) t = in.one_in(32) ? in.number() : last += 0.25;
  std::vector<std::int32_t> ids(static_cast<std::size_t>(3 * n_faces));
  for (std::int32_t &id : ids) id = in.one_in(64) ? in.raw<std::int32_t>() : in.byte() % n;
  faces.n_vertices = n;
  faces.n_faces = n_faces;
  faces.vertex_ids = mostly(in, static_cast<const void *>(ids.data()));
  frames.n_vertices = in.one_in(32) ? in.below(2) - 1 : n;
  frames.n_keys = in.one_in(32) ? in.below(n_keys + 1) - 1 : n_keys;
  frames.time = mostly(in, time.data());
  frames.xyz = mostly(in, xyz.data());
  if (in.one_in(4)) frames.period = in.number();
  frames.interpolation = in.mostly(in.below(2));
  riis_keyframes *keyframes = made_by<riis_keyframes>(
      in, [&](riis_keyframes **made) { return riis_keyframes_create(mostly(in, &faces), mostly(in, &frames), made); });
  if (!keyframes) return;
  const double now = in.number(), since = in.one_in(2) ? in.number() : now;
  const volatile double dt = now - since;  // raises floating-point exceptions here, outside of a checked call
  riis_surface_options options = initialised(in, riis_surface_options_init);
  options.zero_area = in.below(2);
  if (slot && in.one_in(2)) {
    static_cast<void>(call(in, [&] { return riis_surface_update_from_keyframes(slot, keyframes, now, dt, &options); }));
  } else if (riis_surface *made = made_by<riis_surface>(in, [&](riis_surface **surface) {
               return riis_surface_create_from_keyframes(keyframes, now, dt, &options, surface);
             })) {
    riis_surface_destroy(&slot);
    slot = made;
  }
  riis_keyframes_destroy(&keyframes);
  EXPECT(keyframes == nullptr, "destroyed keyframes are not NULL");
}

}  // namespace fuzz
