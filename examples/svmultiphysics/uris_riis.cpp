// SPDX-License-Identifier: Apache-2.0
// This file makes riis the valve engine of svMultiPhysics. riis.cmake compiles it into the solver, and gives the solver's own two
// functions the names sv_calc_sdf and sv_factors. README.md explains this, and names the cases that were run.
//
//   uris_calc_sdf                      once a time step: distances, signs and velocities at the nodes
//   eval_uris_ris_factors_quadrature   in each iteration: K and K u_valve at the Gauss points of an element
//
// The environment variable URIS_ENGINE chooses the engine:
//   riis       the default
//   distances  the distances of riis at the nodes, from which the solver interpolates its K
//   solver     both functions of the solver
#include "uris.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <riis/riis.hpp>

namespace uris {

// sv_calc_sdf and sv_factors are in the solver's uris.cpp, but not in its uris.h.
void sv_calc_sdf(ComMod &com_mod);
void sv_factors(const ComMod &com_mod, const mshType &mesh, const fsType &space, const int element, Vector<double> &K,
                Array<double> &K_u);
void uris_compute_expanded_bbox(const Array<double> &x, const int nsd, const double expansion, Vector<double> &low,
                                Vector<double> &high);

namespace {

// The triangles of a valve's faces, or of its scaffold.
struct Triangles {
  riis::Surface surface;
  riis::Surface middles;         // the triangles shrunk about their middles
  std::vector<int32_t> corners;  // (3, n): numbers of vertices
  std::vector<int32_t> face;     // (n): the number of the face, ...
  std::vector<int32_t> element;  // (n): ... and the triangle's number in it
};

struct Valve {
  Triangles leaflets, scaffold;
  double half_thickness = 0;  // of the leaflets in this step
  int shown = -1;             // the frame and the direction of the motion
};

// The Gauss points of a mesh in one function space, and the sums of K and K u_valve over all valves.
struct Points {
  const mshType *mesh;
  int n_gauss, n_functions;
  std::vector<int64_t> first;     // (n_elements): the element's first point; -1 in a solid
  std::vector<double> x, K, K_u;  // (3, n), (n), (3, n)
  riis::Mesh handle;
  int64_t motion = -1;  // Engine::motion at the last marking
};

struct Engine {
  std::vector<Valve> valves;
  std::vector<std::unique_ptr<Points>> spaces;
  int64_t motion = 0;  // counts the steps in which a valve moved or its band changed
};
Engine engine;

enum class Choice { riis, distances, solver };
Choice choice() {
  static const Choice chosen = [] {
    const char *word = std::getenv("URIS_ENGINE");
    const std::string name = word ? word : "riis";
    if (name == "riis") return Choice::riis;
    if (name == "distances") return Choice::distances;
    if (name == "solver") return Choice::solver;
    throw std::runtime_error("URIS_ENGINE is '" + name + "', and must be riis, distances or solver");
  }();
  return chosen;
}

// ---- Triangles ----

// Adds the triangles of a face. An export of riis has triangles that only enlarge the solver's box of nodes, and that are not
// leaflets. In every frame, the middle of such a triangle is the middle of an earlier triangle. Leaflets may touch in a closed
// valve, so the middles of two frames are compared. `frames` contains the vertices in these frames, and `middles` contains the
// earlier middles.
void add_face(Triangles &triangles, const mshType &face, int number, const std::vector<const Array<double> *> &frames,
              std::set<std::vector<int64_t>> &middles) {
  if (face.eNoN != 3) throw std::runtime_error("riis: the face " + face.name + " of a valve must consist of triangles");
  double size = 0;
  for (const Array<double> *x : frames) {
    for (int i = 0; i < 3 * x->ncols(); ++i) size = std::max(size, std::abs(x->data()[i]));
  }
  const double cell = 1e-7 * size;  // far above the rounding of coordinates, and far below the edges
  for (int e = 0; e < face.nEl; ++e) {
    std::vector<int64_t> middle;
    for (const Array<double> *x : frames) {
      for (int k = 0; k < 3; ++k) {
        const double sum = (*x)(k, face.IEN(0, e)) + (*x)(k, face.IEN(1, e)) + (*x)(k, face.IEN(2, e));
        middle.push_back(std::llround(sum / cell));
      }
    }
    if (!middles.insert(middle).second) continue;
    for (int a = 0; a < 3; ++a) triangles.corners.push_back(face.IEN(a, e));
    triangles.face.push_back(number);
    triangles.element.push_back(e);
  }
}

// Gives riis the triangles at the vertices x. v is null, or contains the velocities of the vertices.
void place(riis::Surface &surface, const Triangles &triangles, const std::vector<int32_t> &corners, int n_vertices,
           const double *x, const double *v, double half_thickness) {
  auto arrays = riis::defaults<riis_surface_arrays>();
  arrays.n_vertices = n_vertices;
  arrays.x = x;
  arrays.y = x + 1;
  arrays.z = x + 2;
  arrays.stride = 3;
  if (v) {
    arrays.vx = v;
    arrays.vy = v + 1;
    arrays.vz = v + 2;
    arrays.velocity_stride = 3;
  }
  arrays.real_bits = 64;
  arrays.n_faces = static_cast<int64_t>(triangles.face.size());
  arrays.vertex_ids = corners.data();
  arrays.id_bits = 32;
  arrays.leaflet_id = triangles.face.data();
  auto options = riis::defaults<riis_surface_options>();
  options.half_thickness = half_thickness;
  options.zero_area = RIIS_ZERO_AREA_SKIP;  // files of other programs may fold a triangle in one frame
  options.n_threads = 1;
  riis::check(surface ? riis_surface_update_from_arrays(surface, &arrays, &options)
                      : riis_surface_create_from_arrays(&arrays, &options, surface.out()));
}

// Shrinks each triangle to 1e-9 of its size. The nearest small triangle is the triangle with the nearest middle.
void place_middles(Triangles &triangles, const Array<double> &x, double half_thickness) {
  std::vector<double> small(3 * triangles.corners.size());
  std::vector<int32_t> corners(triangles.corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    const int32_t *triangle = &triangles.corners[i / 3 * 3];
    corners[i] = static_cast<int32_t>(i);
    for (int k = 0; k < 3; ++k) {
      const double middle = (x(k, triangle[0]) + x(k, triangle[1]) + x(k, triangle[2])) / 3;
      small[3 * i + k] = middle + 1e-9 * (x(k, triangles.corners[i]) - middle);
    }
  }
  place(triangles.middles, triangles, corners, static_cast<int>(corners.size()), small.data(), nullptr, half_thickness);
}

// ---- Nodes ----

// Returns the nodes of fluids in the solver's box, which is a tenth wider than the surface's vertices.
std::vector<int64_t> nodes_in_box(const ComMod &com_mod, const Array<double> &vertices) {
  Vector<double> low(3), high(3);
  uris_compute_expanded_bbox(vertices, 3, 0.1, low, high);
  std::vector<int64_t> nodes;
  for (int node = 0; node < com_mod.tnNo; ++node) {
    bool inside = com_mod.urisFluidNodeMask[node];
    for (int k = 0; k < 3; ++k) {
      const double place = com_mod.x(k, node);
      inside = inside && place >= low(k) && place <= high(k);
    }
    if (inside) nodes.push_back(node);
  }
  return nodes;
}

struct Closest {
  std::vector<double> distance, weight;  // (n), (3, n)
  std::vector<int64_t> triangle;         // (n)
};

// Finds the closest point to each of the nodes. The results have an entry for every node.
Closest closest_points(const ComMod &com_mod, const riis_surface *surface, const std::vector<int64_t> &nodes) {
  Closest closest{std::vector<double>(com_mod.tnNo), std::vector<double>(3 * com_mod.tnNo),
                  std::vector<int64_t>(com_mod.tnNo)};
  if (nodes.empty()) return closest;
  auto points = riis::defaults<riis_points>();
  const double *x = com_mod.x.data();
  points.n_points = com_mod.tnNo;
  points.x = x;
  points.y = x + 1;
  points.z = x + 2;
  points.stride = 3;
  points.real_bits = 64;
  auto options = riis::defaults<riis_closest_options>();
  options.n_point_ids = static_cast<int64_t>(nodes.size());
  options.point_ids = nodes.data();
  options.n_threads = 1;
  auto arrays = riis::defaults<riis_closest_arrays>();
  arrays.distance = closest.distance.data();
  arrays.barycentric = closest.weight.data();
  arrays.triangle_id = closest.triangle.data();
  riis::check(riis_closest_points(surface, &points, &options, &arrays));
  return closest;
}

// Sets the distances to the leaflets and the leaflets' velocity at the nodes. The sign of the distances decides when the valve
// opens. The sign therefore follows the solver's rule: the triangle with the nearest middle decides.
void set_nodes(const ComMod &com_mod, urisType &uris, const Triangles &leaflets) {
  const auto nodes = nodes_in_box(com_mod, uris.x);
  const Closest exact = closest_points(com_mod, leaflets.surface, nodes);
  const Closest middles = closest_points(com_mod, leaflets.middles, nodes);
  uris.sdf = uris.sdf_default;
  if (uris.include_uris_velocity) uris.valve_velocity_fluid = 0.0;
  Vector<double> middle(3), normal(3);
  for (const int64_t id : nodes) {
    const int node = static_cast<int>(id);
    const int64_t t = middles.triangle[node];
    surface_element_barycenter(uris, leaflets.face[t], leaflets.element[t], middle);
    uris_face_unit_normal(uris, 3, leaflets.face[t], leaflets.element[t], normal);
    const Vector<double> place = com_mod.x.col(node);
    uris.sdf(node) = uris_compute_sdf_sign(uris, place, middle, (place - middle) * normal) * exact.distance[node];
    if (!uris.include_uris_velocity) continue;
    for (int a = 0; a < 3; ++a) {
      const int vertex = leaflets.corners[3 * exact.triangle[node] + a];
      for (int k = 0; k < 3; ++k) {
        uris.valve_velocity_fluid(k, node) += exact.weight[3 * node + a] * uris.valve_velocity(k, vertex);
      }
    }
  }
}

// ---- Time steps ----

// Reads the triangles of a valve, and sets the distances to its scaffold, which does not move.
void start_valve(const ComMod &com_mod, urisType &uris, Valve &valve) {
  const Array<double> first = uris.DxOpen.rslice(0), last = uris.DxOpen.rslice(uris.DxOpen.nslices() - 1);
  std::set<std::vector<int64_t>> middles;
  size_t n_read = 0;
  for (int f = 0; f < uris.nFa; ++f) {
    add_face(valve.leaflets, uris.msh[f], f, {&first, &last}, middles);
    n_read += uris.msh[f].nEl;
  }
  const size_t n_leaflets = valve.leaflets.face.size();
  if (com_mod.cm.idcm() == 0) {
    std::cout << "riis: the valve " << uris.name << " has " << n_leaflets << " triangles; " << n_read - n_leaflets
              << " others only widen the solver's box" << std::endl;
  }
  uris.sdf_computed = true;
  if (uris.include_uris_velocity) uris.valve_velocity_fluid.resize(3, com_mod.tnNo);
  if (!uris.scaffold_flag) return;
  const Array<double> &x = uris.scaffold_msh.x;
  middles.clear();
  add_face(valve.scaffold, uris.scaffold_msh, 0, {&x}, middles);
  place(valve.scaffold.surface, valve.scaffold, valve.scaffold.corners, x.ncols(), x.data(), nullptr,
        uris.sdf_deps_close);
  const auto nodes = nodes_in_box(com_mod, x);
  const Closest closest = closest_points(com_mod, valve.scaffold.surface, nodes);
  uris.scaffold_udf.resize(com_mod.tnNo);
  uris.scaffold_udf = uris.sdf_default;
  for (const int64_t node : nodes) uris.scaffold_udf(static_cast<int>(node)) = closest.distance[node];
  uris.scaffold_udf_computed = true;
}

// Returns the half thickness of the leaflets, which grows or shrinks in equal steps during a motion, as in the solver.
double half_thickness(const urisType &uris, int n_frames) {
  const double from = uris.clsFlg ? uris.sdf_deps : uris.sdf_deps_close;
  const double to = uris.clsFlg ? uris.sdf_deps_close : uris.sdf_deps;
  return uris.cnt >= n_frames ? to : from + static_cast<double>(uris.cnt) / n_frames * (to - from);
}

// Moves a valve to its frame in this step. Returns false if nothing has changed, as for a valve at rest.
bool show_frame(const ComMod &com_mod, urisType &uris, Valve &valve) {
  const Array3<double> &frames = uris.clsFlg ? uris.DxClose : uris.DxOpen;
  const int n_frames = frames.nslices();
  const bool rests = uris.cnt > n_frames;
  const int frame = rests ? n_frames : uris.cnt;
  // In the step that shows the last frame, the velocity is that of this frame. Afterwards it is 0.
  const int shown = 2 * (rests ? n_frames + 1 : frame) + uris.clsFlg;
  if (shown == valve.shown) return false;
  valve.shown = shown;

  uris.x = frames.rslice(frame - 1);
  const double *velocity = nullptr;
  if (uris.include_uris_velocity) {
    uris.x_prev = frames.rslice(rests || frame == 1 ? frame - 1 : frame - 2);
    for (int vertex = 0; vertex < uris.tnNo; ++vertex) {
      for (int k = 0; k < 3; ++k) {
        uris.valve_velocity(k, vertex) = (uris.x(k, vertex) - uris.x_prev(k, vertex)) / com_mod.dt;
      }
    }
    velocity = uris.valve_velocity.data();
  }
  valve.half_thickness = half_thickness(uris, n_frames);
  // If the half thickness of a valve shrinks to 0, the valve has no K, but the solver still needs its distances.
  const double thickness = valve.half_thickness > 0 ? valve.half_thickness : uris.sdf_deps_close;
  place(valve.leaflets.surface, valve.leaflets, valve.leaflets.corners, uris.tnNo, uris.x.data(), velocity, thickness);
  place_middles(valve.leaflets, uris.x, thickness);
  set_nodes(com_mod, uris, valve.leaflets);
  return true;
}

// ---- Gauss points ----

// Makes the points of a mesh in a function space, in reference coordinates, which the solver's distances also use. The elements
// of a solid have no points, because the solver requests their K but does not use it.
std::unique_ptr<Points> make_points(const ComMod &com_mod, const mshType &mesh, const fsType &space) {
  auto points = std::make_unique<Points>();
  points->mesh = &mesh;
  points->n_gauss = space.nG;
  points->n_functions = space.eNoN;
  for (int e = 0; e < mesh.nEl; ++e) {
    bool fluid = true;
    for (int a = 0; a < mesh.eNoN; ++a) fluid = fluid && com_mod.urisFluidNodeMask[mesh.IEN(a, e)];
    points->first.push_back(fluid ? static_cast<int64_t>(points->x.size() / 3) : -1);
    for (int g = 0; fluid && g < space.nG; ++g) {
      for (int k = 0; k < 3; ++k) {
        double sum = 0;
        for (int a = 0; a < space.eNoN; ++a) sum += space.N(a, g) * com_mod.x(k, mesh.IEN(a, e));
        points->x.push_back(sum);
      }
    }
  }
  const double *x = points->x.data();
  riis::check(riis_mesh_create(static_cast<int64_t>(points->x.size() / 3), x, x + 1, x + 2, 3, points->handle.out()));
  return points;
}

// Adds K and K u_valve of a surface to the points. A surface without velocities is at rest.
void add_resistance(const riis_surface *surface, double R, bool has_velocities, Points &points, riis_marks *marks) {
  auto options = riis::defaults<riis_mark_options>();
  options.fields = has_velocities ? RIIS_FIELD_VELOCITY : 0;
  options.n_threads = 1;
  riis::check(riis_mark_nodes(surface, points.handle, &options, marks));
  auto resistance = riis::defaults<riis_resistance>();
  resistance.R = R;
  auto arrays = riis::defaults<riis_resistance_arrays>();
  arrays.n_nodes = static_cast<int64_t>(points.K.size());
  arrays.K = points.K.data();
  for (int k = 0; has_velocities && k < 3; ++k) arrays.K_u_surface[k] = points.K_u.data() + k;
  arrays.K_u_surface_stride = 3;
  riis::check(riis_marks_add_resistance(marks, &resistance, &arrays));
}

// Returns the points of a mesh in a function space, with the sums of this step.
const Points &marked_points(const ComMod &com_mod, const mshType &mesh, const fsType &space) {
  auto &spaces = engine.spaces;
  auto found = std::find_if(spaces.begin(), spaces.end(), [&](const auto &points) {
    return points->mesh == &mesh && points->n_gauss == space.nG && points->n_functions == space.eNoN;
  });
  if (found == spaces.end()) found = spaces.insert(spaces.end(), make_points(com_mod, mesh, space));
  Points &points = **found;
  if (points.motion == engine.motion) return points;
  points.motion = engine.motion;
  points.K.assign(points.x.size() / 3, 0);
  points.K_u.assign(points.x.size(), 0);
  if (points.K.empty()) return points;  // a solid's mesh
  riis::Marks marks;
  riis::check(riis_marks_create(marks.out()));
  for (size_t i = 0; i < engine.valves.size(); ++i) {
    const Valve &valve = engine.valves[i];
    const urisType &uris = com_mod.uris[i];
    if (valve.half_thickness > 0) {
      add_resistance(valve.leaflets.surface, uris.resistance, uris.include_uris_velocity, points, marks);
    }
    if (valve.scaffold.surface) add_resistance(valve.scaffold.surface, uris.resistance, false, points, marks);
  }
  return points;
}

}  // namespace

void uris_calc_sdf(ComMod &com_mod) {
  if (choice() == Choice::solver) return sv_calc_sdf(com_mod);
  if (com_mod.nsd != 3) throw std::runtime_error("riis: valves need three dimensions");
  // The solver resets sdf_computed if it has new nodes: at its start, and when it makes a new mesh.
  bool other_nodes = engine.valves.size() != com_mod.uris.size();
  for (const urisType &uris : com_mod.uris) other_nodes = other_nodes || !uris.sdf_computed;
  if (other_nodes) {
    engine.valves.clear();
    engine.valves.resize(com_mod.uris.size());
    engine.spaces.clear();
    com_mod.urisFluidNodeMask.clear();  // the solver sets nodes to 1 and never to 0
    uris_build_fluid_node_mask(com_mod);
    for (size_t i = 0; i < engine.valves.size(); ++i) start_valve(com_mod, com_mod.uris[i], engine.valves[i]);
  }
  bool moved = false;
  for (size_t i = 0; i < engine.valves.size(); ++i) {
    moved = show_frame(com_mod, com_mod.uris[i], engine.valves[i]) || moved;
  }
  engine.motion += moved;
}

void eval_uris_ris_factors_quadrature(const ComMod &com_mod, const mshType &mesh, const fsType &space,
                                      const int element, Vector<double> &K, Array<double> &K_u) {
  if (choice() != Choice::riis) return sv_factors(com_mod, mesh, space, element, K, K_u);
  K.resize(space.nG);
  K_u.resize(3, space.nG);
  K = 0.0;
  K_u = 0.0;
  if (!com_mod.urisActFlag) return;
  const Points &points = marked_points(com_mod, mesh, space);
  const int64_t first = points.first[element];
  if (first < 0) return;
  std::copy_n(&points.K[first], space.nG, K.data());
  std::copy_n(&points.K_u[3 * first], 3 * space.nG, K_u.data());
}

}  // namespace uris
