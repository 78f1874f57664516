// SPDX-License-Identifier: Apache-2.0
#include "cli/run.hpp"

#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "base/array_view.hpp"
#include "cli/conversion.hpp"
#include "cli/handles.hpp"
#include "cli/interruption.hpp"
#include "cli/leaks.hpp"
#include "cli/motion.hpp"
#include "cli/outputs.hpp"
#include "cli/parameters.hpp"
#include "cli/progress.hpp"
#include "cli/refusal.hpp"
#include "cli/report.hpp"
#include "cli/steps.hpp"
#include "cli/valve_file.hpp"
#include "cli/warnings.hpp"

namespace riis::cli {
namespace {

Valve make_kind(const std::string &kind) {
  riis_valve *handle = nullptr;
  const riis_status status = riis_valve_create(kind.c_str(), &handle);
  if (status == RIIS_INVALID_PARAMETER) {
    throw Refusal{exit_bad_data, std::string("--valve: ") + riis_last_error() + ", and files of patches, FILE.json"};
  }
  check(status);
  return Valve(handle);
}

void set_parameters(const Options &options, riis_valve *valve) {
  if (!options.params.empty()) set_from_json_file(valve, options.params);
  for (const std::string &setting : options.settings) set_from_text(valve, setting);
  if (options.opening) check(riis_valve_set_scalar(valve, "opening", *options.opening), "--opening");
}

double opening_of(const riis_valve *valve) {
  double opening = 0;
  check(riis_valve_get(valve, "opening", 1, &opening));
  return opening;
}

Valve make_valve_of_kind(const Options &options) {
  Valve valve = make_kind(options.valve);
  set_parameters(options, valve.get());
  if (!options.params_open.empty()) {
    const Valve open = make_kind(options.valve);
    set_from_json_file(open.get(), options.params_open);
    check(riis_valve_set_open_state(valve.get(), open.get()), options.params_open);
  }
  return valve;
}

Valve make_valve_of_file(const Options &options) {
  const Stage stage("reading " + options.valve, options.quiet);
  ValveFile file(options.valve);
  set_parameters(options, file.valve());
  if (!options.print_params && !options.describe_params) file.check_opening();
  return file.take_valve();
}

Valve make_valve(const Options &options) {
  return is_valve_file(options.valve) ? make_valve_of_file(options) : make_valve_of_kind(options);
}

Surface surface_of_valve(const Options &options, const riis_valve *valve) {
  const Stage stage("making the surface", options.quiet);
  riis_surface *surface = nullptr;
  check(riis_surface_create(valve, &options.surface_options, &surface),
        is_valve_file(options.valve) ? options.valve : "");
  return Surface(surface);
}

// Adds to the component's refusal of a file the command that makes a readable one.
void check_read(riis_status status, const std::string &path, Content content) {
  try {
    check(status);
  } catch (Refusal &refusal) {
    if (status == RIIS_FILE_ERROR) refusal.text += conversion_hint(path, content);
    throw;
  }
}

SurfaceFile read_surface(const Options &options) {
  const char *path = options.surface.c_str();
  const bool by_pieces = options.leaflets == "connected";
  riis_vtk_surface *handle = nullptr;
  const riis_status status = options.leaflets.empty() || by_pieces
                                 ? riis_vtk_surface_read(path, &handle)
                                 : riis_vtk_surface_read_with_leaflets(path, options.leaflets.c_str(), &handle);
  check_read(status, options.surface, Content::surface);
  SurfaceFile file(handle);
  if (by_pieces) check(riis_vtk_surface_number_pieces(file.get()));
  return file;
}

int64_t count_leaflets(const riis_surface *surface) {
  int64_t n = 0;
  const int32_t *leaflet_id = nullptr;
  check(riis_surface_triangles(surface, &n, nullptr, nullptr, &leaflet_id, nullptr));
  return static_cast<int64_t>(std::set<int32_t>(leaflet_id, leaflet_id + n).size());
}

Surface surface_of_file(const Options &options, Seconds &seconds) {
  if (options.time) {
    MovedSurface moved = surface_of_motion(options);
    seconds.read += moved.seconds;
    return std::move(moved.surface);
  }
  const Stage stage("reading " + options.surface, options.quiet);
  const SurfaceFile file = read_surface(options);
  seconds.read += stage.seconds();
  riis_surface_arrays arrays;
  check(riis_surface_arrays_init(&arrays, sizeof arrays));
  check(riis_vtk_surface_arrays(file.get(), &arrays));
  riis_surface *surface = nullptr;
  check(riis_surface_create_from_arrays(&arrays, &options.surface_options, &surface), options.surface);
  return Surface(surface);
}

bool needs_adjacency(int32_t search) { return search == RIIS_SEARCH_NEIGHBOR || search == RIIS_SEARCH_PAPER; }

// Computes K of every node for --resistance.
std::vector<double> resistance_of(const Options &options, const riis_mark_result *result, int64_t n_nodes) {
  riis_resistance how;
  check(riis_resistance_init(&how, sizeof how));
  how.resistance = *options.resistance;
  std::vector<double> coefficient(static_cast<std::size_t>(n_nodes), 0.0);
  check(riis_mark_result_add_resistance(result, &how, n_nodes, coefficient.data(), nullptr), "--resistance");
  return coefficient;
}

// Marks a single node, so that the library refuses bad options before a large mesh is read and marked.
void rehearse_marking(const Options &options, const riis_surface *surface) {
  const double origin[3] = {0, 0, 0};
  riis_mesh *mesh_handle = nullptr;
  check(riis_mesh_create(1, origin, origin + 1, origin + 2, 3, &mesh_handle));
  const Mesh mesh(mesh_handle);
  riis_mark_result *result_handle = nullptr;
  check(riis_mark_result_create(&result_handle));
  const MarkResult result(result_handle);
  riis_mark_options mark_options = options.mark_options;
  if (needs_adjacency(mark_options.search)) mark_options.search = RIIS_SEARCH_EXHAUSTIVE;
  check(riis_mark_nodes(surface, mesh.get(), &mark_options, result.get()));
  check(riis_mark_result_dense(result.get(), 1, options.far_distance, nullptr, nullptr, nullptr, nullptr));
  if (options.resistance) resistance_of(options, result.get(), 1);
}

MeshFile read_mesh(const Options &options, Seconds &seconds) {
  const Stage stage("reading " + options.mesh, options.quiet);
  riis_vtk_mesh *mesh = nullptr;
  check_read(riis_vtk_mesh_read(options.mesh.c_str(), &mesh), options.mesh, Content::mesh);
  seconds.read += stage.seconds();
  return MeshFile(mesh);
}

Mesh borrow_nodes(const Options &options, const riis_vtk_mesh *file, Report &report) {
  const Stage stage("checking the nodes", options.quiet);
  int64_t n_nodes = 0;
  const double *xyz = nullptr;
  check(riis_vtk_mesh_nodes(file, &n_nodes, &report.n_cells, &xyz));
  riis_mesh *mesh = nullptr;
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh), options.mesh);
  report.seconds.mesh = stage.seconds();
  return Mesh(mesh);
}

