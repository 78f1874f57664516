// SPDX-License-Identifier: Apache-2.0
// The valve in the flow: every call of riis that the flow solver makes. All lengths are in metres.
#ifndef RIIS_EXAMPLES_DEALII_OBSTACLE_HPP
#define RIIS_EXAMPLES_DEALII_OBSTACLE_HPP

#include <deal.II/base/exceptions.h>
#include <deal.II/base/point.h>
#include <deal.II/base/utilities.h>

#include <riis/riis.hpp>
#include <string>
#include <vector>

// The entries of the valve in the parameter file.
struct ObstacleSettings {
  std::string kind = "trileaflet";  // a kind of riis, or plate: a square plate across the duct
  std::string parameters;           // such as "annulus=2.4, bending_height=0.5", in the valve's own unit
  double scale = 0.01;              // of the valve's own unit: 0.01 for centimetres
  double position = 0;              // of the valve's origin along the duct, which is the x axis
  double speed = 0;                 // of the plate along the duct
  double half_thickness = 2e-3;     // eps
  double R = 1e4;                   // in kg/(m s)
};

class Obstacle {
 public:
  using Points = std::vector<dealii::Point<3>>;

  // half_width is half the side of the duct that the plate closes.
  Obstacle(const ObstacleSettings &settings, double half_width) : settings(settings), half_width(half_width) {
    riis::check(riis_marks_create(marks.out()));
    options = riis::defaults<riis_surface_options>();
    options.half_thickness = settings.half_thickness;
    options.translation[0] = settings.position;
    options.n_threads = 1;  // each rank has one thread
    resistance = riis::defaults<riis_resistance>();
    resistance.R = settings.R;
    if (is_plate()) return;
    riis::check(riis_valve_create(settings.kind.c_str(), valve.out()));
    for (const std::string &entry : dealii::Utilities::split_string_list(settings.parameters)) set_parameter(entry);
    riis::check(riis_valve_copy(valve, before.out()));
    options.scale = settings.scale;
    options.rotation_axis[1] = 1;  // riis's valves have their axis along z, and this duct along x
    options.rotation_axis[2] = 0;
    options.rotation_angle = 90;
  }

  // Moves the valve to its state at `time`. One time step earlier, the valve had the opening `opening_before`.
  void move(double opening_before, double opening, double time, double time_step) {
    if (is_plate()) return move_plate(time);
    riis::check(riis_valve_set_scalar(before, "opening", opening_before));
    riis::check(riis_valve_set_scalar(valve, "opening", opening));
    if (!surface) riis::check(riis_surface_create(valve, &options, surface.out()));
    riis::check(riis_surface_update_moving(surface, valve, before, time_step, nullptr, nullptr));
  }

  // Takes over the points to mark. The arrays must stay in place until the next call.
  void set_points(const Points &points) {
    riis_mesh *const old = mesh;
    const double *const x = points.empty() ? nullptr : points[0].begin_raw();
    const double *const y = x ? x + 1 : x, *const z = x ? x + 2 : x;
    if (old)
      riis::check(riis_mesh_update(old, points.size(), x, y, z, 3));
    else
      riis::check(riis_mesh_create(points.size(), x, y, z, 3, mesh.out()));
  }

  // Writes K and K u_surface of every point, and returns the number of points in the band.
  std::int64_t mark(std::vector<double> &K, std::vector<dealii::Tensor<1, 3>> &K_u) {
    K.assign(K.size(), 0.);
    K_u.assign(K_u.size(), dealii::Tensor<1, 3>());
    auto mark_options = riis::defaults<riis_mark_options>();
    mark_options.fields = RIIS_FIELD_VELOCITY;
    mark_options.n_threads = 1;
    riis::check(riis_mark_nodes(surface, mesh, &mark_options, marks));
    auto arrays = riis::defaults<riis_resistance_arrays>();
    arrays.n_nodes = K.size();
    arrays.K = K.data();
    arrays.K_u_surface_stride = 3;
    if (!K_u.empty())
      for (unsigned int c = 0; c < 3; ++c) arrays.K_u_surface[c] = &K_u[0][c];
    riis::check(riis_marks_add_resistance(marks, &resistance, &arrays));
    return riis::get<riis_mark_stats>(riis_marks_get_stats, marks).n_marked;
  }

