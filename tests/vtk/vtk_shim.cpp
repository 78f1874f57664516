// SPDX-License-Identifier: Apache-2.0
#include "vtk_shim.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellLocator.h>
#include <vtkCellType.h>
#include <vtkDelaunay3D.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkGenericCell.h>
#include <vtkGeometryFilter.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkShortArray.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPUnstructuredGridWriter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace {

bool ends_with(const std::string &text, const std::string &ending) {
  return text.size() >= ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

// Returns the position of each node in the lattice. The order of the nodes is random.
std::vector<int> shuffled(int n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(7);
  for (int i = n - 1; i > 0; --i) {
    std::swap(order[static_cast<std::size_t>(i)], order[random() % static_cast<unsigned>(i + 1)]);
  }
  return order;
}

void add_tetrahedra(vtkUnstructuredGrid *grid, int n, const std::vector<vtkIdType> &node_at) {
  // The six paths along the edges of a box from one corner to the opposite corner.
  const int paths[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int k = 0; k + 1 < n; ++k) {
    for (int j = 0; j + 1 < n; ++j) {
      for (int i = 0; i + 1 < n; ++i) {
        for (const auto &path : paths) {
          int at[3] = {i, j, k};
          vtkIdType corners[4];
          for (int step = 0; step < 4; ++step) {
            corners[step] = node_at[static_cast<std::size_t>(at[0] + n * (at[1] + n * at[2]))];
            if (step < 3) ++at[path[step]];
          }
          grid->InsertNextCell(VTK_TETRA, 4, corners);
        }
      }
    }
  }
}

template <class Array>
vtkSmartPointer<Array> numbered(const char *name, int n_components, vtkIdType n_tuples, double step) {
  const auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(n_components);
  array->SetNumberOfTuples(n_tuples);
  for (vtkIdType i = 0; i < n_tuples * n_components; ++i) {
    array->SetValue(i, static_cast<typename Array::ValueType>(step * static_cast<double>(i)));
  }
  return array;
}

vtkSmartPointer<vtkUnstructuredGrid> box(int n, const double *lower, const double *upper, bool float_points,
                                         bool with_strings) {
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const int n_nodes = n * n * n;
  const std::vector<int> position = shuffled(n_nodes);
  std::vector<vtkIdType> node_at(static_cast<std::size_t>(n_nodes));
  vtkNew<vtkPoints> points;
  points->SetDataType(float_points ? VTK_FLOAT : VTK_DOUBLE);
  for (int node = 0; node < n_nodes; ++node) {
    const int p = position[static_cast<std::size_t>(node)];
    node_at[static_cast<std::size_t>(p)] = node;
    const int at[3] = {p % n, p / n % n, p / n / n};
    double x[3];
    for (int c = 0; c < 3; ++c) x[c] = lower[c] + (upper[c] - lower[c]) * at[c] / (n - 1);
    points->InsertNextPoint(x);
  }
  grid->SetPoints(points);
  add_tetrahedra(grid, n, node_at);
  grid->GetPointData()->AddArray(numbered<vtkDoubleArray>("pressure", 1, n_nodes, 0.1));
  grid->GetPointData()->AddArray(numbered<vtkFloatArray>("velocity", 3, n_nodes, 0.5));
  grid->GetCellData()->AddArray(numbered<vtkShortArray>("region", 1, grid->GetNumberOfCells(), 1));
  grid->GetFieldData()->AddArray(numbered<vtkDoubleArray>("time", 1, 2, 0.25));
  if (with_strings) {
    vtkNew<vtkStringArray> names;
    names->SetName("name");
    for (int node = 0; node < n_nodes; ++node) names->InsertNextValue("node " + std::to_string(node));
    grid->GetPointData()->AddArray(names);
  }
  return grid;
}

vtkSmartPointer<vtkPointSet> read(const std::string &path) {
  vtkSmartPointer<vtkPointSet> data;
  if (ends_with(path, ".vtp")) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    data = reader->GetOutput();
  } else if (ends_with(path, ".vtu") || ends_with(path, ".VTU")) {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    data = reader->GetOutput();
  } else {
    vtkNew<vtkUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->ReadAllScalarsOn();
    reader->ReadAllVectorsOn();
    reader->Update();
    data = reader->GetOutput();
  }
  return data && data->GetPoints() ? data : nullptr;
}