// The mesh borrows the adjacency.
Adjacency give_adjacency(const Options &options, const riis_vtk_mesh *file, riis_mesh *mesh, Report &report) {
  const Stage stage("finding the nodes' neighbours", options.quiet);
  riis_adjacency *handle = nullptr;
  check(riis_vtk_mesh_adjacency(file, options.mark_options.n_threads, &handle), options.mesh);
  Adjacency adjacency(handle);
  riis_csr rows;
  check(riis_adjacency_csr(adjacency.get(), &rows, sizeof rows));
  check(riis_mesh_set_adjacency(mesh, &rows), options.mesh);
  report.seconds.adjacency = stage.seconds();
  return adjacency;
}

// Not even --quiet silences this: some marks may be missing.
void warn_of_incomplete_marks() {
  std::fputs(
      "riis-mark: the marks may be incomplete: --search paper misses nodes that are not connected to its one start; "
      "--search neighbor finds them\n",
      stderr);
}

// The program replaces no array of the user's by chance.
void check_new_arrays(const Options &options, const riis_vtk_mesh *mesh) {
  if (options.output.empty() || options.replace) return;
  std::vector<const char *> arrays = {"_marked", "_distance", "_leaflet"};
  if (options.resistance) arrays.push_back("_resistance");
  for (const char *what : arrays) {
    int32_t has = 0;
    check(riis_vtk_mesh_has_point_array(mesh, (options.prefix + what).c_str(), &has));
    if (!has) continue;
    throw Refusal{exit_wrong_usage, options.mesh + " already has an array " + options.prefix + what +
                                        ": write --replace to replace it, or --prefix NAME for other arrays beside it"};
  }
}

