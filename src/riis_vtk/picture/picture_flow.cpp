// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/picture/picture_flow.hpp"

#include <riis/riis_vtk.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <vector>

#include <vtkActor.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellDataToPointData.h>
#include <vtkCutter.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProbeFilter.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTriangle.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "common/elementary.hpp"
#include "riis_vtk/base/files.hpp"
#include "riis_vtk/mesh/mesh.hpp"
#include "riis_vtk/picture/drawing.hpp"
#include "riis_vtk/read/other_files.hpp"

namespace riis::vtk {
namespace {

// The colours of matplotlib's map viridis, at equal distances. People with any kind of colour vision see the order of these
// colours.
constexpr unsigned char viridis[][3] = {{68, 1, 84},    {71, 44, 122}, {59, 81, 139},  {44, 113, 142}, {33, 144, 141},
                                        {39, 173, 129}, {92, 200, 99}, {170, 220, 50}, {253, 231, 37}};

// Returns the smallest round number that is not below the given number.
double rounded_up(double number) {
  if (!(number > 0)) return 1;
  const double power = std::pow(10, std::floor(std::log10(number)));
  for (const double digit : {1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.4, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0})
    if (digit * power >= number * (1 - 1e-9)) return digit * power;
  return 10 * power;
}

vtkSmartPointer<vtkPolyData> cut(vtkDataSet *data, const View &view, const Vector &origin) {
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(origin.data());
  plane->SetNormal(view.away().data());
  vtkNew<vtkCutter> cutter;
  cutter->SetCutFunction(plane);
  cutter->SetInputData(data);
  cutter->Update();
  return cutter->GetOutput();
}

void set_data(vtkActor *actor, vtkPolyData *data) {
  vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->SetInputData(data);
}

vtkSmartPointer<vtkActor> plain_actor(const Colour &colour) {
  vtkNew<vtkPolyData> nothing;
  const vtkSmartPointer<vtkActor> actor = actor_of(nothing);
  actor->GetMapper()->ScalarVisibilityOff();
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->LightingOff();
  return actor;
}

// Returns a strip of the given width along each line, in the plane of the view. Plain lines are not used, because OpenGL limits
// their width.
vtkSmartPointer<vtkPolyData> strips(vtkPolyData *lines, const View &view, double width) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> faces;
  vtkNew<vtkIdList> ends;
  for (vtkIdType line = 0; line < lines->GetNumberOfCells(); ++line) {
    lines->GetCellPoints(line, ends);
    for (vtkIdType i = 0; i + 1 < ends->GetNumberOfIds(); ++i) {
      double a[3], b[3], along[3], across[3];
      lines->GetPoint(ends->GetId(i), a);
      lines->GetPoint(ends->GetId(i + 1), b);
      vtkMath::Subtract(b, a, along);
      if (vtkMath::Normalize(along) == 0) continue;
      vtkMath::Cross(view.away().data(), along, across);
      // A strip is longer than its line by half of its width at each end. Strips thus overlap at corners.
      const double half = 0.5 * width;
      vtkIdType corners[4];
      for (int corner = 0; corner < 4; ++corner) {
        const bool is_at_b = corner == 1 || corner == 2;
        double at[3];
        for (int k = 0; k < 3; ++k)
          at[k] = (is_at_b ? b[k] + half * along[k] : a[k] - half * along[k]) + (corner < 2 ? -half : half) * across[k];
        corners[corner] = points->InsertNextPoint(at);
      }
      faces->InsertNextCell(4, corners);
    }
  }
  const auto made = vtkSmartPointer<vtkPolyData>::New();
  made->SetPoints(points);
  made->SetPolys(faces);
  return made;
}

// An area, and its first moment: the sum of the parts' centres times the parts' areas.
struct AreaMoment {
  Vector sum = {0, 0, 0};
  double area = 0;
  void add(const Vector &centre_times_area, double part) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += centre_times_area[k];
    area += part;
  }
  Vector centre() const { return {sum[0] / area, sum[1] / area, sum[2] / area}; }
};

std::map<int, AreaMoment> moments_of_leaflets(vtkPolyData *surface) {
  vtkDataArray *const leaflets = surface->GetCellData()->GetArray(leaflet_array);
  std::map<int, AreaMoment> moments;
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; face < surface->GetNumberOfCells(); ++face) {
    surface->GetCellPoints(face, corners);
    double a[3], b[3], c[3];
    surface->GetPoint(corners->GetId(0), a);
    surface->GetPoint(corners->GetId(1), b);
    surface->GetPoint(corners->GetId(2), c);
    const double part = vtkTriangle::TriangleArea(a, b, c);
    Vector centre;
    for (std::size_t k = 0; k < 3; ++k) centre[k] = part * (a[k] + b[k] + c[k]) / 3;
    moments[static_cast<int>(leaflets->GetComponent(face, 0))].add(centre, part);
  }
  return moments;
}

