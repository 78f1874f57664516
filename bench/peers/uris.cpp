// SPDX-License-Identifier: Apache-2.0
// ./run uris: reads exports and marks the nodes of a cylinder by the rule of svMultiPhysics. By this rule, a node's distance is
// the distance to the nearest middle of a triangle. The program compares these distances with the library's distances to the
// triangles themselves. The program prints rows of the table in docs/export.md.
//   argv[1]   the kind of the valve
//   argv[2]   thousands of nodes
//   argv[3..] the output of riis export
#include <vtkCell.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "shared/cylinder.hpp"
#include "shared/middles.hpp"
#include "shared/vtk_reference.hpp"

namespace {

using namespace bench;

constexpr double pi = 3.14159265358979323846;
// This cylinder contains the bileaflet valve, closed and open.
constexpr Cylinder prosthesis_cylinder{1.6, -1.0, 1.6, 0};

[[noreturn]] void give_up(const std::string &text) {
  std::fprintf(stderr, "riis_bench_uris: %s\n", text.c_str());
  std::exit(1);
}

// Triangles in one state: their corners, (3, 3, n).
using Corners = std::vector<double>;

// The solver's input in one state: the leaflets' triangles, and all nodes. These nodes include the nodes of the face that
// enlarges the solver's box.
struct State {
  Corners leaflets, nodes;
};

struct Export {
  State closed, open;
  double thickness = 0;
};

// Returns the values of all elements with this name, without blanks.
std::vector<std::string> values_of(const std::string &block, const std::string &element) {
  std::vector<std::string> values;
  const std::string tag = "<" + element + ">";
  for (std::size_t at = block.find(tag); at != std::string::npos; at = block.find(tag, at)) {
    at += tag.size();
    std::string value = block.substr(at, block.find('<', at) - at);
    value.erase(std::remove_if(value.begin(), value.end(), [](unsigned char c) { return std::isspace(c) != 0; }),
                value.end());
    values.push_back(value);
  }
  return values;
}

struct Frames {
  std::int64_t n_nodes = 0;
  std::vector<double> first, last;
};

Frames frames_of(const std::string &path) {
  std::ifstream file(path);
  std::int64_t n_frames = 0;
  Frames frames;
  if (!(file >> n_frames >> frames.n_nodes) || n_frames < 1 || frames.n_nodes < 1) give_up(path + ": no two counts");
  for (std::int64_t k = 0; k < n_frames; ++k) {
    frames.last.clear();
    for (std::int64_t i = 0; i < 3 * frames.n_nodes; ++i) {
      double x = 0;
      if (!(file >> x)) give_up(path + ": ends early");
      frames.last.push_back(x);
    }
    if (k == 0) frames.first = frames.last;
  }
  return frames;
}

bool ends_with(const std::string &text, const std::string &end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void add_face(const std::string &vtu, const Frames &frames, Export &all) {
  all.closed.nodes.insert(all.closed.nodes.end(), frames.first.begin(), frames.first.end());
  all.open.nodes.insert(all.open.nodes.end(), frames.last.begin(), frames.last.end());
  if (ends_with(vtu, "/box.vtu")) return;
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(vtu.c_str());
  reader->Update();
  vtkUnstructuredGrid *grid = reader->GetOutput();
  if (grid->GetNumberOfPoints() != frames.n_nodes) give_up(vtu + ": other nodes than its motion");
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    vtkCell *cell = grid->GetCell(i);
    if (cell->GetNumberOfPoints() != 3) give_up(vtu + ": a cell is no triangle");
    for (vtkIdType k = 0; k < 9; ++k) {
      const auto at = static_cast<std::size_t>(3 * cell->GetPointId(static_cast<int>(k / 3)) + k % 3);
      all.closed.leaflets.push_back(frames.first[at]);
      all.open.leaflets.push_back(frames.last[at]);
    }
  }
}

Export read_export(const std::string &path) {
  std::ifstream file(path);
  const std::string block{std::istreambuf_iterator<char>(file), {}};
  const std::vector<std::string> faces = values_of(block, "Face_file_path"),
                                 motions = values_of(block, "Open_motion_file_path"),
                                 thickness = values_of(block, "Thickness");
  if (faces.empty() || faces.size() != motions.size() || thickness.size() != 1) give_up(path + ": no Add_URIS_mesh");
  Export read;
  read.thickness = std::strtod(thickness[0].c_str(), nullptr);
  for (std::size_t i = 0; i < faces.size(); ++i) add_face(faces[i], frames_of(motions[i]), read);
  return read;
}

State state_at(const char *kind, double opening) {
  const Valve valve = make_valve(kind);
  check(riis_valve_set_scalar(valve.get(), "opening", opening));
  const Corners corners = Triangles(make_surface(valve.get()).get()).corners;
  return {corners, corners};
}

// Returns the library's distances from nodes to these triangles. Beyond the half thickness the distance is infinity.
std::vector<double> distances_by_library(const Corners &corners, double half_thickness, const CylinderNodes &nodes) {
  std::vector<std::int64_t> ids(corners.size() / 3);
  std::iota(ids.begin(), ids.end(), 0);
  riis_surface_arrays arrays;
  check(riis_surface_arrays_init(&arrays, sizeof arrays));
  arrays.n_vertices = static_cast<std::int64_t>(ids.size());
  arrays.x = corners.data(), arrays.y = corners.data() + 1, arrays.z = corners.data() + 2;
  arrays.stride = 3;
  arrays.n_faces = arrays.n_vertices / 3;
  arrays.vertex_ids = ids.data();
  arrays.id_bits = 64;
  const Surface surface = make_surface(arrays, half_thickness);
  const Mesh mesh = mesh_over(nodes);
  const Result result = make_result();
  check(riis_mark_nodes(surface.get(), mesh.get(), nullptr, result.get()));
  std::vector<double> distance(static_cast<std::size_t>(nodes.n_nodes()));
  get_distances(result.get(), std::numeric_limits<double>::infinity(), distance);
  return distance;
}

double longest_edge(const Corners &corners) {
  double longest = 0;
  for (std::size_t i = 0; i < corners.size(); i += 9) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double *p = &corners[i + 3 * k], *q = &corners[i + 3 * ((k + 1) % 3)];
      longest = std::max(longest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
  }
  return longest;
}

// Tests whether a node is in the solver's box. The solver widens the bounding box of the faces' nodes by a tenth on each side.
class SolverBox {
 public:
  explicit SolverBox(const std::vector<double> &xyz) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower_[k] = upper_[k] = xyz[k];
      for (std::size_t i = k; i < xyz.size(); i += 3) {
        lower_[k] = std::min(lower_[k], xyz[i]);
        upper_[k] = std::max(upper_[k], xyz[i]);
      }
      const double more = 0.1 * (upper_[k] - lower_[k]);
      lower_[k] -= more;
      upper_[k] += more;
    }
  }
  bool has(const double *p) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < lower_[k] || p[k] > upper_[k]) return false;
    return true;
  }

 private:
  std::array<double, 3> lower_{}, upper_{};
};

