// SPDX-License-Identifier: Apache-2.0
#include "cli/mesh_marking.hpp"

#include "cli/progress.hpp"
#include "cli/refusal.hpp"
#include "cli/valve_source.hpp"
#include "cli/warnings.hpp"

namespace riis::cli {

MeshFile read_mesh(const Options &options, Seconds &seconds) {
  const Stage stage("reading " + options.mesh, options.quiet);
  riis_vtk_mesh *mesh = nullptr;
  check_mesh_read(riis_vtk_mesh_read(options.mesh.c_str(), &mesh), options.mesh);
  seconds.read += stage.seconds();
  return MeshFile(mesh);
}

Mesh borrow_nodes(const riis_vtk_mesh *file, const std::string &path) {
  int64_t n_nodes = 0;
  const double *xyz = nullptr;
  check(riis_vtk_mesh_nodes(file, &n_nodes, nullptr, &xyz));
  riis_mesh *mesh = nullptr;
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh), path);
  return Mesh(mesh);
}

MarkResult new_result() {
  riis_mark_result *result = nullptr;
  check(riis_mark_result_create(&result));
  return MarkResult(result);
}

bool needs_adjacency(int32_t search) { return search == RIIS_SEARCH_NEIGHBOR || search == RIIS_SEARCH_PAPER; }

void rehearse_marking(const Options &options, const riis_surface *surface) {
  const double origin[3] = {0, 0, 0};
  riis_mesh *mesh_handle = nullptr;
  check(riis_mesh_create(1, origin, origin + 1, origin + 2, 3, &mesh_handle));
  const Mesh mesh(mesh_handle);
  const MarkResult result = new_result();
  riis_mark_options mark_options = options.mark_options;
  if (needs_adjacency(mark_options.search)) mark_options.search = RIIS_SEARCH_EXHAUSTIVE;
  check(riis_mark_nodes(surface, mesh.get(), &mark_options, result.get()));
  check(riis_mark_result_dense(result.get(), 1, options.far_distance, nullptr, nullptr, nullptr, nullptr));
  ResistanceSum(1, ResistanceSum::Momentum::no).add(options, result.get());
}

void warn_of_incomplete_marks() {
  warn(
      "the marks may be incomplete: --search paper misses nodes that are not connected to its one start; --search "
      "neighbor finds them");
}

void check_new_arrays(const Options &options, const std::vector<std::string> &names, const riis_vtk_mesh *mesh) {
  if (options.output.empty() || options.replace) return;
  for (const std::string &name : names) {
    int32_t has = 0;
    check(riis_vtk_mesh_has_point_array(mesh, name.c_str(), &has));
    if (!has) continue;
    throw Refusal{exit_wrong_usage, options.mesh + " already has an array " + name +
                                        ": write --replace to replace it, or --prefix NAME for other arrays beside it"};
  }
}

std::vector<std::string> names_of_marks(const std::string &prefix, int32_t fields) {
  std::vector<std::string> names = {prefix + "_marked", prefix + "_distance", prefix + "_leaflet"};
  if (fields & RIIS_FIELD_NORMAL) names.push_back(prefix + "_normal");
  if (fields & RIIS_FIELD_SIDE) names.push_back(prefix + "_side");
  if (fields & RIIS_FIELD_VELOCITY) names.push_back(prefix + "_velocity");
  return names;
}

void set_marks(const Options &options, const riis_mark_result *result, int32_t fields, riis_vtk_mesh *file) {
  check(riis_vtk_mesh_set_named_marks(file, result, options.far_distance, options.prefix.c_str()));
  check(riis_vtk_mesh_set_fields(file, result, fields, options.prefix.c_str()));
}

ResistanceSum::ResistanceSum(int64_t n_nodes, Momentum momentum)
    : n_nodes_(n_nodes),
      coefficient_(static_cast<std::size_t>(n_nodes), 0.0),
      momentum_(momentum == Momentum::yes ? 3 * static_cast<std::size_t>(n_nodes) : 0, 0.0) {}

void ResistanceSum::add(const Options &options, const riis_mark_result *result) {
  if (!options.resistance) return;
  has_any_ = true;
  riis_resistance how;
  check(riis_resistance_init(&how, sizeof how));
  how.resistance = *options.resistance;
  check(riis_mark_result_add_resistance(result, &how, n_nodes_, coefficient_.data(),
                                        momentum_.empty() ? nullptr : momentum_.data()),
        "--resistance");
}

void ResistanceSum::set_arrays(const std::string &prefix, riis_vtk_mesh *file) const {
  if (!has_any_) return;
  const std::string resistance = prefix + "_resistance", momentum = prefix + "_momentum";
  check(riis_vtk_mesh_set_point_array(file, resistance.c_str(), n_nodes_, 1, coefficient_.data()));
  if (!momentum_.empty()) check(riis_vtk_mesh_set_point_array(file, momentum.c_str(), n_nodes_, 3, momentum_.data()));
}

}  // namespace riis::cli
