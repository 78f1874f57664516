// SPDX-License-Identifier: Apache-2.0
// Provides the paper's three methods for measuring a distance on a single leaflet, with the settings that are compared. Input: a
// leaflet, a method, a tolerance. Output: a surface for queries through the public interface.
#pragma once

#include <riis/riis.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "valve/patches.hpp"

namespace riis::accuracy {

inline constexpr double half_thickness = 0.1;  // as in the paper, cm

struct Leaflet {
  const char *name, *valve;
  std::int32_t leaflet_id;
};
// The leaflets have the paper's parameters. The mitral valve is open.
inline constexpr std::array<Leaflet, 2> leaflets{
    {{"right cusp", "aortic", RIIS_LEAFLET_RIGHT}, {"anterior leaflet", "mitral", RIIS_LEAFLET_ANTERIOR}}};

// Returns the valve's patches that belong to this leaflet.
PatchSet patches_of(const Leaflet &leaflet);

struct Setting {
  std::int32_t method;  // RIIS_MEASURE_*
  double tolerance;     // a fraction of the half thickness
  const char *name;
};
const char *name_of(std::int32_t method);
// Minimisation has the paper's tolerances, and the other methods have the tolerances 1, 2, 5 and 10 %.
inline constexpr std::array<Setting, 10> settings{{{RIIS_MEASURE_MINIMIZATION, 0.001, "0.001"},
                                                   {RIIS_MEASURE_MINIMIZATION, 0.01, "0.01"},
                                                   {RIIS_MEASURE_SAMPLING, 0.01, "1 %"},
                                                   {RIIS_MEASURE_SAMPLING, 0.02, "2 %"},
                                                   {RIIS_MEASURE_SAMPLING, 0.05, "5 %"},
                                                   {RIIS_MEASURE_SAMPLING, 0.1, "10 %"},
                                                   {RIIS_MEASURE_TRIANGLES, 0.01, "1 %"},
                                                   {RIIS_MEASURE_TRIANGLES, 0.02, "2 %"},
                                                   {RIIS_MEASURE_TRIANGLES, 0.05, "5 %"},
                                                   {RIIS_MEASURE_TRIANGLES, 0.1, "10 %"}}};

// A surface made of patches. A failure throws std::runtime_error with the library's message.
class MeasuredSurface {
 public:
  MeasuredSurface(const PatchSet &patches, std::int32_t method, double tolerance);

  riis_closest closest(const double *point) const;
  double distance(const double *point) const { return closest(point).distance; }
  // Returns the number of triangles, samples or patches, depending on the method.
  std::int64_t size() const;

 private:
  struct Destroy {
    void operator()(riis_surface *surface) const { riis_surface_destroy(&surface); }
  };
  std::unique_ptr<riis_surface, Destroy> surface_;
};

}  // namespace riis::accuracy
