// SPDX-License-Identifier: Apache-2.0
// Reads XDMF. An .xdmf file describes a mesh, whose numbers are in this file, in HDF5 files or in plain binary files (xdmf.org,
// "XDMF Model and Format"). The reader reads XDMF as FEniCS, dolfinx and meshio write it. The nodes of a cell are in VTK's order,
// as in FEniCS, dolfinx and meshio.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>

#include "common/array_view.hpp"
#include "common/xml_text.hpp"
#include "riis_vtk/read/other_files.hpp"

namespace riis::vtk {
namespace {

namespace fs = std::filesystem;

// A type of cells: its number in a list of mixed types, and its names in lower case without "_". If the number of nodes varies,
// n_nodes is 0. If a type of cells has several names, the first name is written. The number is 0 for a type without a number in
// XDMF, such as cells of order 3. dolfinx writes cells of order 3 with VTK's order of nodes.
struct Topology {
  int number, vtk_type, n_nodes;
  const char *written;
  std::array<const char *, 2> names;
};
constexpr Topology topologies[] = {
    {1, VTK_POLY_VERTEX, 0, "Polyvertex", {"polyvertex", ""}},
    {2, VTK_POLY_LINE, 0, "Polyline", {"polyline", ""}},
    {3, VTK_POLYGON, 0, "Polygon", {"polygon", ""}},
    {4, VTK_TRIANGLE, 3, "Triangle", {"triangle", "tri3"}},
    {5, VTK_QUAD, 4, "Quadrilateral", {"quadrilateral", "quad4"}},
    {6, VTK_TETRA, 4, "Tetrahedron", {"tetrahedron", "tet4"}},
    {7, VTK_PYRAMID, 5, "Pyramid", {"pyramid", "pyramid5"}},
    {8, VTK_WEDGE, 6, "Wedge", {"wedge", "wedge6"}},
    {9, VTK_HEXAHEDRON, 8, "Hexahedron", {"hexahedron", "hex8"}},
    {34, VTK_QUADRATIC_EDGE, 3, "Edge_3", {"edge3", ""}},
    {35, VTK_BIQUADRATIC_QUAD, 9, "Quadrilateral_9", {"quadrilateral9", "quad9"}},
    {36, VTK_QUADRATIC_TRIANGLE, 6, "Triangle_6", {"triangle6", "tri6"}},
    {37, VTK_QUADRATIC_QUAD, 8, "Quadrilateral_8", {"quadrilateral8", "quad8"}},
    {38, VTK_QUADRATIC_TETRA, 10, "Tetrahedron_10", {"tetrahedron10", "tet10"}},
    {39, VTK_QUADRATIC_PYRAMID, 13, "Pyramid_13", {"pyramid13", ""}},
    {40, VTK_QUADRATIC_WEDGE, 15, "Wedge_15", {"wedge15", ""}},
    {41, VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18, "Wedge_18", {"wedge18", ""}},
    {48, VTK_QUADRATIC_HEXAHEDRON, 20, "Hexahedron_20", {"hexahedron20", "hex20"}},
    {49, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 24, "Hexahedron_24", {"hexahedron24", "hex24"}},
    {50, VTK_TRIQUADRATIC_HEXAHEDRON, 27, "Hexahedron_27", {"hexahedron27", "hex27"}},
    {0, VTK_LAGRANGE_TRIANGLE, 10, "Triangle_10", {"triangle10", ""}},
    {0, VTK_LAGRANGE_QUADRILATERAL, 16, "Quadrilateral_16", {"quadrilateral16", ""}},
    {0, VTK_LAGRANGE_TETRAHEDRON, 20, "Tetrahedron_20", {"tetrahedron20", ""}},
};

std::string plain_name(const std::string &name) {
  std::string plain = lower_case(name);
  plain.erase(std::remove(plain.begin(), plain.end(), '_'), plain.end());
  return plain;
}

std::string shortened(const std::string &text) { return text.substr(0, 60); }

// Reads the numbers that a DataItem describes.
class XdmfFile {
 public:
  XdmfFile(const std::string &path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  vtkSmartPointer<vtkUnstructuredGrid> read() {
    const XmlElement outermost = parse_xml(path_, bytes_);
    if (outermost.name != "Xdmf") fail_file(path_, "is not an XDMF file: it holds <", shortened(outermost.name), ">");
    const XmlElement *domain = outermost.child("Domain");
    if (!domain) fail_file(path_, "holds no Domain");
    const XmlElement &first = first_mesh(*domain);
    read_points(part_of(*domain, first, "Geometry"));
    read_cells(part_of(*domain, first, "Topology"));
    const auto grid = mesh_.grid(path_);
    for (const XmlElement &child : first.children)
      if (child.name == "Attribute") read_attribute(child, grid);
    if (is_single_) add_note(grid, "its points have single precision");
    return grid;
  }

 private:
  // Returns the first grid that is not a collection. For a collection over time, returns the grid of the first time.
  const XmlElement &first_mesh(const XmlElement &parent) const {
    const XmlElement *grid = parent.child("Grid");
    if (!grid) fail_file(path_, "holds no Grid with a Topology");
    const std::string type = lower_case(grid->attribute("GridType")),
                      how = lower_case(grid->attribute("CollectionType"));
    if (type == "collection" || type == "tree") {
      const auto n_grids = std::count_if(grid->children.begin(), grid->children.end(),
                                         [](const XmlElement &child) { return child.name == "Grid"; });
      if (how != "temporal" && n_grids > 1) fail_file(path_, "holds a ", type, " of several meshes; one mesh is read");
      return first_mesh(*grid);
    }
    return *grid;
  }

  // Returns the element Topology or Geometry of a grid. In a series in time, a grid may refer to another grid's Topology or
  // Geometry, which meshio and dolfinx write only once.
  const XmlElement &part_of(const XmlElement &domain, const XmlElement &grid, const char *name) const {
    if (const XmlElement *own = grid.child(name)) return *own;
    for (const XmlElement &child : grid.children) {
      // The name of the element may have any prefix.
      const std::string &element = child.name;
      if (element.substr(element.rfind(':') + 1) != "include") continue;
      if (!child.attribute("href").empty()) fail_file(path_, "includes the mesh of another file");
      const XmlElement *included = grid_with(domain, name, named_in(child.attribute("xpointer")));
      if (included) return *included->child(name);
    }
    fail_file(path_, "has a Grid without a Topology or without a Geometry");
  }

  // Returns the name in a pointer such as //Grid[@Name="mesh"]/.... If the pointer has no name, returns "".
  static std::string named_in(const std::string &pointer) {
    const std::string begin = "@Name=";
    const std::size_t at = pointer.find(begin);
    if (at == std::string::npos || at + begin.size() + 1 >= pointer.size()) return "";
    const std::size_t first = at + begin.size() + 1;
    return pointer.substr(first, pointer.find(pointer[first - 1], first) - first);
  }

  // Returns the first grid that has its own part of a mesh. The grid, or a grid around it, must have the given name. With "" as
  // the name, every grid is accepted. Returns NULL if no grid fits.
  static const XmlElement *grid_with(const XmlElement &parent, const char *part, const std::string &name) {
    for (const XmlElement &child : parent.children) {
      if (child.name != "Grid") continue;
      const bool has_name = name.empty() || child.attribute("Name") == name;
      if (has_name && child.child(part)) return &child;
      if (const XmlElement *found = grid_with(child, part, has_name ? "" : name)) return found;
    }
    return nullptr;
  }

  static const XmlElement *item_of(const XmlElement &element) { return element.child("DataItem"); }

  const XmlElement &required_item(const XmlElement &element) const {
    const XmlElement *item = item_of(element);
    for (const XmlElement *const other : {&element, item})
      if (other && !other->attribute("Reference").empty())
        fail_file(path_, "has a ", other->name, " that refers to another ", other->name,
                  "; riis reads only numbers that stand in their own place");
    if (!item) fail_file(path_, "has a ", element.name, " without a DataItem");
    return *item;
  }

  // FEniCS names this attribute NumberType, and meshio names it DataType.
  static std::string type_of(const XmlElement &item) {
    return lower_case(item.attribute("NumberType").empty() ? item.attribute("DataType") : item.attribute("NumberType"));
  }
  static bool is_real(const XmlElement &item) {
    const std::string type = type_of(item);
    return type.empty() || type == "float";
  }

  // Returns the number of rows and the number of columns. A single dimension is the number of rows, and there is one column.
  std::array<std::int64_t, 2> size_of(const XmlElement &item) const {
    const std::string text = item.attribute("Dimensions");
    std::string_view rest = text;
    std::array<std::int64_t, 2> size = {1, 1};
    int n_given = 0;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      std::int64_t n = 0;
      constexpr std::int64_t most = std::int64_t{1} << 45;
      if (!read_number(word, n) || n < 0 || n > most || (size[1] > 0 && n > most / std::max<std::int64_t>(size[1], 1)))
        fail_file(path_, "has a DataItem with the dimensions \"", shortened(text), "\"");
      n_given == 0 ? size[0] = n : size[1] *= n;
      ++n_given;
    }
    if (n_given == 0) fail_file(path_, "has a DataItem without dimensions");
    return size;
  }