// Returns n different nodes, chosen at random from the first n_nodes.
std::vector<vtkIdType> drawn(int n_nodes, int n, std::mt19937 &random) {
  std::vector<vtkIdType> nodes(static_cast<std::size_t>(n_nodes));
  std::iota(nodes.begin(), nodes.end(), 0);
  for (int i = 0; i < n; ++i) {
    std::swap(nodes[static_cast<std::size_t>(i)],
              nodes[static_cast<std::size_t>(i) + random() % static_cast<unsigned>(n_nodes - i)]);
  }
  nodes.resize(static_cast<std::size_t>(n));
  return nodes;
}

void add_polyhedron(vtkUnstructuredGrid *grid, const std::vector<vtkIdType> &p) {
  const vtkIdType faces[] = {3, p[0], p[1], p[2], 3, p[0], p[1], p[3], 3, p[1], p[2], p[3], 3, p[2], p[0], p[3]};
  grid->InsertNextCell(VTK_POLYHEDRON, 4, p.data(), 4, faces);
}

class CountingWindow : public vtkOutputWindow {
 public:
  static CountingWindow *New();
  vtkTypeMacro(CountingWindow, vtkOutputWindow);
  void DisplayText(const char *) override { ++n_messages; }
  int n_messages = 0;
};
vtkStandardNewMacro(CountingWindow);

CountingWindow *counting_window() {
  static const vtkNew<CountingWindow> window;
  return window.Get();
}

}  // namespace

vtkSmartPointer<vtkPolyData> shim_polydata(int64_t n_points, const double *xyz, int64_t n_triangles,
                                           const int64_t *corners) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int64_t i = 0; i < n_points; ++i) points->InsertNextPoint(xyz + 3 * i);
  vtkNew<vtkCellArray> triangles;
  for (int64_t i = 0; i < n_triangles; ++i) {
    const vtkIdType ids[3] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
    triangles->InsertNextCell(3, ids);
  }
  const auto faces = vtkSmartPointer<vtkPolyData>::New();
  faces->SetPoints(points);
  faces->SetPolys(triangles);
  return faces;
}

extern "C" {

int shim_write_box(const char *path, int encoding, int n, const double lower[3], const double upper[3],
                   int float_points) {
  const bool legacy = encoding == SHIM_LEGACY_ASCII || encoding == SHIM_LEGACY_BINARY;
  const auto grid = box(n, lower, upper, float_points != 0, !legacy);
  if (legacy) {
    vtkNew<vtkUnstructuredGridWriter> writer;
    writer->SetFileName(path);
    writer->SetInputData(grid);
    writer->SetFileType(encoding == SHIM_LEGACY_ASCII ? VTK_ASCII : VTK_BINARY);
    return writer->Write();
  }
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(path);
  writer->SetInputData(grid);
  if (encoding == SHIM_ASCII) writer->SetDataModeToAscii();
  if (encoding == SHIM_BINARY) writer->SetDataModeToBinary();
  if (encoding == SHIM_COMPRESSED || encoding == SHIM_RAW) writer->SetDataModeToAppended();
  if (encoding != SHIM_COMPRESSED) writer->SetCompressorTypeToNone();
  if (encoding == SHIM_RAW) writer->EncodeAppendedDataOff();
  return writer->Write();
}

int shim_write_blocks(const char *path, int encoding, int compressor, int header_bits) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  const auto grid = box(5, lower, upper, false, false);
  for (int i = 0; i < 5; ++i) {
    const vtkIdType corners[4] = {i, i + 20, i + 40, i + 60};
    add_polyhedron(grid, {corners, corners + 4});
  }
  grid->GetCellData()->AddArray(numbered<vtkShortArray>("region", 1, grid->GetNumberOfCells(), 1));
  vtkNew<vtkGeometryFilter> outside;
  vtkSmartPointer<vtkXMLWriter> writer;
  if (ends_with(path, ".vtp")) {
    outside->SetInputData(grid);
    writer = vtkSmartPointer<vtkXMLPolyDataWriter>::New();
    writer->SetInputConnection(outside->GetOutputPort());
  } else {
    writer = vtkSmartPointer<vtkXMLUnstructuredGridWriter>::New();
    writer->SetInputData(grid);
  }
  writer->SetFileName(path);
  writer->SetDataMode(encoding == SHIM_ASCII    ? vtkXMLWriter::Ascii
                      : encoding == SHIM_BINARY ? vtkXMLWriter::Binary
                                                : vtkXMLWriter::Appended);
  writer->SetEncodeAppendedData(encoding != SHIM_RAW);
  writer->SetCompressorType(compressor);
  writer->SetBlockSize(1024);
  writer->SetHeaderType(header_bits);
  return writer->Write();
}

