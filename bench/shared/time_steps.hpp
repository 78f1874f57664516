// SPDX-License-Identifier: Apache-2.0
// Makes a solver's time step: the valve moves, its surface is updated, nodes are marked, and the list of marked nodes is read.
#pragma once

#include <cstdint>
#include <string>

#include "handles.hpp"

namespace bench {

struct StepOptions {
  const char *kind = "aortic";  // the kind of valve
  double half_thickness = 0.1;
  double tolerance = 0.05;
  int n_threads = 1;
  std::int32_t instructions = RIIS_INSTRUCTIONS_AUTO;
  // With a fixed triangulation, the aortic valve changes its opening from step to step. Without a fixed triangulation, the angle
  // of its cusps changes.
  std::int32_t triangulation = RIIS_TRIANGULATION_ADAPTED;
};

// Marks by the search over clusters. The mesh is borrowed.
class TimeSteps {
 public:
  TimeSteps(const riis_mesh *mesh, const StepOptions &options)
      : mesh_(mesh),
        opens_(std::string(options.kind) == "mitral" || options.triangulation == RIIS_TRIANGULATION_FIXED),
        valve_(make_valve(options.kind)) {
    move_to(0.5);
    riis_surface_options of_surface;
    check(riis_surface_options_init(&of_surface, sizeof of_surface));
    of_surface.tolerance = options.tolerance;
    of_surface.half_thickness = options.half_thickness;
    of_surface.n_threads = options.n_threads;
    of_surface.triangulation = options.triangulation;
    surface_ = make_surface(valve_.get(), &of_surface);
    check(riis_mark_options_init(&marking_, sizeof marking_));
    marking_.search = RIIS_SEARCH_CLUSTERS;
    marking_.n_threads = options.n_threads;
    marking_.instructions = options.instructions;
  }

  // Moves the valve to a position from 0 to 1. Between positions 0 and 1, either the valve opens, or the free edges of the aortic
  // valve's cusps turn by 30 degrees. A fixed triangulation allows only the opening to change.
  void move_to(double position) {
    if (opens_)
      check(riis_valve_set_scalar(valve_.get(), "opening", position));
    else
      check(riis_valve_set_scalar(valve_.get(), "leaflet_angle", 30 + 30 * position));
  }
  // Moves the valve by a sixtieth of the range of positions. The valve goes back and forth within a twelfth of this range.
  void move() {
    step_ = (step_ + 1) % 10;
    move_to(0.5 + (step_ < 5 ? step_ : 10 - step_) / 60.0);
  }
  void update() { check(riis_surface_update(surface_.get(), valve_.get(), nullptr)); }
  void mark() { check(riis_mark_nodes(surface_.get(), mesh_, &marking_, result_.get())); }
  riis_mark_list step() {
    update();
    mark();
    return marked_in(result_.get());
  }

  // Returns whether the processor has the requested instructions.
  bool can_mark() const {
    const riis_status status = riis_mark_nodes(surface_.get(), mesh_, &marking_, make_result().get());
    if (status != RIIS_UNAVAILABLE) check(status);
    return status == RIIS_OK;
  }

  int n_threads() const { return marking_.n_threads; }
  const riis_surface *surface() const { return surface_.get(); }
  const riis_marks *result() const { return result_.get(); }
  riis_mark_stats stats() const { return stats_of(result_.get()); }

 private:
  const riis_mesh *mesh_;
  bool opens_;
  Valve valve_;
  Surface surface_;
  Result result_ = make_result();
  riis_mark_options marking_;
  int step_ = 0;
};

}  // namespace bench
