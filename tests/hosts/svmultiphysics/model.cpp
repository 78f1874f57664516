// SPDX-License-Identifier: Apache-2.0
// Runs time steps of a small model of svMultiPhysics with valves, for examples/svmultiphysics/uris_riis.cpp and uris_check.cpp.
// The functions of the solver that these files call are rewritten here.
//   model CASE   beat     a valve with a box, a scaffold, a ramp of the half thickness and a solid beside the fluid
//                two      two valves, of which one is scaled and has no velocities
//                remesh   a beat with other nodes from step 9 on
//                vanish   a half thickness of 0 in the open valve
//                quads    a face with four corners, which is refused
// The program's output is the tables of uris_check.cpp.
#include "uris.h"

#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <stdexcept>

namespace uris {

void sv_calc_sdf(ComMod &com_mod);
void sv_factors(const ComMod &com_mod, const mshType &mesh, const fsType &space, const int element, Vector<double> &K,
                Array<double> &K_u);
void uris_compute_expanded_bbox(const Array<double> &x, const int nsd, const double expansion, Vector<double> &low,
                                Vector<double> &high);

// A node belongs to the fluid if at least one of its elements belongs to the fluid.
void uris_build_fluid_node_mask(ComMod &com_mod) {
  com_mod.urisFluidNodeMask.resize(com_mod.tnNo, false);
  for (const mshType &mesh : com_mod.msh) {
    for (int e = 0; mesh.name == "fluid" && e < mesh.nEl; ++e) {
      for (int a = 0; a < mesh.eNoN; ++a) com_mod.urisFluidNodeMask[mesh.IEN(a, e)] = true;
    }
  }
}

void uris_compute_expanded_bbox(const Array<double> &x, const int nsd, const double expansion, Vector<double> &low,
                                Vector<double> &high) {
  for (int k = 0; k < nsd; ++k) {
    double least = x(k, 0), largest = x(k, 0);
    for (int j = 1; j < x.ncols(); ++j) {
      least = std::min(least, x(k, j));
      largest = std::max(largest, x(k, j));
    }
    const double more = expansion * (largest > least ? largest - least : 1);
    low(k) = least - more;
    high(k) = largest + more;
  }
}

void surface_element_barycenter(const urisType &uris, int face, int element, Vector<double> &middle) {
  for (int k = 0; k < 3; ++k) {
    middle(k) = 0;
    for (int a = 0; a < 3; ++a) middle(k) += uris.x(k, uris.msh[face].IEN(a, element));
    middle(k) /= 3;
  }
}

void uris_face_unit_normal(const urisType &uris, const int nsd, const int face, const int element,
                           Vector<double> &normal) {
  Vector<double> corner[3];
  for (int a = 0; a < nsd; ++a) corner[a] = uris.x.col(uris.msh[face].IEN(a, element));
  const Vector<double> p = corner[1] - corner[0], q = corner[2] - corner[0];
  for (int k = 0; k < 3; ++k) normal(k) = p((k + 1) % 3) * q((k + 2) % 3) - p((k + 2) % 3) * q((k + 1) % 3);
  const double length = std::sqrt(normal * normal);
  for (int k = 0; k < 3; ++k) normal(k) /= length;
}

double uris_compute_sdf_sign(const urisType &uris, const Vector<double> &place, const Vector<double> &middle,
                             const double above) {
  if (uris.clsFlg) return (place - middle) * uris.nrm < 0 && above < 0 ? -1 : 1;
  return above < 0 ? -1 : 1;
}

// The nearest middle of a triangle counts. If several middles are equally near, the first counts.
void sv_calc_sdf(ComMod &com_mod) {
  if (com_mod.urisFluidNodeMask.empty()) uris_build_fluid_node_mask(com_mod);
  for (urisType &uris : com_mod.uris) {
    const Array3<double> &frames = uris.clsFlg ? uris.DxClose : uris.DxOpen;
    const int frame = std::min(uris.cnt, frames.nslices());
    uris.x = frames.rslice(frame - 1);
    if (frame < uris.cnt && uris.sdf_computed) continue;
    uris.sdf.resize(com_mod.tnNo);
    uris.sdf = uris.sdf_default;
    uris.sdf_computed = true;
    Vector<double> low(3), high(3), middle(3), nearest(3), normal(3);
    uris_compute_expanded_bbox(uris.x, 3, 0.1, low, high);
    for (int node = 0; node < com_mod.tnNo; ++node) {
      const Vector<double> place = com_mod.x.col(node);
      bool inside = com_mod.urisFluidNodeMask[node];
      for (int k = 0; k < 3; ++k) inside = inside && place(k) >= low(k) && place(k) <= high(k);
      if (!inside) continue;
      double least = std::numeric_limits<double>::infinity();
      for (int f = 0; f < uris.nFa; ++f) {
        for (int e = 0; e < uris.msh[f].nEl; ++e) {
          surface_element_barycenter(uris, f, e, middle);
          const double squared = (place - middle) * (place - middle);
          if (squared >= least) continue;
          least = squared;
          nearest = middle;
          uris_face_unit_normal(uris, 3, f, e, normal);
        }
      }
      const double sign = uris_compute_sdf_sign(uris, place, nearest, (place - nearest) * normal);
      uris.sdf(node) = sign * std::sqrt(least);
    }
  }
}

// Gives constant values, because the test only needs to see that this function was called.
void sv_factors(const ComMod &, const mshType &, const fsType &space, const int, Vector<double> &K,
                Array<double> &K_u) {
  K.resize(space.nG);
  K = 1.0;
  K_u.resize(3, space.nG);
}

}  // namespace uris

