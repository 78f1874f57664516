// SPDX-License-Identifier: Apache-2.0
// riis patient: one command that does the work of all commands of docs/patient.md.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/vectors.hpp"
#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/commands/commands.hpp"
#include "program/input/placing.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/report.hpp"
#include "program/patient/case_files.hpp"
#include "program/patient/flat_ends.hpp"
#include "program/patient/patient_mesh.hpp"
#include "program/patient/patient_steps.hpp"
#include "program/patient/solver_case.hpp"

namespace riis::program {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

Words joined(std::initializer_list<Words> lists) {
  Words all;
  for (const Words &words : lists) all.insert(all.end(), words.begin(), words.end());
  return all;
}

// Defaults of lengths, in millimetres.
constexpr double aortic_half_thickness = 1, mitral_half_thickness = 1.5, usual_skirt = 6, usual_noise = 0.3;
// Limits of the half thickness. A value beyond these limits has a wrong unit, or would close the open valve.
constexpr double least_half_thickness_mm = 0.1, most_half_thickness_mm = 4, most_skirt_mm = 30;
// The mean distance of landmarks from the wall is usually at most `usual_distance_mm` if a person has set them. Above
// `doubtful_distance_mm`, the landmarks are probably wrong.
constexpr double usual_distance_mm = 1, doubtful_distance_mm = 2;
constexpr double usual_band_edge = 0.95, usual_largest_edge = 3;
// svMultiPhysics spreads K over whole elements. In a coarser mesh, svMultiPhysics' closed valve would therefore leak much
// (docs/export.md).
constexpr double uris_band_edge = 0.55;
constexpr double usual_resistance = 1e4;  // kg/(m s)
// If an edge leaks, a second mesh with shorter edges is made.
constexpr double shorter_by = 0.9;
// The largest number of nodes that is usual for a flow solver on one computer.
constexpr std::int64_t many_nodes = 40000;
// The number of nodes grows with a power of 1 / (edge length in the band). The power was measured on meshes of a root and a
// ventricle.
constexpr double power_of_nodes = 2.5;
// The number of nodes also grows with a power of 1 / (half thickness), because all edge lengths change with the half thickness.
// This power was measured on meshes of a root.
constexpr double power_of_thinner = 2.4;
// The least share of the open valve that the band should leave open. In a narrower valve the flow differs: the gradient grows
// with the square of 1 / area. beat_table.py has the same limit.
constexpr double least_open_share = 0.8;
constexpr int n_marked_openings = 11;

// The opening of a valve during a beat of 0.72 s. The times are in seconds, as in examples/demo. The text `times` has the times
// for which files are written.
struct Beat {
  const char *text, *times;
};
constexpr Beat aortic_beat{"time,opening\n0.00,0\n0.06,1\n0.17,0.79\n0.21,0\n", "0:0.22:0.02"};
constexpr Beat mitral_beat{"time,opening\n0.00,0\n0.22,0\n0.29,1\n0.40,0.62\n0.50,0.55\n0.57,0.85\n0.66,0\n",
                           "0.2:0.68:0.04"};
const char *const shown_period = "0.72";

// Returns the kind of valve to which the landmarks belong, or "".
std::string kind_of_roles(const LandmarkFile &landmarks) {
  const auto n_of = [&](std::int32_t role) { return std::count(landmarks.roles.begin(), landmarks.roles.end(), role); };
  const auto n_nadirs = n_of(RIIS_LANDMARK_NADIR);
  if (n_nadirs > 0) return n_nadirs == 2 ? "bicuspid" : n_nadirs == 4 ? "quadricuspid" : "coapting";
  return n_of(RIIS_LANDMARK_HINGE) == 0 && n_of(RIIS_LANDMARK_ANNULUS) > 0 ? "mitral" : "";
}

void check_kind(const std::string &kind) {
  static const std::set<std::string> kinds = {"coapting",     "trileaflet", "bicuspid",
                                              "quadricuspid", "mitral",     "mitral_coapting"};
  if (kinds.count(kind) > 0) return;
  if (kind == "aortic")
    refuse_usage("--valve: the aortic valve does not close: write --valve coapting or --valve trileaflet");
  refuse_usage("--valve: riis patient takes " + one_of({kinds.begin(), kinds.end()}) +
               ", or a disease of riis help diseases, not " + kind +
               "; docs/patient.md has the single commands, which take every kind");
}

// Returns the numbers that a step has written to its report.
Json stats_of(const std::string &name) { return parse_json_file("logs/" + name + ".json", "stats"); }

// Returns whether the file exists, because pictures and movies may be missing.
bool exists(const char *path) {
  std::error_code error;
  return fs::exists(path, error);
}

class PatientRun {
 public:
  explicit PatientRun(const PatientOptions &options) : options_(options), steps_(options.quiet) {}

  ExitCode run() {
    gmsh_ = require_gmsh();
    read_landmarks_and_wall();
    PatientFolder folder(options_.folder, options_.replace, inputs_);
    if (!folder.removed().empty()) steps_.say("replaced", "removed " + folder.removed());
    copy_inputs();
    place();
    check_valve();
    make_mesh();
    check_sealed();
    write_marks();
    write_beat();
    write_case();
    write_report();
    folder.finish();
    print_end();
    return exit_fine;
  }

