// SPDX-License-Identifier: Apache-2.0
#include "grids_shim.h"

#include <cmath>
#include <string>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridWriter.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridWriter.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsWriter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "vtk_shim.h"

namespace {

using Data = vtkSmartPointer<vtkDataSet>;

template <class Array>
vtkSmartPointer<Array> array_of(const char *name, const double *values, vtkIdType n) {
  const auto made = vtkSmartPointer<Array>::New();
  made->SetName(name);
  made->SetNumberOfTuples(n);
  for (vtkIdType i = 0; i < n; ++i) made->SetComponent(i, 0, values[i]);
  return made;
}

vtkSmartPointer<vtkDataArray> axis_of(const shim_grid &grid, int axis) {
  if (grid.is_single) return array_of<vtkFloatArray>("axis", grid.x[axis], grid.n[axis]);
  return array_of<vtkDoubleArray>("axis", grid.x[axis], grid.n[axis]);
}

// In VTK 9.1, an image may have a matrix that turns its points. A legacy file stores no matrix.
vtkSmartPointer<vtkImageData> image_of(const shim_grid &grid, bool is_legacy) {
  const auto made = is_legacy ? vtkSmartPointer<vtkImageData>(vtkSmartPointer<vtkStructuredPoints>::New())
                              : vtkSmartPointer<vtkImageData>::New();
  made->SetExtent(grid.first[0], grid.first[0] + grid.n[0] - 1, grid.first[1], grid.first[1] + grid.n[1] - 1,
                  grid.first[2], grid.first[2] + grid.n[2] - 1);
  made->SetOrigin(grid.origin[0], grid.origin[1], grid.origin[2]);
  made->SetSpacing(grid.spacing[0], grid.spacing[1], grid.spacing[2]);
  const double c = std::cos(grid.turn), s = std::sin(grid.turn);
  if (grid.turn != 0) made->SetDirectionMatrix(c, -s, 0, s, c, 0, 0, 0, 1);
  return made;
}

vtkSmartPointer<vtkRectilinearGrid> rectilinear_of(const shim_grid &grid) {
  const auto made = vtkSmartPointer<vtkRectilinearGrid>::New();
  made->SetDimensions(grid.n[0], grid.n[1], grid.n[2]);
  made->SetXCoordinates(axis_of(grid, 0));
  made->SetYCoordinates(axis_of(grid, 1));
  made->SetZCoordinates(axis_of(grid, 2));
  return made;
}

Data straight_of(const shim_grid &grid, bool is_legacy) {
  if (grid.x[0]) return rectilinear_of(grid);
  return image_of(grid, is_legacy);
}

Data data_of(const shim_grid &grid, bool is_legacy) {
  Data made = straight_of(grid, is_legacy);
  if (grid.is_curved) {
    const auto curved = vtkSmartPointer<vtkStructuredGrid>::New();
    curved->SetDimensions(grid.n[0], grid.n[1], grid.n[2]);
    vtkNew<vtkPoints> points;
    if (!grid.is_single) points->SetDataTypeToDouble();
    for (vtkIdType i = 0; i < made->GetNumberOfPoints(); ++i) {
      double p[3];
      made->GetPoint(i, p);
      points->InsertNextPoint(p[0] + grid.bend * std::sin(p[1]), p[1] + grid.bend * std::sin(p[2]), p[2]);
    }
    curved->SetPoints(points);
    made = curved;
  }
  vtkNew<vtkDoubleArray> value, sample;
  value->SetName("value");
  sample->SetName("sample");
  for (vtkIdType i = 0; i < made->GetNumberOfPoints(); ++i) value->InsertNextValue(std::sin(static_cast<double>(i)));
  for (vtkIdType i = 0; i < made->GetNumberOfCells(); ++i) sample->InsertNextValue(std::cos(static_cast<double>(i)));
  made->GetPointData()->AddArray(value);
  made->GetCellData()->AddArray(sample);
  if (grid.n_zones == 0) return made;
  vtkNew<vtkDoubleArray> zone;
  zone->SetName("zone");
  for (vtkIdType i = 0; i < made->GetNumberOfCells(); ++i)
    zone->InsertNextValue(static_cast<double>(i / 3 % grid.n_zones));
  made->GetCellData()->AddArray(zone);
  return made;
}

template <class Writer>
int write_xml(const char *path, int encoding, vtkDataObject *data) {
  vtkNew<Writer> writer;
  writer->SetFileName(path);
  writer->SetInputData(data);
  if (encoding == SHIM_ASCII) writer->SetDataModeToAscii();
  if (encoding == SHIM_BINARY) writer->SetDataModeToBinary();
  if (encoding == SHIM_COMPRESSED || encoding == SHIM_RAW) writer->SetDataModeToAppended();
  if (encoding == SHIM_RAW) writer->EncodeAppendedDataOff();
  if (encoding != SHIM_COMPRESSED) writer->SetCompressorTypeToNone();
  return writer->Write();
}

template <class Writer>
int write_legacy(const char *path, int encoding, vtkDataObject *data) {
  vtkNew<Writer> writer;
  writer->SetFileName(path);
  writer->SetInputData(data);
  if (encoding == SHIM_LEGACY_BINARY) writer->SetFileTypeToBinary();
  return writer->Write();
}

template <class Reader, class Axes>
int read_grid(const char *path, int n[3], double *const x[3], const char *name, double *values, const Axes &axes) {
  vtkNew<Reader> reader;
  reader->SetFileName(path);
  reader->Update();
  auto *const data = reader->GetOutput();
  vtkDataArray *const array = data ? data->GetPointData()->GetArray(name) : nullptr;
  if (!array) return 0;
  data->GetDimensions(n);
  axes(data, x);
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int c = 0; c < array->GetNumberOfComponents(); ++c) *values++ = array->GetComponent(i, c);
  return 1;
}

}  // namespace

