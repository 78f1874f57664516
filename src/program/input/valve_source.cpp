// SPDX-License-Identifier: Apache-2.0
#include "program/input/valve_source.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/parameters.hpp"
#include "program/input/valve_file.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {

namespace {

void set_parameters(const ValveOptions &options, riis_valve *valve) {
  set_placed_parameters(options, valve);
  if (!options.params.empty()) set_from_json_file(valve, options.params);
  for (const std::string &setting : options.settings) set_from_text(valve, setting);
  if (options.opening) check(riis_valve_set_scalar(valve, "opening", *options.opening), "--opening");
}

Valve make_valve_of_kind(const ValveOptions &options) {
  Valve valve = make_kind(options.valve, "--valve");
  set_parameters(options, valve.get());
  if (!options.params_open.empty()) {
    const Valve open = make_kind(options.valve, "--valve");
    set_from_json_file(open.get(), options.params_open);
    check(riis_valve_set_open_state(valve.get(), open.get()), options.params_open);
  }
  return valve;
}

Valve make_valve_of_file(const ValveOptions &options, OpeningCheck opening) {
  const Stage stage("reading " + options.valve, options.quiet);
  ValveFile file(options.valve);
  set_parameters(options, file.valve());
  if (opening == OpeningCheck::yes) file.check_opening();
  return file.take_valve();
}

// Checks the status of reading a file. If riis_vtk cannot read the file, adds to the refusal a command that converts it.
void check_read(riis_status status, const std::string &path, Content content) {
  try {
    check(status);
  } catch (Refusal &refusal) {
    if (status == RIIS_FILE_ERROR) refusal.text += conversion_hint(path, content, refusal.text);
    throw;
  }
}

Surface surface_of_valve(const ValveOptions &options, const riis_valve *valve) {
  const Stage stage("making the surface", options.quiet);
  riis_surface *surface = nullptr;
  check(riis_surface_create(valve, &options.surface_options, &surface),
        is_valve_file(options.valve) ? options.valve : "");
  return Surface(surface);
}

Surface surface_of_file(const ValveOptions &options, const riis_vtk_surface *file, FileVelocity velocity) {
  riis_surface_arrays arrays;
  check(riis_vtk_surface_get_arrays(file, &arrays, sizeof arrays));
  std::vector<double> zeros;
  if (velocity == FileVelocity::zero) {
    zeros.resize(static_cast<std::size_t>(arrays.n_vertices), 0.0);
    arrays.vx = arrays.vy = arrays.vz = zeros.data();
  }
  riis_surface *surface = nullptr;
  check(riis_surface_create_from_arrays(&arrays, &options.surface_options, &surface), options.surface);
  return Surface(surface);
}

}  // namespace

Valve make_kind(const std::string &kind, const std::string &subject) {
  riis_valve *handle = nullptr;
  const riis_status status = riis_valve_create(kind.c_str(), &handle);
  if (status == RIIS_INVALID_PARAMETER) {
    throw Refusal{exit_bad_data, subject + ": " + riis_last_error() + ", and files of patches, FILE.json"};
  }
  check(status);
  return Valve(handle);
}

Valve make_valve(const ValveOptions &options, OpeningCheck opening, WarpSource *moving) {
  Valve valve = is_valve_file(options.valve) ? make_valve_of_file(options, opening) : make_valve_of_kind(options);
  WarpSource warp = read_warp(options);
  if (warp.moves() && !moving) refuse_usage("--warp: landmarks that move need --times");
  warp.apply(0, valve.get());
  if (moving) *moving = std::move(warp);
  set_skirt(options, valve.get(), "--skirt");
  return valve;
}

namespace {

SurfaceFile read_wall(const ValveOptions &options) {
  riis_vtk_surface *handle = nullptr;
  check_read(riis_vtk_surface_read(options.wall.c_str(), nullptr, &handle), options.wall, Content::surface);
  return SurfaceFile(handle);
}

// Makes the wall, and multiplies its lengths by `scale`. It is already in the mesh's frame, so no other placement applies to it.
Surface make_wall(const ValveOptions &options, const SurfaceFile &file, double scale = 1) {
  ValveOptions as_it_is;
  as_it_is.surface = options.wall;
  as_it_is.surface_options.zero_area = RIIS_ZERO_AREA_SKIP;
  as_it_is.surface_options.scale = scale;
  return surface_of_file(as_it_is, file.get(), FileVelocity::none);
}

// Returns a hint if the skirt would reach the wall in another unit, and "" otherwise.
std::string hint_of_unit(const ValveOptions &options, const SurfaceFile &file, const riis_valve *valve) {
  for (const char *factor : {"0.1", "10", "0.01", "100", "0.001", "1000"}) {
    const Valve copy = copy_of(valve);
    const Surface wall = make_wall(options, file, std::stod(factor));
    if (riis_valve_set_skirt_to_wall(copy.get(), wall.get(), *options.skirt, &options.surface_options) == RIIS_OK)
      return std::string("; with its lengths times ") + factor + " the wall would be: save it in the mesh's unit";
  }
  return "";
}

}  // namespace