  // Reads the numbers of an item as doubles or as whole numbers.
  template <class Number>
  std::vector<Number> numbers(const XmlElement &item) {
    const auto [n_rows, n_columns] = size_of(item);
    if (n_columns > 0 && n_rows > (std::int64_t{1} << 45) / n_columns)
      fail_file(path_, "has a DataItem with ", n_rows, " x ", n_columns, " numbers");
    const std::int64_t n = n_rows * n_columns;
    const std::string kind = lower_case(item.attribute("ItemType")), format = lower_case(item.attribute("Format"));
    if (!kind.empty() && kind != "uniform")
      fail_file(path_, "has a DataItem of the kind ", shortened(kind), "; only Uniform is read");
    if (!item.attribute("Reference").empty())
      fail_file(path_, "has a DataItem with a Reference to another DataItem, and references are not read");
    if (format.empty() || format == "xml") return numbers_of_text<Number>(item, n);
    if (format == "hdf" || format == "h5") return numbers_of_hdf5<Number>(item, n);
    if (format == "binary") return numbers_of_binary<Number>(item, n);
    fail_file(path_, "has a DataItem of the format ", shortened(format), "; XML, HDF and Binary are read");
  }

  template <class Number>
  std::vector<Number> numbers_of_text(const XmlElement &item, std::int64_t n) {
    const std::size_t end = static_cast<std::size_t>(item.text.data() - bytes_.data()) + item.text.size();
    Source in(path_, bytes_.substr(0, end));
    in.skip(end - item.text.size());
    in.check_count(n, 1, "numbers");
    std::vector<Number> values(static_cast<std::size_t>(n));
    for (Number &value : values) {
      // The rest is checked only near the end of the text. A check of the whole rest after each number would take a time
      // proportional to the square of n.
      if (in.rest().size() < 64 && std::all_of(in.rest().begin(), in.rest().end(), is_blank))
        in.refuse("a DataItem has ", static_cast<std::int64_t>(&value - values.data()), " of its ", n, " numbers");
      if constexpr (std::is_same_v<Number, double>)
        value = in.real(8);
      else
        value = in.integer(8);
    }
    if (!in.word().empty()) in.refuse("more than ", n, " numbers are in a DataItem");
    note_precision(item);
    return values;
  }

