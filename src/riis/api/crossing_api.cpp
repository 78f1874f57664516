// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_find_crossings and riis_crossings_*. The search is in measures/measures.hpp.
#include <algorithm>
#include <chrono>
#include <numeric>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "measures/measures.hpp"
#include "parallel/parallel_for.hpp"

using riis::guarded_with_handles;
using riis::require_handle;

namespace {

const riis_crossing_options default_crossing_options{sizeof(riis_crossing_options), 1e-6, 0, 0};

riis_crossing_options checked(const riis_crossing_options *options) {
  const riis_crossing_options whole = riis::completed(options, "options", default_crossing_options);
  riis::check_range("options", "depth", whole.depth, 0, 1);
  riis::check_threads(whole.n_threads, "options.n_threads");
  riis::check_reserved("options.reserved", whole.reserved);
  return whole;
}

// Returns the list of the pairs. The field `seconds` of the list is 0 until the caller of this function sets it.
riis_crossing_list list_of(const riis::TriangleSet &set, const riis::Crossings &pairs) {
  const auto n = riis::view(pairs.depth).size();
  riis_crossing_list list{n, nullptr, nullptr, nullptr, nullptr, 0, 0, {0, 0, 0}, {-1, -1}, {-1, -1}, 0};
  if (n == 0) return list;
  list.triangle_id = pairs.triangle_id.data();
  list.point = pairs.point.data();
  list.depth = pairs.depth.data();
  list.length = pairs.length.data();
  const auto deepest = std::max_element(pairs.depth.begin(), pairs.depth.end()) - pairs.depth.begin();
  list.total_length = std::accumulate(pairs.length.begin(), pairs.length.end(), 0.0);
  list.deepest_depth = riis::view(pairs.depth)[deepest];
  std::copy_n(pairs.point.begin() + 3 * deepest, 3, list.deepest_point);
  std::copy_n(pairs.triangle_id.begin() + 2 * deepest, 2, list.deepest_triangle_id);
  for (int i = 0; i < 2; ++i)
    list.deepest_leaflet_id[i] = riis::view(set.leaflet_id)[riis::view(pairs.triangle)[2 * deepest + i]];
  return list;
}

}  // namespace

extern "C" {

RIIS_DEFINE_INIT(riis_crossing_options_init, riis_crossing_options, options, default_crossing_options)

riis_status riis_crossings_create(riis_crossings **crossings) { return riis::create_handle(crossings, "crossings"); }

void riis_crossings_destroy(riis_crossings **crossings) { riis::destroy_handle(crossings, "crossings"); }

riis_status riis_find_crossings(const riis_surface *surface, const riis_crossing_options *options,
                                riis_crossings *crossings) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    const riis_crossing_options whole = checked(options);
    require_handle(crossings, "crossings");
    const auto start = std::chrono::steady_clock::now();
    const int n_threads = riis::threads_for(whole.n_threads, "options.n_threads", content.triangles().n_triangles(),
                                            riis::triangles_per_thread);
    crossings->pairs = riis::find_crossings(content.triangles(), content.scene().groups(),
                                            whole.depth * content.half_thickness(), n_threads);
    crossings->list = list_of(content.triangles(), crossings->pairs);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    crossings->list.seconds = elapsed.count();
  });
}

riis_status riis_crossings_get_list(const riis_crossings *crossings, riis_crossing_list *list, int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis_crossing_list &found = require_handle(crossings, "crossings")->list;
    riis::write_struct(list, struct_size, "list", found);
  });
}
}