 private:
  // ---- What the user gave ----

  void read_landmarks_and_wall() {
    const double begin = steps_.seconds();
    landmarks_ =
        read_landmarks(options_.landmarks, text_of_file(options_.landmarks), options_.has_valve ? options_.valve : "");
    const std::string given = options_.has_valve         ? options_.valve
                              : landmarks_.valve.empty() ? kind_of_roles(landmarks_)
                                                         : "";
    the_.kind = kind_of(landmarks_, given, Reader::program);
    check_kind(the_.kind);
    the_.is_mitral = is_mitral_kind(the_.kind);
    the_.name = the_.is_mitral ? "mitral_valve" : "aortic_valve";
    the_.folder = ".";
    the_.solver = options_.solver;
    the_.hold = options_.hold;
    if (options_.heart_rate)
      the_.period =
          std::round(60 / (*options_.heart_rate * seconds_between_files)) / std::round(1 / seconds_between_files);
    const std::string kind_by_roles = kind_of_roles(landmarks_);
    if (options_.has_valve && !kind_by_roles.empty() && is_mitral_kind(kind_by_roles) != the_.is_mitral)
      refuse_usage("--valve: the landmarks of " + options_.landmarks + " are those of " +
                   (the_.is_mitral ? "an aortic" : "a mitral") + " valve, and " + the_.kind + " is " +
                   (the_.is_mitral ? "a mitral" : "an aortic") + " valve: leave out --valve");
    check_names_of_cusps(landmarks_, the_.kind);
    const auto point_of = [](const std::vector<double> &xyz) { return std::array<double, 3>{xyz[0], xyz[1], xyz[2]}; };
    EndPoints points;
    if (options_.inlet) points.inlet = point_of(*options_.inlet);
    for (const std::vector<double> &outlet : options_.outlets) points.outlets.push_back(point_of(outlet));
    wall_ = read_patient_wall(options_.wall, points);
    frame_ = frame_of_wall(wall_, landmarks_, options_.wall_unit, options_.axes);
    the_.unit = options_.unit.value_or(frame_.unit);
    millimetre_ = factor_between(Unit::millimetre, the_.unit);
    the_.half_thickness =
        length_of(options_.given_half_thickness, the_.is_mitral ? mitral_half_thickness : aortic_half_thickness,
                  least_half_thickness_mm, most_half_thickness_mm);
    the_.skirt = length_of(options_.given_skirt, usual_skirt, 0, most_skirt_mm);
    largest_edge_ = length_of(options_.given_largest_edge, usual_largest_edge * the_.half_thickness / millimetre_, 0,
                              most_skirt_mm);
    band_edge_ = options_.band_edge.value_or(options_.solver == "svmultiphysics" ? uris_band_edge : usual_band_edge);
    the_.resistance = options_.given_resistance ? options_.given_resistance->number : usual_resistance;
    steps_.say("patient", "a " + the_.kind + " valve by " + counted(view(landmarks_.names).size(), "landmark") +
                              " of " + options_.landmarks +
                              (options_.has_valve || !landmarks_.valve.empty() ? "" : " (--valve names another)"));
    for (const std::string &remark : wall_.remarks) steps_.say("wall", remark);
    steps_.say("wall",
               options_.wall + ": " + counted(wall_.triangles.n(), "triangle") + ", " +
                   counted(view(wall_.ends).size(), "flat end") + ", in " + name_of(frame_.unit) +
                   (frame_.axes == "mesh" ? "" : " and " + frame_.axes) + ": the landmarks are " +
                   printed("%.3g", frame_.away) + " mm from it on average, at most " + printed("%.3g", frame_.worst) +
                   " mm, " + frame_.farthest,
               steps_.seconds() - begin);
    if (frame_.away > doubtful_distance_mm)
      warn(options_.landmarks + ": the landmarks are " + printed("%.3g", frame_.away) + " mm from the wall of " +
           options_.wall + " on average, but a person usually sets them within " + shown(usual_distance_mm) +
           " mm: they may belong to another patient or image. Load both in 3D Slicer");
    steps_.say("folder", options_.folder + ", where lengths are in " + name_of(the_.unit) + ". " + commands_file +
                             " has the command of each next step");
    std::error_code error;
    inputs_ = {fs::absolute(options_.wall, error).string(), fs::absolute(options_.landmarks, error).string()};
    if (!options_.params.empty()) inputs_.push_back(fs::absolute(options_.params, error).string());
  }

  // Returns the length that an option gives, in the unit of the folder. Without a unit, a number has the unit of the wall.
  // `least` and `most` are in millimetres.
  double length_of(const std::optional<Amount> &given, double usual_mm, double least_mm, double most_mm) const {
    // Twelve digits leave out the conversion's rounding errors, which would show in the commands.
    const auto in_unit = [&](double mm) { return *number_in(printed("%.12g", mm * millimetre_)); };
    if (!given) return in_unit(usual_mm);
    const double mm = given->number * (given->has_unit ? 1000 : factor_between(frame_.unit, Unit::millimetre));
    if (mm < least_mm || mm > most_mm) {
      std::string cure;
      for (const Unit unit : {Unit::millimetre, Unit::centimetre, Unit::metre}) {
        const double meant = given->number * factor_between(unit, Unit::millimetre);
        if (!given->has_unit && cure.empty() && meant >= least_mm && meant <= most_mm)
          cure = std::string("; without a unit, the number has that of WALL: write ") + given->subject + " '" +
                 given->text + " " + name_of(unit) + "' if " + words_of(unit) + " are meant";
      }
      refuse_usage(given->subject + ": " + given->text +
                   (given->has_unit ? "" : std::string(" ") + name_of(frame_.unit)) + " is not from " +
                   shown(least_mm) + " to " + shown(most_mm) + " mm" + cure);
    }
    return in_unit(mm);
  }