int shim_write_legacy(const char *path, int binary, int version) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 40; ++i) points->InsertNextPoint(i % 2, i % 3, i);
  points->GetData()->GetRange(-1);
  grid->SetPoints(points);
  const vtkIdType corners[4] = {0, 1, 2, 3};
  grid->InsertNextCell(VTK_TETRA, 4, corners);
  const auto flow = numbered<vtkDoubleArray>("flow", 3, 40, 0.5);
  flow->SetComponentName(0, "along x");
  flow->GetRange(-1);
  grid->GetPointData()->AddArray(flow);
  grid->GetPointData()->AddArray(numbered<vtkDoubleArray>("p", 1, 40, 1));
  vtkNew<vtkBitArray> bits;
  bits->SetName("bits");
  for (int i = 0; i < 40; ++i) bits->InsertNextValue(i % 2);
  grid->GetPointData()->AddArray(bits);
  vtkNew<vtkUnstructuredGridWriter> writer;
  writer->SetFileName(path);
  writer->SetInputData(grid);
  writer->SetFileType(binary ? VTK_BINARY : VTK_ASCII);
  writer->SetFileVersion(version);
  return writer->Write();
}

int shim_read_points(const char *path, int64_t *n_points, int64_t *n_cells, char point_type[32], double *xyz) {
  const auto data = read(path);
  if (!data) return 0;
  if (n_points) *n_points = data->GetNumberOfPoints();
  if (n_cells) *n_cells = data->GetNumberOfCells();
  if (point_type) std::strcpy(point_type, data->GetPoints()->GetData()->GetDataTypeAsString());
  for (vtkIdType i = 0; xyz && i < data->GetNumberOfPoints(); ++i) data->GetPoint(i, xyz + 3 * i);
  return 1;
}

int shim_write_pieces(const char *path, const char *pvtu, int n_pieces) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  vtkNew<vtkXMLPUnstructuredGridReader> list_reader;
  vtkNew<vtkXMLPUnstructuredGridWriter> writer;
  if (ends_with(path, ".pvtu")) {
    list_reader->SetFileName(path);
    writer->SetInputConnection(list_reader->GetOutputPort());
  } else {
    reader->SetFileName(path);
    writer->SetInputConnection(reader->GetOutputPort());
  }
  writer->SetFileName(pvtu);
  writer->SetNumberOfPieces(n_pieces);
  writer->SetStartPiece(0);
  writer->SetEndPiece(n_pieces - 1);
  return writer->Write();
}

int64_t shim_read_pieces(const char *pvtu, const char *array, double *sum, int64_t *n_cells) {
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName(pvtu);
  reader->Update();
  vtkUnstructuredGrid *grid = reader->GetOutput();
  vtkDataArray *values = grid->GetPointData()->GetArray(array);
  if (!values) return -1;
  *sum = 0;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i) *sum += values->GetTuple1(i);
  *n_cells = grid->GetNumberOfCells();
  return grid->GetNumberOfPoints();
}

