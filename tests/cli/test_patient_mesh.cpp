// SPDX-License-Identifier: Apache-2.0
// gmsh makes meshes with named boundaries in random vessels whose cut ends are known. The test reads the files itself. If a face
// has only one tetrahedron, it must be in exactly one boundary. In some tests, scripts take the place of gmsh and fail in several
// ways.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "common/array_view.hpp"
#include "cut_tubes.hpp"
#include "program/base/refusal.hpp"
#include "program/patient/patient_mesh.hpp"

namespace {

namespace fs = std::filesystem;
using namespace riis::program;
using namespace riis::tests;
using namespace riis;

template <class Function>
void expect_refused(const std::vector<std::string> &parts, const Function &function) {
  try {
    function();
    expect(false, "it is refused with " + parts[0]);
  } catch (const Refusal &refusal) {
    for (const std::string &part : parts)
      expect(refusal.text.find(part) != std::string::npos, "\"" + refusal.text + "\" has \"" + part + "\"");
  }
}

std::string text_in(const std::string &path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_text_file(const std::string &path, const std::string &text) { std::ofstream(path) << text; }

// A size field has one edge length near the middle of a box, and three times this length at the corners.
void write_field(const std::string &path, const Vector3 &middle, double side, double edge) {
  std::ostringstream text;
  for (const double x : middle) text << x - side / 2 << " ";
  text << "\n" << side / 2 << " " << side / 2 << " " << side / 2 << "\n3 3 3\n";
  for (int i = 0; i < 27; ++i) text << (i == 13 ? edge : 3 * edge) << "\n";
  write_text_file(path, text.str());
}

// The content of mesh.msh.
struct Read {
  std::map<int, std::string> names;
  std::vector<Vector3> points;
  std::vector<std::pair<int, Corners>> triangles;
  std::vector<std::array<std::int64_t, 4>> cells;
};

Read read_msh(const std::string &path) {
  std::ifstream file(path);
  Read read;
  std::string word;
  while (file >> word) {
    std::size_t n = 0;
    if (word == "$MeshFormat") {
      std::string version, type;
      file >> version >> type;
      expect(version == "2.2" && type == "0", "the mesh has the ASCII format 2.2");
    } else if (word == "$PhysicalNames") {
      for (file >> n; n > 0; --n) {
        int dimension = 0, group = 0;
        file >> dimension >> group >> word;
        expect(dimension == (word == "\"blood\"" ? 3 : 2), "only the blood is a volume");
        read.names[group] = word.substr(1, word.size() - 2);
      }
    } else if (word == "$Nodes") {
      for (file >> n; n > 0; --n) {
        Vector3 point;
        file >> word >> point[0] >> point[1] >> point[2];
        read.points.push_back(point);
      }
    } else if (word == "$Elements") {
      for (file >> n; n > 0; --n) {
        int type = 0, n_tags = 0, group = 0, entity = 0;
        file >> word >> type >> n_tags >> group >> entity;
        expect(n_tags == 2 && (type == 2 || type == 4) && read.names.count(group) > 0, "each element has a group");
        std::array<std::int64_t, 4> corner{};
        for (int k = 0; k < (type == 2 ? 3 : 4); ++k) {
          file >> view(corner)[k];
          --view(corner)[k];
        }
        if (type == 2)
          read.triangles.push_back({group, {corner[0], corner[1], corner[2]}});
        else
          read.cells.push_back(corner);
      }
    }
  }
  return read;
}

double volume_of(const std::vector<Vector3> &points, const std::array<std::int64_t, 4> &cell) {
  const Vector3 &a = view(points)[cell[0]];
  return dot(cross(view(points)[cell[1]] - a, view(points)[cell[2]] - a), view(points)[cell[3]] - a) / 6;
}

// Returns the numbers of an array in a VTK file with text.
std::vector<std::int64_t> array_in(const std::string &text, const std::string &type, const std::string &name) {
  const std::size_t at = text.find("type=\"" + type + "\" Name=\"" + name + "\"");
  expect(at != std::string::npos, "the file has the array " + name + " of type " + type);
  std::vector<std::int64_t> numbers;
  if (at == std::string::npos) return numbers;
  const std::size_t begin = text.find('>', at) + 1;
  std::istringstream words(text.substr(begin, text.find('<', begin) - begin));
  for (std::int64_t number; words >> number;) numbers.push_back(number);
  return numbers;
}

void expect_files(const std::string &folder, const PatientMesh &mesh, double unit) {
  const Read read = read_msh(folder + "/mesh.msh");
  expect(static_cast<std::int64_t>(read.points.size()) == mesh.n_nodes, "number of nodes");
  expect(static_cast<std::int64_t>(read.cells.size()) == mesh.n_cells, "number of cells");
  expect(read.names.size() == mesh.boundaries.size() + 1, "number of groups");
  std::map<Corners, std::pair<int, std::int64_t>> outer;  // by sorted corners: the number of cells, and the last cell
  double volume = 0;
  for (std::size_t i = 0; i < read.cells.size(); ++i) {
    const auto &cell = read.cells[i];
    expect(volume_of(read.points, cell) > 0, "each cell has a positive volume");
    volume += volume_of(read.points, cell);
    for (std::size_t k = 0; k < 4; ++k) {
      Corners face{cell[(k + 1) % 4], cell[(k + 2) % 4], cell[(k + 3) % 4]};
      std::sort(face.begin(), face.end());
      ++outer[face].first;
      outer[face].second = static_cast<std::int64_t>(i);
    }
  }
  expect_near(volume / std::pow(unit, 3), mesh.volume / std::pow(unit, 3), 1e-6, "volume");
  std::map<int, double> areas;
  double enclosed = 0;
  for (const auto &[group, corner] : read.triangles) {
    Corners key = corner;
    std::sort(key.begin(), key.end());
    const auto found = outer.find(key);
    if (found == outer.end() || found->second.first != 1) {
      expect(false, "each face of a boundary is a face of one cell");
      break;
    }
    found->second.first = 0;  // a second boundary must not have this face
    const Vector3 &a = view(read.points)[corner[0]], &b = view(read.points)[corner[1]],
                  &c = view(read.points)[corner[2]];
    areas[group] += 0.5 * norm(cross(b - a, c - a));
    enclosed += dot(a - read.points[0], cross(b - a, c - a)) / 6;
  }
  expect(std::none_of(outer.begin(), outer.end(), [](const auto &face) { return face.second.first == 1; }),
         "each outer face of the cells is in a boundary");
  expect_near(enclosed / volume, 1, 1e-9,
              "the volume within the boundaries, which face outwards, over that of the cells");
  const std::string volume_text = text_in(folder + "/mesh.vtu");
  const auto node_ids = array_in(volume_text, "Int32", "GlobalNodeID");
  expect(
      static_cast<std::int64_t>(node_ids.size()) == mesh.n_nodes && node_ids.back() == mesh.n_nodes && node_ids[0] == 1,
      "nodes of mesh.vtu have ids from 1");
  expect(static_cast<std::int64_t>(array_in(volume_text, "Int32", "GlobalElementID").size()) == mesh.n_cells,
         "cells of mesh.vtu have ids");
  for (const Boundary &boundary : mesh.boundaries) {
    expect(read.names.at(boundary.group) == boundary.name, "the group has the boundary's name");
    expect_near(areas[boundary.group] / boundary.area, 1, 1e-9, "area of " + boundary.name);
    const std::string text = text_in(folder + "/faces/" + boundary.name + ".vtp");
    const auto nodes = array_in(text, "Int32", "GlobalNodeID"), cells = array_in(text, "Int32", "GlobalElementID"),
               faces = array_in(text, "Int32", "ModelFaceID"), corners = array_in(text, "Int64", "connectivity");
    expect(static_cast<std::int64_t>(cells.size()) == boundary.n_faces && corners.size() == 3 * cells.size(),
           "number of faces of " + boundary.name);
    expect(std::all_of(faces.begin(), faces.end(), [&](std::int64_t id) { return id == boundary.group; }),
           "faces have the group's number");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto &cell = view(read.cells)[cells[i] - 1];
      for (std::size_t k = 0; k < 3; ++k)
        if (std::count(cell.begin(), cell.end(), view(nodes)[corners[3 * i + k]] - 1) != 1) {
          expect(false, "a face belongs to the cell of its GlobalElementID");
          return;
        }
    }
  }
}

// Makes meshes in random vessels by the gmsh in PATH. Without gmsh nothing calls this function.
[[maybe_unused]] void random_meshes(random_source &random, const std::string &folder) {
  const int n = trials(2, 30);
  for (int trial = 0; trial < n; ++trial) {
    here = "mesh " + std::to_string(trial);
    const int n_ends = trial % 2 == 0 ? 2 : 2 + static_cast<int>(random_bits(&random) % 4);
    const CutVessels vessels =
        draw_vessels(random, n_ends, random_between(&random, 0, 0.05), trial % 2 == 0 ? Cap::open : Cap::fan);
    const double unit = trial % 2 == 0 ? 0.012 : 12;  // metres or millimetres
    const Placement placement = draw_placement(random, unit, 30 * unit);
    write_stl(folder + "/in.stl", vessels.triangles, placement, Turned::all, random);
    write_field(folder + "/sizes.dat", placement.of({}), 16 * unit, 0.35 * unit);
    try {
      PatientWall wall = read_patient_wall(folder + "/in.stl");
      name_ends(wall, placement.of(vessels.axes[0]), placement.turned(-1 * vessels.axes[0]));
      std::vector<std::string> commands;
      const PatientMesh mesh = mesh_patient(wall, {folder, folder + "/sizes.dat", unit,
                                                   [&](const std::string &command) { commands.push_back(command); }});
      expect(commands.size() == 2 && commands[0].rfind("gmsh -2 ", 0) == 0 && commands[1].rfind("gmsh -3 ", 0) == 0,
             "gmsh is started twice, and said");
      expect(mesh.boundaries.size() == static_cast<std::size_t>(n_ends) + 1, "number of boundaries");
      expect(mesh.boundaries[0].name == "inlet" && mesh.boundaries[1].name == "outlet" &&
                 mesh.boundaries.back().name == "wall",
             "names of boundaries");
      if (n_ends > 2) expect(mesh.boundaries[2].name == "outlet_2", "name of the second outlet");
      expect_near(mesh.volume / wall.volume, 1, 0.1, "volume of the mesh over that of the wall");
      expect(mesh.least_quality > 0 && mesh.least_quality < 1, "quality of the worst cell");
      for (const Boundary &boundary : mesh.boundaries) {
        if (boundary.name == "wall") continue;
        const auto same = [&](const CutEnd &a, const CutEnd &b) {
          return norm(placement.of(a.centre) - boundary.centre) < norm(placement.of(b.centre) - boundary.centre);
        };
        const CutEnd &end = *std::min_element(vessels.ends.begin(), vessels.ends.end(), same);
        expect_near(boundary.area / (unit * unit * end.area), 1, 0.04, "area of " + boundary.name);
        expect_near(dot(boundary.outward, placement.turned(end.outward)), 1, 1e-4, "normal of " + boundary.name);
        expect((boundary.name == "inlet") == (&end == &vessels.ends[0]), "the inlet is upstream");
      }
      expect_files(folder, mesh, unit);
      // The boundary of a volume mesh can serve as a wall.
      const PatientWall again = read_patient_wall(folder + "/mesh.vtu");
      expect(again.ends.size() == wall.ends.size(), "the mesh has the ends of the wall");
      expect_near(again.volume / mesh.volume, 1, 1e-9, "volume within the boundary of the mesh");
    } catch (const Refusal &refusal) {
      expect(false, "it is not refused by: " + refusal.text);
    }
  }
}

// Puts a shell script named gmsh first in PATH.
void stand_for_gmsh(const std::string &folder, const std::string &script) {
  fs::create_directories(folder + "/bin");
  write_text_file(folder + "/bin/gmsh", "#!/bin/sh\n" + script + "\n");
  chmod((folder + "/bin/gmsh").c_str(), 0755);
  static const std::string before = std::getenv("PATH");
  setenv("PATH", (folder + "/bin:" + before).c_str(), 1);
}

void failing_programs(random_source &random, const std::string &folder) {
  here = "failing gmsh";
  const CutVessels vessels = draw_vessels(random, 2, 0, Cap::fan);
  const Placement as_it_is = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 1, {}};
  write_stl(folder + "/in.stl", vessels.triangles, as_it_is, Turned::none, random);
  PatientWall wall = read_patient_wall(folder + "/in.stl");
  name_ends(wall, vessels.axes[0], -1 * vessels.axes[0]);
  const PatientMeshOptions options{folder, folder + "/sizes.dat", 1, [](const std::string &) {}, 0};
  const auto mesh = [&] { mesh_patient(wall, options); };
  // The argument after -log is the path of the log, and the argument after -o is the path of the mesh.
  const std::string words = "while [ $# -gt 0 ]; do case $1 in -log) log=$2;; -o) mesh=$2;; esac; shift; done; ";
  stand_for_gmsh(
      folder,
      words +
          "echo 'Error: Field 1: cannot be read' > \"$log\"; echo 'Error:     1 error' >> \"$log\"; touch \"$mesh\"");
  expect_refused({"gmsh fails: Field 1: cannot be read (" + folder +
                  "/gmsh/surface.log); look for overlapping triangles in " + folder + "/in.stl"},
                 mesh);
  stand_for_gmsh(folder, "echo 'no memory' >&2; exit 1");
  expect_refused({"gmsh fails: no memory (" + folder + "/gmsh/surface.log)"}, mesh);
  stand_for_gmsh(folder, "exit 0");
  expect_refused({"gmsh fails: it writes no mesh (" + folder + "/gmsh/surface.log)"}, mesh);
  stand_for_gmsh(folder, "trap '' TERM; exec sleep 1000");
  PatientMeshOptions hasty = options;
  hasty.surface_seconds = 1;
  expect_refused({"gmsh did not end within 1 seconds (" + folder + "/gmsh/surface.log)"},
                 [&] { mesh_patient(wall, hasty); });
  // The mesh of a second try has other nodes.
  stand_for_gmsh(folder, "mkdir '" + folder + "/first' && cp '" + folder + "/gmsh/wall.msh' '" + folder +
                             "/first' && exec sleep 1000\ncmp -s '" + folder + "/first/wall.msh' '" + folder +
                             "/gmsh/wall.msh' || echo 'other nodes' >&2\nexit 1");
  expect_refused({"gmsh fails: other nodes"}, [&] { mesh_patient(wall, hasty); });
  stand_for_gmsh(folder, "kill -9 $$");
  expect_refused({"gmsh fails: a signal ended it"}, mesh);
  stand_for_gmsh(folder,
                 words + "printf '$MeshFormat\\n2.2 0 8\\n$EndMeshFormat\\n$Nodes\\n2\\n1 0 0 0\\n2 1' > \"$mesh\"");
  expect_refused({folder + "/gmsh/surface.msh: ", "the file is incomplete"}, mesh);
  // A wall goes through itself, because a point near the first end was moved through the wall behind it.
  PatientWall crossed = wall;
  const Vector3 axis = unit_vector(vessels.axes[0]), other = cross(axis, Vector3{axis[1], axis[2], axis[0]});
  for (Vector3 &point : crossed.triangles.points) {
    if (std::abs(dot(point, axis) - 3.5) > 0.2 || dot(point, other) < 0.4 * norm(other)) continue;
    point = point - 3.0 * unit_vector(other);
    break;
  }
  expect_refused({"gmsh fails: it writes", "the wall goes through itself at ", " of triangles, the deepest at "}, [&] {
    stand_for_gmsh(folder, "exit 0");
    mesh_patient(crossed, options);
  });
  // This surface has a hole, as a surface from gmsh has if triangles overlap.
  stand_for_gmsh(folder,
                 words +
                     "printf '$MeshFormat\\n2.2 0 8\\n$EndMeshFormat\\n$Nodes\\n3\\n1 0 0 0\\n2 1 0 0\\n3 0 1 0\\n"
                     "$EndNodes\\n$Elements\\n1\\n1 2 2 0 1 1 2 3\\n$EndElements\\n' > \"$mesh\"");
  expect_refused({"gmsh made a surface that is not closed at 3 edges"}, mesh);
  setenv("PATH", (folder + "/faces").c_str(), 1);
  expect_refused({"gmsh: there is no such program in PATH", "'sudo apt-get install gmsh' installs it"},
                 [] { require_gmsh(); });

  here = "failing files";
  expect_refused({"/dev/full: cannot be written: No space left on device"}, [&] { write_wall(wall, "/dev/full"); });
  PatientMeshOptions bad = options;
  bad.folder = folder + "/in.stl";
  expect_refused({folder + "/in.stl/gmsh: the folder cannot be made: Not a directory"},
                 [&] { mesh_patient(wall, bad); });
  bad = options;
  bad.field = "a\"b";
  expect_refused({"a\"b: gmsh does not read a path with a quotation mark"}, [&] { mesh_patient(wall, bad); });
}

}  // namespace

int main() {
  random_source random = random_start("test_patient_mesh");
  const std::string folder = fs::absolute("patient_mesh_" + std::to_string(getpid())).string();
  fs::create_directories(folder);
#ifdef RIIS_GMSH
  random_meshes(random, folder);
#else
  std::printf("gmsh is missing: no mesh is made\n");
#endif
  failing_programs(random, folder);
  fs::remove_all(folder);
  return n_faults == 0 ? 0 : 1;
}