// Gives the mesh an array with K of every node.
void set_resistance(const Options &options, const riis_mark_result *result, riis_vtk_mesh *file, int64_t n_nodes) {
  if (!options.resistance) return;
  const std::vector<double> coefficient = resistance_of(options, result, n_nodes);
  check(riis_vtk_mesh_set_point_array(file, (options.prefix + "_resistance").c_str(), n_nodes, 1, coefficient.data()));
}

// Returns the marks, because pictures may need them under other names than the output.
MarkResult mark(const Options &options, const riis_surface *surface, const riis_valve *valve, riis_vtk_mesh *file,
                Report &report) {
  Adjacency adjacency;  // outlives the mesh, which borrows it
  const Mesh mesh = borrow_nodes(options, file, report);
  if (needs_adjacency(options.mark_options.search)) adjacency = give_adjacency(options, file, mesh.get(), report);
  riis_mark_result *handle = nullptr;
  check(riis_mark_result_create(&handle));
  MarkResult result(handle);
  {
    const Stage stage("marking", options.quiet);
    check(riis_mark_nodes(surface, mesh.get(), &options.mark_options, result.get()), options.mesh);
    report.seconds.search = stage.seconds();
  }
  check(riis_mark_result_stats(result.get(), &report.marks, sizeof report.marks));
  check(riis_vtk_mesh_set_named_marks(file, result.get(), options.far_distance, options.prefix.c_str()));
  set_resistance(options, result.get(), file, report.marks.n_nodes);
  if (!report.marks.complete) warn_of_incomplete_marks();
  const std::string warning = warning_of(situation_of(options, report.surface, report.marks, file));
  if (!warning.empty()) warn(warning);
  const double limit = options.mark_options.distance_limit;
  report.distance_limit = limit > 0 ? limit : report.surface.half_thickness;
  report.distance = options.surface_options.distance;
  report.mesh_name = options.mesh;
  look_for_leaks(options, {surface, valve, file, mesh.get(), result.get()}, report);
  return result;
}

void write_files(const Options &options, const riis_surface *surface, const riis_vtk_mesh *mesh, Report &report) {
  const Stage stage("writing", options.quiet);
  if (!options.surface_output.empty()) {
    const UnbrokenWrite unbroken;
    check(riis_vtk_surface_write(surface, options.surface_output.c_str()));
    report.written.push_back(options.surface_output);
  }
  if (!options.output.empty()) {
    const UnbrokenWrite unbroken;
    check(riis_vtk_mesh_write(mesh, options.output.c_str()));
    report.written.push_back(options.output);
  }
  report.seconds.write = stage.seconds();
}

std::vector<const char *> leaflet_names(const Options &options) {
  if (!options.surface.empty()) return {};
  if (options.valve == "aortic") return {"right", "left", "non-coronary"};
  if (options.valve == "mitral") return {"anterior", "posterior"};
  return {};
}

// Says whether the valve is the paper's aortic valve, which nobody should take for a closed one (docs/meshes.md).
bool is_papers_aortic_valve(const Options &options, const riis_valve *valve) {
  if (!valve || options.valve != "aortic") return false;
  int64_t n_parameters = 0;
  check(riis_valve_n_parameters(valve, &n_parameters));
  for (int64_t i = 0; i < n_parameters; ++i) {
    riis_parameter parameter;
    double values[3] = {0, 0, 0};
    check(riis_valve_parameter(valve, i, &parameter, sizeof parameter));
    check(riis_valve_get(valve, parameter.name, parameter.n_values, values));
    if (!std::equal(values, values + 3, parameter.default_values)) return false;
  }
  return true;
}

// A file has its name without folders as title. A kind of valve has its name with a capital, like the other captions.
std::string picture_title(const Options &options, const riis_valve *valve, const Report &report) {
  std::string title = surface_title(report);
  title.erase(0, report.surface_name.rfind('/') + 1);
  if (report.opening && !is_valve_file(report.surface_name)) title[0] = static_cast<char>(title[0] - 'a' + 'A');
  if (is_papers_aortic_valve(options, valve)) title += " (the paper's, not closed)";
  return title;
}