int64_t shim_read_corners(const char *path, int64_t *ids) {
  const auto data = read(path);
  if (!data) return -1;
  int64_t n = 0;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell) {
    data->GetCellPoints(cell, corners);
    for (const vtkIdType corner : *corners) {
      if (ids) ids[n] = corner;
      ++n;
    }
  }
  return n;
}

int shim_write_zoo(const char *path) {
  struct Kind {
    int type, n_nodes;
  };
  const Kind kinds[] = {{VTK_TETRA, 4}, {VTK_VERTEX, 1},     {VTK_PYRAMID, 5},         {VTK_TRIANGLE, 3},
                        {VTK_WEDGE, 6}, {VTK_LINE, 2},       {VTK_VOXEL, 8},           {VTK_PENTAGONAL_PRISM, 10},
                        {VTK_QUAD, 4},  {VTK_HEXAHEDRON, 8}, {VTK_QUADRATIC_TETRA, 10}};
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  std::mt19937 random(11);
  for (int i = 0; i < n_shim_zoo; ++i) points->InsertNextPoint(i % 4, i / 4 % 4, i / 16);
  grid->SetPoints(points);
  for (int round = 0; round < 3; ++round) {
    for (const Kind &kind : kinds) {
      const bool volume = kind.n_nodes >= 4 && kind.n_nodes <= 8 && kind.type != VTK_QUAD;
      const std::vector<vtkIdType> nodes = drawn(volume ? n_shim_zoo - 10 : n_shim_zoo, kind.n_nodes, random);
      grid->InsertNextCell(kind.type, kind.n_nodes, nodes.data());
    }
    add_polyhedron(grid, drawn(n_shim_zoo, 4, random));
  }
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(path);
  writer->SetInputData(grid);
  return writer->Write();
}

int64_t shim_read_edges(const char *path, int cell_type, int64_t *edges) {
  const auto data = read(path);
  if (!data) return -1;
  int64_t n = 0;
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType cell_id = 0; cell_id < data->GetNumberOfCells(); ++cell_id) {
    if (data->GetCellType(cell_id) != cell_type) continue;
    data->GetCell(cell_id, cell);
    for (int i = 0; i < cell->GetNumberOfEdges(); ++i, ++n) {
      if (!edges) continue;
      vtkIdList *ends = cell->GetEdge(i)->GetPointIds();
      edges[2 * n] = ends->GetId(0);
      edges[2 * n + 1] = ends->GetId(1);
    }
  }
  return n;
}

int shim_shape_functions(int cell_type, const double point[3], double *values, double *derivatives) {
  vtkNew<vtkGenericCell> cell;
  cell->SetCellType(cell_type);
  cell->InterpolateFunctions(point, values);
  cell->InterpolateDerivs(point, derivatives);
  return static_cast<int>(cell->GetNumberOfPoints());
}

int shim_write_delaunay(const char *path, int64_t n, const double *xyz) {
  const auto data = shim_polydata(n, xyz, 0, nullptr);
  vtkNew<vtkDelaunay3D> delaunay;
  delaunay->SetInputData(data);
  delaunay->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(path);
  writer->SetInputConnection(delaunay->GetOutputPort());
  return writer->Write();
}

int shim_read_array(const char *path, char where, const char *name, char type[32], int64_t *n_components,
                    int64_t *n_tuples, double *values) {
  const auto data = read(path);
  if (!data) return 0;
  vtkFieldData *fields = where == 'p'   ? static_cast<vtkFieldData *>(data->GetPointData())
                         : where == 'c' ? static_cast<vtkFieldData *>(data->GetCellData())
                                        : data->GetFieldData();
  vtkAbstractArray *array = fields->GetAbstractArray(name);
  if (!array) return 0;
  if (type) std::strcpy(type, array->GetDataTypeAsString());
  if (n_components) *n_components = array->GetNumberOfComponents();
  if (n_tuples) *n_tuples = array->GetNumberOfTuples();
  for (vtkIdType i = 0; values && i < array->GetNumberOfValues(); ++i) values[i] = array->GetVariantValue(i).ToDouble();
  return 1;
}

