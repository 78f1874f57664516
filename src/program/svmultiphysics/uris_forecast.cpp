// SPDX-License-Identifier: Apache-2.0
#include "program/svmultiphysics/uris_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "common/array_view.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/report.hpp"
#include "program/svmultiphysics/uris_solver.hpp"

namespace riis::program {
namespace {

// The end of the bands in which the solver measures pressures, in half thicknesses.
constexpr double band_end = 5;
// The least sufficient drop, as a share of (R / eps) u. The second number is the largest half thickness that is tried, divided by
// the given half thickness.
constexpr double enough = 0.9, most_thickness = 2;
// The largest drop that is a valid forecast is (R / eps) u divided by this share.
constexpr double least_of_sensible = 0.95;

// Returns whether two corners are the ends of an edge.
bool is_edge(const SolverElement &element, std::size_t a, std::size_t b) {
  const auto &p = element.node_places[a], &q = element.node_places[b];
  const bool agrees[] = {p[0] == q[0], p[1] == q[1], p[2] == q[2]};
  if (element.n_corners == 4) return true;
  if (element.n_corners == 6) return agrees[2] || (agrees[0] && agrees[1]);
  return agrees[0] + agrees[1] + agrees[2] == 2;
}

class Forecaster {
 public:
  Forecaster(const ExportOptions &options, UrisLeaflets &leaflets)
      : options_(options),
        leaflets_(leaflets),
        file_(read_mesh_file(options.mesh, options.cells_where)),
        mesh_(solver_mesh_of(file_.get(), options.mesh, options.to_solver)),
        half_thickness_(leaflets.half_thickness()) {
    check(riis_vtk_mesh_get_median_edge(file_.get(), &median_edge_));
    median_edge_ *= options.to_solver;
    const std::string regions = options.cells_where.empty() ? text_of_regions(options.mesh, file_.get()) : "";
    if (!regions.empty()) warn(regions);
  }

  UrisForecast forecast(const UrisMotion &motion) {
    say("svMultiPhysics in this mesh: " + counted(mesh_.n_nodes, "node") + ", elements " + mesh_.element->name +
        ", median edge " + shown(median_edge_));
    check_closed(motion.closing.back());
    check_open(motion.opening.back());
    try {
      find_drop(motion.closing.back());
    } catch (const NoFlow &no_flow) {
      say("expected drop: not computed, because " + no_flow.reason);
      warn(
          "the drop across the closed valve was not computed, and it is not known whether the leaflets separate two "
          "sides of " +
          options_.mesh + ", because " + no_flow.reason +
          "; the computation needs NumPy and SciPy (Debian: python3-scipy), and RIIS_PYTHON names the Python that has "
          "them");
    }
    const std::size_t n = motion.opening.size() + motion.closing.size();
    StepProgress progress("reading frames as the solver does", n, options_.quiet);
    std::string &table = forecast_.table;
    table =
        "motion,frame,opening,lower_x,lower_y,lower_z,upper_x,upper_y,upper_z,nodes_in_box,solver_area,library_area,"
        "nodes_before,volume_before,nodes_behind,volume_behind,leaflet_speed,node_speed\n";
    for (std::size_t i = 0; i < n; ++i) {
      progress.begin(i);
      const bool is_closing = i >= motion.opening.size();
      const std::size_t frame = is_closing ? i - motion.opening.size() : i;
      add_row(is_closing, frame, (is_closing ? motion.closing : motion.opening)[frame]);
    }
    say("largest speed of a leaflet " + shown(fastest_.of_leaflets) + ", and of a node that the solver moves with it " +
        shown(fastest_.of_nodes));
    return std::move(forecast_);
  }

 private:
  void say(const std::string &line) { forecast_.lines.push_back(line); }

  SolverDistances distances_at(double opening, bool is_closing) {
    vertices_ = leaflets_.vertices_at(opening);
    return solver_distances(mesh_, leaflets_, vertices_, is_closing, half_thickness_);
  }
  std::vector<double> near_nodes(double limit) const {
    return exact_distances(mesh_.n_nodes, mesh_.xyz(), leaflets_.surface(), limit, options_.n_threads);
  }
  SolverBand band_before(const SolverDistances &distances, bool is_closing) const {
    const double far = is_closing ? band_end * half_thickness_ : std::numeric_limits<double>::infinity();
    return solver_band(mesh_, distances, -far, -half_thickness_, leaflets_.forward());
  }
  SolverBand band_behind(const SolverDistances &distances) const {
    return solver_band(mesh_, distances, half_thickness_, band_end * half_thickness_, leaflets_.forward());
  }

