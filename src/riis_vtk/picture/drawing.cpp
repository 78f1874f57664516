// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture/drawing.hpp"

#include <vtkActor.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace riis::vtk {

vtkSmartPointer<vtkRenderer> two_sided_renderer() {
  const auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->TwoSidedLightingOn();
  return renderer;
}

vtkSmartPointer<vtkActor> actor_of(vtkPolyData *data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

vtkSmartPointer<vtkActor> coloured_actor_of(vtkPolyData *faces) {
  const vtkSmartPointer<vtkActor> actor = actor_of(faces);
  actor->GetMapper()->SetScalarModeToUseCellData();
  actor->GetMapper()->SetColorModeToDirectScalars();
  return actor;
}

vtkSmartPointer<vtkPolyData> smoothed(vtkPolyData *faces) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(faces);
  normals->SetFeatureAngle(40);
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

void set_font(vtkTextProperty *property, int size) {
  property->SetFontFamilyToArial();
  property->SetFontSize(size);
}

vtkSmartPointer<vtkImageData> image_of(vtkRenderWindow *window) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  image->ShouldRerenderOff();
  image->Update();
  return image->GetOutput();
}

vtkSmartPointer<vtkUnsignedCharArray> encoded_png(vtkImageData *image) {
  // The picture is first written to memory, because the PNG library prints a message if it cannot write a file.
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetInputData(image);
  writer->Write();
  vtkUnsignedCharArray *bytes = writer->GetResult();
  const bool is_whole = bytes && bytes->GetNumberOfValues() > 0 && writer->GetErrorCode() == vtkErrorCode::NoError;
  return is_whole ? bytes : nullptr;
}

}  // namespace riis::vtk