// Leaking edges are drawn red. A picture of a mesh without leaks says so if the edges of all cells are known.
void show_leaks(const riis_mark_result *result, const LeakReport &leaks, riis_vtk_picture_options &how) {
  static constexpr int64_t none = 0;
  check(riis_mark_result_leaking_edges(result, &how.n_leaking_edges, &how.leaking_edges, nullptr, nullptr));
  if (how.n_leaking_edges == 0 && leaks.n_cells_left_out == 0) how.leaking_edges = &none;
}

void draw_pictures(const Options &options, const riis_valve *valve, const riis_surface *surface,
                   const riis_vtk_mesh *mesh, const riis_mark_result *result, Report &report) {
  const std::string title = picture_title(options, valve, report);
  const std::vector<const char *> names = leaflet_names(options);
  std::vector<int32_t> views;
  std::vector<const char *> paths;
  for (const Picture &picture : options.pictures) {
    views.push_back(picture.view);
    paths.push_back(picture.path.c_str());
  }
  const auto n_pictures = view(paths).size();
  if (n_pictures == 0) return;
  const Stage stage("drawing " + options.pictures[0].path + (n_pictures > 1 ? ", ..." : ""), options.quiet);
  const UnbrokenWrite unbroken;
  riis_vtk_picture_options how;
  check(riis_vtk_picture_options_init(&how, sizeof how));
  how.title = title.c_str();
  how.leaflet_names = names.data();
  how.n_leaflet_names = view(names).size();
  if (result) show_leaks(result, report.leaks, how);
  check(riis_vtk_draw_views(surface, mesh, &how, n_pictures, views.data(), paths.data()));
  report.written.insert(report.written.end(), paths.begin(), paths.end());
  report.seconds.picture = stage.seconds();
}

void write_stats(const Options &options, const Report &report) {
  if (!options.stats.empty()) write_text(options.stats, json_of(report));
}

void print_table(const Options &options, const Report &report) {
  if (!options.quiet && options.stats != "-") write_text("-", table_of(report));
}

}  // namespace

ExitCode run(const Options &options) {
  const Valve valve = options.surface.empty() ? make_valve(options) : nullptr;
  if (options.print_params || options.describe_params) {
    write_text("-", options.print_params ? json_template(valve.get()) + "\n" : parameter_table(valve.get()));
    return exit_fine;
  }
  check_outputs(options);
  Report report;
  const Surface surface = valve ? surface_of_valve(options, valve.get()) : surface_of_file(options, report.seconds);
  check(riis_surface_get_info(surface.get(), &report.surface, sizeof report.surface));
  report.surface_name = valve ? options.valve : options.surface;
  if (valve) report.opening = opening_of(valve.get());
  report.time = options.time;
  if (!options.leaflets.empty()) report.n_leaflets = count_leaflets(surface.get());
  report.seconds.surface = report.surface.seconds_triangles;
  report.seconds.scene = report.surface.seconds_scene;
  if (!options.mesh.empty()) rehearse_marking(options, surface.get());
  const MeshFile mesh = options.mesh.empty() ? nullptr : read_mesh(options, report.seconds);
  if (mesh) check_new_arrays(options, mesh.get());
  const MarkResult result = mesh ? mark(options, surface.get(), valve.get(), mesh.get(), report) : nullptr;
  if (options.n_steps > 0) report.step = time_steps(options, valve.get(), mesh.get());
  write_files(options, surface.get(), mesh.get(), report);
  try {
    // The component draws the marks under these names. The file with the other names is written by now.
    if (result && !options.pictures.empty())
      check(riis_vtk_mesh_set_marks(mesh.get(), result.get(), options.far_distance));
    draw_pictures(options, valve.get(), surface.get(), mesh.get(), result.get(), report);
  } catch (const Refusal &) {
    // The marks are still good.
    write_stats(options, report);
    throw;
  }
  write_stats(options, report);
  print_table(options, report);
  return result && report.marks.n_marked == 0 && !options.allow_none ? exit_none_marked : exit_fine;
}

}  // namespace riis::cli