void set_skirt(const ValveOptions &options, riis_valve *valve, const std::string &subject) {
  if (!options.skirt) return;
  if (options.wall.empty()) {
    check(riis_valve_set_scalar(valve, "skirt_length", *options.skirt / options.surface_options.scale), subject);
    return;
  }
  const SurfaceFile file = read_wall(options);
  const Surface wall = make_wall(options, file);
  const riis_status status = riis_valve_set_skirt_to_wall(valve, wall.get(), *options.skirt, &options.surface_options);
  if (status == RIIS_INVALID_ARGUMENT) {
    const std::string reason = options.wall + ": " + riis_last_error();
    throw Refusal{exit_bad_data, reason + hint_of_unit(options, file, valve)};
  }
  check(status, subject);
}

riis_gap gap_to_wall(const ValveOptions &options, const riis_surface *surface) {
  const Surface wall = make_wall(options, read_wall(options));
  riis_gap gap;
  check(riis_surface_get_gap(surface, wall.get(), nullptr, &gap, sizeof gap), options.wall);
  return gap;
}

double opening_of(const riis_valve *valve) {
  double opening = 0;
  check(riis_valve_get(valve, "opening", 1, &opening));
  return opening;
}

Valve copy_of(const riis_valve *valve) {
  riis_valve *copy = nullptr;
  check(riis_valve_copy(valve, &copy));
  return Valve(copy);
}

// Tries the valve at opening 1 only. A valve that is valid at 0 and refused at 1 has only one state. Other faults are reported
// when the surface is made.
std::string why_closed(riis_valve *valve, const riis_surface_options &how) {
  check(riis_valve_set_scalar(valve, "opening", 1));
  riis_surface *surface = nullptr;
  const riis_status status = riis_surface_create(valve, &how, &surface);
  const Surface owned(surface);
  return status == RIIS_INVALID_PARAMETER ? riis_last_error() : "";
}

void check_mesh_read(riis_status status, const std::string &path) { check_read(status, path, Content::mesh); }

SurfaceFile read_surface(const ValveOptions &options, Seconds &seconds) {
  const Stage stage("reading " + options.surface, options.quiet);
  const char *path = options.surface.c_str();
  const bool by_pieces = options.leaflets == "connected";
  riis_vtk_surface *handle = nullptr;
  const char *leaflets = options.leaflets.empty() || by_pieces ? nullptr : options.leaflets.c_str();
  const riis_status status = riis_vtk_surface_read(path, leaflets, &handle);
  check_read(status, options.surface, Content::surface);
  SurfaceFile file(handle);
  if (by_pieces) check(riis_vtk_surface_number_pieces(file.get()));
  seconds.read += stage.seconds();
  return file;
}

Surface make_surface(const ValveSource &source, FileVelocity velocity) {
  if (source.keyframes) return surface_of_keyframes(source.options, source.keyframes.get());
  return source.valve ? surface_of_valve(source.options, source.valve.get())
                      : surface_of_file(source.options, source.file.get(), velocity);
}

int64_t count_leaflets(const riis_surface *surface) {
  const riis_triangles triangles = triangles_of(surface);
  const std::set<int32_t> ids(triangles.leaflet_id, triangles.leaflet_id + triangles.n_triangles);
  return static_cast<int64_t>(ids.size());
}

// ---- Motion ----

namespace {

Motion read_motion(const ValveOptions &options) {
  const bool by_pieces = options.leaflets == "connected";
  const char *leaflets = options.leaflets.empty() || by_pieces ? nullptr : options.leaflets.c_str();
  riis_vtk_motion *handle = nullptr;
  check(riis_vtk_motion_read_pvd(options.surface.c_str(), leaflets, &handle));
  Motion motion(handle);
  if (by_pieces) check(riis_vtk_motion_number_pieces(motion.get()));
  return motion;
}

std::vector<std::string> files_of(const riis_vtk_motion *motion) {
  int64_t n_files = 0;
  const char *const *paths = nullptr;
  check(riis_vtk_motion_get_files(motion, &n_files, &paths));
  return {paths, paths + n_files};
}

Keyframes keyframes_of(const ValveOptions &options, const riis_vtk_motion *motion) {
  riis_surface_arrays arrays;
  riis_keyframe_arrays frames;
  check(riis_vtk_motion_get_arrays(motion, &arrays, sizeof arrays));
  check(riis_vtk_motion_get_frames(motion, &frames, sizeof frames));
  frames.period = options.period;
  riis_keyframes *handle = nullptr;
  check(riis_keyframes_create(&arrays, &frames, &handle), options.surface);
  return Keyframes(handle);
}

}  // namespace

