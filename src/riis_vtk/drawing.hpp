// SPDX-License-Identifier: Apache-2.0
// Pictures and the paper's figures share the X display and these steps of drawing.
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

// A connection to the X display that VTK opens, held while VTK draws. VTK 9.1 renders only through X and GLX, and aborts the
// process if either is missing. A server without clients resets itself and meanwhile refuses connections.
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

// Blue, orange, bluish green, reddish purple, vermilion, sky blue: distinct with any colour vision (Okabe, Ito 2008).
inline constexpr unsigned char distinct_colours[][3] = {{0, 114, 178},   {230, 159, 0}, {0, 158, 115},
                                                        {204, 121, 167}, {213, 94, 0},  {86, 180, 233}};

// Returns a renderer with a white background that lights faces from both sides. It has no lights yet.
vtkSmartPointer<vtkRenderer> white_renderer();

vtkSmartPointer<vtkActor> actor_of(vtkPolyData *data);

// The cell scalars, three bytes each, are the colours of the faces.
vtkSmartPointer<vtkActor> coloured_actor_of(vtkPolyData *faces);

// Returns the faces with normals at their corners. The normals hide smooth edges between faces, and sharp edges stay visible.
vtkSmartPointer<vtkPolyData> smoothed(vtkPolyData *faces);

// Sets the font of all texts; size is in pixels.
void set_font(vtkTextProperty *property, int size);

// Returns the bytes of a PNG file with the last picture of the window, or NULL if it could not be encoded.
vtkSmartPointer<vtkUnsignedCharArray> encoded_png(vtkRenderWindow *window);

}  // namespace riis::vtk
