// SPDX-License-Identifier: Apache-2.0
#include "program/run.hpp"

#include <string>
#include <vector>

#include "program/case.hpp"
#include "program/case_file.hpp"
#include "program/crossings.hpp"
#include "program/handles.hpp"
#include "program/leaks.hpp"
#include "program/marking_in_pieces.hpp"
#include "program/mesh_marking.hpp"
#include "program/mesh_reading.hpp"
#include "program/outputs.hpp"
#include "program/parameters.hpp"
#include "program/pictures.hpp"
#include "program/place.hpp"
#include "program/progress.hpp"
#include "program/ranks.hpp"
#include "program/refusal.hpp"
#include "program/report.hpp"
#include "program/size_field.hpp"
#include "program/states.hpp"
#include "program/uris_export.hpp"
#include "program/valve_source.hpp"
#include "program/warnings.hpp"

namespace riis::program {
namespace {

std::vector<std::string> names_of_arrays(const MarkOptions &options) {
  std::vector<std::string> names = names_of_marks(options.prefix, 0);
  if (options.resistance) names.push_back(options.prefix + "_K");
  return names;
}

// Marks the mesh and sets its arrays. Returns the marks, because pictures may need them under other names than in the output.
Marks mark(const MarkOptions &options, const riis_surface *surface, const riis_valve *valve, riis_vtk_mesh *file,
           Report &report) {
  check(riis_vtk_mesh_get_nodes(file, nullptr, &report.n_cells, nullptr));
  MarkedFile marked = mark_file(options, surface, file, report.seconds);
  riis_mesh *const mesh = marked.mesh.get();
  const Marks &result = marked.marks;
  report.marks = marked.stats;
  if (!report.marks.complete) warn_of_incomplete_marks();
  if (const auto warning = warning_of(situation_of(options, report.surface, report.marks, file))) warn({*warning});
  const double limit = options.mark_options.distance_limit;
  report.distance_limit = limit > 0 ? limit : report.surface.half_thickness;
  report.distance = options.surface_options.measure;
  report.mesh_name = options.mesh;
  look_for_leaks(options, {surface, valve, file, mesh, result.get(), "the surface"}, report);
  measure_flow(options, {surface, valve, file, mesh, result.get(), "the surface"}, report);
  check_passage(options, {surface, valve, file, mesh, result.get(), "the surface"}, report);
  return std::move(marked.marks);
}

void write_surface(const MarkOptions &options, const riis_surface *surface, Report &report) {
  if (options.surface_output.empty()) return;
  const UnbrokenWrite unbroken;
  if (ranks::is_first()) check(riis_vtk_surface_write(surface, options.surface_output.c_str()));
  report.written.push_back(options.surface_output);
}

void write_files(const MarkOptions &options, const riis_surface *surface, const riis_vtk_mesh *mesh, Report &report) {
  const Stage stage("writing", options.quiet);
  write_surface(options, surface, report);
  if (!options.output.empty()) {
    const UnbrokenWrite unbroken;
    check(riis_vtk_mesh_write(mesh, options.output.c_str()));
    report.written.push_back(options.output);
  }
  report.seconds.write = stage.seconds();
}

void write_stats(const MarkOptions &options, const Report &report) {
  if (!options.stats.empty()) write_text(options.stats, json_of(report));
}

void print_table(const MarkOptions &options, const Report &report) {
  if (!options.quiet && options.stats != "-") write_text("-", take_notes() + table_of(report));
}

// Refuses outputs that would replace a frame. Outputs are written after all frames are read, so the user would not notice.
Keyframes keyframes_of_run(const MarkOptions &options, Seconds &seconds) {
  KeyframeFiles read = read_keyframes(options, seconds);
  check_no_output_is("a frame of --surface " + options.surface, read.files, options);
  return std::move(read.keyframes);
}

ExitCode run_single(MarkOptions options) {
  std::optional<MeshPieces> pieces;
  if (is_in_pieces(options.mesh)) {
    check_options_of_pieces(options);
    options.pieces = pieces.emplace(options.mesh).files();
  }
  ValveSource source{options, options.surface.empty() ? make_valve(options) : nullptr, nullptr};
  const riis_valve *valve = source.valve.get();
  check_views(options, 1, options);
  const OutputLocks locks = check_outputs(options);
  Report report;
  if (options.time)
    source.keyframes = keyframes_of_run(options, report.seconds);
  else if (!valve)
    source.file = read_surface(options, report.seconds);
  const Surface surface = make_surface(source, FileVelocity::none);
  source.file.reset();
  source.keyframes.reset();
  check(riis_surface_get_info(surface.get(), &report.surface, sizeof report.surface));
  report.surface_name = valve ? options.valve : options.surface;
  if (valve) report.opening = opening_of(valve);
  if (valve && !options.wall.empty()) report.gap = gap_to_wall(options, surface.get());
  report.time = options.time;
  if (!options.leaflets.empty()) report.n_leaflets = count_leaflets(surface.get());
  report.seconds.surface = report.surface.seconds_triangles;
  report.seconds.scene = report.surface.seconds_scene;
  if (options.check_crossing) look_for_crossings(options, valve, surface.get(), report);
  if (valve && !options.check_crossing) report.crossings = check_shape(options, valve, !options.params_open.empty());
  if (!options.mesh.empty()) rehearse_marking(options, surface.get());
  if (pieces) {
    mark_pieces(options, *pieces, surface.get(), valve, names_of_arrays(options), report);
    write_surface(options, surface.get(), report);
    write_stats(options, report);
    print_table(options, report);
    return report.marks.n_marked == 0 && !options.allow_none ? exit_none_marked : exit_fine;
  }
  const MeshFile mesh = options.mesh.empty() ? nullptr : read_mesh(options, report.seconds);
  if (mesh) check_new_arrays(options, names_of_arrays(options), mesh.get());
  const Marks result = mesh ? mark(options, surface.get(), valve, mesh.get(), report) : nullptr;
  if (options.n_steps > 0) report.step = time_steps(options, source.valve.get(), mesh.get());
  write_files(options, surface.get(), mesh.get(), report);
  try {
    // The marks get the default names, under which riis_vtk draws them. The output, which may have other names, is already
    // written.
    if (result && !options.pictures.empty())
      check(riis_vtk_mesh_set_marks(mesh.get(), result.get(), options.far_distance, nullptr));
    draw_pictures(options, {&options}, picture_title(options, valve, report), leaflet_names(options), surface.get(),
                  mesh.get(), result.get(), report);
  } catch (const Refusal &) {
    // The statistics are written even if drawing failed, because the marks are valid.
    write_stats(options, report);
    throw;
  }
  write_stats(options, report);
  print_table(options, report);
  return result && report.marks.n_marked == 0 && !options.allow_none ? exit_none_marked : exit_fine;
}

bool has_pieces(const ValveOptions &) { return false; }
bool has_pieces(const SizeFieldOptions &) { return false; }
bool has_pieces(const MarkOptions &options) { return is_in_pieces(options.mesh) || !options.series.case_file.empty(); }

ExitCode run_command(const MarkOptions &options) {
  const bool has_case = !options.series.case_file.empty();
  if (!has_case && options.series.times.empty()) return run_single(options);
  // The movie is checked before the case is read, because a case may have many files.
  check_movie(options.series.movie);
  Case all = has_case ? read_case(options) : case_of_command_line(options);
  return run_case(all);
}

ExitCode run_command(const SizeFieldOptions &options) { return run_size_field(options); }

ExitCode run_command(const StatesOptions &options) {
  run_states(options);
  return exit_fine;
}

ExitCode run_command(const ExportOptions &options) {
  export_uris(options);
  return exit_fine;
}

ExitCode run_command(const PlaceOptions &options) {
  run_place(options);
  return exit_fine;
}

ExitCode run_command(const ParamsOptions &options) {
  const Valve valve = make_valve(options, OpeningCheck::no);
  write_text("-", options.describe ? parameter_table(valve.get()) : json_template(valve.get()) + "\n");
  return exit_fine;
}

}  // namespace

ExitCode run(const Request &request) {
  const auto run_it = [](const auto &options) {
    // Only a mesh in pieces gives work to more than one rank.
    if (!ranks::is_first() && !has_pieces(options)) return exit_fine;
    const ExitCode code = run_command(options);
    return code == exit_fine && options.strict && n_warnings() > 0 ? exit_warned : code;
  };
  return std::visit(run_it, request);
}

}  // namespace riis::program
