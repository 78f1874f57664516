// SPDX-License-Identifier: Apache-2.0
// The inputs are landmarks of a patient. The results are the sizes and the placement of the valve, as a report and as the file of
// a placed valve. The program and the Python package share this code.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <riis/riis.hpp>
#include <string>
#include <vector>

#include "program/base/units.hpp"
#include "program/input/json.hpp"

namespace riis::program {

// The input is a file of landmarks (docs/formats.md): JSON, 3D Slicer's .mrk.json, or CSV. The results are the landmarks as the
// library takes them. A file must state its unit and its axes, because the program does not guess them.

// The directions of x, y and z. LPS is left, posterior, superior; RAS is right, anterior, superior. `mesh` stands for the mesh's
// own axes.
enum class Axes { LPS, RAS, mesh };
const std::vector<std::string> &axes_names();
const char *name_of(Axes axes);

struct LandmarkFile {
  std::string path;
  bool is_file = true;                    // false: the landmarks are in memory, and `path` is words for them
  std::vector<std::string> names;         // as in the file
  std::vector<double> xyz;                // (3, n), in the file's unit and axes
  std::vector<std::int32_t> roles;        // RIIS_LANDMARK_*
  std::vector<std::int32_t> leaflet_ids;  // (2, n)
  std::string valve;                      // the valve's kind, or "" without a statement in the file
  std::string wanted;                     // the kind that the user named before the file was read, or ""
  Unit unit = Unit::millimetre;
  Axes axes = Axes::mesh;
  std::optional<double> noise;
  std::optional<std::array<double, 3>> flow;
  std::vector<double> flow_ends;  // (3, 2), flow_from and flow_to; empty if they are not given
  Json parameters;                // an object of known sizes, in centimetres; null without known sizes

  // Changes lengths to another unit, and coordinates to other axes.
  void convert(Unit to);
  void convert(Axes to);
};

bool is_mitral_kind(const std::string &kind);

// Returns the ending of a file of landmarks, such as ".mrk.json". The ending tells the file's format.
std::string landmark_ending(const std::string &path);
// Reads the text of a file of landmarks. The ending of its path tells the format. `kind` is the kind of valve that the user
// named, or "". If a name is wrong, the message lists the names for this kind.
LandmarkFile read_landmarks(const std::string &path, const std::string &text, const std::string &kind = "");
// If all given nadirs and commissures name their cusps, every nadir and commissure of this kind of valve must be given. The
// refusal names the missing landmarks.
void check_names_of_cusps(const LandmarkFile &landmarks, const std::string &kind);
// Takes landmarks from a JSON object in memory, which has the keys of a landmark file. `subject` names the landmarks in refusals.
LandmarkFile landmarks_of_json(const std::string &subject, const Json &root);

// The reader of a message: a user of the program or of the Python package. Messages write options like --unit mm for the program,
// and like unit='mm' for Python.
enum class Reader { program, python };

// The user's statements about the landmarks, in addition to the statements of the file.
struct PlaceRequest {
  Reader reader = Reader::program;
  std::optional<Unit> unit;     // to which lengths are converted
  std::string axes;             // "LPS" or "RAS", to which coordinates are converted; "": the landmarks' axes
  std::optional<double> noise;  // in the unit after the conversion
  std::optional<std::vector<double>> flow;  // in the axes after the conversion
};
// Changes the landmarks' unit and axes as the user requests.
void adapt(LandmarkFile &landmarks, const PlaceRequest &request);
// Returns the kind of valve that the user named. If the user named no kind, returns the kind of the landmarks' file, or "".
// Refuses a file whose kind differs from the user's kind.
std::string kind_of(const LandmarkFile &landmarks, const std::string &given, Reader reader);

// A size of the valve.
struct Size {
  riis_parameter parameter;
  std::vector<double> values;
  double standard_error;
  int32_t state;
  bool follows;  // the parameter was not set, and has the value of another parameter
};

struct Placed {
  LandmarkFile landmarks;
  std::string kind;
  std::vector<Size> sizes;
  std::size_t n_trigones_left_out = 0;
  riis_placement placement{};
  std::vector<double> residuals;
  double noise = 0;                                               // as stated, in the mesh's unit
  std::vector<double> places;                                     // (3, n), of the landmarks on the valve
  riis_surface_options where = defaults<riis_surface_options>();  // the placement
  bool is_warped = false;
  // The pairs of the warp: landmarks on the valve and in the patient, (3, n), and their names. Several landmarks at the same
  // place make only one pair.
  std::vector<double> sources, targets;
  std::vector<std::string> paired_names;
  double warp_noise = 0;          // the noise that smooths the warp; 0: the warp meets the landmarks
  std::vector<double> still_off;  // distances of the landmarks from the warped closed valve, exact to a micrometre
};

// Finds the sizes and the placement of the valve from the landmarks. The parameters in `held` keep the values that the caller has
// set. Parameters that the landmarks' file states also keep their values.
Placed place_by_landmarks(const LandmarkFile &of_file, riis_valve *valve, const std::string &kind,
                          const std::vector<std::string> &held, Reader reader);

// Warps the valve to the landmarks, and returns the warp. The noise smooths the warp. With a noise of 0 the warp meets the
// landmarks. Refuses a warp if the valve folds at one of five openings. The message says whether smoothing the warp helps. Other
// commands check the openings that they use.
Warp warp_to_landmarks(Placed &placed, riis_valve *valve, double noise, Reader reader);

// Refuses landmarks that are far from the given nodes of a mesh, (3, n_nodes). `of`, such as " of mesh.vtu", names the mesh in
// the message. If other axes or another unit would bring the landmarks to the nodes, the message says so.
void check_at_nodes(const LandmarkFile &landmarks, std::int64_t n_nodes, const double *nodes, const std::string &of,
                    Reader reader);

std::string place_report(const Placed &placed, Reader reader);
// placed_file_of returns the file of a placed valve. with_parameters_of returns such a file with the valve's present parameters.
std::string placed_file_of(const Placed &placed, const riis_valve *valve);
std::string with_parameters_of(const std::string &placed_file, const riis_valve *valve);

}  // namespace riis::program
