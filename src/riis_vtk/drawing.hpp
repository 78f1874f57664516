// SPDX-License-Identifier: Apache-2.0
// Pictures and the paper's figures have the X display and these steps of drawing in common.
#pragma once

#include <vtkSmartPointer.h>

struct _XDisplay;
class vtkActor;
class vtkPolyData;
class vtkRenderWindow;
class vtkRenderer;
class vtkTextProperty;
class vtkUnsignedCharArray;

namespace riis::vtk {

// A connection to the X display that VTK would open, held while VTK draws. VTK 9.1 renders only through X and GLX, and aborts the
// process where it finds neither. A server without clients resets itself and refuses connections meanwhile.
class HeldDisplay {
 public:
  // Fails with RIIS_UNAVAILABLE unless the display is there and has GLX.
  HeldDisplay();
  ~HeldDisplay();
  HeldDisplay(const HeldDisplay &) = delete;
  HeldDisplay &operator=(const HeldDisplay &) = delete;

 private:
  _XDisplay *display_;
};

// Blue, orange, bluish green, reddish purple, vermilion, sky blue: told apart with any colour vision (Okabe, Ito 2008).
inline constexpr unsigned char distinct_colours[][3] = {{0, 114, 178},   {230, 159, 0}, {0, 158, 115},
                                                        {204, 121, 167}, {213, 94, 0},  {86, 180, 233}};

// Returns a renderer with a white background that lights faces from both sides. It has no lights yet.
vtkSmartPointer<vtkRenderer> white_renderer();

vtkSmartPointer<vtkActor> actor_of(vtkPolyData *data);

// Each face has the colour that the cell scalars, three bytes each, give it.
vtkSmartPointer<vtkActor> coloured_actor_of(vtkPolyData *faces);

// Returns the faces with normals at their corners that hide the edges between them, but not the sharp ones.
vtkSmartPointer<vtkPolyData> smoothed(vtkPolyData *faces);

// The font of all texts; size is in pixels.
void set_font(vtkTextProperty *property, int size);

// The bytes of a PNG file with what the window last rendered; NULL if it could not be encoded.
vtkSmartPointer<vtkUnsignedCharArray> encoded_png(vtkRenderWindow *window);

}  // namespace riis::vtk