  static std::string text_of(const SolverBand &band) {
    return counted(band.n_nodes, "node") + ", volume " + shown(band.volume) + ", from " + shown(band.from) + " to " +
           shown(band.to) + " along the flow";
  }

  [[noreturn]] void refuse_motion(const std::string &verb, const std::string &reason) const {
    refuse_data(options_.mesh + ": svMultiPhysics would never " + verb + " the valve: " + reason);
  }

  void check_closed(double opening) {
    const SolverDistances distances = distances_at(opening, true);
    const SolverBand before = band_before(distances, true), behind = band_behind(distances);
    const std::string from_to = " from " + in_mesh(half_thickness_) + " to " + in_mesh(band_end * half_thickness_);
    for (const auto &[band, side] : {std::pair(&before, "before"), {&behind, "behind"}})
      if (band->n_nodes == 0)
        refuse_motion("open", std::string("no node is ") + side + " the closed leaflets at a distance" + from_to +
                                  ", where the solver takes the pressure");
    std::int64_t n_triangles = 0;
    for (const UrisLeaflet &leaflet : leaflets_.leaflets()) n_triangles += view(leaflet.triangles).size();
    say("each marking of the closed valve measures " +
        shown(static_cast<double>(distances.n_in_box) * static_cast<double>(n_triangles)) + " distances, from " +
        counted(distances.n_in_box, "node") + " of its box to every triangle");
    say("the valve opens when the upstream pressure exceeds the downstream pressure");
    say("  before: " + text_of(before));
    say("  behind: " + text_of(behind));
  }

  void check_open(double opening) {
    const SolverBand before = band_before(distances_at(opening, false), false);
    if (before.n_nodes == 0)
      refuse_motion("close", "no node of the solver's box is before the open leaflets at a distance of " +
                                 in_mesh(half_thickness_) + " or more, where the solver takes the mean flow");
    say("the valve closes when the mean flow upstream of the open leaflets reverses");
    say("  before: " + text_of(before));
  }

  // The ratio of the expected drop to (R / eps) u. The drop is valid if the equations were solved.
  struct Expected : ClosedDrop {
    double drop = 0, area = 0;
  };
  Expected expected_at(double half_thickness, const SolverDistances &distances, const SolverDistances &wide,
                       const std::vector<double> &near) const {
    const double reach = std::max(2.5 * half_thickness, half_thickness + 2 * median_edge_);
    Expected expected{closed_drop(mesh_, distances, wide, near, reach, half_thickness,
                                  {options_.resistance, options_.density, options_.viscosity, options_.time_step},
                                  options_.quiet)};
    if (!expected.is_solved) return expected;
    expected.area = exact_area(mesh_, leaflets_.surface(), near, half_thickness, options_.n_threads, false);
    expected.drop = expected.area / expected.flow;
    return expected;
  }