  std::string in_mm(double length) const { return printed("%.3g", length / millimetre_) + " mm"; }
  // rounded_mm returns a length in millimetres, rounded upwards, and option_mm returns this length as an option's value.
  double rounded_mm(double length) const { return std::ceil(100 * length / millimetre_ - 1e-6) / 100; }
  std::string option_mm(double length) const { return "'" + shortest(rounded_mm(length)) + " mm'"; }

  void copy_inputs() {
    landmarks_name_ = "landmarks" + landmark_ending(options_.landmarks);
    copy(inputs_[1], landmarks_name_);
    if (!options_.params.empty()) copy(inputs_[2], "params.json");
    scale_wall(wall_, factor_between(frame_.unit, the_.unit));
    write_wall(wall_, "wall.stl");
  }
  static void copy(const std::string &from, const std::string &to) {
    std::error_code error;
    fs::copy_file(from, to, error);
    if (error) refuse_data(from + ": cannot be copied to " + to + ": " + error.message());
  }

  // ---- The valve ----

  Words place_words(const Words &more, bool with_flow = true) const {
    Words words = {"place",  landmarks_name_,   "--valve", options_.disease.empty() ? the_.kind : options_.disease,
                   "--unit", name_of(the_.unit)};
    if (frame_.axes != "mesh") words.insert(words.end(), {"--axes", frame_.axes});
    if (options_.flow && with_flow) words.insert(words.end(), {"--flow", numbers_text(options_.flow->data(), 3, ",")});
    if (!options_.params.empty()) words.insert(words.end(), {"--params", "params.json"});
    for (const std::string &setting : options_.settings) words.insert(words.end(), {"--set", setting});
    return joined({words, more});
  }

  double noise() const {
    if (!options_.noise && landmarks_.noise) return factor_between(landmarks_.unit, the_.unit) * *landmarks_.noise;
    return length_of(options_.noise, usual_noise, 0, most_skirt_mm);
  }

  void place() {
    check_flow();
    static const char *const names[] = {"none", "exact", "smoothed"};
    const Words noise_words = options_.noise ? Words{"--noise", shortest(noise())} : Words();
    StepEnd end = steps_.run(
        "place",
        place_words(joined({{"--warp", names[options_.warp_choice]}, noise_words, {"--output", "placed.json"}})));
    // The step reads a copy of the landmarks, but a message should name the user's file.
    for (std::string &message : end.messages)
      if (message.rfind(landmarks_name_ + ":", 0) == 0) message.replace(0, landmarks_name_.size(), options_.landmarks);
    if (!end.is_fine()) steps_.refuse("place", end, cure_of_folds(end));
    show_warnings(end);
    const Json placed = parse_json_file("placed.json", "a placed valve");
    const Json &fit = placed["fit"];
    std::string text = "the fitted " + the_.kind + " valve misses the landmarks by " + in_mm(fit["rms"]) + " (rms)";
    if (fit.contains("warped_rms")) text += ", and by " + in_mm(fit["warped_rms"]) + " after a warp bends it to them";
    steps_.say("place", text, end.seconds);
    if (!fit["undetermined"].empty())
      steps_.say("place", "not determined by the landmarks, and guessed by proportions: " +
                              joined_by(described(fit["undetermined"]), ", ") +
                              ". More landmarks or --set would determine them (logs/place.log)");
    report_["fit"] = fit;
    const PlacedFile file = read_placed("placed.json", placed, the_.unit);
    for (std::size_t k = 0; k < 3; ++k) centre_[k] = file.where.translation[k];
    flow_ = flow_of(file);
    name_ends(wall_, centre_, flow_);
  }

  // Returns the direction of the blood. The atrium of a mitral valve lies in the direction of z.
  Vector3 flow_of(const PlacedFile &file) const {
    const double *const axis = file.where.rotation_axis;
    return turned({0, 0, the_.is_mitral ? -1.0 : 1.0}, {axis[0], axis[1], axis[2]}, file.where.rotation_angle);
  }

  // Returns the names of parameters with their descriptions.
  std::vector<std::string> described(const std::vector<std::string> &names) const {
    const Valve valve = make_kind(the_.kind, "--valve");
    std::vector<std::string> made;
    for (const riis_parameter &parameter : all_parameters(valve))
      if (std::find(names.begin(), names.end(), parameter.name) != names.end())
        made.push_back(std::string(parameter.name) + " (" + parameter.description + ")");
    return made;
  }