  // Returns the path of the file that an item names. The name is relative to the folder of the .xdmf file.
  std::string beside(const std::string &name) const { return (fs::path(path_).parent_path() / name).string(); }

  template <class Number>
  std::vector<Number> numbers_of_hdf5(const XmlElement &item, std::int64_t n) {
    std::string_view text = item.text;
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    const std::string name = plain_text(text);
    // The checkpoints of FEniCS name data as FILE.h5:DATASET. The name of a dataset may contain colons.
    std::size_t colon = name.rfind(":/");
    if (colon == std::string::npos) colon = name.rfind(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == name.size())
      fail_file(path_, "has a DataItem \"", shortened(name), "\"; it must be FILE.h5:/DATASET");
    bool is_single = false;
    auto values = read_hdf5<Number>(beside(name.substr(0, colon)), name.substr(colon + 1), n, is_single);
    last_is_single_ = is_single;
    return values;
  }

  template <class Number>
  std::vector<Number> numbers_of_binary(const XmlElement &item, std::int64_t n) {
    std::string_view text = item.text;
    const std::string file_path = beside(plain_text(take_word(text)));
    const MappedFile file(file_path, check_readable(file_path));
    const bool are_real = is_real(item);
    const std::string type = type_of(item), given = item.attribute("Precision");
    const std::string precision = !given.empty() ? given : type == "char" || type == "uchar" ? "1" : "4";
    int n_bytes = 0;
    if (!read_number(std::string_view(precision), n_bytes) || n_bytes < (are_real ? 4 : 1) || n_bytes > 8 ||
        (n_bytes & (n_bytes - 1)) != 0)
      fail_file(path_, "has binary numbers of ", shortened(precision),
                " bytes; real numbers have 4 or 8 bytes, and whole "
                "numbers 1, 2, 4 or 8");
    std::int64_t begin = 0;
    const std::string seek = item.attribute("Seek");
    if (!seek.empty() && (!read_number(std::string_view(seek), begin) || begin < 0 ||
                          begin > static_cast<std::int64_t>(file.bytes().size())))
      fail_file(path_, "has a DataItem with Seek=\"", shortened(seek), "\"");
    Source in(file_path, file.bytes());
    in.skip(static_cast<std::size_t>(begin));
    in.is_binary = true;
    in.is_swapped = lower_case(item.attribute("Endian")) == "big";
    in.check_count(n, n_bytes, "numbers");
    std::vector<Number> values(static_cast<std::size_t>(n));
    if (are_real && !std::is_same_v<Number, double>) fail_file(path_, "has real numbers in place of whole numbers");
    for (Number &value : values)
      value = are_real ? static_cast<Number>(in.real(n_bytes))
                       : static_cast<Number>(in.integer(n_bytes, type == "uint" || type == "uchar"));
    note_precision(item);
    return values;
  }

