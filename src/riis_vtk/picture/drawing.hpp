// SPDX-License-Identifier: Apache-2.0
// The X display, and the steps of drawing that the pictures and the paper's figures have in common.
#pragma once

#include <vtkSmartPointer.h>

struct _XDisplay;
class vtkActor;
class vtkImageData;
class vtkPolyData;
class vtkRenderWindow;
class vtkRenderer;
class vtkTextProperty;
class vtkUnsignedCharArray;

namespace riis::vtk {

// Holds a connection to the X display while VTK draws. On Linux, VTK 9.1 draws only through X and GLX. VTK aborts the process if
// X or GLX is missing. An X server resets itself after its last client has left, and refuses connections during this time.
// Therefore this connection stays open.
class HeldDisplay {
 public:
  // Fails with RIIS_UNAVAILABLE if there is no display, or if the display has no GLX.
  HeldDisplay();
  ~HeldDisplay();
  HeldDisplay(const HeldDisplay &) = delete;
  HeldDisplay &operator=(const HeldDisplay &) = delete;

 private:
  [[maybe_unused]] _XDisplay *display_ = nullptr;  // not used on macOS
};

// Blue, orange, bluish green, reddish purple, vermilion and sky blue. People with any kind of colour vision can tell these
// colours apart (Okabe, Ito 2008).
inline constexpr unsigned char distinct_colours[][3] = {{0, 114, 178},   {230, 159, 0}, {0, 158, 115},
                                                        {204, 121, 167}, {213, 94, 0},  {86, 180, 233}};

// Returns a renderer whose faces are lit from both sides. The caller must add lights.
vtkSmartPointer<vtkRenderer> two_sided_renderer();

vtkSmartPointer<vtkActor> actor_of(vtkPolyData *data);

// Returns an actor for faces. The cell scalars of `faces` give the colours of the faces, three bytes for each cell. The actor has
// its own copy of the points.
vtkSmartPointer<vtkActor> coloured_actor_of(vtkPolyData *faces);

// Returns the faces with normals at their corners. With normals at the corners, smooth edges between faces become invisible, but
// sharp edges stay visible.
vtkSmartPointer<vtkPolyData> smoothed(vtkPolyData *faces);

// Sets the font that all texts use. `size` is in pixels.
void set_font(vtkTextProperty *property, int size);

// Returns the window's last picture.
vtkSmartPointer<vtkImageData> image_of(vtkRenderWindow *window);

// Returns the picture as the bytes of a PNG file, or NULL if it could not be encoded.
vtkSmartPointer<vtkUnsignedCharArray> encoded_png(vtkImageData *image);

}  // namespace riis::vtk