double delta(double distance, double thickness) {
  return distance < thickness ? (1 + std::cos(pi * distance / thickness)) / (2 * thickness) : 0;
}

// Checks that a loop over all middles finds the same distances as VTK's point locator.
void check_locator(const std::vector<double> &middles, const std::vector<double> &xyz,
                   const std::vector<double> &found) {
  constexpr std::int64_t n_checked = 100;
  const std::int64_t n = static_cast<std::int64_t>(found.size());
  for (std::int64_t i = 0; i < n; i += 1 + n / n_checked) {
    double distance = 0;
    distances_to_middles(middles, 1, xyz.data() + 3 * i, &distance);
    if (std::abs(distance - found[static_cast<std::size_t>(i)]) > 1e-12) give_up("the point locator is wrong");
  }
}

void print_row(const std::string &valve, const std::string &cut, const State &state, double thickness,
               const CylinderNodes &nodes) {
  const Corners &corners = state.leaflets;
  const std::vector<double> distance = distances_by_library(corners, thickness, nodes);
  std::vector<double> marked, truth, middles;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (!(distance[i] <= thickness)) continue;
    marked.insert(marked.end(), nodes.xyz().begin() + static_cast<std::ptrdiff_t>(3 * i),
                  nodes.xyz().begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    truth.push_back(distance[i]);
  }
  for (std::size_t i = 0; i < corners.size(); i += 9)
    for (std::size_t k = 0; k < 3; ++k)
      middles.push_back((corners[i + k] + corners[i + 3 + k] + corners[i + 6 + k]) / 3);
  std::vector<double> by_rule(truth.size());
  VtkPoints(middles).distances(static_cast<std::int64_t>(truth.size()), marked.data(), 1e3, by_rule.data());
  check_locator(middles, marked, by_rule);
  const SolverBox box(state.nodes);
  double sum = 0, sum_by_rule = 0, excess = 0;
  std::int64_t n_lost = 0, n_outside = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sum += delta(truth[i], thickness);
    sum_by_rule += delta(by_rule[i], thickness);
    n_lost += by_rule[i] > thickness;
    n_outside += !box.has(&marked[3 * i]);
    excess = std::max(excess, by_rule[i] - truth[i]);
  }
  const double n = static_cast<double>(truth.size());
  std::printf("| %s | %s | %zu | %.2f | %zu | %.2f %% | %.2f %% | %.3f | %lld |\n", valve.c_str(), cut.c_str(),
              corners.size() / 9, longest_edge(corners) / thickness, truth.size(),
              100 * static_cast<double>(n_lost) / n, 100 * (1 - sum_by_rule / sum), excess / thickness,
              static_cast<long long>(n_outside));
}

}  // namespace

int main(int argc, char **argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: %s KIND THOUSANDS_OF_NODES BLOCK...\n", argv[0]);
    return 2;
  }
  const char *const kind = argv[1];
  const std::string name = kind;
  const Cylinder cylinder = name == "mitral" ? cylinders[1] : name == "bileaflet" ? prosthesis_cylinder : cylinders[0];
  const CylinderNodes nodes(cylinder, n_nodes_given(argc, argv, 2, 1));
  const double half_thickness = 0.1;
  const auto print = [&](const std::string &cut, const State &closed, const State &open) {
    print_row(name + ", closed", cut, closed, half_thickness, nodes);
    print_row(name + ", open", cut, open, half_thickness, nodes);
  };
  print("not exported", state_at(kind, 0), state_at(kind, 1));
  for (int i = 3; i < argc; ++i) {
    const Export read = read_export(argv[i]);
    if (read.thickness != half_thickness) give_up(std::string(argv[i]) + ": another Thickness than 0.1");
    const std::string path = argv[i];
    const std::size_t begin = path.rfind('_') + 1;
    print(path.substr(begin, path.rfind('.') - begin), read.closed, read.open);
  }
  return 0;
}