  void note_precision(const XmlElement &item) {
    const std::string precision = item.attribute("Precision");
    last_is_single_ = precision == "4" && lower_case(item.attribute("Format")) == "binary";
  }

  void read_points(const XmlElement &geometry) {
    std::string type = plain_name(geometry.attribute("GeometryType"));
    if (type.empty()) type = plain_name(geometry.attribute("Type"));
    if (lower_case(geometry.attribute("GeometryType") + geometry.attribute("Type")) == "x_y_z") {
      read_coordinates(geometry);
      return;
    }
    if (!type.empty() && type != "xyz" && type != "xy")
      fail_file(path_, "has a Geometry of the type ", shortened(type), "; XYZ, XY and X_Y_Z are read");
    const XmlElement &item = required_item(geometry);
    const std::int64_t n_columns = type == "xy" ? 2 : 3;
    const auto size = size_of(item);
    const std::vector<double> values = numbers<double>(item);
    is_single_ = last_is_single_;
    if (view(values).size() % n_columns != 0 || (size[1] != 1 && size[1] != n_columns))
      fail_file(path_, "has a Geometry of ", size[0], " x ", size[1], " numbers; a node has ", n_columns);
    mesh_.xyz->Allocate(view(values).size() / n_columns * 3);
    for (std::int64_t i = 0; i < view(values).size(); i += n_columns)
      mesh_.add_point(view(values)[i], view(values)[i + 1], n_columns == 3 ? view(values)[i + 2] : 0.0);
  }