  void find_drop(double opening) {
    const SolverDistances distances = distances_at(opening, true);
    warn_of_negative_shapes(distances);
    const std::vector<double> near =
        near_nodes(std::max(band_end * half_thickness_, most_thickness * half_thickness_ + 2 * median_edge_));
    // With a larger half thickness, the export has a larger box. The signs of distances must be known up to the reach of the
    // larger box.
    const SolverDistances wide = solver_distances(mesh_, leaflets_, vertices_, true, half_thickness_,
                                                  band_end * most_thickness * half_thickness_ + 4 * median_edge_);
    const Expected expected = expected_at(half_thickness_, distances, wide, near);
    if (!expected.is_separated) {
      say("expected drop: none, because the closed leaflets do not divide this mesh into two sides");
      warn("svMultiPhysics will not hold the pressure: the closed leaflets do not separate two sides of " +
           options_.mesh);
      return;
    }
    if (!expected.is_solved) {
      say("expected drop: not found, because the equations were not solved");
      forecast_.failure = "the drop across the closed valve was not found, because the equations were not solved. " +
                          text_of_stiffness() + "; the files are written";
      return;
    }
    if (!is_sensible(expected.drop)) {
      say("expected drop: not found, because no drop between 0 and 1/" + shown(least_of_sensible) +
          " of (R/eps) u solves the solver's equations");
      warn("the drop across the closed valve was not found, because no drop between 0 and 1/" +
           shown(least_of_sensible) +
           " of (R/eps) u solves the solver's equations; the solver's stabilisation needs a density of about 1 g/cm3");
      return;
    }
    say("expected drop of the closed valve: " + printed("%.4f", expected.drop) + " of (R/eps) u, with eps = " +
        shown(half_thickness_) + ", " + shown(half_thickness_ / median_edge_) + " edges");
    say("  u is the flow over the area of the leaflets in the mesh, " + printed("%.5g", expected.area) +
        "; the solver's sum of delta is " + shown(solver_area(mesh_, distances, half_thickness_) / expected.area) +
        " of the exact sum");
    if (expected.drop >= enough) return;
    std::string needed;
    try {
      needed = thickness_for(wide, near);
    } catch (const NoFlow &no_flow) {
      needed = "the half thickness that the mesh needs was not computed, because " + no_flow.reason;
    }
    say("  " + needed);
    warn("in svMultiPhysics the pressure will drop by " + shown(expected.drop) +
         " of (R/eps) u across the closed valve; " + needed);
  }

  // Returns a sentence about how stiff the resistance makes the equations.
  std::string text_of_stiffness() const {
    const double stiffness = options_.resistance * options_.time_step / (options_.density * half_thickness_);
    return "With --resistance " + shown(options_.resistance) + ", R dt/(rho eps) is " + shown(stiffness) +
           ", but it is about 1 to 1,000 in flows of blood: look at the unit of --resistance";
  }

  // Tries larger half thicknesses, in steps of a quarter of the given half thickness. The last step is halved twice for a finer
  // result.
  std::string thickness_for(const SolverDistances &wide, const std::vector<double> &near) {
    bool are_found = true;
    const auto is_enough = [&](double factor) {
      const Expected expected = expected_at(factor * half_thickness_, wide, wide, near);
      const bool is_found = expected.is_solved && is_sensible(expected.drop);
      are_found = are_found && is_found;
      return is_found && expected.drop >= enough;
    };
    double below = 1, above = 1;
    do {
      below = above;
      above += 0.25;
      if (above > most_thickness)
        return are_found ? "even a half thickness of " + in_mesh(most_thickness * half_thickness_) +
                               " does not give a drop of " + shown(enough) +
                               "; the mesh needs shorter edges, or the export needs finer triangles"
                         : "the half thickness for a drop of " + shown(enough) + " was not found";
    } while (!is_enough(above));
    for (int i = 0; i < 2; ++i) {
      const double middle = (below + above) / 2;
      (is_enough(middle) ? above : below) = middle;
    }
    return "a drop of " + shown(enough) + " needs a half thickness of " + in_mesh(above * half_thickness_) +
           text_of_finer_mesh(near, above);
  }

  // Returns the shorter edge length that has the same effect as multiplying the half thickness by `factor`. The drop depends on
  // the ratio of edge and half thickness. All edges are assumed to become shorter by the same length, because size fields with
  // different edges in the band differ in this way.
  std::string text_of_finer_mesh(const std::vector<double> &near, double factor) const {
    std::vector<double> lengths, volumes;
    const SolverElement &element = *mesh_.element;
    for (std::int64_t e = 0; e < mesh_.n_elements(); ++e) {
      const std::int64_t *const nodes = mesh_.nodes_of(e);
      if (std::none_of(nodes, nodes + element.n_corners,
                       [&](std::int64_t i) { return view(near)[i] <= half_thickness_; }))
        continue;
      for (std::size_t b = 0; b < element.n_corners; ++b)
        for (std::size_t a = 0; a < b; ++a)
          if (is_edge(element, a, b))
            lengths.push_back(distance_between(mesh_.point(nodes[a]).data(), mesh_.point(nodes[b]).data()));
    }
    for (std::int64_t i = 0; i < mesh_.n_nodes; ++i)
      if (view(near)[i] <= half_thickness_) volumes.push_back(view(mesh_.node_volume)[i]);
    if (lengths.empty() || volumes.empty()) return "";
    const double edge = median(lengths), volume = median(volumes), shorter = edge - edge / factor;
    double n_nodes = 0;
    for (const double of_node : mesh_.node_volume) {
      const double of_edges = edge * std::cbrt(std::max(of_node, 0.0) / volume);
      // A node at the wall has a small volume, but its edges are as long as those of its neighbours.
      const double ratio = std::max(of_edges, edge) / (std::max(of_edges, edge) - shorter);
      n_nodes += ratio * ratio * ratio;
    }
    return ", or edges of " + in_mesh(edge / factor) + " in the band, " + shown(1 / factor) +
           " times as long as now, in about " + rounded(n_nodes) + " nodes";
  }