  // Refuses a direction of flow that contradicts the landmarks. Without --flow, the horns of a mitral annulus show the side of
  // the atrium if their height clearly exceeds the error of the landmarks. riis place compares --flow with the other landmarks.
  void check_flow() {
    if (!the_.is_mitral || !options_.flow) return;
    const char *const trial = "logs/flow_trial.json";
    if (!steps_.run_silently("flow_trial", place_words({"--output", trial}, false)).is_fine()) return;
    const auto along = flow_of(read_placed(trial, parse_json_file(trial, "a placed valve"), the_.unit));
    const std::vector<double> &given = *options_.flow;
    if (dot(along, {given[0], given[1], given[2]}) >= 0) return;
    refuse_usage("--flow: " + numbers_text(given.data(), 3, ",") +
                 " points into the atrium: both horns of an annulus lie on the atrium's side, so the landmarks of " +
                 options_.landmarks + " show a flow along " +
                 numbers_text(along.data(), 3, ",", [](double x) { return printed("%.2f", x); }) +
                 ": leave out --flow");
  }

  // If the warp folds, finds a noise that smooths the warp enough.
  std::string cure_of_folds(const StepEnd &end) {
    const auto says = [&](const char *text) { return end.reason().find(text) != std::string::npos; };
    const bool is_cured = says("--warp smoothed does not fold");  // riis place has tried the landmarks' own noise
    if (is_cured || !(says("the warp folds") || says("the warp turns"))) return "";
    const auto is_placed = [&](const Words &how) {
      return steps_.run_silently("place_trial", place_words(how)).is_fine();
    };
    const bool is_own_tried = noise() > 0;
    const double own = is_own_tried ? noise() : usual_noise * millimetre_;
    for (const double factor : {1.0, 2.0, 3.0, 5.0}) {
      if (factor == 1 && is_own_tried) continue;
      const double tried = rounded_mm(factor * own) * millimetre_;
      if (is_placed({"--warp", "smoothed", "--noise", shortest(tried), "--output", "placed.json"}))
        return ". It does not fold with --warp smoothed --noise " + option_mm(tried) +
               ", but first look for a misplaced landmark";
    }
    return is_placed({"--warp", "none", "--output", "placed.json"})
               ? ". --warp none places the valve without a warp, but first look for a misplaced landmark"
               : "";
  }

  Words with_valve(const Words &begin, const Words &end = {}) const {
    return joined({begin,
                   {"--valve", "placed.json", "--skirt", shortest(the_.skirt), "--wall", "wall.stl", "--half-thickness",
                    shortest(the_.half_thickness)},
                   end});
  }

  void check_valve() {
    const StepEnd end = steps_.run("crossings", with_valve({"check", "crossings"}, {"--stats", "logs/crossings.json"}));
    if (end.status == exit_warned)
      refuse_data(end.reason() + ". Look for a misplaced landmark near there" +
                  (options_.warp_choice == no_warp ? "" : "; --warp none shows whether the warp is the cause"));
    if (!end.is_fine()) steps_.refuse("crossings", end, cure_of_missed_wall(end));
    show_warnings(end);
    const Json gap = stats_of("crossings")["gap"];
    report_["gap"] = gap;
    const double least = gap["least"], most = gap["most"];
    std::string text = "closes the gap between the closed valve and the wall, at most " + in_mm(std::max(most, 0.0));
    if (least < 0) text += "; elsewhere the closed valve reaches up to " + in_mm(-least) + " into the wall";
    steps_.say("skirt", text + "; no leaflets go through each other at 101 openings", end.seconds);
  }

  // Finds the length of a skirt that would reach the wall.
  std::string cure_of_missed_wall(const StepEnd &end) {
    if (end.reason().find("wall.stl: ") != 0) return "";
    for (const double longest : {8, 10, 12, 15, 20}) {
      if (longest * millimetre_ <= the_.skirt) continue;
      const StepEnd trial = steps_.run_silently(
          "skirt_trial", {"surface", "--valve", "placed.json", "--skirt", shortest(longest * millimetre_), "--wall",
                          "wall.stl", "--output", "logs/trial.vtp"});
      if (trial.is_fine())
        return ". If the wall is right there, --skirt " + option_mm(longest * millimetre_) +
               " is long enough; otherwise look at the landmarks near there";
    }
    return ". Even a skirt of 20 mm does not reach this wall at every opening: check that the landmarks are at their "
           "places and belong to this patient";
  }

  void show_warnings(const StepEnd &end) const {
    for (const std::string &message : end.messages) warn(message);
  }

  // ---- The mesh ----

  void make_mesh() {
    for (int attempt = 0;; ++attempt) {
      make_mesh_once();
      find_sides();
      const std::int64_t n_leaks = mark_all_openings();
      report_["n_leaking_edges"] = n_leaks;
      if (n_leaks == 0)
        return steps_.say("marks", "no edge leaks at " + std::to_string(n_marked_openings) + " openings",
                          marks_seconds_);
      const std::string text = counted(n_leaks, "edge") + " leak" + (n_leaks == 1 ? "s" : "") + " at " +
                               std::to_string(n_marked_openings) + " openings";
      if (attempt == 1)
        refuse_data(text + " also in the second mesh, whose edges in the band have " + shown(band_edge_) +
                    " half thicknesses: --band-edge " + shown(shorter_by * band_edge_) +
                    " makes them shorter, or --half-thickness " + option_mm(1.1 * the_.half_thickness) +
                    " thickens the band");
      band_edge_ *= shorter_by;
      steps_.say("marks",
                 text + ": the mesh is made once more, with edges of " + shown(band_edge_) + " half thicknesses",
                 marks_seconds_);
    }
  }