  // Reads x, y and z from three items.
  void read_coordinates(const XmlElement &geometry) {
    std::vector<std::vector<double>> axes;
    required_item(geometry);
    for (const XmlElement &child : geometry.children) {
      if (child.name != "DataItem") continue;
      axes.push_back(numbers<double>(child));
      is_single_ = is_single_ || last_is_single_;
    }
    if (axes.size() != 3 || axes[1].size() != axes[0].size() || axes[2].size() != axes[0].size())
      fail_file(path_, "has a Geometry of the type X_Y_Z; it must have 3 DataItems of equal length");
    for (std::int64_t i = 0; i < view(axes[0]).size(); ++i)
      mesh_.add_point(view(axes[0])[i], view(axes[1])[i], view(axes[2])[i]);
  }

  void read_cells(const XmlElement &topology) {
    std::string type = topology.attribute("TopologyType");
    if (type.empty()) type = topology.attribute("Type");
    const std::string plain = plain_name(type);
    const std::string base_text = topology.attribute("BaseOffset");
    std::int64_t base = 0;
    if (!base_text.empty() && !read_number(std::string_view(base_text), base))
      fail_file(path_, "has a Topology with BaseOffset=\"", shortened(base_text), "\"");
    const XmlElement *item = item_of(topology);
    if (!item && plain == "polyvertex") return;  // points alone
    const XmlElement &found = required_item(topology);
    const auto size = size_of(found);
    const std::vector<std::int64_t> ids = numbers<std::int64_t>(found);
    if (plain == "mixed") return read_mixed(ids, base);
    for (const Topology &known : topologies) {
      if (plain != known.names[0] && plain != known.names[1]) continue;
      const std::string per_cell = topology.attribute("NodesPerElement");
      std::int64_t n_nodes = known.n_nodes == 0 ? size[1] : known.n_nodes;
      if (known.n_nodes == 0 && !per_cell.empty() && !read_number(std::string_view(per_cell), n_nodes))
        fail_file(path_, "has a Topology with NodesPerElement=\"", shortened(per_cell), "\"");
      if (n_nodes < 1 || view(ids).size() % n_nodes != 0 || (size[1] != 1 && size[1] != n_nodes))
        fail_file(path_, "has a Topology of ", size[0], " x ", size[1], " numbers; a ", shortened(type), " has ",
                  n_nodes);
      for (std::int64_t i = 0; i < view(ids).size(); i += n_nodes) add_cell(known, n_nodes, ids.data() + i, base);
      return;
    }
    fail_file(path_, "has a Topology of the type ", shortened(type), ", which is not read");
  }

  void add_cell(const Topology &known, std::int64_t n_nodes, const std::int64_t *nodes, std::int64_t base) {
    for (std::int64_t i = 0; i < n_nodes; ++i) {
      // If the base were invalid, the subtraction could overflow.
      const std::int64_t n = mesh_.xyz->GetNumberOfTuples(), node = nodes[i];
      if (base < 0 || base > 1 || node < base || node - base >= n)
        fail_file(path_, "cell ", mesh_.types->GetNumberOfValues(), " names point ", node, " of ", n);
      mesh_.ids->InsertNextValue(node - base);
    }
    // FEniCS writes intervals as lines of two nodes, and vertices as polyvertices of one node.
    const int type = known.vtk_type == VTK_POLY_LINE && n_nodes == 2     ? VTK_LINE
                     : known.vtk_type == VTK_POLY_VERTEX && n_nodes == 1 ? VTK_VERTEX
                                                                         : known.vtk_type;
    mesh_.end_cell(type);
  }

