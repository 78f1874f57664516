// SPDX-License-Identifier: Apache-2.0
// The view of a picture.
// The inputs are the direction of view, and the extents of the surface and the mesh. The result is the visible part of space,
// which the camera, the cut and the scale bar use. If the mesh extends beyond the panel, planes cut the mesh, and dashed lines
// show the cuts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <vtkPlane.h>
#include <vtkSmartPointer.h>

class vtkCamera;
class vtkPointSet;
class vtkPolyData;

namespace riis::vtk {

using Vector = std::array<double, 3>;

struct Extent {
  double lower, upper;
  double middle() const { return 0.5 * lower + 0.5 * upper; }
  double half() const { return 0.5 * upper - 0.5 * lower; }
  bool meets(const Extent &other) const { return lower <= other.upper && other.lower <= upper; }
};

// Extents along the axes of a view, which point to the right, upwards, and away from the eye.
using Extents = std::array<Extent, 3>;
// Extents along x, y and z.
using Bounds = std::array<Extent, 3>;

// The unit vectors along the axes x, y and z of a valve after its placement.
using Axes = std::array<Vector, 3>;

// Returns the mesh's axes after a turn about an axis. The axis may have any length except 0.
Axes axes_turned(const double axis[3], double degrees);

// Returns the axes after a turn about their own z.
Axes turned_about_z(const Axes &axes, double degrees);

// A view without perspective, so that lengths in the picture can be compared. right, up and away are perpendicular unit vectors.
struct View {
  std::array<Vector, 3> axes;

  // The value of `view` is a constant RIIS_VTK_VIEW_* for a single view, not the constant for three views. Views along the axes
  // of the valve need `valve`. For RIIS_VTK_VIEW_VALVE_LONG, the caller turns the axes of the valve, and the view is that of
  // RIIS_VTK_VIEW_VALVE_SIDE with the turned axes.
  View(std::int32_t view, const Axes &valve);
  const Vector &right() const { return axes[0]; }
  const Vector &up() const { return axes[1]; }
  const Vector &away() const { return axes[2]; }
  Extents extents_of(vtkPointSet *data) const;
  // Returns the extents of a whole box.
  Extents extents_of(const Bounds &bounds) const;
};

// The part of space that a panel shows, measured along the axes of the panel's view.
struct Sight {
  Extents shown;                  // x and y extend to the panel's edges; z is the depth of surface and mesh
  std::array<Extent, 2> uncut;    // x and y at which the mesh is cut if it extends further
  std::array<bool, 2> cut_below;  // whether the mesh is cut on the left, and below
  std::array<bool, 2> cut_above;  // whether the mesh is cut on the right, and above
  bool is_cut() const { return cut_below[0] || cut_below[1] || cut_above[0] || cut_above[1]; }
};

// Returns the sight, which is the part of space that the panel shows. The sight always contains the surface. If the mesh is not
// much larger than the surface along an axis, the sight contains the whole mesh along this axis. Pictures of a valve that moves
// in a mesh thus show the same part of space, and can be compared. Along any other axis, the sight contains only the surroundings
// of the surface.
//   mesh    NULL if there is none
//   aspect  the panel's width divided by its height
//   least   the least half height of the panel, so that several views can have one scale
//   reach   the size of the surroundings, as a multiple of their usual size
Sight sight_of(const Extents &surface, const Extents *mesh, double aspect, double least = 0, double reach = 1);

void aim_camera(vtkCamera *camera, const View &view, const Sight &sight);

// Returns the planes at which the mapper of the mesh must cut. If the whole mesh is visible, there are no planes.
std::vector<vtkSmartPointer<vtkPlane>> cutting_planes(const View &view, const Sight &sight);

// Returns dashed lines where the planes cut the boundary. The lines are nearer to the eye than everything else.
vtkSmartPointer<vtkPolyData> dashes_where_cut(const View &view, const Sight &sight, vtkPolyData *boundary);

// Red, green and blue, each from 0 to 1.
using Colour = std::array<double, 3>;

}  // namespace riis::vtk