  void make_mesh_once() {
    const StepEnd end = steps_.run(
        "size_field", with_valve({"size-field", "valve.dat"},
                                 {"--band-edge", shown(band_edge_), "--largest-edge", shortest(largest_edge_)}));
    if (!end.is_fine()) steps_.refuse("size_field", end);
    show_warnings(end);
    steps_.say("edges",
               in_mm(band_edge_ * the_.half_thickness) + " in the band, " + in_mm(largest_edge_) + " elsewhere",
               end.seconds);
    PatientMeshOptions how;
    how.folder = ".";
    how.field = "valve.dat";
    how.largest_edge = largest_edge_;
    how.announce = [this](const std::string &command) { steps_.announce(command); };
    const double begin = steps_.seconds();
    PatientMesh mesh = mesh_patient(wall_, how);
    the_.boundaries = std::move(mesh.boundaries);
    the_.n_nodes = mesh.n_nodes;
    the_.n_cells = mesh.n_cells;
    the_.band_edge = band_edge_ * the_.half_thickness;
    steps_.say("mesh",
               "mesh.msh: " + grouped(the_.n_nodes) + " nodes, " + grouped(the_.n_cells) + " tetrahedra; boundaries " +
                   names_of_boundaries(),
               steps_.seconds() - begin);
    if (the_.n_nodes <= many_nodes) return;
    const double thicker =
        the_.half_thickness *
        std::pow(static_cast<double>(the_.n_nodes) / static_cast<double>(many_nodes), 1 / power_of_thinner);
    steps_.say("mesh", "more than " + grouped(many_nodes) + " nodes take long to compute" +
                           time_with(static_cast<double>(the_.n_nodes), ": ") + ": --half-thickness " +
                           option_mm(thicker) + " would need about " + grouped(many_nodes));
  }

  // Returns words for how long the solver takes for a beat with this number of nodes, or "" without a solver.
  std::string time_with(double n_nodes, const std::string &begin) const {
    const SolverCost *const cost = options_.solver == "openfoam"         ? &openfoam_cost
                                   : options_.solver == "svmultiphysics" ? &svmultiphysics_cost
                                   : options_.solver == "fenicsx"        ? &dolfinx_cost
                                                                         : nullptr;
    if (cost == nullptr) return "";
    const double n_cells = n_nodes * static_cast<double>(the_.n_cells) / static_cast<double>(the_.n_nodes);
    return begin + "about " + time_of_beat(*cost, n_cells, the_.period) + " of a processor for a beat";
  }

  std::string names_of_boundaries() const {
    std::vector<std::string> names;
    for (const Boundary &boundary : the_.boundaries) names.push_back(boundary.name);
    return joined_by(names, ", ");
  }

  // Marks the mesh at all openings. Returns the number of leaking edges.
  std::int64_t mark_all_openings() {
    const double begin = steps_.seconds();
    std::int64_t sum = 0;
    Words typed = with_valve({"riis", "mark", "mesh.msh"});
    steps_.announce("for x in 0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 1; do " + shell_text(typed) +
                    " --opening $x --stats logs/marks_$x.json; done");
    for (const double opening : openings_from_0_to_1(n_marked_openings)) {
      const std::string name = "marks_" + shortest(std::round(100 * opening) / 100);
      const StepEnd end = steps_.run_silently(
          name, with_valve({"mark", "mesh.msh"}, {"--opening", name.substr(6), "--stats", "logs/" + name + ".json"}));
      if (!end.is_fine()) steps_.refuse(name, end);
      const Json leaks = stats_of(name)["n_leaking_edges"];
      if (!leaks.is_number())
        refuse_data("mesh.msh: leaks are unknown at the opening " + name.substr(6) + ": " + end.reason());
      sum += leaks.get<std::int64_t>();
    }
    marks_seconds_ = steps_.seconds() - begin;
    return sum;
  }

  // ---- Does it seal? ----

  void find_sides() {
    MarkOptions marking;
    marking.valve = "placed.json";
    marking.skirt = the_.skirt;
    marking.wall = "wall.stl";
    marking.has_half_thickness = true;
    marking.surface_options.half_thickness = the_.half_thickness;
    use_named_valve(marking);
    apply_units(marking);
    const ValveSides sides = sides_of_valve("mesh.msh", marking, the_.boundaries, centre_, flow_, millimetre_);
    the_.upstream = sides.upstream;
    the_.downstream = sides.downstream;
    the_.ball_radius = sides.ball_radius;
    check_ends(sides);
  }