  // Returns each point's distance from the valve.
  std::vector<double> distances(const Points &points) const {
    std::vector<double> result(points.size());
    if (points.empty()) return result;
    auto there = riis::defaults<riis_points>();
    there.n_points = points.size();
    there.x = points[0].begin_raw();
    there.y = points[0].begin_raw() + 1;
    there.z = points[0].begin_raw() + 2;
    there.stride = 3;
    auto closest_options = riis::defaults<riis_closest_options>();
    closest_options.n_threads = 1;
    auto arrays = riis::defaults<riis_closest_arrays>();
    arrays.distance = result.data();
    riis::check(riis_closest_points(surface, &there, &closest_options, &arrays));
    return result;
  }

  // The area that resists. The area is that of the surface, or of the part of the plate in the duct.
  double area() const {
    if (is_plate()) return 4 * half_width * half_width;
    return riis::get<riis_surface_info>(riis_surface_get_info, surface).area;
  }

  // All settings that must be the same after a restart.
  std::string description() const {
    std::ostringstream text;
    text.precision(17);
    text << settings.kind << " (" << settings.parameters << ") scale " << settings.scale << " position "
         << settings.position << " speed " << settings.speed << " half thickness " << settings.half_thickness << " R "
         << settings.R;
    return text.str();
  }

 private:
  const ObstacleSettings settings;
  const double half_width;
  riis_surface_options options;
  riis_resistance resistance;
  riis::Valve valve, before;
  riis::Surface surface;
  riis::Mesh mesh;
  riis::Marks marks;

  bool is_plate() const { return settings.kind == "plate"; }

  void set_parameter(const std::string &entry) {
    const std::vector<std::string> sides = dealii::Utilities::split_string_list(entry, '=');
    AssertThrow(sides.size() == 2, dealii::ExcMessage("Valve/Parameters: '" + entry + "' is not NAME=VALUE"));
    double value = 0;
    try {
      value = dealii::Utilities::string_to_double(sides[1]);
    } catch (const std::exception &) {
      AssertThrow(false,
                  dealii::ExcMessage("Valve/Parameters: '" + sides[1] + "' of " + sides[0] + " is not a number"));
    }
    riis::check(riis_valve_set_scalar(valve, sides[0].c_str(), value));
  }

  // The plate overlaps the walls by two half thicknesses, so its rim is far from the flow.
  void move_plate(double time) {
    const double w = half_width + 2 * settings.half_thickness, x = settings.speed * time;
    const double vertices[4][3] = {{x, -w, -w}, {x, w, -w}, {x, w, w}, {x, -w, w}}, v[3] = {settings.speed, 0, 0};
    const double velocities[4][3] = {{v[0], 0, 0}, {v[0], 0, 0}, {v[0], 0, 0}, {v[0], 0, 0}};
    const std::int32_t corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
    auto arrays = riis::defaults<riis_surface_arrays>();
    arrays.n_vertices = 4;
    arrays.x = &vertices[0][0], arrays.y = &vertices[0][1], arrays.z = &vertices[0][2];
    arrays.vx = &velocities[0][0], arrays.vy = &velocities[0][1], arrays.vz = &velocities[0][2];
    arrays.stride = arrays.velocity_stride = 3;
    arrays.n_faces = 2;
    arrays.vertex_ids = corners;
    if (surface)
      riis::check(riis_surface_update_from_arrays(surface, &arrays, nullptr));
    else
      riis::check(riis_surface_create_from_arrays(&arrays, &options, surface.out()));
  }
};

#endif