  // Reads cells of several types. Each cell consists of the number of its type, followed by its nodes. If a type has no fixed
  // number of nodes, the number of nodes comes before the nodes.
  void read_mixed(const std::vector<std::int64_t> &values, std::int64_t base) {
    std::int64_t at = 0;
    const std::int64_t end = view(values).size();
    while (at < end) {
      const std::int64_t number = view(values)[at++];
      const auto *const known = std::find_if(std::begin(topologies), std::end(topologies),
                                             [&](const Topology &t) { return t.number == number && number != 0; });
      const std::int64_t cell = mesh_.types->GetNumberOfValues();
      if (known == std::end(topologies))
        fail_file(path_, "cell ", cell, " is of XDMF's type ", number, ", which is not read");
      std::int64_t n_nodes = known->n_nodes;
      if (n_nodes == 0 && at < end) n_nodes = view(values)[at++];
      if (n_nodes < 1 || n_nodes > end - at)
        fail_file(path_, "cell ", cell, " claims ", n_nodes, " nodes, and its Topology has ", end - at,
                  " more numbers");
      add_cell(*known, n_nodes, values.data() + at, base);
      at += n_nodes;
    }
  }

  // Adds the values of nodes or cells as arrays. Other values are left out, such as the functions in checkpoints of FEniCS.
  void read_attribute(const XmlElement &attribute, vtkUnstructuredGrid *grid) {
    const std::string center = lower_case(attribute.attribute("Center")), name = attribute.attribute("Name");
    const bool is_of_cells = center == "cell";
    const XmlElement *item = item_of(attribute);
    if (!item || name.empty() || !attribute.attribute("ItemType").empty() ||
        (!is_of_cells && center != "node" && !center.empty()))
      return;
    const std::int64_t n = is_of_cells ? grid->GetNumberOfCells() : grid->GetNumberOfPoints();
    const auto size = size_of(*item);
    constexpr std::int64_t most_components = 1000;
    if (size[0] != n || size[1] < 1 || size[1] > most_components)
      fail_file(path_, "attribute ", shortened(name), " has ", size[0], " x ", size[1], " values for ", n,
                is_of_cells ? " cells" : " nodes");
    auto *const to = is_of_cells ? static_cast<vtkDataSetAttributes *>(grid->GetCellData()) : grid->GetPointData();
    if (is_real(*item)) {
      const std::vector<double> values = numbers<double>(*item);
      const auto array = named_array<vtkDoubleArray>(name, n, static_cast<int>(size[1]));
      std::copy(values.begin(), values.end(), array->GetPointer(0));
      to->AddArray(array);
    } else {
      const std::vector<std::int64_t> values = numbers<std::int64_t>(*item);
      const auto array = named_array<vtkTypeInt64Array>(name, n, static_cast<int>(size[1]));
      std::copy(values.begin(), values.end(), array->GetPointer(0));
      to->AddArray(array);
    }
  }

  const std::string &path_;
  std::string_view bytes_;
  PlainGrid mesh_;
  bool is_single_ = false, last_is_single_ = false;
};

// ---- Writing ----

const Topology *topology_of(vtkUnstructuredGrid *grid, vtkIdType cell) {
  int vtk_type = grid->GetCellType(cell);
  if (vtk_type == VTK_LINE) vtk_type = VTK_POLY_LINE;
  if (vtk_type == VTK_VERTEX) vtk_type = VTK_POLY_VERTEX;
  // The order of a Lagrange cell follows from its number of nodes.
  const vtkIdType n_nodes = grid->GetCells()->GetCellSize(cell);
  const auto *const found = std::find_if(std::begin(topologies), std::end(topologies), [&](const Topology &t) {
    return t.vtk_type == vtk_type && (t.number != 0 || t.n_nodes == n_nodes);
  });
  return found == std::end(topologies) ? nullptr : found;
}

// Writes the text of the .xdmf file. Numbers go into the text, or into an HDF5 file.
class XdmfWriter {
 public:
  XdmfWriter(const std::string &path, vtkUnstructuredGrid *grid) : path_(path), grid_(grid) {
    if (has_hdf5) hdf5_.emplace(fs::path(path).replace_extension("h5").string());
  }