  void check_sealed() {
    const double begin = steps_.seconds();
    const std::string from = numbers_text(the_.upstream.data(), 3, ","),
                      to = numbers_text(the_.downstream.data(), 3, ",");
    const auto passage_at = [&](const char *opening, const std::string &name) {
      const StepEnd end = steps_.run(
          name, with_valve({"check", "leaks", "mesh.msh"},
                           {"--opening", opening, "--between=" + from, to, "--stats", "logs/" + name + ".json"}));
      if (!end.is_fine()) steps_.refuse(name, end);
      return stats_of(name);
    };
    const Json closed = passage_at("0", "closed"), open = passage_at("1", "open");
    report_["closed"] = closed["passage"]["state"];
    report_["open"] = open["passage"]["state"];
    const bool may_leak = !options_.disease.empty() ||
                          std::any_of(options_.settings.begin(), options_.settings.end(),
                                      [](const std::string &setting) { return setting.rfind("bump_", 0) == 0; });
    if (closed["passage"]["state"] != "closed" && !may_leak) {
      const Json thicker = closed["passage"]["closing_half_thickness"];
      refuse_data("the closed valve does not seal: the blood passes " + in_mm(closed["passage"]["distance"]) +
                  " from it at " + point_text(closed["passage"]["point"]) +
                  (thicker.is_number() ? ". --half-thickness " + option_mm(thicker) +
                                             " closes the passage, or look at the landmarks near there"
                                       : ". Look at the landmarks near there"));
    }
    if (open["passage"]["state"] != "open")
      refuse_data("the open valve lets no blood pass: the widest passage is " + in_mm(open["passage"]["distance"]) +
                  " from it. A smaller --half-thickness leaves more room");
    const double square_cm = factor_between(the_.unit, Unit::centimetre) * factor_between(the_.unit, Unit::centimetre);
    const Disease *const disease = disease_named(options_.disease);
    std::string text = "the closed valve seals";
    if (closed["passage"]["state"] != "closed")
      text = "the closed valve leaves a gap, because the valve is diseased";
    else if (disease != nullptr && disease->opening == 0 && disease->area > 0)
      text +=
          ", because the band closes the gap of " + options_.disease + ", which a smaller --half-thickness leaves open";
    text += ", and the open valve lets the blood pass";
    if (open.contains("orifice")) {
      // The line also has the whole orifice, because the captions of the pictures show this larger area.
      const double orifice = square_cm * open["orifice"]["area"].get<double>();
      const double effective = square_cm * open["orifice"]["effective_area"].get<double>();
      text += ": the band leaves " + printed("%.3g", effective) + " of " + printed("%.3g", orifice) + " cm2";
      report_["effective_area_cm2"] = effective;
      the_.open_area = OpenArea{1e-4 * orifice, 1e-4 * effective, ""};
    }
    steps_.say("passage", text, steps_.seconds() - begin);
    say_outside(open);
    if (the_.open_area) check_open_share(open["orifice"]);
  }

  // Says how much of the open valve lies in the wall, where it marks nothing.
  void say_outside(const Json &open) {
    const Json outside = open.value("outside", Json());
    constexpr double least_said = 0.01;
    const double share = outside.is_object() ? outside["share"].get<double>() : 0.0;
    if (share < least_said) return;
    std::vector<std::string> leaflets;
    for (const Json &leaflet : outside["leaflets"])
      leaflets.push_back(leaflet["name"].get<std::string>() + " " +
                         printed("%.2g", 100 * leaflet["share"].get<double>()) + " %");
    const double least = open.contains("gap") ? open["gap"]["least"].get<double>() : 0.0;
    steps_.say("outside", "of the open leaflets, " + printed("%.2g", 100 * share) + " % of the area" +
                              (leaflets.empty() ? "" : " (" + joined_by(leaflets, ", ") + ")") +
                              " is outside the mesh, where nothing resists the blood" +
                              (least < 0 ? "; the open valve reaches up to " + in_mm(-least) + " into the wall" : ""));
  }

  // Warns if the band takes much of a small orifice. rim_reach is the width that the band takes along the orifice's edge, in half
  // thicknesses.
  void check_open_share(const Json &orifice) {
    const double area = orifice["area"], free = orifice["effective_area"], perimeter = orifice["perimeter"];
    if (!(area > 0) || free >= least_open_share * area) return;
    report_["open_share"] = free / area;
    const double thinner = (1 - least_open_share) * area / (orifice["rim_reach"].get<double>() * perimeter);
    const double thinner_mm = std::floor(100 * thinner / millimetre_ + 1e-6) / 100;
    const std::string share = printed("%.0f", 100 * least_open_share) + " %";
    const double n_nodes = static_cast<double>(the_.n_nodes) *
                           std::pow(the_.half_thickness / (thinner_mm * millimetre_), power_of_thinner);
    the_.open_area->cure = perimeter > 0 && thinner_mm >= least_half_thickness_mm
                               ? "In riis patient, --half-thickness '" + shortest(thinner_mm) +
                                     " mm' would leave about " + share + ". It needs about " +
                                     grouped(std::int64_t(1000 * std::round(n_nodes / 1000))) + " nodes" +
                                     time_with(n_nodes, ", and ") + "."
                               : "No half thickness of riis patient would leave " + share + ": " +
                                     shown(least_half_thickness_mm) + " mm is the least.";
    warn("the band, " + in_mm(the_.half_thickness) + " on each side of the leaflets, closes " +
         printed("%.0f", 100 * (1 - free / area)) +
         " % of the orifice. The blood will meet a narrower valve than yours, with less flow and a larger gradient. " +
         the_.open_area->cure);
  }