namespace {

// A box of tetrahedra from (-1, -1, -1) to (1.5, 1, 1.5), whose inner nodes are shifted at random. The part with x above 1 is a
// solid.
void make_mesh(ComMod &com_mod, int n, unsigned seed) {
  const int size[3] = {5 * n / 4, n, 5 * n / 4};
  auto node = [&](int i, int j, int k) { return i + (size[0] + 1) * (j + (size[1] + 1) * k); };
  com_mod.tnNo = node(size[0], size[1], size[2]) + 1;
  com_mod.x.resize(3, com_mod.tnNo);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (int k = 0; k <= size[2]; ++k) {
    for (int j = 0; j <= size[1]; ++j) {
      for (int i = 0; i <= size[0]; ++i) {
        const int place[3] = {i, j, k};
        for (int d = 0; d < 3; ++d) {
          const bool shaken = place[d] > 0 && place[d] < size[d] && (d || i != n);
          com_mod.x(d, node(i, j, k)) = -1 + 2.0 / n * (place[d] + (shaken ? shift(random) : 0));
        }
      }
    }
  }
  com_mod.msh.assign(2, mshType());
  for (int m = 0; m < 2; ++m) {
    mshType &mesh = com_mod.msh[m];
    mesh.name = m ? "solid" : "fluid";
    mesh.eNoN = 4;
    const int first = m ? n : 0, last = m ? size[0] : n;
    mesh.nEl = 6 * (last - first) * size[1] * size[2];
    mesh.IEN.resize(4, mesh.nEl);
    int e = 0;
    const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        for (int i = first; i < last; ++i) {
          for (const auto &order : orders) {  // for each tetrahedron, a path along three edges of the cell
            int place[3] = {i, j, k};
            mesh.IEN(0, e) = node(i, j, k);
            for (int a = 0; a < 3; ++a) {
              ++place[order[a]];
              mesh.IEN(a + 1, e) = node(place[0], place[1], place[2]);
            }
            ++e;
          }
        }
      }
    }
  }
}

// Rounds to a multiple of 2^-30, so that sums of three coordinates are exact, as in an export of riis.
double rounded(double value) { return std::ldexp(std::nearbyint(std::ldexp(value, 30)), -30); }

const int n_quads = 8;
const int n_vertices = (n_quads + 1) * (n_quads + 1);

// The vertices of two flaps. The flaps hang on the lines y = -1 and y = 1, and touch at their ends in the closed valve.
Array<double> flaps(double angle, bool box, double scale) {
  Array<double> x(3, 2 * n_vertices + (box ? 9 : 0));
  for (int flap = 0; flap < 2; ++flap) {
    for (int j = 0; j <= n_quads; ++j) {
      for (int i = 0; i <= n_quads; ++i) {
        const double along = static_cast<double>(j) / n_quads, hinged = std::min(along, 0.75) / 0.75;
        const int vertex = i + (n_quads + 1) * j + n_vertices * flap;
        const double y = 1 - hinged * std::cos(angle), z = hinged * std::sin(angle) + 1.5 * std::max(0.0, along - 0.75);
        x(0, vertex) = scale * rounded(-0.9 + 1.8 * i / n_quads);
        x(1, vertex) = scale * rounded(flap ? y : -y);
        x(2, vertex) = scale * rounded(z);
      }
    }
  }
  // All triangles of the box have the same middle as the first triangle of the first flap.
  const int corners[3] = {0, n_quads + 2, n_quads + 1};
  const double wide[3] = {1.25, -1.25, 0}, thin[3] = {0.125, 0.125, -0.25};
  for (int axis = 0; box && axis < 3; ++axis) {
    for (int a = 0; a < 3; ++a) {
      for (int k = 0; k < 3; ++k) {
        const double shift = k == axis ? wide[a] : k == (axis + 1) % 3 ? thin[a] : 0;
        x(k, 2 * n_vertices + 3 * axis + a) = x(k, corners[a]) + scale * shift;
      }
    }
  }
  return x;
}

mshType flap_face(int flap) {
  mshType face;
  face.name = flap ? "right" : "left";
  face.nEl = 2 * n_quads * n_quads;
  face.eNoN = 3;
  face.IEN.resize(3, face.nEl);
  for (int j = 0, e = 0; j < n_quads; ++j) {
    for (int i = 0; i < n_quads; ++i) {
      const int corner = i + (n_quads + 1) * j + n_vertices * flap, above = corner + n_quads + 1;
      const int corners[2][3] = {{corner, above + 1, above}, {corner, corner + 1, above + 1}};
      for (const auto &triangle : corners) {
        for (int a = 0; a < 3; ++a) face.IEN(flap ? 2 - a : a, e) = triangle[a];  // normals point upwards
        ++e;
      }
    }
  }
  return face;
}

