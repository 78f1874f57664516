// SPDX-License-Identifier: Apache-2.0
#include "program/svmultiphysics/uris_forecast.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include "common/array_view.hpp"
#include "program/base/other_program.hpp"
#include "program/base/progress.hpp"
#include "program/base/text.hpp"
#include "program/mark/warnings.hpp"
#include "program/patient/case_files.hpp"

namespace riis::program {
namespace {

// Writes arrays for uris_flow.py to a temporary file. The format is NumPy's .npy, version 1.0, with the rows one after the other,
// in this machine's byte order.
class Arrays {
 public:
  Arrays() { check_written(file_.get() != nullptr); }

  void add(const std::vector<double> &numbers, const std::vector<std::int64_t> &shape) {
    add("f8", numbers.data(), sizeof(double), shape);
  }
  void add(const std::vector<std::int64_t> &numbers, const std::vector<std::int64_t> &shape) {
    add("i8", numbers.data(), sizeof(std::int64_t), shape);
  }
  void add(const std::vector<char> &numbers) { add("u1", numbers.data(), 1, {view(numbers).size()}); }
  void add(const char *type, const void *numbers, std::size_t bytes, const std::vector<std::int64_t> &shape) {
    std::string text;
    std::size_t n = 1;
    for (const std::int64_t length : shape) {
      text += std::to_string(length) + ',';
      n *= static_cast<std::size_t>(length);
    }
    std::string head = std::string("{'descr': '=") + type + "', 'fortran_order': False, 'shape': (" + text + "), }";
    // In this format, an array's numbers begin at a multiple of 64 bytes. Ten bytes stand before the array's head.
    head.append(63 - (10 + head.size()) % 64, ' ');
    head += '\n';
    const char start[] = {'\x93', 'N', 'U', 'M', 'P', 'Y', 1, 0, static_cast<char>(head.size()), 0};
    write(start, sizeof start);
    write(head.data(), head.size());
    write(numbers, bytes * n);
  }

  // Moves to the beginning of the file, and returns the file.
  std::FILE *file() {
    check_written(std::fflush(file_.get()) == 0);
    std::rewind(file_.get());
    return file_.get();
  }

 private:
  void write(const void *bytes, std::size_t n) { check_written(std::fwrite(bytes, 1, n, file_.get()) == n); }
  static void check_written(bool is_fine) {
    if (!is_fine) throw NoFlow{std::string("a temporary file cannot be written: ") + system_text(errno)};
  }

  TemporaryFile file_ = temporary_file();
};

template <std::size_t n>
std::vector<double> flat(const std::vector<std::array<double, n>> &points) {
  std::vector<double> numbers;
  for (const std::array<double, n> &point : points) numbers.insert(numbers.end(), point.begin(), point.end());
  return numbers;
}

void add_element(const SolverElement &element, Arrays &arrays) {
  std::vector<double> weights, values, slopes;
  for (std::size_t g = 0; g < element.gauss.size(); ++g) {
    const std::vector<double> of_point = flat(element.at_gauss[g].slopes);
    weights.push_back(element.gauss[g].weight);
    values.insert(values.end(), element.at_gauss[g].values.begin(), element.at_gauss[g].values.end());
    slopes.insert(slopes.end(), of_point.begin(), of_point.end());
  }
  const std::int64_t n_points = view(weights).size(), n_nodes = static_cast<std::int64_t>(element.n_nodes);
  arrays.add(flat(element.node_places), {n_nodes, 3});
  arrays.add(weights, {n_points});
  arrays.add(values, {n_points, n_nodes});
  arrays.add(slopes, {n_points, n_nodes, 3});
}

}  // namespace

ClosedDrop closed_drop(const SolverMesh &mesh, const SolverDistances &distances, const SolverDistances &sides,
                       const std::vector<double> &near, double reach, double half_thickness, const SolverFluid &fluid,
                       bool quiet) {
  const std::int64_t n_nodes = static_cast<std::int64_t>(mesh.element->n_nodes);
  std::vector<char> is_inside, is_before;
  std::vector<double> delta;
  for (std::int64_t e = 0; e < mesh.n_elements(); ++e) {
    const std::int64_t *const nodes = mesh.nodes_of(e);
    is_inside.push_back(std::any_of(nodes, nodes + n_nodes, [&](std::int64_t i) { return view(near)[i] <= reach; }));
    if (!is_inside.back()) continue;
    for (const ShapeFunctions &at : mesh.element->at_gauss)
      delta.push_back(solver_delta(mesh, e, at, distances, half_thickness));
  }
  for (const double distance : sides.to_leaflets) is_before.push_back(distance < 0);
  Arrays arrays;
  const std::vector<double> numbers = {fluid.resistance, fluid.density, fluid.viscosity, fluid.time_step,
                                       half_thickness};
  arrays.add(numbers, {5});
  arrays.add("f8", mesh.xyz(), sizeof(double), {mesh.n_nodes, 3});
  arrays.add(mesh.nodes, {mesh.n_elements(), n_nodes});
  add_element(*mesh.element, arrays);
  arrays.add(is_inside);
  const std::int64_t n_points = static_cast<std::int64_t>(mesh.element->gauss.size());
  arrays.add(delta, {view(delta).size() / n_points, n_points});
  arrays.add(is_before);

  StepProgress progress("the drop with a half thickness of " + shown(half_thickness), 100, quiet);
  std::string last;
  const auto read = [&](const std::string &line) {
    last = line;
    const int step = line.rfind("step ", 0) == 0 ? std::atoi(line.c_str() + 5) : 0;
    if (step > 0) progress.begin(static_cast<std::size_t>(std::min(step, 99)));
  };
  const std::string python = python_of_user();
  // Python must not look for modules in the current folder, because a file there may have the name of a module.
  const std::string script = "import sys; del sys.path[0]\n" + case_texts().at("../svmultiphysics/uris_flow.py");
  const ProgramEnd end = run_program({python, "-c", script}, arrays.file(), read);
  if (end.error != 0) throw NoFlow{python + " cannot be run: " + system_text(end.error)};
  if (last.rfind("lacks ", 0) == 0) throw NoFlow{python + ' ' + last};
  if (end.status != 0) throw NoFlow{python + " failed" + (end.last_message.empty() ? "" : ": " + end.last_message)};
  ClosedDrop drop;
  drop.is_separated = last != "open";
  drop.is_solved = last.rfind("flow ", 0) == 0;
  if (drop.is_separated && !drop.is_solved && last != "unsolved") throw NoFlow{python + " printed '" + last + "'"};
  if (drop.is_solved) drop.flow = std::strtod(last.c_str() + 5, nullptr);
  return drop;
}

}  // namespace riis::program