int shim_write_grid(const char *path, int encoding, const shim_grid *grid) {
  const std::string name = path, ending = name.substr(name.size() - 4);
  const Data data = data_of(*grid, ending == ".vtk");
  if (ending == ".vti") return write_xml<vtkXMLImageDataWriter>(path, encoding, data);
  if (ending == ".vtr") return write_xml<vtkXMLRectilinearGridWriter>(path, encoding, data);
  if (ending == ".vts") return write_xml<vtkXMLStructuredGridWriter>(path, encoding, data);
  if (grid->is_curved) return write_legacy<vtkStructuredGridWriter>(path, encoding, data);
  if (grid->x[0]) return write_legacy<vtkRectilinearGridWriter>(path, encoding, data);
  return write_legacy<vtkStructuredPointsWriter>(path, encoding, data);
}

int shim_write_grid_as_cells(const char *path, const shim_grid *grid) {
  const Data data = data_of(*grid, false);
  vtkNew<vtkUnstructuredGrid> made;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) points->InsertNextPoint(data->GetPoint(i));
  made->SetPoints(points);
  made->AllocateEstimate(data->GetNumberOfCells(), 8);
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    vtkIdList *const ids = data->GetCell(i)->GetPointIds();
    const int type = data->GetCellType(i);
    const auto swap = [&](vtkIdType a) {
      const vtkIdType id = ids->GetId(a);
      ids->SetId(a, ids->GetId(a + 1));
      ids->SetId(a + 1, id);
    };
    if (type == VTK_VOXEL || type == VTK_PIXEL) swap(2);
    if (type == VTK_VOXEL) swap(6);
    made->InsertNextCell(type == VTK_VOXEL ? VTK_HEXAHEDRON : type == VTK_PIXEL ? VTK_QUAD : type, ids);
  }
  made->GetPointData()->ShallowCopy(data->GetPointData());
  made->GetCellData()->ShallowCopy(data->GetCellData());
  return write_xml<vtkXMLUnstructuredGridWriter>(path, SHIM_RAW, made);
}

int shim_read_grid(const char *path, int n[3], double *const x[3], const char *array, double *values) {
  const std::string name = path;
  if (name.substr(name.size() - 4) == ".vti")
    return read_grid<vtkXMLImageDataReader>(path, n, x, array, values, [](vtkImageData *data, double *const to[3]) {
      for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < data->GetDimensions()[axis]; ++i) {
          int at[3] = {data->GetExtent()[0], data->GetExtent()[2], data->GetExtent()[4]};
          at[axis] += i;
          double point[3];
          data->TransformIndexToPhysicalPoint(at, point);
          to[axis][i] = point[axis];
        }
    });
  return read_grid<vtkXMLRectilinearGridReader>(
      path, n, x, array, values, [](vtkRectilinearGrid *data, double *const to[3]) {
        vtkDataArray *const axes[3] = {data->GetXCoordinates(), data->GetYCoordinates(), data->GetZCoordinates()};
        for (int axis = 0; axis < 3; ++axis)
          for (vtkIdType i = 0; i < axes[axis]->GetNumberOfTuples(); ++i) to[axis][i] = axes[axis]->GetComponent(i, 0);
      });
}
