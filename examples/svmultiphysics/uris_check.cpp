// SPDX-License-Identifier: Apache-2.0
// Compares the valve engines inside svMultiPhysics. With -D RIIS_URIS_CHECK=ON, riis.cmake adds this file and gives the functions
// of uris_riis.cpp the names riis_calc_sdf and riis_factors. Environment:
//   URIS_TABLE  the beginning of the tables' names. Without it nothing is written and nothing is compared
//   URIS_CHECK  signs: also calls the solver's own distances in each step. all: also compares K and K u_valve of all Gauss points
//               with a loop over all triangles. Without it, the tables have the frames, sums and seconds only
// Tables: URIS_TABLE_nodes_RANK.csv has a line for each valve in each step, and URIS_TABLE_points_RANK.csv one for each function
// space in each step. Seconds are seconds of processor time.
#include "uris.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace uris {

void sv_calc_sdf(ComMod &com_mod);  // the solver's own
void riis_calc_sdf(ComMod &com_mod);
void riis_factors(const ComMod &com_mod, const mshType &mesh, const fsType &space, const int element, Vector<double> &K,
                  Array<double> &K_u);

namespace {

using Point = std::array<double, 3>;

std::string environment(const char *name) {
  const char *value = std::getenv(name);
  return value ? value : "";
}
bool writes() { return !environment("URIS_TABLE").empty(); }
bool compares_points() { return environment("URIS_CHECK") == "all" && environment("URIS_ENGINE") != "solver"; }
bool compares_signs() {
  return (environment("URIS_CHECK") == "signs" || compares_points()) && environment("URIS_ENGINE") != "solver";
}

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::ofstream table(const ComMod &com_mod, const std::string &name, const std::string &head) {
  std::ofstream file(environment("URIS_TABLE") + "_" + name + "_" + std::to_string(com_mod.cm.idcm()) + ".csv");
  file << std::setprecision(17) << head << std::endl;
  return file;
}

Point operator-(const Point &a, const Point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point &a, const Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point column(const Array<double> &x, int i) { return {x(0, i), x(1, i), x(2, i)}; }

// Returns the weights of the triangle's corners at the point nearest to p (Ericson 2004, 5.1.5).
Point closest_weights(const Point &p, const std::array<Point, 3> &t) {
  const Point ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / (d4 - d3 + d5 - d6);
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

// The faces of a valve or of its scaffold, for loops over all triangles.
struct Loop {
  struct Triangle {
    std::array<Point, 3> corners, velocities;
  };
  std::vector<std::vector<Triangle>> faces;
  double half_thickness, R;

  void add(const mshType &face, const Array<double> &x, const Array<double> *velocity) {
    if (face.name == "box") return;  // in exports of riis, these triangles only widen the solver's box
    faces.emplace_back(face.nEl);
    for (int e = 0; e < face.nEl; ++e) {
      for (int a = 0; a < 3; ++a) {
        faces.back()[e].corners[a] = column(x, face.IEN(a, e));
        faces.back()[e].velocities[a] = velocity ? column(*velocity, face.IEN(a, e)) : Point{};
      }
    }
  }

  // Adds K and K u_valve at p. Several faces may be equally near, such as those of leaflets that touch. The velocity is then the
  // mean of their velocities (docs/theory/marks.md, "Equally near leaflets").
  void add_resistance(const Point &p, double &K, Point &K_u) const {
    std::vector<std::pair<double, Point>> nearest;  // the distance to each face, and the velocity there
    for (const auto &face : faces) {
      double least = std::numeric_limits<double>::infinity();
      Point velocity{};
      for (const Triangle &triangle : face) {
        const Point w = closest_weights(p, triangle.corners);
        Point q{}, u{};
        for (int a = 0; a < 3; ++a) {
          for (int k = 0; k < 3; ++k) {
            q[k] += w[a] * triangle.corners[a][k];
            u[k] += w[a] * triangle.velocities[a][k];
          }
        }
        const double squared = dot(p - q, p - q);
        if (squared >= least) continue;
        least = squared;
        velocity = u;
      }
      nearest.emplace_back(std::sqrt(least), velocity);
    }
    double distance = std::numeric_limits<double>::infinity();
    for (const auto &face : nearest) distance = std::min(distance, face.first);
    if (!(distance < half_thickness)) return;
    const double share = distance / half_thickness;
    const double here = R * (1 + std::cos(std::acos(-1.0) * share)) / (2 * half_thickness * half_thickness);
    K += here;
    const auto is_near = [&](const auto &face) { return face.first <= distance + 1e-6 * half_thickness; };
    const auto n_near = std::count_if(nearest.begin(), nearest.end(), is_near);
    for (const auto &face : nearest) {
      for (int k = 0; is_near(face) && k < 3; ++k) K_u[k] += here * face.second[k] / static_cast<double>(n_near);
    }
  }
};

int n_frames(const urisType &uris) { return uris.clsFlg ? uris.DxClose.nslices() : uris.DxOpen.nslices(); }

double half_thickness(const urisType &uris) {
  const double share = std::min(1.0, static_cast<double>(uris.cnt) / n_frames(uris));
  const double closed = uris.clsFlg ? share : 1 - share;
  return closed * uris.sdf_deps_close + (1 - closed) * uris.sdf_deps;
}

std::vector<Loop> loops(const ComMod &com_mod) {
  std::vector<Loop> found;
  for (const urisType &uris : com_mod.uris) {
    found.push_back({{}, half_thickness(uris), uris.resistance});
    for (int f = 0; f < uris.nFa; ++f) {
      found.back().add(uris.msh[f], uris.x, uris.include_uris_velocity ? &uris.valve_velocity : nullptr);
    }
    if (!uris.scaffold_flag) continue;
    found.push_back({{}, uris.sdf_deps_close, uris.resistance});
    found.back().add(uris.scaffold_msh, uris.scaffold_msh.x, nullptr);
  }
  return found;
}

// ---- Nodes ----

struct Signs {
  int box = 0, other_box = 0, other_sign = 0, within = 0, lost = 0;
};

Signs compare(const urisType &uris, const Vector<double> &ours) {
  Signs signs;
  const double eps = half_thickness(uris);
  for (int node = 0; node < ours.size(); ++node) {
    const double a = ours(node), b = uris.sdf(node);
    signs.other_box += (a == uris.sdf_default) != (b == uris.sdf_default);
    if (a == uris.sdf_default) continue;
    ++signs.box;
    signs.other_sign += (a < 0) != (b < 0);
    signs.within += std::abs(a) < eps;
    signs.lost += std::abs(a) < eps && std::abs(b) >= eps;
  }
  return signs;
}

void write_nodes(const ComMod &com_mod, double ours, double solver, const std::vector<Signs> &signs) {
  static std::ofstream file =
      table(com_mod, "nodes",
            "step,valve,count,frames,closing,half_thickness,seconds,solver_seconds,box,other_box,other_sign,"
            "within,lost");
  for (size_t i = 0; i < com_mod.uris.size(); ++i) {
    const urisType &uris = com_mod.uris[i];
    const Signs &s = signs[i];
    file << com_mod.cTS << ',' << uris.name << ',' << uris.cnt << ',' << n_frames(uris) << ',' << uris.clsFlg << ','
         << half_thickness(uris) << ',' << ours << ',' << solver << ',' << s.box << ',' << s.other_box << ','
         << s.other_sign << ',' << s.within << ',' << s.lost << std::endl;
  }
}

// ---- Gauss points ----

struct Sums {
  int points = 0, solid = 0, marked = 0, wrong = 0;
  double K = 0, K_u = 0, largest_K = 0, largest_K_u = 0, K_error = 0, K_u_error = 0;
};

// Adds the points of one element to the sums, and compares them with the loops.
void add_element(const ComMod &com_mod, const mshType &mesh, const fsType &space, int e, const std::vector<Loop> &all,
                 const Vector<double> &K, const Array<double> &K_u, Sums &sums) {
  bool fluid = true;
  for (int a = 0; a < mesh.eNoN; ++a) fluid = fluid && com_mod.urisFluidNodeMask[mesh.IEN(a, e)];
  for (int g = 0; g < space.nG; ++g) {
    if (!fluid) {
      ++sums.solid;
      continue;
    }
    ++sums.points;
    sums.marked += K(g) > 0;
    sums.K += K(g);
    for (int k = 0; k < 3; ++k) sums.K_u += std::abs(K_u(k, g));
    if (all.empty()) continue;
    Point p{}, true_K_u{};
    double true_K = 0;
    for (int k = 0; k < 3; ++k) {
      for (int a = 0; a < space.eNoN; ++a) p[k] += space.N(a, g) * com_mod.x(k, mesh.IEN(a, e));
    }
    for (const Loop &loop : all) loop.add_resistance(p, true_K, true_K_u);
    sums.wrong += (true_K > 0) != (K(g) > 0);
    sums.largest_K = std::max(sums.largest_K, true_K);
    sums.K_error = std::max(sums.K_error, std::abs(K(g) - true_K));
    for (int k = 0; k < 3; ++k) {
      sums.largest_K_u = std::max(sums.largest_K_u, std::abs(true_K_u[k]));
      sums.K_u_error = std::max(sums.K_u_error, std::abs(K_u(k, g) - true_K_u[k]));
    }
  }
}

void write_points(const ComMod &com_mod, const mshType &mesh, const fsType &space) {
  static std::ofstream file =
      table(com_mod, "points",
            "step,mesh,gauss,functions,points,solid,seconds,seconds_again,marked,wrong,K,K_u,largest_K,"
            "K_error,largest_K_u,K_u_error");
  const std::vector<Loop> all = compares_points() ? loops(com_mod) : std::vector<Loop>();
  Vector<double> K;
  Array<double> K_u;
  double times[3] = {seconds()};
  for (int pass = 1; pass < 3; ++pass) {
    for (int e = 0; e < mesh.nEl; ++e) riis_factors(com_mod, mesh, space, e, K, K_u);
    times[pass] = seconds();
  }
  Sums sums;
  for (int e = 0; e < mesh.nEl; ++e) {
    riis_factors(com_mod, mesh, space, e, K, K_u);
    add_element(com_mod, mesh, space, e, all, K, K_u, sums);
  }
  file << com_mod.cTS << ',' << mesh.name << ',' << space.nG << ',' << space.eNoN << ',' << sums.points << ','
       << sums.solid << ',' << times[1] - times[0] << ',' << times[2] - times[1] << ',' << sums.marked << ','
       << sums.wrong << ',' << sums.K << ',' << sums.K_u << ',' << sums.largest_K << ',' << sums.K_error << ','
       << sums.largest_K_u << ',' << sums.K_u_error << std::endl;
}

}  // namespace

void uris_calc_sdf(ComMod &com_mod) {
  if (!writes()) return riis_calc_sdf(com_mod);
  const std::vector<urisType> before = compares_signs() ? com_mod.uris : std::vector<urisType>();
  const double start = seconds();
  riis_calc_sdf(com_mod);
  const double middle = seconds();
  std::vector<Signs> signs(com_mod.uris.size());
  if (!before.empty()) {
    const std::vector<urisType> ours = com_mod.uris;
    com_mod.uris = before;
    sv_calc_sdf(com_mod);
    for (size_t i = 0; i < ours.size(); ++i) {
      if (ours[i].sdf.size() == com_mod.uris[i].sdf.size()) signs[i] = compare(com_mod.uris[i], ours[i].sdf);
    }
    com_mod.uris = ours;
  }
  write_nodes(com_mod, middle - start, before.empty() ? 0 : seconds() - middle, signs);
}

void eval_uris_ris_factors_quadrature(const ComMod &com_mod, const mshType &mesh, const fsType &space,
                                      const int element, Vector<double> &K, Array<double> &K_u) {
  static int step = -1;
  static std::set<std::tuple<const mshType *, int, int>> written;  // in this step
  if (writes() && com_mod.urisActFlag) {
    if (step != com_mod.cTS) written.clear();
    step = com_mod.cTS;
    if (written.emplace(&mesh, space.nG, space.eNoN).second) write_points(com_mod, mesh, space);
  }
  riis_factors(com_mod, mesh, space, element, K, K_u);
}

}  // namespace uris