  void write() {
    text_ =
        "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\" xmlns:xi=\"https://www.w3.org/2001/XInclude\">\n<Domain>\n"
        "<Grid Name=\"mesh\" GridType=\"Uniform\">\n";
    write_cells();
    text_ += "<Geometry GeometryType=\"XYZ\">\n";
    auto *const points = vtkDoubleArray::SafeDownCast(grid_->GetPoints()->GetData());
    write_reals("geometry", points->GetPointer(0), grid_->GetNumberOfPoints(), 3);
    text_ += "</Geometry>\n";
    write_arrays(grid_->GetPointData(), "Node");
    write_arrays(grid_->GetCellData(), "Cell");
    text_ += "</Grid>\n</Domain>\n</Xdmf>\n";
    ReplacingFile file(path_);
    file.write(reinterpret_cast<const unsigned char *>(text_.data()), static_cast<std::int64_t>(text_.size()));
    if (hdf5_) hdf5_->commit();
    file.commit("</Xdmf>");
  }

 private:
  void begin_item(const std::string &dataset, std::int64_t n_rows, int n_columns, const char *type) {
    text_ += joined("<DataItem NumberType=\"", type, "\" Precision=\"8\" Dimensions=\"", n_rows);
    if (n_columns > 1) text_ += joined(" ", n_columns);
    text_ += hdf5_ ? "\" Format=\"HDF\">" : "\" Format=\"XML\">\n";
    if (hdf5_) text_ += in_xml(fs::path(hdf5_->path()).filename().string()) + ":/" + in_xml(dataset);
  }

  template <class Number>
  void write_numbers(const std::string &dataset, const Number *values, std::int64_t n_rows, int n_columns,
                     const char *type) {
    begin_item(dataset, n_rows, n_columns, type);
    if (hdf5_) {
      hdf5_->write(dataset, values, n_rows, n_columns);
    } else {
      for (std::int64_t i = 0; i < n_rows * n_columns; ++i) {
        char digits[32];
        text_.append(digits, std::to_chars(digits, digits + sizeof digits, values[i]).ptr);
        text_ += (i + 1) % n_columns == 0 ? '\n' : ' ';
      }
    }
    text_ += "</DataItem>\n";
  }
  void write_reals(const std::string &dataset, const double *values, std::int64_t n_rows, int n_columns) {
    write_numbers(dataset, values, n_rows, n_columns, "Float");
  }

