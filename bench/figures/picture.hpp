// SPDX-License-Identifier: Apache-2.0
// Draws a picture of surfaces, curves, points and texts, seen without perspective on a white background.
// Input: objects in centimetres, and the sizes of lines, points and texts in pixels. Output: the bytes of a PNG file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <vtkSmartPointer.h>

#include "geometry/vec3.hpp"
#include "riis_vtk/picture/drawing.hpp"

class vtkPolyData;
class vtkRenderer;

namespace riis::figures {

struct Colour {
  unsigned char red, green, blue;
};

constexpr Colour distinct(int i) {
  const auto &rgb = vtk::distinct_colours[i];
  return {rgb[0], rgb[1], rgb[2]};
}
inline constexpr Colour blue = distinct(0), orange = distinct(1), green = distinct(2), purple = distinct(3),
                        vermilion = distinct(4), sky_blue = distinct(5), dark{45, 45, 45}, grey{130, 130, 130},
                        light_grey{205, 205, 205};

// Mixes the colour with white. `white` is the fraction of white.
Colour paler(Colour colour, double white);

struct Png {
  int width, height;
  std::vector<unsigned char> bytes;
};

using Points = std::vector<Vec3>;
using Segments = std::vector<std::array<Vec3, 2>>;

// Triangles or quads, each with a colour.
struct Faces {
  std::size_t n_corners;  // number of corners of each face
  Points points;
  std::vector<std::int64_t> corners;  // (n_corners, n)
  std::vector<Colour> colours;

  std::size_t size() const { return colours.size(); }
};

// The styles of surfaces. A ghost is transparent. Painted faces keep their colours from every direction, because the colours are
// data.
enum class Shading { smooth, flat, ghost, painted };

// The direction in which the eye looks, and the upward direction.
struct View {
  Vec3 direction, up;  // unit, perpendicular
};
View looking(Vec3 direction, Vec3 up);
inline constexpr View top_view{{0, 0, -1}, {0, 1, 0}};

struct PictureSize {
  int width, height;
};

class Picture {
 public:
  // The picture contains all points of to_fit, at least the margin (pixels) away from the edges and from the title.
  Picture(PictureSize size, const View &view, const Points &to_fit, double margin = 60);

  // Objects that lie in faces are drawn above them, in this order: faces, segments, curves, points. Among objects of one kind, a
  // higher rank is drawn above a lower one.
  void add_faces(const Faces &faces, Shading shading);
  void add_segments(const Segments &segments, Colour colour, double width, int rank = 0);
  void add_curve(const Points &points, Colour colour, double width, int rank = 0);
  void add_dashed(const Points &points, Colour colour, double width);
  void add_points(const Points &points, Colour colour, double diameter);

  // Adds a text whose middle is `right` pixels to the right of a point and `above` pixels above it.
  void add_label(Vec3 at, const std::string &text, double right, double above, Colour colour = dark, int size = 26);
  // Adds a text whose middle is moved away from the point `from`, as seen by this camera.
  void add_label_away(Vec3 at, Vec3 from, const std::string &text, double distance, Colour colour = dark,
                      int size = 26);
  void add_title(const std::string &text);

  // Adds a scale bar of 1 cm at the lower left, and the directions of x, y and z at the lower right.
  void add_scale_and_axes();

  Png png() const;

 private:
  Vec3 at_pixel(double x, double y) const;
  Vec3 raised(Vec3 p, int layer) const;
  vtkSmartPointer<vtkPolyData> lines(const std::vector<Points> &lines, int layer) const;
  void add_tubes(vtkPolyData *lines, Colour colour, double width);
  void add_text(double x, double y, const std::string &text, Colour colour, int size, bool is_centred);

  PictureSize size_;
  Vec3 right_, up_, direction_;
  Vec3 focus_;    // the point in the middle of the picture
  double depth_;  // half of the largest extent of the objects
  double pixel_;  // the size of a pixel in centimetres
  vtkSmartPointer<vtkRenderer> renderer_;
};

}  // namespace riis::figures