// Returns the centre of the surface's area.
Vector middle_of(const std::map<int, AreaMoment> &leaflets) {
  AreaMoment whole;
  for (const auto &[leaflet, moment] : leaflets) whole.add(moment.sum, moment.area);
  return whole.centre();
}

// Returns the lines whose two ends are inside the grid. Outside of the grid, for example in the wall, a leaflet meets no flow.
vtkSmartPointer<vtkPolyData> lines_inside(vtkPolyData *lines, vtkUnstructuredGrid *grid) {
  vtkNew<vtkProbeFilter> probe;
  probe->SetInputData(lines);
  probe->SetSourceData(grid);
  probe->Update();
  vtkDataArray *const is_inside = probe->GetOutput()->GetPointData()->GetArray(probe->GetValidPointMaskArrayName());
  const auto kept = vtkSmartPointer<vtkPolyData>::New();
  kept->SetPoints(lines->GetPoints());
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdList> ends;
  for (vtkIdType line = 0; line < lines->GetNumberOfCells(); ++line) {
    lines->GetCellPoints(line, ends);
    if (is_inside->GetComponent(ends->GetId(0), 0) != 0 && is_inside->GetComponent(ends->GetId(1), 0) != 0)
      cells->InsertNextCell(ends);
  }
  kept->SetLines(cells);
  return kept;
}

// Moves an actor towards the eye, so that it is drawn in front of the plane. Without perspective, the actor looks the same.
void move_near(vtkActor *actor, const View &view, double length) {
  actor->SetPosition(-length * view.away()[0], -length * view.away()[1], -length * view.away()[2]);
}

}  // namespace

Flow flow_of(const riis_vtk_mesh &mesh, const std::string &name) {
  vtkUnstructuredGrid *const grid = mesh.grid();
  vtkSmartPointer<vtkDataArray> at_points = grid->GetPointData()->GetArray(name.c_str()),
                                in_cells = grid->GetCellData()->GetArray(name.c_str());
  Flow flow;
  if (!at_points && !in_cells && !mesh.foam_time.empty()) {
    in_cells = read_foam_vectors(mesh.foam_time, name, grid->GetNumberOfCells());
    in_cells->SetName(name.c_str());
    flow.unit = "m/s";
    flow.time = std::filesystem::path(mesh.foam_time).filename().string();
  }
  vtkDataArray *const found = at_points ? at_points : in_cells;
  if (!found) {
    const std::string &foam_case = mesh.foam_case;
    refuse_argument("options->velocity is \"", name, "\", which is not an array of the mesh",
                    foam_case.empty() ? "" : "; for a field of OpenFOAM, name a time in place of the case: ",
                    foam_case.empty() ? "" : foam_times_of(foam_case));
  }
  if (found->GetNumberOfComponents() != 3)
    refuse_argument("options->velocity is \"", name, "\", whose number of components is ",
                    found->GetNumberOfComponents(), ", not 3");
  if (found->GetInformation()->Has(vtkDataArray::UNITS_LABEL()))
    flow.unit = found->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
  vtkNew<vtkUnstructuredGrid> plain;
  plain->CopyStructure(grid);
  if (at_points) {
    plain->GetPointData()->SetVectors(at_points);
    flow.grid = plain;
    return flow;
  }
  plain->GetCellData()->SetVectors(in_cells);
  vtkNew<vtkCellDataToPointData> averaged;
  averaged->SetInputData(plain);
  averaged->Update();
  flow.grid = averaged->GetUnstructuredGridOutput();
  flow.grid->GetPointData()->SetActiveVectors(name.c_str());
  return flow;
}

Colour colour_of_speed(double share) {
  constexpr std::size_t last = std::size(viridis) - 1;
  const double at = last * std::clamp(share, 0.0, 1.0);
  const auto below = std::min(last - 1, static_cast<std::size_t>(at));
  Colour colour;
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = viridis[below][k], b = viridis[below + 1][k];
    colour[k] = (a + (at - static_cast<double>(below)) * (b - a)) / 255;
  }
  return colour;
}

