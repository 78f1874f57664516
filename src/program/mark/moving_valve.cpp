// SPDX-License-Identifier: Apache-2.0
#include "program/mark/moving_valve.hpp"

#include <algorithm>
#include <string>

#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "program/base/refusal.hpp"
#include "program/mark/crossings.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {

Marks new_result() { return create<Marks>(riis_marks_create); }

Marks marks_of(const riis_surface *surface, riis_mesh *mesh, const riis_mark_options &how) {
  Marks marks = new_result();
  check(riis_mark_nodes(surface, mesh, &how, marks));
  return marks;
}

riis_mark_options how_to_mark_again(const MarkOptions &options, double limit) {
  riis_mark_options how = options.mark_options;
  how.search = RIIS_SEARCH_AUTO;
  how.distance_limit = limit;
  return how;
}

bool needs_adjacency(int32_t search) { return search == RIIS_SEARCH_NEIGHBOR || search == RIIS_SEARCH_PAPER; }

void add_resistance(const MarkOptions &options, const riis_marks *result, std::vector<double> &K,
                    std::vector<double> &K_u_surface) {
  auto how = defaults<riis_resistance>();
  how.R = *options.resistance * options.K_factor;
  auto to = defaults<riis_resistance_arrays>();
  to.n_nodes = view(K).size();
  to.K = K.data();
  for (int c = 0; c < 3 && !K_u_surface.empty(); ++c) to.K_u_surface[c] = K_u_surface.data() + c;
  to.K_u_surface_stride = 3;
  check(riis_marks_add_resistance(result, &how, &to), "--resistance");
}

namespace {

// Marks a single node. The library therefore refuses bad options before a large mesh is read and marked.
void rehearse_marking(const MarkOptions &options, const riis_surface *surface) {
  const double origin[3] = {0, 0, 0};
  const auto mesh = create<Mesh>(riis_mesh_create, 1, origin, origin + 1, origin + 2, 3);
  riis_mark_options mark_options = options.mark_options;
  if (needs_adjacency(mark_options.search)) mark_options.search = RIIS_SEARCH_EXHAUSTIVE;
  const Marks result = marks_of(surface, mesh, mark_options);
  auto dense = defaults<riis_dense_arrays>();
  dense.n_nodes = 1;
  dense.far_distance = options.far_distance;
  check(riis_marks_get_dense(result, &dense));
  std::vector<double> K(1), none;
  if (options.resistance) add_resistance(options, result, K, none);
}

}  // namespace

MovingValve::MovingValve(ValveSource &source, double time, bool moves) : source_(source), result_(new_result()) {
  is_at_rest_ = !moves || (!source.keyframes && (!source.valve || (source.law.is_constant() && !source.warp.moves())));
  if (source.keyframes) source.options.time = time;
  if (source.valve) {
    if (moves) before_ = copy_of(source.valve);
    opening_ = source.law.at(time);
    set_time(time, source.valve);
  }
  has_velocities_ = source.file != nullptr;
  surface_ = make_surface(source, moves ? FileVelocity::zero : FileVelocity::none);
  source.file.reset();
  if (!moves) source.keyframes.reset();
}

std::optional<double> MovingValve::opening() const { return source_.valve ? std::optional(opening_) : std::nullopt; }

void MovingValve::set_time(double time, riis_valve *valve) {
  check(riis_valve_set_scalar(valve, "opening", source_.law.at(time)), subject());
  if (source_.warp.moves()) source_.warp.apply(time, valve);
}

void MovingValve::move_to(double time, std::optional<double> since) {
  if (is_at_rest_ && (!since || has_velocities_)) return;
  if (source_.keyframes) {
    check(riis_surface_update_from_keyframes(surface_, source_.keyframes, time, time - since.value_or(time), nullptr),
          options().surface);
    return;
  }
  if (since) set_time(*since, before_);
  set_time(time, source_.valve);
  opening_ = source_.law.at(time);
  check(since ? riis_surface_update_moving(surface_, source_.valve, before_, time - *since, nullptr, nullptr)
              : riis_surface_update(surface_, source_.valve, nullptr),
        subject());
  has_velocities_ = since.has_value();
}

