// SPDX-License-Identifier: Apache-2.0
// riis_find_crossings and its pairs: argument checks around the search (surface/crossings.hpp).
#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/array_view.hpp"
#include "base/errors.hpp"
#include "base/ranges.hpp"
#include "parallel/parallel_for.hpp"
#include "surface/crossings.hpp"

using riis::guarded;
using riis::require;
using riis::require_handle;

namespace {

// The structs' sizes in the first release.
constexpr std::int64_t options_size = 24, crossings_size = 80;

const riis_crossing_options default_options{sizeof(riis_crossing_options), 1e-6, 0, 0};

riis_crossing_options checked(const riis_crossing_options *options) {
  const riis_crossing_options whole = riis::completed<options_size>(options, "options", default_options);
  riis::check_range("options", "depth", whole.depth, 0, 1);
  riis::check_threads(whole.n_threads, "options.n_threads");
  return whole;
}

// The seconds stay 0.
riis_crossings summary_of(const riis::TriangleSet &set, const riis::Crossings &pairs) {
  riis_crossings summary{riis::view(pairs.depth).size(), 0, 0, {0, 0, 0}, {-1, -1}, {-1, -1}, 0};
  if (summary.n_pairs == 0) return summary;
  const auto deepest = std::max_element(pairs.depth.begin(), pairs.depth.end()) - pairs.depth.begin();
  summary.length = std::accumulate(pairs.length.begin(), pairs.length.end(), 0.0);
  summary.depth = riis::view(pairs.depth)[deepest];
  std::copy_n(pairs.point.begin() + 3 * deepest, 3, summary.point);
  std::copy_n(pairs.triangle_id.begin() + 2 * deepest, 2, summary.triangle_id);
  for (int i = 0; i < 2; ++i)
    summary.leaflet_id[i] = riis::view(set.leaflet_id)[riis::view(pairs.triangle)[2 * deepest + i]];
  return summary;
}

}  // namespace

extern "C" {

riis_status riis_crossing_options_init(riis_crossing_options *options, int64_t struct_size) {
  return guarded([&] { riis::init_struct<options_size>(options, struct_size, "options", default_options); });
}

riis_status riis_find_crossings(riis_surface *surface, const riis_crossing_options *options, riis_crossings *crossings,
                                int64_t struct_size) {
  return guarded([&] {
    const riis::Surface &content = riis::content_of(surface);
    const riis_crossing_options whole = checked(options);
    require(crossings, "crossings");
    riis::check_struct_size<crossings_size, riis_crossings>(struct_size, "crossings");
    const auto start = std::chrono::steady_clock::now();
    const int n_threads = riis::threads_for(whole.n_threads, "options.n_threads", content.triangles().n_triangles(),
                                            riis::triangles_per_thread);
    riis::Crossings found = riis::find_crossings(content.triangles(), content.scene().groups(),
                                                 whole.depth * content.half_thickness(), n_threads);
    riis_crossings summary = summary_of(content.triangles(), found);
    surface->crossings = std::move(found);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    summary.seconds = elapsed.count();
    riis::write_struct<crossings_size>(crossings, struct_size, "crossings", summary);
  });
}

riis_status riis_surface_crossing_pairs(const riis_surface *surface, int64_t *n_pairs, const int64_t **triangle_id,
                                        const double **point, const double **depth, const double **length) {
  return guarded([&] {
    const riis::Crossings &pairs = require_handle(surface, "surface")->crossings;
    const bool empty = pairs.depth.empty();
    riis::put(n_pairs, riis::view(pairs.depth).size());
    riis::put(triangle_id, empty ? nullptr : pairs.triangle_id.data());
    riis::put(point, empty ? nullptr : pairs.point.data());
    riis::put(depth, empty ? nullptr : pairs.depth.data());
    riis::put(length, empty ? nullptr : pairs.length.data());
  });
}
}