int shim_read_png(const char *path, int *width, int *height, int *n_colours, int n_coloured[2]) {
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(path)) return 0;
  reader->SetFileName(path);
  reader->Update();
  vtkImageData *image = reader->GetOutput();
  int size[3];
  image->GetDimensions(size);
  *width = size[0];
  *height = size[1];
  n_coloured[0] = n_coloured[1] = 0;
  const int n_channels = image->GetNumberOfScalarComponents();
  std::set<std::vector<unsigned char>> colours;
  for (int y = 0; y < size[1]; ++y) {
    for (int x = 0; x < size[0]; ++x) {
      const auto *pixel = static_cast<const unsigned char *>(image->GetScalarPointer(x, y, 0));
      const std::vector<unsigned char> colour(pixel, pixel + n_channels);
      const auto [least, most] = std::minmax_element(colour.begin(), colour.end());
      n_coloured[x < size[0] / 2 ? 0 : 1] += *most - *least > 60;
      colours.insert(colour);
    }
  }
  *n_colours = static_cast<int>(colours.size());
  return 1;
}

namespace {

// Reads the first channels of a picture. Returns NULL if the picture has fewer channels.
unsigned char *read_channels(const char *path, int n_channels, int *width, int *height) {
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(path)) return nullptr;
  reader->SetFileName(path);
  reader->Update();
  vtkImageData *image = reader->GetOutput();
  if (image->GetNumberOfScalarComponents() < n_channels) return nullptr;
  int size[3];
  image->GetDimensions(size);
  *width = size[0];
  *height = size[1];
  auto *pixels = static_cast<unsigned char *>(std::malloc(static_cast<std::size_t>(n_channels * size[0] * size[1])));
  for (int i = 0; pixels && i < size[0] * size[1]; ++i)
    std::copy_n(static_cast<const unsigned char *>(image->GetScalarPointer(i % size[0], i / size[0], 0)), n_channels,
                pixels + n_channels * i);
  return pixels;
}

}  // namespace

unsigned char *shim_read_pixels(const char *path, int *width, int *height) {
  return read_channels(path, 3, width, height);
}

unsigned char *shim_read_clear_pixels(const char *path, int *width, int *height) {
  return read_channels(path, 4, width, height);
}

void shim_distances(int method, int64_t n_vertices, const double *vertices, int64_t n_triangles, const int64_t *corners,
                    int64_t n_points, const double *points, double *distances) {
  const auto data = shim_polydata(n_vertices, vertices, n_triangles, corners);
  if (method == SHIM_IMPLICIT_DISTANCE) {
    vtkNew<vtkImplicitPolyDataDistance> implicit;
    implicit->SetInput(data);
    for (int64_t i = 0; i < n_points; ++i) {
      double point[3] = {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
      distances[i] = std::fabs(implicit->EvaluateFunction(point));
    }
    return;
  }
  vtkSmartPointer<vtkAbstractCellLocator> locator;
  if (method == SHIM_STATIC_LOCATOR) {
    locator = vtkSmartPointer<vtkStaticCellLocator>::New();
  } else {
    locator = vtkSmartPointer<vtkCellLocator>::New();
  }
  locator->SetDataSet(data);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  for (int64_t i = 0; i < n_points; ++i) {
    double closest[3], squared = -1;
    vtkIdType cell_id = -1;
    int sub_id = 0;
    locator->FindClosestPoint(points + 3 * i, closest, cell, cell_id, sub_id, squared);
    distances[i] = std::sqrt(squared);
  }
}

void shim_watch_window(void) {
  counting_window()->n_messages = 0;
  vtkOutputWindow::SetInstance(counting_window());
}

int shim_n_messages(void) { return counting_window()->n_messages; }

void shim_say_error(void) { vtkGenericWarningMacro("said by the test"); }
}