bool is_motion_file(const std::string &surface) {
  const std::string ending = surface.substr(surface.size() - std::min<std::size_t>(surface.size(), 4));
  return ending == ".pvd" || ending == ".PVD";
}

KeyframeFiles read_keyframes(const ValveOptions &options, Seconds &seconds) {
  const Stage stage("reading " + options.surface, options.quiet);
  const Motion motion = read_motion(options);
  seconds.read += stage.seconds();
  KeyframeFiles read{nullptr, files_of(motion.get())};
  read.keyframes = keyframes_of(options, motion.get());
  return read;
}

std::vector<double> times_of_frames(const ValveOptions &options) {
  const Motion motion = read_motion(options);
  riis_keyframe_arrays frames;
  check(riis_vtk_motion_get_frames(motion.get(), &frames, sizeof frames));
  return {frames.time, frames.time + frames.n_keys};
}

Surface surface_of_keyframes(const ValveOptions &options, const riis_keyframes *keyframes) {
  riis_surface *surface = nullptr;
  check(riis_surface_create_from_keyframes(keyframes, *options.time, 0, &options.surface_options, &surface),
        options.surface);
  return Surface(surface);
}

// ---- Conversion ----

namespace {

namespace fs = std::filesystem;

// The endings that a tool converts. tests/cli/test_cli_conversions.c tests each ending if the tool is installed.
const std::set<std::string> meshes_of_gmsh = {".unv", ".bdf", ".nas", ".mesh"};
const std::set<std::string> meshes_of_meshio = {".inp", ".su2", ".med"};
// ParaView opens these. They hold blocks, or grids that are not unstructured.
const std::set<std::string> meshes_of_paraview = {".cgns", ".case", ".encas", ".vtkhdf", ".vti", ".vtr",
                                                  ".vts",  ".pvti", ".pvtr",  ".pvts",   ".plt", ".tec"};
const std::set<std::string> surfaces_of_gmsh = {".msh", ".unv", ".bdf", ".nas", ".mesh", ".ply", ".ply2", ".vtk"};
const std::set<std::string> surfaces_of_meshio = {".obj", ".off"};
const std::set<std::string> surfaces_only = {".stl", ".vtp", ".ply", ".ply2", ".obj", ".off"};

// Quotes the path, so that a shell reads it as one word and a program does not read it as an option.
std::string shell_word(std::string path) {
  if (path[0] == '-') path.insert(0, "./");
  const auto is_plain = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c >= 128 ||
           std::string("_-./+,:@%").find(static_cast<char>(c)) != std::string::npos;
  };
  if (std::all_of(path.begin(), path.end(), is_plain)) return path;
  std::string quoted = "'";
  for (const char c : path) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string with_ending(const std::string &path, const char *ending) {
  return shell_word(fs::path(path).replace_extension(ending).string());
}

std::string by_gmsh(const std::string &path, const char *format) {
  return "; gmsh converts it: gmsh -save " + shell_word(path) + " -format " + format + " -o " +
         with_ending(path, format);
}

std::string by_meshio(const std::string &path, const char *format) {
  return "; meshio converts it: meshio convert " + shell_word(path) + " " + with_ending(path, format);
}

// A .msh may be of another version of gmsh, or of Ansys Fluent. A damaged one cannot be converted.
std::string hint_for_msh(const std::string &path, const std::string &refusal) {
  if (refusal.find("of gmsh's format;") != std::string::npos || refusal.find("is of gmsh's type") != std::string::npos)
    return by_gmsh(path, "vtk");
  return refusal.find("is not a mesh of gmsh") != std::string::npos ? by_meshio(path, "vtu") : "";
}

}  // namespace

std::string conversion_hint(const std::string &path, Content wanted, const std::string &refusal) {
  const std::string ending = ending_of(path);
  // A refusal replaces control characters. So a path with such characters gets no hint, because the command would not work.
  if (std::any_of(path.begin(), path.end(), [](unsigned char c) { return c < ' ' || c == 127; })) return "";
  if (wanted == Content::mesh) {
    if (ending == ".msh") return hint_for_msh(path, refusal);
    if (meshes_of_gmsh.count(ending) != 0) return by_gmsh(path, "vtk");
    if (meshes_of_meshio.count(ending) != 0) return by_meshio(path, "vtu");
    if (meshes_of_paraview.count(ending) != 0)
      return "; ParaView converts it: the filters Merge Blocks and Append Datasets, then File > Save Data..., " +
             with_ending(path, "vtu");
    if (ending == ".cas") return "; OpenFOAM converts it: fluentMeshToFoam " + shell_word(path);
    if (ending == ".h5" || ending == ".hdf5") return "; give the .xdmf file that names it";
    return surfaces_only.count(ending) != 0 ? "; --surface takes a surface" : "";
  }
  if (surfaces_of_gmsh.count(ending) != 0) return by_gmsh(path, "stl");
  return surfaces_of_meshio.count(ending) != 0 ? by_meshio(path, "stl") : "";
}

}  // namespace riis::program