Axes axes_through_two_leaflets(vtkPolyData *surface, const Axes &valve) {
  const std::map<int, AreaMoment> leaflets = moments_of_leaflets(surface);
  const Vector middle = middle_of(leaflets);
  std::vector<Axes> tried;
  std::vector<double> distances;  // for each plane, from the second nearest centre or from the only centre
  for (int degrees = 0; degrees < 180; degrees += 15) {
    tried.push_back(turned_about_z(valve, degrees));
    const View view(RIIS_VTK_VIEW_VALVE_LONG, tried.back());
    std::vector<double> from_centres;
    for (const auto &[leaflet, moment] : leaflets) {
      const Vector centre = moment.centre();
      double away = 0;
      for (std::size_t k = 0; k < 3; ++k) away += (centre[k] - middle[k]) * view.away()[k];
      from_centres.push_back(std::abs(away));
    }
    std::sort(from_centres.begin(), from_centres.end());
    distances.push_back(from_centres[std::min<std::size_t>(1, from_centres.size() - 1)]);
  }
  // Several planes are nearly as good as the best, for example three planes of a valve with three cusps. The first of these
  // planes is taken, so that the view stays the same while the valve opens.
  const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
  const double good = *least + 0.2 * (*most - *least);
  const auto first =
      std::find_if(distances.begin(), distances.end(), [&](double distance) { return distance <= good; });
  return tried[static_cast<std::size_t>(first - distances.begin())];
}

FlowPanel::FlowPanel(const Flow &flow, vtkPolyData *wall, const Colour &line)
    : flow_(flow), renderer_(two_sided_renderer()), faces_(wall) {
  vtkNew<vtkPolyData> nothing;
  plane_ = actor_of(nothing);
  plane_->GetMapper()->SetScalarModeToUsePointData();
  plane_->GetMapper()->SetColorModeToDirectScalars();
  plane_->GetProperty()->LightingOff();
  wall_ = plain_actor(line);
  // White strips with a dark edge are visible on every colour of the plane, and on every background.
  around_leaflets_ = plain_actor({0.1, 0.1, 0.1});
  leaflets_ = plain_actor({1, 1, 1});
  for (vtkActor *actor : {plane_.Get(), wall_.Get(), around_leaflets_.Get(), leaflets_.Get()})
    renderer_->AddActor(actor);
}

vtkSmartPointer<vtkPolyData> FlowPanel::plane_of(const View &view) const {
  vtkSmartPointer<vtkPolyData> plane = cut(flow_.grid, view, middle_);
  vtkDataArray *const velocity = plane->GetPointData()->GetVectors();
  vtkNew<vtkDoubleArray> speed;
  for (vtkIdType i = 0; i < plane->GetNumberOfPoints(); ++i) {
    double v[3];
    velocity->GetTuple(i, v);
    speed->InsertNextValue(hypotenuse(v[0], v[1], v[2]));
  }
  plane->GetPointData()->Initialize();
  plane->GetPointData()->SetScalars(speed);
  return plane;
}

void FlowPanel::show(vtkPolyData *surface, const std::vector<View> &views) {
  surface_ = surface;
  middle_ = middle_of(moments_of_leaflets(surface));
  fastest_ = 0;
  for (const View &view : views) {
    const vtkSmartPointer<vtkPolyData> plane = plane_of(view);
    if (plane->GetNumberOfPoints() > 0)
      fastest_ = std::max(fastest_, plane->GetPointData()->GetScalars()->GetRange()[1]);
  }
  upper_end_ = rounded_up(fastest_);
}

void FlowPanel::look(const View &view, const Sight &sight) {
  const vtkSmartPointer<vtkPolyData> plane = plane_of(view);
  vtkDataArray *const speed = plane->GetPointData()->GetScalars();
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < plane->GetNumberOfPoints(); ++i)
    for (const double part : colour_of_speed(speed->GetComponent(i, 0) / upper_end_))
      colours->InsertNextValue(static_cast<unsigned char>(255 * part + 0.5));
  plane->GetPointData()->SetScalars(colours);
  set_data(plane_, plane);
  const double pixel = sight.shown[1].half() / 250;  // about a line's width
  set_data(wall_, strips(cut(faces_, view, middle_), view, 1.5 * pixel));
  const vtkSmartPointer<vtkPolyData> leaflets = lines_inside(cut(surface_, view, middle_), flow_.grid);
  set_data(around_leaflets_, strips(leaflets, view, 4.5 * pixel));
  set_data(leaflets_, strips(leaflets, view, 2.5 * pixel));
  const double step = 0.002 * sight.shown[1].half();
  move_near(wall_, view, step);
  move_near(around_leaflets_, view, 2 * step);
  move_near(leaflets_, view, 3 * step);
}

}  // namespace riis::vtk