  // Refuses ends that lie on the wrong side of the closed valve. If the user chose such an end, the message names the option.
  void check_ends(const ValveSides &sides) const {
    if (!sides.are_apart) return;
    std::vector<std::pair<std::string, bool>> wrong;  // ends, and whether they are before the valve
    for (const auto &[names, is_before] : {std::pair(sides.after, false), std::pair(sides.before, true)})
      for (const std::string &name : names)
        if ((name == "inlet") != is_before) wrong.emplace_back(name, is_before);
    if (wrong.empty()) return;
    const auto is_chosen = [&](const auto &end) {
      return end.first == "inlet" ? options_.inlet.has_value() : !options_.outlets.empty();
    };
    const auto chosen = std::find_if(wrong.begin(), wrong.end(), is_chosen);
    const auto &[name, is_before] = chosen == wrong.end() ? wrong[0] : *chosen;
    refuse_data(
        "mesh.msh: the end " + name + " at " + point_text(end_named(name).centre) +
        (chosen == wrong.end() ? "" : ", which --" + std::string(name == "inlet" ? "inlet" : "outlet") + " chose,") +
        " is " + (is_before ? "before" : "after") + " the valve" + cure_of_ends(sides));
  }

  const Boundary &end_named(const std::string &name) const {
    return *std::find_if(the_.boundaries.begin(), the_.boundaries.end(),
                         [&](const Boundary &boundary) { return boundary.name == name; });
  }

  // Returns the options that choose ends on the correct sides of the valve.
  std::string cure_of_ends(const ValveSides &sides) const {
    std::string text;
    if (options_.flow) text = ", according to --flow: reverse --flow if it points against the blood; otherwise";
    if (sides.before.empty() || sides.after.empty())
      return text + (text.empty() ? ": " : " ") + "no flat end is " + (sides.before.empty() ? "before" : "after") +
             " it: cut the vessel flat there";
    const auto option = [&](const char *begin, const std::string &name) {
      const double to_wall = factor_between(the_.unit, frame_.unit);
      std::vector<std::string> numbers;
      for (const double x : end_named(name).centre) numbers.push_back(printed("%.5g", to_wall * x));
      return begin + joined_by(numbers, ",");
    };
    const auto largest = std::max_element(
        sides.before.begin(), sides.before.end(),
        [&](const std::string &a, const std::string &b) { return end_named(a).area < end_named(b).area; });
    text += (text.empty() ? ":" : "") + std::string(" write ") + option("--inlet=", *largest);
    for (const std::string &name : sides.after) text += option(" --outlet=", name);
    return text + (sides.before.size() > 1 ? "; other flat parts become wall" : "");
  }

  template <class Point>
  std::string point_text(const Point &point) const {
    const double p[3] = {point[0], point[1], point[2]};
    return place_text(options_in_folder(), p, the_.half_thickness);
  }
  ValveOptions options_in_folder() const {
    ValveOptions options;
    options.unit = the_.unit;
    return options;
  }

  // ---- Files ----

  void write_marks() {
    for (const auto &[opening, name] : {std::pair<std::string, std::string>{"0", "closed"}, {"1", "open"}}) {
      const Words words = with_valve({"mark", "mesh.msh"}, {"--opening", opening, "--output", name + ".vtu"});
      run_with_picture(name + "_marks", joined({words, {"--picture", name + ".png", "--view", "valve-oblique"}}), words,
                       name + ".vtu", name + ".png");
    }
  }

  // Runs a command that also draws. If the program cannot draw on this machine, says so and runs the command without pictures.
  void run_with_picture(const std::string &name, const Words &with_picture, const Words &words,
                        const std::string &output, const std::string &picture) {
    StepEnd end = steps_.run(name, with_picture);
    std::string missing;
    if (!end.is_fine()) {
      missing = end.reason();
      end = steps_.run(name, words);
      if (!end.is_fine()) steps_.refuse(name, end);
    }
    steps_.say("written", output + (missing.empty() ? ", " + picture : "; without " + picture + ": " + missing),
               end.seconds);
    if (!missing.empty()) report_["missing"][picture] = missing;
  }

  void write_beat() {
    const Beat &beat = the_.is_mitral ? mitral_beat : aortic_beat;
    write_text("beat.csv", beat.text);
    const Words words = with_valve(
        {"mark", "mesh.msh"}, {"--resistance", shortest(the_.resistance), "--cycle", "beat.csv", "--period",
                               shown_period, "--interpolation", "cubic", "--times", beat.times, "--output", "beat.pvd",
                               "--surface-output", "leaflets.pvd", "--series-table", "beat_table.csv"});
    const Words movie = {"--movie", "beat.mp4", "--movie-view", "valve-oblique", "--frame-rate", "6"};
    run_with_picture("beat", joined({words, movie}), words, "beat.pvd, leaflets.pvd, beat_table.csv", "beat.mp4");
    // The picture is not drawn here, because a user wants to choose the opening and the view.
    steps_.note("a picture for a talk",
                shell_text(with_valve({"riis", "mark", "mesh.msh"},
                                      {"--opening", "0.5", "--picture", "talk.png", "--picture-size", "3840x2160",
                                       "--picture-panels", "valve", "--view", "valve-oblique"})));
  }