urisType make_valve(const std::string &name, bool box, double scale) {
  urisType uris;
  uris.name = name;
  for (int flap = 0; flap < 2; ++flap) uris.msh.push_back(flap_face(flap));
  if (box) {
    mshType face;
    face.name = "box";
    face.nEl = face.eNoN = 3;
    face.IEN.resize(3, 3);
    for (int i = 0; i < 9; ++i) face.IEN(i % 3, i / 3) = 2 * n_vertices + i;
    uris.msh.push_back(face);
  }
  uris.nFa = static_cast<int>(uris.msh.size());
  const int n_frames = 5;
  for (int frame = 0; frame < n_frames; ++frame) {
    const double opening = static_cast<double>(frame) / (n_frames - 1);
    uris.DxOpen.push_back(flaps(1.2 * opening, box, scale));
    uris.DxClose.push_back(flaps(1.2 * (1 - opening), box, scale));
  }
  uris.x = uris.x_prev = uris.DxOpen.rslice(0);
  uris.tnNo = uris.x.ncols();
  uris.valve_velocity.resize(3, uris.tnNo);
  uris.nrm.resize(3);
  uris.nrm(2) = 1;
  uris.sdf_deps = 0.15;
  uris.sdf_deps_close = 0.2;
  uris.sdf_default = 1e6 * uris.sdf_deps_close;
  uris.resistance = 1e4;
  return uris;
}

// A frame at rest around the flaps.
void add_scaffold(urisType &uris) {
  mshType &mesh = uris.scaffold_msh;
  mesh.name = "scaffold";
  mesh.nEl = 2;
  mesh.eNoN = 3;
  mesh.IEN.resize(3, 2);
  mesh.x.resize(3, 4);
  for (int i = 0; i < 4; ++i) {
    mesh.x(0, i) = i % 2 ? 1 : 0.85;
    mesh.x(1, i) = i / 2 ? 0.9 : -0.9;
    mesh.x(2, i) = 0.05 * i;
  }
  const int corners[2][3] = {{0, 1, 2}, {1, 3, 2}};
  for (int i = 0; i < 6; ++i) mesh.IEN(i % 3, i / 3) = corners[i / 3][i % 3];
  uris.scaffold_flag = true;
}

// Does what the solver does at its start and after each new mesh.
void initialize(ComMod &com_mod) {
  for (urisType &uris : com_mod.uris) {
    uris.sdf.resize(com_mod.tnNo);
    uris.sdf_computed = false;
  }
}

fsType make_space(int n_gauss) {
  fsType space;
  space.nG = n_gauss;
  space.eNoN = 4;
  space.N.resize(4, n_gauss);
  for (int g = 0; g < n_gauss; ++g) {
    for (int a = 0; a < 4; ++a) space.N(a, g) = a == g ? 0.55 : (g < 4 ? 0.15 : 0.25);
  }
  return space;
}

void run(const std::string &name) {
  ComMod com_mod;
  com_mod.dt = 0.01;
  make_mesh(com_mod, 6, 1);
  com_mod.uris.push_back(make_valve("flaps", true, 1));
  urisType &uris = com_mod.uris[0];
  if (name == "beat" || name == "remesh") add_scaffold(uris);
  if (name == "two") {
    com_mod.uris.push_back(make_valve("scaled", false, 0.7));
    com_mod.uris[1].include_uris_velocity = false;
  } else if (name == "vanish") {
    uris.sdf_deps = 0;
  } else if (name == "quads") {
    uris.msh[1].eNoN = 4;
  } else if (name != "beat" && name != "remesh") {
    throw std::runtime_error("no case has the name " + name);
  }
  initialize(com_mod);
  const fsType spaces[2] = {make_space(4), make_space(5)};
  for (com_mod.cTS = 1; com_mod.cTS <= 17; ++com_mod.cTS) {
    if (name == "remesh" && com_mod.cTS == 9) {
      make_mesh(com_mod, 6, 2);  // the same number of nodes, so that no array's length shows the change
      initialize(com_mod);
    }
    if (com_mod.cTS == 3 || com_mod.cTS == 11) {
      for (urisType &each : com_mod.uris) {
        each.clsFlg = com_mod.cTS == 11;
        each.cnt = 1;
      }
    }
    uris::uris_calc_sdf(com_mod);
    Vector<double> K;
    Array<double> K_u;
    for (const mshType &mesh : com_mod.msh) {
      for (const fsType &space : spaces) {
        for (int e = 0; e < mesh.nEl; ++e) {
          uris::eval_uris_ris_factors_quadrature(com_mod, mesh, space, e, K, K_u);
        }
      }
    }
    for (urisType &each : com_mod.uris) ++each.cnt;
  }
}

}  // namespace

int main(int argc, char **argv) {
  try {
    run(argc == 2 ? argv[1] : "");
  } catch (const std::exception &error) {
    std::cerr << error.what() << std::endl;
    return 1;
  }
  return 0;
}