  // Returns a count that is rounded to two significant digits.
  static std::string rounded(double count) {
    const double unit = power_of_ten(std::max(0, decimal_exponent(count) - 1));
    return grouped(static_cast<std::int64_t>(std::llround(count / unit) * std::llround(unit)));
  }

  // Because of the stabilisation, the drop can exceed (R / eps) u a little. A drop that is negative or much larger than (R / eps)
  // u is no valid forecast.
  static bool is_sensible(double drop) { return drop > 0 && drop <= 1 / least_of_sensible; }

  // Returns a length in the unit of the mesh, as the user would write it.
  std::string in_mesh(double length) const {
    return shown(length / options_.to_solver) + (options_.unit ? std::string(" ") + name_of(*options_.unit) : "");
  }

  // Warns if negative interpolated distances cause resistance far from the valve.
  void warn_of_negative_shapes(const SolverDistances &distances) {
    const SolverElement &element = *mesh_.element;
    if (element.n_nodes == element.n_corners) return;
    std::int64_t n = 0;
    for (std::int64_t e = 0; e < mesh_.n_elements(); ++e)
      for (const ShapeFunctions &at : element.at_gauss)
        n += interpolated_distance(mesh_, e, at, distances.to_leaflets) < -half_thickness_;
    if (n == 0) return;
    say("WRONG: resistance at " + counted(n, "Gauss point") + " on the border of the solver's box, far from the valve");
    warn("svMultiPhysics will put resistance at " + counted(n, "Gauss point") +
         " on the border of its box, because quadratic elements make distances negative there; use linear elements");
  }

  void add_row(bool is_closing, std::size_t frame, double opening) {
    const std::vector<double> vertices_before = vertices_;
    const SolverDistances distances = distances_at(opening, is_closing);
    const SolverBand before = band_before(distances, is_closing), behind = band_behind(distances);
    const std::vector<double> near = near_nodes(3 * half_thickness_ + 2 * median_edge_);
    std::string &row = forecast_.table;
    row += (is_closing ? "close," : "open,") + std::to_string(frame) + ',' + shortest(opening);
    for (const double *corner : {distances.box.lower, distances.box.upper})
      for (int k = 0; k < 3; ++k) row += ',' + shortest(corner[k]);
    row += ',' + std::to_string(distances.n_in_box) + ',' + shortest(solver_area(mesh_, distances, half_thickness_)) +
           ',' + shortest(exact_area(mesh_, leaflets_.surface(), near, half_thickness_, options_.n_threads, true));
    for (const SolverBand *band : {&before, &behind})
      row += ',' + std::to_string(band->n_nodes) + ',' + shortest(band->volume);
    // In the first frame of a motion, the valve is at rest.
    const SolverSpeeds speeds = frame == 0 ? SolverSpeeds{}
                                           : solver_speeds(mesh_, leaflets_, distances, vertices_, vertices_before,
                                                           options_.time_step, half_thickness_);
    row += ',' + shortest(speeds.of_leaflets) + ',' + shortest(speeds.of_nodes) + '\n';
    fastest_.of_leaflets = std::max(fastest_.of_leaflets, speeds.of_leaflets);
    fastest_.of_nodes = std::max(fastest_.of_nodes, speeds.of_nodes);
  }

  const ExportOptions &options_;
  UrisLeaflets &leaflets_;
  MeshFile file_;
  SolverMesh mesh_;
  double half_thickness_, median_edge_ = 0;
  std::vector<double> vertices_;  // of the last frame that was read
  SolverSpeeds fastest_;
  UrisForecast forecast_;
};

}  // namespace

UrisForecast forecast_of(const ExportOptions &options, const UrisMotion &motion, UrisLeaflets &leaflets) {
  return Forecaster(options, leaflets).forecast(motion);
}

}  // namespace riis::program
