// SPDX-License-Identifier: Apache-2.0
// Reads gmsh's .msh files of versions 2 and 4.1, as text or binary. The format is described in the chapter "Gmsh file formats" of
// gmsh's manual. The order of nodes is described in the section "Node ordering" of the chapter. Nodes and elements keep the
// file's order. Elements of all dimensions become cells. The cell array gmsh:physical has the first physical group of each cell,
// and further arrays have further groups.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <unordered_map>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>

#include "common/array_view.hpp"
#include "riis_vtk/read/other_files.hpp"

namespace riis::vtk {
namespace {

struct ElementType {
  int gmsh_type, n_nodes, vtk_type;
  std::vector<int> order;  // for each node in VTK's order, its position in gmsh's order; empty if both are equal
};

const ElementType *find_type(std::int64_t gmsh_type) {
  static const std::vector<ElementType> types = {
      {15, 1, VTK_VERTEX, {}},
      {1, 2, VTK_LINE, {}},
      {2, 3, VTK_TRIANGLE, {}},
      {3, 4, VTK_QUAD, {}},
      {4, 4, VTK_TETRA, {}},
      {5, 8, VTK_HEXAHEDRON, {}},
      // In VTK, the base of a wedge is ordered as seen from outside. In gmsh, the base of a prism is ordered as seen from inside.
      {6, 6, VTK_WEDGE, {0, 2, 1, 3, 5, 4}},
      {7, 5, VTK_PYRAMID, {}},
      {8, 3, VTK_QUADRATIC_EDGE, {}},
      {9, 6, VTK_QUADRATIC_TRIANGLE, {}},
      {16, 8, VTK_QUADRATIC_QUAD, {}},
      {10, 9, VTK_BIQUADRATIC_QUAD, {}},
      {11, 10, VTK_QUADRATIC_TETRA, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
      {17, 20, VTK_QUADRATIC_HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
      {12, 27, VTK_TRIQUADRATIC_HEXAHEDRON, {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                             19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26}},
      {18, 15, VTK_QUADRATIC_WEDGE, {0, 2, 1, 3, 5, 4, 7, 9, 6, 13, 14, 12, 8, 11, 10}},
      {13, 18, VTK_BIQUADRATIC_QUADRATIC_WEDGE, {0, 2, 1, 3, 5, 4, 7, 9, 6, 13, 14, 12, 8, 11, 10, 16, 17, 15}},
      {19, 13, VTK_QUADRATIC_PYRAMID, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
      // VTK 9.1 has no type for a pyramid with a node in the middle of its base. The node in the middle of the base stays a node
      // of the mesh. The cell on the other side of the base gives this node its edges.
      {14, 14, VTK_QUADRATIC_PYRAMID, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
  };
  const auto found =
      std::find_if(types.begin(), types.end(), [&](const ElementType &type) { return type.gmsh_type == gmsh_type; });
  return found == types.end() ? nullptr : &*found;
}

// Finds the position of a node from its tag. Tags are nearly always the numbers from 1 without large gaps.
class NodeTags {
 public:
  NodeTags(const std::string &path, std::vector<std::int64_t> tags) {
    const std::int64_t n = view(tags).size();
    const std::int64_t most = tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end());
    const bool are_dense = most < 4 * n + 1000 && std::all_of(tags.begin(), tags.end(), [](auto t) { return t >= 0; });
    if (are_dense) position_.assign(static_cast<std::size_t>(most + 1), -1);
    for (std::int64_t i = 0; i < n; ++i) {
      const std::int64_t tag = view(tags)[i];
      bool is_new = true;
      if (are_dense) {
        is_new = view(position_)[tag] < 0;
        view(position_)[tag] = i;
      } else {
        is_new = sparse_.emplace(tag, i).second;
      }
      if (!is_new) fail_file(path, "has two nodes with the tag ", tag);
    }
  }

  std::optional<vtkIdType> find(std::int64_t tag) const {
    if (!sparse_.empty()) {
      const auto found = sparse_.find(tag);
      return found == sparse_.end() ? std::nullopt : std::optional<vtkIdType>(found->second);
    }
    if (tag < 0 || tag >= view(position_).size() || view(position_)[tag] < 0) return std::nullopt;
    return view(position_)[tag];
  }

 private:
  std::vector<vtkIdType> position_;
  std::unordered_map<std::int64_t, vtkIdType> sparse_;
};

class GmshFile {
 public:
  GmshFile(const std::string &path, std::string_view bytes) : path_(path), in_(path, bytes) {}

  vtkSmartPointer<vtkUnstructuredGrid> read() {
    read_format();
    for (std::string section = next_section(); !section.empty(); section = next_section()) {
      const bool is_parametric = section == "ParametricNodes" && !is_new_;
      if (is_repeated(section)) {
        skip_to_end_of(section);
        continue;
      }
      const std::string_view begin = in_.rest();
      if (section == "Nodes" || is_parametric) {
        if (tags_) in_.refuse("has a second section $", section, ", which differs from the first");
        std::vector<std::int64_t> tags = is_new_ ? read_nodes() : read_old_nodes(is_parametric);
        tags_.emplace(path_, std::move(tags));
        nodes_ = begin.substr(0, begin.size() - in_.rest().size());
      } else if (section == "Elements") {
        if (!tags_) in_.refuse("has $Elements before $Nodes");
        if (has_elements_) in_.refuse("has a second section $Elements, which differs from the first");
        has_elements_ = true;
        is_new_ ? read_elements() : read_old_elements();
        elements_ = begin.substr(0, begin.size() - in_.rest().size());
      } else if (section == "Entities" && is_new_ && !has_entities_) {
        read_entities(false);
        has_entities_ = true;
      } else if (section == "PartitionedEntities" && is_new_ && !has_parts_) {
        read_entities(true);
        has_parts_ = true;
      } else if (section == "PhysicalNames" && names_.empty()) {
        read_names();
      } else {
        skip_to_end_of(section);
        continue;
      }
      expect_end_of(section);
    }
    if (!tags_) fail_file(path_, "is truncated: it has no section $Nodes");
    // gmsh writes the section of elements even if the mesh has no elements.
    if (!has_elements_) fail_file(path_, "is truncated: it has no section $Elements");
    const std::int64_t n_copies = drop_copies();
    const auto grid = mesh_.grid(path_);
    if (n_copies > 0)
      add_note(grid, joined(n_copies,
                            " elements of further physical groups are the same cells as those of the first groups"));
    if (std::any_of(physical_.begin(), physical_.end(), [](std::int32_t tag) { return tag != 0; })) {
      add_groups(grid, physical_array, physical_);
      for (std::size_t k = 0; k < further_.size(); ++k)
        add_groups(grid, joined(physical_array, "_", k + 2), further_[k]);
      add_names(grid);
    }
    return grid;
  }

 private:
  using Groups = std::vector<std::int32_t>;  // a group of each element, or 0

  static void add_groups(vtkUnstructuredGrid *grid, const std::string &name, const Groups &groups) {
    const auto array = named_array<vtkTypeInt32Array>(name, static_cast<vtkIdType>(groups.size()));
    std::copy(groups.begin(), groups.end(), array->GetPointer(0));
    grid->GetCellData()->AddArray(array);
  }

  void add_names(vtkUnstructuredGrid *grid) const {
    if (names_.empty()) return;
    const auto array = named_array<vtkStringArray>(region_names_array, static_cast<vtkIdType>(names_.size()));
    for (std::size_t i = 0; i < names_.size(); ++i) array->SetValue(static_cast<vtkIdType>(i), names_[i]);
    grid->GetFieldData()->AddArray(array);
  }

  // Returns whether a section has the same bytes as the section that was read before. gmsh writes the whole mesh again when it
  // appends a view.
  bool is_repeated(const std::string &section) const {
    const std::string_view &before = section == "Elements" ? elements_ : nodes_;
    const bool is_mesh = section == "Nodes" || section == "ParametricNodes" || section == "Elements";
    return is_mesh && !before.empty() && in_.rest().substr(0, before.size()) == before;
  }

  static constexpr int int_bytes = 4, size_bytes = 8, real_bytes = 8;

  void skip_blanks() {
    const auto begin = std::find_if_not(in_.rest().begin(), in_.rest().end(), is_blank);
    in_.skip(static_cast<std::size_t>(begin - in_.rest().begin()));
  }

  // Returns the name of the next section without "$". Returns "" at the end of the file.
  std::string next_section() {
    skip_blanks();
    if (in_.rest().empty()) return "";
    if (in_.rest()[0] != '$') in_.refuse("a section must begin with $, as $Nodes does");
    const std::string_view line = in_.line();
    const std::size_t length = std::min(line.find_last_not_of(" \r\t") + 1, std::size_t{64});
    return std::string(line.substr(1, length - 1));
  }

  void expect_end_of(const std::string &section) {
    skip_blanks();
    const std::string end = "$End" + section;
    if (in_.rest().empty()) fail_file(path_, "is truncated: it ends before ", end);
    if (in_.rest().substr(0, end.size()) != end)
      in_.refuse("holds more than $", section, " claims; ", end, " must be here");
    in_.skip(end.size());
  }

  void skip_to_end_of(const std::string &section) {
    const std::size_t found = in_.rest().find("$End" + section);
    if (found == std::string_view::npos) fail_file(path_, "is truncated: it ends before $End", section);
    in_.skip(found);
    expect_end_of(section);
  }

  // Reads the names of groups of volumes. A line has the form DIMENSION NUMBER "NAME", even in a binary file. Lines for other
  // dimensions are skipped.
  void read_names() {
    const std::size_t end = in_.rest().find("$EndPhysicalNames");
    if (end == std::string_view::npos) fail_file(path_, "is truncated: it ends before $EndPhysicalNames");
    std::string_view text = in_.rest().substr(0, end);
    while (!text.empty()) {
      std::string_view line = take_line(text);
      const std::string_view dimension = take_word(line), number = take_word(line);
      const std::size_t open = line.find('"'), close = line.rfind('"');
      if (dimension != "3" || open == std::string_view::npos || close <= open) continue;
      names_.emplace_back(number);
      names_.emplace_back(line.substr(open + 1, close - open - 1));
    }
    in_.skip(end);
  }

  void read_format() {
    skip_blanks();
    if (in_.rest().substr(0, 11) != "$MeshFormat")
      fail_file(path_, "is not a mesh of gmsh: it does not begin with $MeshFormat");
    in_.line();
    const std::string version(in_.word());
    is_new_ = version == "4.1";
    if (!is_new_ && version != "2" && version.rfind("2.", 0) != 0)
      fail_file(path_, "is of version ", version.substr(0, 20), " of gmsh's format; versions 2 and 4.1 are read");
    const std::int64_t is_binary = in_.integer(int_bytes), data_size = in_.integer(int_bytes);
    if (is_binary != 0 && is_binary != 1) in_.refuse("the file type is ", is_binary, "; it must be 0 or 1");
    if (data_size != 8) in_.refuse("the data size is ", data_size, "; only 8 is read");
    if (is_binary == 1) {
      in_.line();
      in_.is_binary = true;
      const std::int64_t one = in_.integer(int_bytes);
      in_.is_swapped = one == 1 << 24;
      if (one != 1 && !in_.is_swapped) in_.refuse("the number that tells the byte order is ", one, "; it must be 1");
    }
    expect_end_of("MeshFormat");
  }

  // ---- Version 2 ----

  // Counts are text even in binary files.
  std::int64_t text_count(std::int64_t least_bytes, const char *things) {
    const bool is_binary = in_.is_binary;
    in_.is_binary = false;
    const std::int64_t n = in_.integer(int_bytes);
    in_.is_binary = is_binary;
    if (is_binary) in_.line();
    in_.check_count(n, least_bytes, things);
    return n;
  }

  // In a text file, a number takes at least two bytes: a digit and a blank. A node with parameters also has an entity, and
  // coordinates on a curve or a surface.
  std::vector<std::int64_t> read_old_nodes(bool is_parametric) {
    const std::int64_t n = text_count(in_.is_binary ? int_bytes + 3 * real_bytes : 8, "nodes");
    std::vector<std::int64_t> tags(static_cast<std::size_t>(n));
    mesh_.xyz->Allocate(3 * n);
    for (std::int64_t &tag : tags) {
      tag = in_.integer(int_bytes);
      add_point();
      if (!is_parametric) continue;
      const std::int64_t dimension = in_.integer(int_bytes);
      in_.integer(int_bytes);
      const std::int64_t n_parameters = dimension == 1 || dimension == 2 ? dimension : 0;
      for (std::int64_t k = 0; k < n_parameters; ++k) in_.real(real_bytes);
    }
    return tags;
  }

  void read_old_elements() {
    const std::int64_t n = text_count(in_.is_binary ? 3 * int_bytes : 8, "elements");
    std::vector<std::int64_t> groups;
    for (std::int64_t i = 0; i < n;) {
      std::int64_t type_number = 0, n_alike = 1, n_tags = 0;
      if (in_.is_binary) {
        type_number = in_.integer(int_bytes);
        n_alike = in_.integer(int_bytes);
        n_tags = in_.integer(int_bytes);
        if (n_alike < 1 || n_alike > n - i) in_.refuse("a block has ", n_alike, " elements; ", n - i, " are left");
      }
      for (std::int64_t k = 0; k < n_alike; ++k, ++i) {
        const std::int64_t tag = in_.integer(int_bytes);
        if (!in_.is_binary) {
          type_number = in_.integer(int_bytes);
          n_tags = in_.integer(int_bytes);
        }
        in_.check_count(n_tags, in_.is_binary ? int_bytes : 2, "tags of an element");
        std::vector<std::int64_t> group;
        for (std::int64_t t = 0; t < n_tags; ++t) {
          const std::int64_t value = in_.integer(int_bytes);
          if (t == 0) group.push_back(value);
        }
        add_element(type_of(tag, type_number), tag, group, int_bytes);
      }
    }
  }

  // ---- Version 4.1 ----

  std::vector<std::int64_t> read_nodes() {
    const std::int64_t n_blocks = in_.integer(size_bytes);
    const std::int64_t n = in_.count(size_bytes, in_.is_binary ? size_bytes + 3 * real_bytes : 8, "nodes");
    read_sizes(2);  // the least and the largest tag
    std::vector<std::int64_t> tags;
    tags.reserve(static_cast<std::size_t>(n));
    mesh_.xyz->Allocate(3 * n);
    for (std::int64_t block = 0; block < n_blocks; ++block) {
      const std::int64_t dimension = in_.integer(int_bytes);
      in_.integer(int_bytes);
      const std::int64_t is_parametric = in_.integer(int_bytes);
      const std::int64_t n_here = in_.integer(size_bytes);
      if (n_here < 0 || n_here > n - view(tags).size())
        in_.refuse("a block has ", n_here, " nodes; ", n - view(tags).size(), " are left");
      for (std::int64_t i = 0; i < n_here; ++i) tags.push_back(in_.integer(size_bytes));
      for (std::int64_t i = 0; i < n_here; ++i) {
        add_point();
        if (is_parametric != 0)
          for (std::int64_t k = 0; k < std::clamp(dimension, std::int64_t{0}, std::int64_t{3}); ++k)
            in_.real(real_bytes);
      }
    }
    if (view(tags).size() != n) in_.refuse("$Nodes has ", view(tags).size(), " of the ", n, " nodes that it claims");
    return tags;
  }

  void read_elements() {
    const std::int64_t n_blocks = in_.integer(size_bytes);
    const std::int64_t n = in_.count(size_bytes, in_.is_binary ? 2 * size_bytes : 4, "elements");
    read_sizes(2);
    std::int64_t n_read = 0;
    for (std::int64_t block = 0; block < n_blocks; ++block) {
      const std::int64_t dimension = in_.integer(int_bytes), entity = in_.integer(int_bytes);
      const std::int64_t type_number = in_.integer(int_bytes), n_here = in_.integer(size_bytes);
      if (n_here < 0 || n_here > n - n_read) in_.refuse("a block has ", n_here, " elements; ", n - n_read, " are left");
      const std::vector<std::int64_t> &groups = groups_[{dimension, entity}];
      for (std::int64_t i = 0; i < n_here; ++i) {
        const std::int64_t tag = in_.integer(size_bytes);
        add_element(type_of(tag, type_number), tag, groups, size_bytes);
      }
      n_read += n_here;
    }
    if (n_read != n) in_.refuse("$Elements has ", n_read, " of the ", n, " elements that it claims");
  }

  // Reads the physical groups of the model's points, curves, surfaces and volumes. An entity may have several groups. If gmsh has
  // partitioned the mesh, elements belong to parts of entities, and the parts also have groups.
  void read_entities(bool are_parts) {
    if (are_parts) {
      read_sizes(1);  // the number of partitions
      const std::int64_t n_ghosts = in_.count(size_bytes, 2, "ghost entities");
      read_integers(2 * n_ghosts);
    }
    std::int64_t n[4];
    for (std::int64_t &n_entities : n) n_entities = in_.count(size_bytes, 8, "entities");
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (std::int64_t i = 0; i < n[dimension]; ++i) {
        const std::int64_t entity = in_.integer(int_bytes);
        if (are_parts) {
          read_integers(2);  // skips the dimension and the tag of the whole entity
          read_integers(in_.count(size_bytes, 2, "partitions of an entity"));
        }
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in_.real(real_bytes);
        const std::int64_t n_groups = in_.count(size_bytes, 2, "physical groups");
        for (std::int64_t k = 0; k < n_groups; ++k) groups_[{dimension, entity}].push_back(in_.integer(int_bytes));
        if (dimension == 0) continue;
        read_integers(in_.count(size_bytes, 2, "sides of an entity"));
      }
    }
  }

  // ---- Both versions ----

  void read_sizes(int n) {
    for (int i = 0; i < n; ++i) in_.integer(size_bytes);
  }

  void read_integers(std::int64_t n) {
    for (std::int64_t i = 0; i < n; ++i) in_.integer(int_bytes);
  }

  void add_point() {
    const double x = in_.real(real_bytes), y = in_.real(real_bytes), z = in_.real(real_bytes);
    mesh_.add_point(x, y, z);
  }

  const ElementType &type_of(std::int64_t tag, std::int64_t type_number) const {
    if (const ElementType *type = find_type(type_number)) return *type;
    in_.refuse("element ", tag, " is of gmsh's type ", type_number, "; elements of orders 1 and 2 are read");
  }

  void add_element(const ElementType &type, std::int64_t tag, const std::vector<std::int64_t> &groups, int id_bytes) {
    std::array<vtkIdType, 27> ids;
    for (int i = 0; i < type.n_nodes; ++i) {
      const std::int64_t node = in_.integer(id_bytes);
      const auto id = tags_->find(node);
      if (!id) in_.refuse("element ", tag, " has the node ", node, ", which $Nodes lacks");
      ids[static_cast<std::size_t>(i)] = *id;
    }
    const int n_kept = type.order.empty() ? type.n_nodes : static_cast<int>(type.order.size());
    for (int i = 0; i < n_kept; ++i)
      mesh_.ids->InsertNextValue(view(ids)[type.order.empty() ? i : view(type.order)[i]]);
    mesh_.end_cell(type.vtk_type);
    const std::size_t element = physical_.size();
    physical_.push_back(groups.empty() ? 0 : static_cast<std::int32_t>(groups[0]));
    for (std::size_t k = 1; k < groups.size(); ++k) add_group(element, static_cast<std::int32_t>(groups[k]));
  }

  // Adds a further group to an element. Few groups of a mesh overlap. Therefore one list has the second groups of all elements,
  // another list has the third groups, and so on.
  void add_group(std::size_t element, std::int32_t group) {
    std::size_t k = 0;
    while (k < further_.size() && element < further_[k].size() && further_[k][element] != 0) ++k;
    if (k >= most_groups) return;
    if (k == further_.size()) further_.emplace_back();
    if (further_[k].size() <= element) further_[k].resize(element + 1, 0);
    further_[k][element] = group;
  }

  // In version 2, an element with several physical groups is listed once for each group, each time with another number. Of such
  // copies of an element, the reader keeps the first. Returns the number of copies that are left out. Equal elements within one
  // group are all kept.
  std::int64_t drop_copies() {
    const bool are_grouped =
        std::any_of(physical_.begin(), physical_.end(), [&](std::int32_t group) { return group != physical_[0]; });
    for (Groups &groups : further_) groups.resize(physical_.size(), 0);
    if (is_new_ || !are_grouped) return 0;
    const std::int64_t n = view(physical_).size();
    std::vector<std::pair<std::uint64_t, std::int64_t>> order;  // the elements in the order of a hash of type and nodes
    order.reserve(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i) {
      std::uint64_t hash = mesh_.types->GetValue(i);
      for (const vtkIdType node : sorted_nodes(i))
        hash = (hash ^ static_cast<std::uint64_t>(node)) * 0x9e3779b97f4a7c15u;
      order.emplace_back(hash, i);
    }
    std::sort(order.begin(), order.end());
    std::vector<char> is_copy(static_cast<std::size_t>(n), 0);
    std::int64_t n_copies = 0;
    for (std::int64_t i = 1, first = 0; i < n; ++i) {
      if (view(order)[i].first != view(order)[first].first) first = i;
      const std::int64_t a = view(order)[first].second, b = view(order)[i].second;
      if (a == b || view(physical_)[a] == view(physical_)[b] || mesh_.types->GetValue(a) != mesh_.types->GetValue(b) ||
          sorted_nodes(a) != sorted_nodes(b))
        continue;
      view(is_copy)[b] = 1;
      add_group(static_cast<std::size_t>(a), view(physical_)[b]);
      ++n_copies;
    }
    for (Groups &groups : further_) groups.resize(physical_.size(), 0);
    if (n_copies > 0) remove(is_copy);
    return n_copies;
  }

  std::vector<vtkIdType> sorted_nodes(std::int64_t element) const {
    const vtkIdType *const ids = mesh_.ids->GetPointer(0);
    std::vector<vtkIdType> nodes(ids + mesh_.ends->GetValue(element), ids + mesh_.ends->GetValue(element + 1));
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  void remove(const std::vector<char> &is_copy) {
    vtkIdType n_kept = 0, n_ids = 0;
    for (std::int64_t i = 0, begin = 0, end = 0; i < view(physical_).size(); ++i, begin = end) {
      end = mesh_.ends->GetValue(i + 1);
      if (view(is_copy)[i] != 0) continue;
      for (vtkIdType k = begin; k < end; ++k) mesh_.ids->SetValue(n_ids++, mesh_.ids->GetValue(k));
      mesh_.types->SetValue(n_kept, mesh_.types->GetValue(i));
      view(physical_)[n_kept] = view(physical_)[i];
      for (Groups &groups : further_) view(groups)[n_kept] = view(groups)[i];
      mesh_.ends->SetValue(++n_kept, n_ids);
    }
    mesh_.ids->Resize(n_ids);
    mesh_.types->Resize(n_kept);
    mesh_.ends->Resize(n_kept + 1);
    physical_.resize(static_cast<std::size_t>(n_kept));
    for (Groups &groups : further_) groups.resize(static_cast<std::size_t>(n_kept));
  }

  const std::string &path_;
  Source in_;
  bool is_new_ = false, has_elements_ = false, has_entities_ = false, has_parts_ = false;
  std::string_view nodes_, elements_;  // the bytes of the sections, without their first and last lines
  std::optional<NodeTags> tags_;
  std::map<std::array<std::int64_t, 2>, std::vector<std::int64_t>> groups_;  // by dimension and entity
  PlainGrid mesh_;
  static constexpr std::size_t most_groups = 16;  // further groups of an element
  Groups physical_;
  std::vector<Groups> further_;
  std::vector<std::string> names_;  // the numbers and the names of groups of volumes alternate
};

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_gmsh(const std::string &path) {
  const MappedFile file(path, check_readable(path));
  return GmshFile(path, file.bytes()).read();
}

}  // namespace riis::vtk