  void write_case() {
    if (options_.solver == "none") return;
    const double begin = steps_.seconds();
    if (options_.solver == "openfoam") write_openfoam_case(the_);
    if (options_.solver == "svmultiphysics") write_svmultiphysics_case(the_);
    if (options_.solver == "fenicsx") write_fenicsx_case(the_);
    steps_.say(
        "case",
        "for " + options_.solver +
            (options_.heart_rate ? ", at " + printed("%.3g", 60 / the_.period) + " beats a minute: a beat lasts " +
                                       shortest(the_.period) + " s, a multiple of the time between two files"
                                 : ""),
        steps_.seconds() - begin);
    if (the_.is_mitral)
      steps_.say("case",
                 "the ventricle of the case has a rigid wall and cannot fill: blood that passes the valve leaves at "
                 "once through the outlet, even in diastole. The outlet therefore has the pressure of the ventricle, "
                 "not of the aorta");
  }

  void write_report() {
    Json json = {{"version", riis_version_string()}, {"gmsh", gmsh_}, {"valve", the_.kind}};
    if (!options_.disease.empty()) json["disease"] = options_.disease;
    json["unit"] = name_of(the_.unit);
    json["wall"] = {{"file", options_.wall},
                    {"unit", name_of(frame_.unit)},
                    {"axes", frame_.axes},
                    {"landmarks_away_mm", frame_.away}};
    json["half_thickness"] = the_.half_thickness;
    json["band_edge"] = band_edge_;
    json["largest_edge"] = largest_edge_;
    json["skirt"] = the_.skirt;
    json["resistance"] = the_.resistance;
    json["n_nodes"] = the_.n_nodes;
    json["n_cells"] = the_.n_cells;
    for (const Boundary &boundary : the_.boundaries)
      json["boundaries"].push_back({{"name", boundary.name},
                                    {"group", boundary.group},
                                    {"centre", boundary.centre},
                                    {"area", boundary.area},
                                    {"n_faces", boundary.n_faces}});
    json["centre"] = centre_;
    json["flow"] = flow_;
    json["upstream"] = the_.upstream;
    json["downstream"] = the_.downstream;
    json["ball_radius"] = the_.ball_radius;
    json.update(report_);
    json["solver"] = options_.solver;
    json["seconds"] = steps_.seconds();
    json["commands"] = steps_.commands();
    write_text("patient.json", json.dump(2) + "\n");
  }

  void print_end() {
    const double finer = std::pow(static_cast<double>(the_.n_nodes) / many_nodes, 1 / power_of_nodes);
    if (finer < 1)
      steps_.say("edges", "the mesh of " + grouped(the_.n_nodes) +
                              " nodes is ready for a run; for a comparison with a finer mesh, --band-edge " +
                              printed("%.2f", finer * band_edge_) + " makes about " + grouped(many_nodes) +
                              " nodes in place of --band-edge " + shown(band_edge_) + time_with(many_nodes, ": "));
    steps_.say("done", "in " + printed("%.0f", steps_.seconds()) + " s. " + options_.folder + " has:");
    const std::pair<std::string, const char *> files[] = {
        {"mesh.msh",
         "the mesh for programs that read gmsh's files; mesh.vtu is for ParaView, and faces/ has the mesh's "
         "boundaries"},
        {"placed.json", "the valve, for --valve of every command of riis; wall.stl is the wall"},
        {"closed.vtu", "the marked mesh with the closed valve; open.vtu has the open valve"},
        {"closed.png", "pictures of both"},
        {"beat.pvd", "a prescribed beat for ParaView, without a flow; leaflets.pvd has the leaflets"},
        {"beat.mp4", "the prescribed beat as a movie"},
        {commands_file, "the commands of this run, whose output is in logs/, and a command for a picture for a talk"},
        {"patient.json", "all numbers of this run"}};
    for (const auto &[name, what] : files)
      if (exists(name.c_str())) steps_.say("  " + name + std::string(13 - name.size(), ' '), what);
    const std::string path = options_.folder + "/" + options_.solver;
    if (options_.solver != "none")
      steps_.say("beats",
                 "in the solver's case, the blood moves the valve, so the valve opens and closes at other times than "
                 "in beat.pvd and beat.mp4");
    if (options_.solver == "openfoam")
      steps_.say("once", "in the top folder of riis: ./run openfoam plugin (docs/patient_openfoam.md)");
    if (options_.solver == "fenicsx")
      steps_.say("run", "python3 " + path + "/run.py, with a Python that has dolfinx");
    else if (options_.solver != "none")
      steps_.say("run", path + "/Allrun");
  }

  const PatientOptions &options_;
  PatientSteps steps_;
  SolverCase the_;  // whose folder is the working folder
  std::string gmsh_, landmarks_name_;
  LandmarkFile landmarks_;
  PatientWall wall_;
  WallFrame frame_;
  std::vector<std::string> inputs_;
  double millimetre_ = 1, largest_edge_ = 0;  // in the folder's unit
  double band_edge_ = 0;                      // in half thicknesses
  double marks_seconds_ = 0;
  std::array<double, 3> centre_{}, flow_{};
  Json report_ = Json::object();
};

}  // namespace

ExitCode run_patient(const PatientOptions &options) {
  try {
    return PatientRun(options).run();
  } catch (Refusal &refusal) {
    refusal.text += cure_of_full_disc(refusal.text);
    throw;
  }
}

}  // namespace riis::program
