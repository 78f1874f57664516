// SPDX-License-Identifier: Apache-2.0
#include "program/input/valve_source.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <vector>

#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/face_faults.hpp"
#include "program/input/parameters.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/wall.hpp"

namespace riis::program {

namespace {

void set_parameters(const ValveOptions &options, riis_valve *valve) {
  set_own_parameters(options, valve);
  if (!options.params.empty()) set_from_json_file(valve, options.params);
  for (const std::string &setting : options.settings) set_from_text(valve, setting);
  if (options.opening) check(riis_valve_set_scalar(valve, "opening", *options.opening), "--opening");
}

Valve valve_of(const ValveOptions &options, OpeningCheck opening) {
  const Stage stage("reading " + options.valve, options.quiet);
  NewValve valve(options.valve, "--valve");
  set_parameters(options, valve);
  if (!options.params_open.empty()) {
    const Valve open = make_kind(options.valve, "--valve");
    set_from_json_file(open, options.params_open);
    check(riis_valve_set_open_state(valve, open), options.params_open);
  }
  return opening == OpeningCheck::yes ? valve.take() : valve.take_unchecked();
}

bool has_text(const std::string &text, const char *part) { return text.find(part) != std::string::npos; }

Surface surface_of_valve(const ValveOptions &options, const riis_valve *valve) {
  const Stage stage("making the surface", options.quiet);
  return create_for<Surface>(subject_of(options), riis_surface_create, valve, &options.surface_options);
}

Surface surface_of_file(const ValveOptions &options, const riis_vtk_surface *file, FileVelocity velocity) {
  auto arrays = get<riis_surface_arrays>(riis_vtk_surface_get_arrays, file);
  std::vector<double> zeros;
  if (velocity == FileVelocity::zero) {
    zeros.resize(static_cast<std::size_t>(arrays.n_vertices), 0.0);
    arrays.vx = arrays.vy = arrays.vz = zeros.data();
  }
  try {
    const SkirtOfFile skirt(options, arrays);
    return create_for<Surface>(options.surface, riis_surface_create_from_arrays, &skirt.arrays(),
                               &options.surface_options);
  } catch (Refusal &refusal) {
    refusal.text = with_attached_array(refusal.text);
    if (has_text(refusal.text, "has zero area")) refusal.text += "; --skip-zero-area leaves out such triangles";
    throw;
  }
}

}  // namespace

Valve make_kind(const std::string &kind, const std::string &subject) {
  Valve valve;
  const riis_status status = riis_valve_create(kind.c_str(), valve.out());
  if (status == RIIS_INVALID_PARAMETER) {
    refuse_data(subject + ": " + riis_last_error() +
                ", diseases (riis help diseases), and files of patches, FILE.json");
  }
  check(status);
  return valve;
}

NewValve::NewValve(const std::string &valve, const std::string &subject) {
  if (!is_valve_file(valve)) {
    valve_ = make_kind(valve, subject);
    return;
  }
  path_ = valve;
  ValveFile file(path_);
  valve_ = std::move(file.valve);
  can_open_ = file.can_open;
}

Valve NewValve::take() {
  const double opening = opening_of(valve_);
  if (opening != 0 && !can_open_)
    refuse_file(path_, "opening is " + Json(opening).dump() + ", but the file has no \"open\" state");
  return take_unchecked();
}

Valve make_valve(const ValveOptions &options, OpeningCheck opening, WarpSource *moving) {
  Valve valve = valve_of(options, opening);
  WarpSource warp = read_warp(options);
  if (warp.moves() && !moving) refuse_usage("--warp: landmarks that move need --times");
  warp.apply(0, valve);
  if (moving) *moving = std::move(warp);
  set_skirt(options, valve, "--skirt");
  return valve;
}

namespace {

SurfaceFile read_surface_file(const std::string &path, const char *leaflets) {
  SurfaceFile file;
  check_read(riis_vtk_surface_read(path.c_str(), leaflets, file.out()), path, Content::surface);
  return file;
}

// Returns the name of the cell array that --leaflets gives, or NULL without this option.
const char *array_of_leaflets(const ValveOptions &options) {
  return options.leaflets.empty() || options.leaflets == "connected" ? nullptr : options.leaflets.c_str();
}

}  // namespace

std::string subject_of(const ValveOptions &options) { return is_valve_file(options.valve) ? options.valve : ""; }

double opening_of(const riis_valve *valve) {
  double opening = 0;
  check(riis_valve_get(valve, "opening", 1, &opening));
  return opening;
}

std::vector<double> openings_from_0_to_1(std::int32_t n) {
  std::vector<double> openings;
  for (std::int32_t i = 0; i < n; ++i) openings.push_back(static_cast<double>(i) / (n - 1));
  return openings;
}

Valve copy_of(const riis_valve *valve) { return create<Valve>(riis_valve_copy, valve); }

Surface surface_at(riis_valve *valve, double opening, const riis_surface_options &how) {
  check(riis_valve_set_scalar(valve, "opening", opening));
  Surface surface;
  const riis_status status = riis_surface_create(valve, &how, surface.out());
  if (status != RIIS_INVALID_PARAMETER && status != RIIS_LIMIT_EXCEEDED) check(status);
  return surface;
}

// Tries the valve only at opening 1. A valve that is accepted at opening 0 but refused at opening 1 has only one state. Other
// faults are reported when the surface is made.
std::string why_closed(riis_valve *valve, const riis_surface_options &how) {
  check(riis_valve_set_scalar(valve, "opening", 1));
  Surface surface;
  const riis_status status = riis_surface_create(valve, &how, surface.out());
  return status == RIIS_INVALID_PARAMETER ? riis_last_error() : "";
}

void check_read(riis_status status, const std::string &path, Content content) {
  try {
    check(status);
  } catch (Refusal &refusal) {
    if (status == RIIS_FILE_ERROR) refusal.text += conversion_hint(path, content, refusal.text);
    throw;
  }
}

namespace {

bool moves(const std::string &file) {
  const std::string ending = ending_of(file);
  return ending == ".pvd" || ending == ".dat";
}

}  // namespace

void set_surface(ValveOptions &options, const std::vector<std::string> &files, const std::string &subject) {
  options.surface_files = files;
  options.surface = files.front();
  if (files.size() > 1) options.surface += " and " + std::to_string(files.size() - 1) + " more";
  for (const std::string &file : files)
    if (moves(file) != moves(files.front()))
      refuse_usage(subject + ": one of " + files.front() + " and " + file + " moves, and the other file does not");
}

bool is_motion(const ValveOptions &options) {
  return !options.surface_files.empty() && moves(options.surface_files.front());
}

std::vector<std::string> leaflets_of_files(const ValveOptions &options) {
  std::vector<std::string> names;
  if (options.surface_files.size() > 1)
    for (const std::string &file : options.surface_files) names.push_back(std::filesystem::path(file).stem().string());
  return names;
}

SurfaceFile read_surface(const ValveOptions &options, Seconds &seconds) {
  const Stage stage("reading " + options.surface, options.quiet);
  SurfaceFile file;
  for (const std::string &path : options.surface_files) {
    SurfaceFile next = read_surface_file(path, array_of_leaflets(options));
    if (file)
      check(riis_vtk_surface_append(file.get(), next.get()), path);
    else
      file = std::move(next);
  }
  if (options.leaflets == "connected") check(riis_vtk_surface_number_pieces(file.get()));
  seconds.read += stage.seconds();
  return file;
}

Surface make_surface(const ValveSource &source, FileVelocity velocity) {
  if (source.valve) return surface_of_valve(source.options, source.valve);
  Surface surface =
      source.keyframes ? create_for<Surface>(source.options.surface, riis_surface_create_from_keyframes,
                                             source.keyframes, *source.options.time, 0, &source.options.surface_options)
                       : surface_of_file(source.options, source.file.get(), velocity);
  warn_of_faces(source.options, surface);
  return surface;
}

namespace {

// The name of a leaflet in files, and the name that users see.
struct LeafletName {
  std::string in_files, shown;
};
using LeafletNames = std::vector<LeafletName>;  // by leaflet_id

// Returns the names of a kind's leaflets. A file of patches has no names of leaflets.
LeafletNames names_of_kind(const std::string &kind) {
  static const LeafletNames coronary = {{"right", "right"}, {"left", "left"}, {"non_coronary", "non-coronary"}},
                            numbered = {{"cusp_0", "cusp 0"},
                                        {"cusp_1", "cusp 1"},
                                        {"cusp_2", "cusp 2"},
                                        {"cusp_3", "cusp 3"}},
                            mitral = {{"anterior", "anterior"}, {"posterior", "posterior"}},
                            tricuspid = {{"anterior", "anterior"}, {"septal", "septal"}, {"posterior", "posterior"}},
                            mechanical = {{"positive", "x > 0"}, {"negative", "x < 0"}, {"housing", "housing"}};
  static const std::map<std::string, LeafletNames> names = {
      {"aortic", coronary},        {"coapting", coronary},     {"trileaflet", coronary},
      {"bicuspid", numbered},      {"quadricuspid", numbered}, {"mitral", mitral},
      {"mitral_coapting", mitral}, {"tricuspid", tricuspid},   {"bileaflet", mechanical}};
  const auto known = names.find(kind);
  return known == names.end() ? LeafletNames{} : known->second;
}

}  // namespace

std::string name_of_leaflet(const ValveOptions &options, const riis_surface_info &surface, std::int32_t leaflet,
                            const char *word) {
  if (leaflet == surface.skirt_leaflet_id) return "skirt";
  std::vector<std::string> names = leaflets_of_files(options);
  if (options.surface.empty())
    for (const LeafletName &name : names_of_kind(options.valve)) names.push_back(name.shown);
  const auto at = static_cast<std::size_t>(leaflet);
  return at < names.size() ? names[at] : word + std::to_string(leaflet);
}

std::string file_name_of_leaflet(const std::string &kind, std::int32_t leaflet) {
  const LeafletNames names = names_of_kind(kind);
  const auto at = static_cast<std::size_t>(leaflet);
  return at < names.size() ? names[at].in_files : "leaflet_" + std::to_string(leaflet);
}

int64_t count_leaflets(const riis_surface *surface) {
  const riis_triangles triangles = triangles_of(surface);
  const std::set<int32_t> ids(triangles.leaflet_id, triangles.leaflet_id + triangles.n_triangles);
  return static_cast<int64_t>(ids.size());
}

// ---- Motion ----

namespace {

Motion read_motion(const ValveOptions &options) {
  Motion motion;
  for (const std::string &path : options.surface_files) {
    const char *const leaflets = array_of_leaflets(options);
    auto next = ending_of(path) == ".dat"
                    ? create<Motion>(riis_vtk_motion_read_frames, path.c_str(), options.frame_step, leaflets)
                    : create<Motion>(riis_vtk_motion_read_pvd, path.c_str(), leaflets);
    if (motion)
      check(riis_vtk_motion_append(motion, next), path);
    else
      motion = std::move(next);
  }
  if (options.leaflets == "connected") check(riis_vtk_motion_number_pieces(motion));
  return motion;
}

}  // namespace

KeyframeFiles read_keyframes(const ValveOptions &options, Seconds &seconds) {
  const Stage stage("reading " + options.surface, options.quiet);
  const Motion motion = read_motion(options);
  seconds.read += stage.seconds();
  int64_t n_files = 0;
  const char *const *paths = nullptr;
  check(riis_vtk_motion_get_files(motion, &n_files, &paths));
  const auto arrays = get<riis_surface_arrays>(riis_vtk_motion_get_arrays, motion);
  auto frames = get<riis_keyframe_arrays>(riis_vtk_motion_get_frames, motion);
  frames.period = options.period;
  try {
    const SkirtOfFile skirt(options, arrays);
    KeyframeFiles made{create_for<Keyframes>(options.surface, riis_keyframes_create, &skirt.arrays(), &frames),
                       {paths, paths + n_files},
                       {frames.time, frames.time + frames.n_keys}};
    skirt.check_times(made.keyframes, made.times);
    return made;
  } catch (Refusal &refusal) {
    refusal.text = with_attached_array(refusal.text);
    throw;
  }
}

// ---- Conversion ----

namespace {

namespace fs = std::filesystem;

// The endings of files that a tool converts. tests/cli/test_cli_conversions.c tests each ending if the tool is installed.
const std::set<std::string> meshes_of_gmsh = {".unv", ".bdf", ".nas"};
// gmsh 4 silently leaves out the prisms of a .mesh file.
const std::set<std::string> meshes_of_meshio = {".inp", ".su2",  ".med", ".mesh", ".meshb", ".avs", ".dat", ".f3grid",
                                                ".h5m", ".mdpa", ".vol", ".node", ".ele",   ".xml", ".post"};
// Endings of files that ParaView opens. The files contain blocks or structured grids.
const std::set<std::string> meshes_of_paraview = {".cgns", ".case", ".encas", ".vtkhdf", ".pvti", ".pvtr",
                                                  ".pvts", ".plt",  ".tec",   ".vtmb",   ".vtpc", ".vtpd"};
// Endings of CAD files. gmsh fills a CAD model with cells, or covers it with triangles.
const std::set<std::string> cad_files = {".step", ".stp", ".iges", ".igs", ".brep"};
const std::set<std::string> surfaces_of_gmsh = {".msh", ".unv", ".bdf", ".nas", ".mesh", ".ply2", ".med", ".wrl"};
const std::set<std::string> surfaces_of_meshio = {".off"};
// Endings of surface files that meshio converts to .vtu files with all faces. In a .stl file, meshio would write only the
// triangles.
const std::set<std::string> faces_of_meshio = {".xdmf", ".xmf", ".inp", ".e", ".exo", ".avs", ".mdpa", ".vol"};
const std::set<std::string> surfaces_of_paraview = {".vtkhdf", ".pvtp", ".vtm"};
const std::set<std::string> surfaces_only = {".stl", ".vtp", ".ply", ".ply2", ".obj", ".off"};

// Returns the path in a form that a shell reads as one word, and that no program takes for an option.
std::string path_in_shell(const std::string &path) { return shell_word(path[0] == '-' ? "./" + path : path); }

std::string with_ending(const std::string &path, const char *ending) {
  return path_in_shell(fs::path(path).replace_extension(ending).string());
}

std::string by_gmsh(const std::string &path, const char *format) {
  return "; gmsh converts it: gmsh -save " + path_in_shell(path) + " -format " + format + " -o " +
         with_ending(path, format);
}

// gmsh writes elements of order 3 and more to a .vtk file with their nodes in the wrong order.
std::string at_order_2(const std::string &path) {
  if (path.find_first_of("'\"\\") != std::string::npos) return "";
  const std::string lowered = fs::path(path).replace_extension().string() + "_order2.msh";
  return "; gmsh lowers the order: echo 'Merge \"" + path + "\"; SetOrder 2; Save \"" + lowered +
         "\";' > order2.geo && gmsh -parse_and_exit order2.geo";
}

std::string by_meshio(const std::string &path, const char *format) {
  return "; meshio converts it: meshio convert " + path_in_shell(path) + " " + with_ending(path, format);
}

std::string meshed_by_gmsh(const std::string &path, int dimension, const char *format) {
  return "; gmsh meshes it: gmsh -" + std::to_string(dimension) + " " + path_in_shell(path) + " -format " + format +
         " -o " + with_ending(path, format);
}

std::string by_paraview(const std::string &path) {
  return "; ParaView converts it: the filters Merge Blocks and Append Datasets, then File > Save Data..., " +
         with_ending(path, "vtu");
}

std::string first_bytes_of(const std::string &path, std::size_t n) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(n, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(n));
  return bytes;
}

// Returns the last words of a refusal, which name the first mesh of a .pvd file, for example ", such as step0.vtu". Returns "" if
// the .pvd file names no mesh.
std::string first_file_of_list(const std::string &path) {
  constexpr std::size_t most_bytes = 65536;
  const std::string text = first_bytes_of(path, most_bytes), begin = " file=\"";
  const std::size_t at = text.find(begin, text.find("<DataSet"));
  if (at == std::string::npos) return "";
  const std::size_t first = at + begin.size(), end = text.find('"', first);
  const std::string name = end == std::string::npos ? "" : text.substr(first, end - first);
  if (name.empty() || name.find('&') != std::string::npos || std::any_of(name.begin(), name.end(), is_control))
    return "";
  return ", such as " + path_in_shell((fs::path(path).parent_path() / name).string());
}

// A .msh file may be from another version of gmsh, or from Ansys Fluent. For a damaged .msh file there is no hint, because no
// program can convert the file. SimVascular also uses the ending .msh, for an XML file that describes a mesh.
std::string hint_for_msh(const std::string &path, const std::string &refusal) {
  if (has_text(refusal, "is of gmsh's type")) return at_order_2(path);
  if (has_text(refusal, "of gmsh's format;")) return by_gmsh(path, "vtk");
  if (!has_text(refusal, "is not a mesh of gmsh")) return "";
  if (first_bytes_of(path, 4) == "$NOD") return by_gmsh(path, "vtk");  // version 1
  if (first_bytes_of(path, 1) == "<")
    return "; it is SimVascular's description of a mesh: give the mesh, which is beside it, " +
           with_ending(path, "vtu");
  return by_meshio(path, "vtu");
}

}  // namespace