  void write_cells() {
    const std::int64_t n_cells = grid_->GetNumberOfCells();
    std::vector<std::int64_t> values;
    bool is_mixed = false;
    std::int64_t without_number = -1;  // the first cell that a mixed list cannot contain
    for (std::int64_t cell = 0; cell < n_cells; ++cell) {
      const int type = grid_->GetCellType(cell);
      const Topology *const of_cell = topology_of(grid_, cell);
      if (!of_cell) fail_file(path_, "cell ", cell, " is of VTK's type ", type, ", which XDMF lacks; write a .vtu");
      if (of_cell->number == 0 && without_number < 0) without_number = cell;
      is_mixed = is_mixed || type != grid_->GetCellType(0) || of_cell->n_nodes == 0;
    }
    if (is_mixed && without_number >= 0)
      fail_file(path_, "cell ", without_number, " is of VTK's type ", grid_->GetCellType(without_number),
                ", which XDMF lacks among cells of other types; write a .vtu");
    const Topology *const known = n_cells > 0 ? topology_of(grid_, 0) : &topologies[0];
    for (std::int64_t cell = 0; cell < n_cells; ++cell) {
      vtkIdType n_nodes = 0;
      const vtkIdType *nodes = nullptr;
      grid_->GetCells()->GetCellAtId(cell, n_nodes, nodes);
      if (is_mixed) {
        const Topology *const here = topology_of(grid_, cell);
        values.push_back(here->number);
        if (here->n_nodes == 0) values.push_back(n_nodes);
      }
      values.insert(values.end(), nodes, nodes + n_nodes);
    }
    if (n_cells == 0) {
      text_ +=
          joined("<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"", grid_->GetNumberOfPoints(), "\" />\n");
      return;
    }
    text_ += joined("<Topology TopologyType=\"", is_mixed ? "Mixed" : known->written, "\" NumberOfElements=\"", n_cells,
                    "\">\n");
    const int n_columns = is_mixed ? 1 : known->n_nodes;
    write_numbers("topology", values.data(), view(values).size() / n_columns, n_columns, "Int");
    text_ += "</Topology>\n";
  }

  // Returns an attribute with the unit of an array. The unit is an attribute, because readers expect only the numbers inside the
  // element.
  static std::string unit_of(vtkDataArray *array) {
    if (!array->HasInformation() || !array->GetInformation()->Has(vtkDataArray::UNITS_LABEL())) return "";
    return joined(" Unit=\"", in_xml(array->GetInformation()->Get(vtkDataArray::UNITS_LABEL())), "\"");
  }

  // Writes the numbers of nodes or cells as elements. Names and other texts cannot be written to XDMF.
  void write_arrays(vtkDataSetAttributes *from, const char *center) {
    for (int i = 0; i < from->GetNumberOfArrays(); ++i) {
      vtkDataArray *const array = from->GetArray(i);
      if (!array || !array->GetName()) continue;
      const std::string name = array->GetName();
      const int n_columns = array->GetNumberOfComponents();
      text_ += joined("<Attribute Name=\"", in_xml(name), "\" AttributeType=\"",
                      n_columns == 1   ? "Scalar"
                      : n_columns == 3 ? "Vector"
                                       : "Matrix",
                      "\" Center=\"", center, "\"", unit_of(array), ">\n");
      std::string dataset = std::string(center) + "_" + name;
      std::replace(dataset.begin(), dataset.end(), '/', '_');
      // A "_" is added, because the arrays a/b and a_b would otherwise get the same name.
      while (!datasets_.insert(dataset).second) dataset += '_';
      const std::int64_t n = array->GetNumberOfTuples();
      if (array->GetDataType() == VTK_DOUBLE || array->GetDataType() == VTK_FLOAT) {
        std::vector<double> values(static_cast<std::size_t>(n * n_columns));
        for (std::int64_t k = 0; k < n * n_columns; ++k)
          view(values)[k] = array->GetComponent(k / n_columns, static_cast<int>(k % n_columns));
        write_reals(dataset, values.data(), n, n_columns);
      } else {
        std::vector<std::int64_t> values(static_cast<std::size_t>(n * n_columns));
        for (std::int64_t k = 0; k < n * n_columns; ++k) view(values)[k] = array->GetVariantValue(k).ToTypeInt64();
        write_numbers(dataset, values.data(), n, n_columns, "Int");
      }
      text_ += "</Attribute>\n";
    }
  }

  std::string path_, text_;
  vtkUnstructuredGrid *grid_;
  std::optional<Hdf5Writer> hdf5_;
  std::set<std::string> datasets_;  // names of arrays in the HDF5 file
};

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_xdmf(const std::string &path) {
  const MappedFile file(path, check_readable(path));
  return XdmfFile(path, file.bytes()).read();
}

void write_xdmf(const std::string &path, vtkUnstructuredGrid *grid) { XdmfWriter(path, grid).write(); }

}  // namespace riis::vtk