void MovingValve::mark(FileNodes &nodes, int32_t fields) {
  riis_mark_options how = options().mark_options;
  how.fields = fields;
  if (needs_adjacency(how.search)) nodes.find_neighbors(how.n_threads);
  check(riis_mark_nodes(surface_, nodes.mesh(), &how, result_), options().mesh);
}

double MovingValve::largest_speed() const {
  const riis_triangles triangles = triangles_of(surface_);
  const double *velocity = triangles.velocity;
  double largest = 0;
  for (int64_t i = 0; velocity && i < triangles.n_vertices; ++i)
    largest = std::max(largest, hypotenuse(velocity[3 * i], velocity[3 * i + 1], velocity[3 * i + 2]));
  return largest;
}

std::vector<MovingValve> moving_valves(Case &all) {
  std::vector<MovingValve> valves;
  valves.reserve(all.valves.size());
  for (ValveSource &source : all.valves) {
    try {
      valves.emplace_back(source, all.times()[0], all.is_series());
      MovingValve &made = valves.back();
      const std::string part = all.part_of(valves.size() - 1);
      if (all.options.check_crossing)
        made.crossings = look_for_crossings(source.options, source.valve, made.surface(), part);
      else if (source.valve)
        made.crossings = check_shape(source.options, source.valve, source.has_open_state, part);
      if (!all.options.mesh.empty())
        rehearse_marking(source.options, made.surface());
      else if (auto warning = warning_of_thickness(source.options, info_of(made.surface())))
        warn(all.before(valves.size() - 1) + warning->text + warning->advice);
    } catch (Refusal &refusal) {
      if (!source.subject.empty() && refusal.text.rfind(source.subject, 0) != 0)
        refusal = {exit_bad_data, source.subject + ": " + refusal.text};
      throw;
    }
  }
  return valves;
}

// ---- Joined surface ----

void add_triangles(Triangles &all, const riis_triangles &more) {
  const int64_t before = view(all.points).size();
  for (const double *xyz = more.xyz; xyz != more.xyz + 3 * more.n_vertices; xyz += 3)
    all.points.push_back({xyz[0], xyz[1], xyz[2]});
  for (const int64_t *id = more.vertex_id; id != more.vertex_id + 3 * more.n_triangles; id += 3)
    all.corners.push_back({before + id[0], before + id[1], before + id[2]});
}

Surface joined_surface(const std::vector<const riis_surface *> &surfaces, const riis_surface_options &how,
                       double skirt_length) {
  Triangles joined;
  std::vector<std::int32_t> leaflets;
  std::int64_t first = 0;
  for (const riis_surface *const surface : surfaces) {
    const riis_triangles triangles = triangles_of(surface);
    add_triangles(joined, triangles);
    for (int64_t i = 0; i < triangles.n_triangles; ++i)
      leaflets.push_back(static_cast<std::int32_t>(first + triangles.leaflet_id[i]));
    first += info_of(surface).largest_leaflet_id + 1;
  }
  riis_surface_arrays arrays = arrays_of(joined);
  arrays.leaflet_id = leaflets.data();
  arrays.skirt_length = skirt_length;
  return create<Surface>(riis_surface_create_from_arrays, &arrays, &how);
}

riis_surface_options with_band_of(const riis_surface *surface) {
  auto how = defaults<riis_surface_options>();
  how.half_thickness = info_of(surface).half_thickness;
  how.offset = info_of(surface).offset;
  return how;
}

std::vector<const riis_surface *> surfaces_of(const std::vector<MovingValve> &valves) {
  std::vector<const riis_surface *> surfaces;
  for (const MovingValve &valve : valves) surfaces.push_back(valve.surface());
  return surfaces;
}

}  // namespace riis::program