std::string conversion_hint(const std::string &path, Content wanted, const std::string &refusal) {
  const std::string ending = ending_of(path);
  // A refusal shows control characters as question marks. A path with control characters therefore gets no hint: the printed
  // command would name another file.
  if (std::any_of(path.begin(), path.end(), is_control) || has_text(refusal, "Git LFS")) return "";
  if (wanted == Content::mesh) {
    if (ending == ".msh") return hint_for_msh(path, refusal);
    if (meshes_of_gmsh.count(ending) != 0) return by_gmsh(path, "vtk");
    // meshio 5.3 cannot write the group names of a MED file to a .vtu file.
    if (meshes_of_meshio.count(ending) != 0) return by_meshio(path, ending == ".med" ? "xdmf" : "vtu");
    if (meshes_of_paraview.count(ending) != 0) return by_paraview(path);
    if (has_text(refusal, "holds multiblock")) return by_paraview(path);
    if (ending == ".pvd") return "; a .pvd is a list of files: give one of its meshes" + first_file_of_list(path);
    if (ending == ".bp" || has_text(refusal, "of ADIOS2"))
      return "; in dolfinx, write with io.XDMFFile or io.VTKFile in place of io.VTXWriter";
    if (cad_files.count(ending) != 0) return meshed_by_gmsh(path, 3, "vtk");
    if (ending == ".feb") return "; FEBio Studio converts it: File > Export FE Model..., " + with_ending(path, "vtk");
    if (ending == ".re2" || ending == ".rea")
      return "; Nek5000 converts it: run the case for one step with its coordinates in the output, open CASE.nek5000 "
             "in ParaView, then File > Save Data..., " +
             with_ending(path, "vtu");
    if (ending == ".cas") return "; OpenFOAM converts it: fluentMeshToFoam " + path_in_shell(path);
    if (ending == ".h5" || ending == ".hdf5") return "; give the .xdmf file that names it";
    const bool is_surface = surfaces_only.count(ending) != 0 || refusal.find("holds polydata") != std::string::npos;
    return is_surface ? "; --surface takes a surface" : "";
  }
  // A .vtk file by gmsh has points and lines beside faces, and gmsh can convert it. For other .vtk files there is no hint,
  // because a damaged file cannot be converted.
  if (ending == ".vtk") return refusal.find("; a surface has") != std::string::npos ? by_gmsh(path, "stl") : "";
  if (surfaces_of_gmsh.count(ending) != 0) return by_gmsh(path, "stl");
  if (faces_of_meshio.count(ending) != 0) return by_meshio(path, "vtu");
  if (surfaces_of_paraview.count(ending) != 0) return by_paraview(path);
  if (cad_files.count(ending) != 0) return meshed_by_gmsh(path, 2, "stl");
  return surfaces_of_meshio.count(ending) != 0 ? by_meshio(path, "stl") : "";
}

}  // namespace riis::program
