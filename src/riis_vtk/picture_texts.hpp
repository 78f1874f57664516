// SPDX-License-Identifier: Apache-2.0
// In: a picture's texts. Out: the bands above and below its panels, with captions, the key of colours, axes and a scale bar.
#pragma once

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "riis_vtk/picture_panels.hpp"
#include "riis_vtk/picture_view.hpp"

class vtkRenderer;

namespace riis::vtk {

// The places of a picture's parts, in pixels from the lower left corner. A picture too low for bands has neither bands nor texts.
class Layout {
 public:
  Layout(int width, int height, int n_panels);
  bool has_texts() const { return top_ > 0; }
  int n_panels() const { return n_panels_; }
  int letter() const { return letter_; }  // the height of the texts' font
  int margin() const { return letter_; }
  double panel_left(int panel) const { return width_ * static_cast<double>(panel) / n_panels_; }
  double panel_width() const { return width_ / static_cast<double>(n_panels_); }
  double panel_height() const { return height_ - top_ - bottom_; }
  // The lower end of a line of text. The caption's lines count from the top, the key's lines from the panels downwards.
  double caption_line(int line) const { return height_ - 1.6 * letter_ * (line + 1); }
  double key_line(int line) const { return bottom_ - 1.6 * letter_ * (line + 1); }
  double bottom() const { return bottom_; }
  // Left, lower, right and upper end, each from 0 to 1 across the picture.
  std::array<double, 4> viewport(int panel) const;
  double line_width() const;

 private:
  int width_, height_, n_panels_, letter_;
  double top_ = 0, bottom_ = 0;
};

struct KeyEntry {
  std::string text;
  Colour colour;
};

struct PanelTexts {
  std::vector<std::string> caption;  // lines
  std::vector<KeyEntry> key;         // as many as fit
};

// Draws all texts of a picture behind its panels. unit follows the number at the scale bar. It gets an s unless the number is 1,
// or the unit has no plural, as a symbol.
vtkSmartPointer<vtkRenderer> texts_of_picture(const Layout &layout, const std::vector<PanelTexts> &panels,
                                              const View &view, const Sight &sight, const std::string &unit,
                                              bool has_plural);

// Returns the part of a text that VTK can draw in one line. VTK knows letters other than ASCII only as UTF-8.
std::string drawable(std::string text);
// Returns the number with commas between thousands.
std::string grouped(vtkIdType n);
// Returns texts such as "1 edge" and "1,200 edges".
std::string counted(vtkIdType n, const std::string &singular);
// Returns the largest 1, 2 or 5 times a power of ten that is not above the limit.
double round_length(double limit);

}  // namespace riis::vtk
