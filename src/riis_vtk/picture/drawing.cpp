// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture/drawing.hpp"

#include <vtkActor.h>
#include <vtkCellData.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <vector>

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

namespace {

// Returns copies of the cells that share no points, so that each point can have the colour of its cell. Mesa's softpipe, which is
// in the program's archive, ignores the colours of cells but draws the colours of points.
vtkSmartPointer<vtkPolyData> with_colours_of_points(vtkPolyData *cells) {
  auto apart = vtkSmartPointer<vtkPolyData>::New();
  vtkDataArray *colours = cells->GetCellData()->GetScalars();
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> at_points;
  points->SetDataTypeToDouble();
  at_points->SetNumberOfComponents(3);
  apart->GetPointData()->CopyAllocate(cells->GetPointData(), 3 * cells->GetNumberOfCells());
  apart->AllocateEstimate(cells->GetNumberOfCells(), 3);
  std::vector<vtkIdType> corners;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell) {
    vtkIdType n = 0;
    const vtkIdType *former = nullptr;
    cells->GetCellPoints(cell, n, former);
    corners.clear();
    for (vtkIdType i = 0; i < n; ++i) {
      corners.push_back(points->InsertNextPoint(cells->GetPoint(former[i])));
      apart->GetPointData()->CopyData(cells->GetPointData(), former[i], corners.back());
      at_points->InsertNextTuple(cell, colours);
    }
    apart->InsertNextCell(cells->GetCellType(cell), static_cast<int>(n), corners.data());
  }
  apart->SetPoints(points);
  apart->GetPointData()->SetScalars(at_points);
  return apart;
}

}  // namespace

vtkSmartPointer<vtkActor> coloured_actor_of(vtkPolyData *faces) {
  const vtkSmartPointer<vtkActor> actor = actor_of(with_colours_of_points(faces));
  actor->GetMapper()->SetScalarModeToUsePointData();
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
  // The picture is first written to memory, because the PNG library would print a message if it could not write a file.
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetInputData(image);
  writer->Write();
  vtkUnsignedCharArray *bytes = writer->GetResult();
  const bool is_whole = bytes && bytes->GetNumberOfValues() > 0 && writer->GetErrorCode() == vtkErrorCode::NoError;
  return is_whole ? bytes : nullptr;
}

}  // namespace riis::vtk
