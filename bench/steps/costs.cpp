// SPDX-License-Identifier: Apache-2.0
// Measures the cost of each call for the table in docs/performance.md: the time of the shortest of repeated calls, and the memory
// that stays with the handle. The meshes are cylinders of a million nodes around the valves, and the tolerance is 5 %. argv[1],
// optional: thousands of nodes.
#include <riis/riis.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "shared/cylinder.hpp"
#include "shared/memory.hpp"
#include "shared/shortest.hpp"

namespace {

using namespace bench;

std::string time_text(double seconds) {
  char text[32];
  const double value = seconds * (seconds < 1e-3 ? 1e6 : seconds < 1 ? 1e3 : 1);
  std::snprintf(text, sizeof text, value < 9.95 ? "%.1f %s" : "%.0f %s", value,
                seconds < 1e-3 ? "µs"
                : seconds < 1  ? "ms"
                               : "s");
  return text;
}

std::string memory_text(double bytes) {
  if (bytes < 1e3) return "< 1 kB";
  char text[32];
  const double value = bytes / (bytes < 1e6 ? 1e3 : 1e6);
  std::snprintf(text, sizeof text, value < 9.95 ? "%.1f %s" : "%.0f %s", value, bytes < 1e6 ? "kB" : "MB");
  return text;
}

struct Row {
  std::string call, time[2], memory[2];
};

// Collects the table's rows. The column of one valve is filled at a time.
class Table {
 public:
  void begin(int column) {
    column_ = column;
    row_ = 0;
  }
  // bytes < 0 means that the call keeps no memory.
  void add(const std::string &call, double seconds, double bytes = -1) {
    if (row_ == rows_.size()) rows_.push_back({call, {}, {}});
    rows_[row_].time[column_] = time_text(seconds);
    if (bytes >= 0) rows_[row_].memory[column_] = memory_text(bytes);
    ++row_;
  }
  void print() const {
    std::printf("| call | aortic | mitral | memory kept |\n|---|---|---|---|\n");
    for (const Row &row : rows_) {
      std::printf("| %s | %s | %s | %s |\n", row.call.c_str(), row.time[0].c_str(), row.time[1].c_str(),
                  (row.memory[0] == row.memory[1] ? row.memory[0] : row.memory[0] + ", " + row.memory[1]).c_str());
    }
  }

 private:
  int column_ = 0;
  std::size_t row_ = 0;
  std::vector<Row> rows_;
};

// Makes the object as often as the timing needs, and once more to count the bytes that malloc gave it.
template <class Handle>
void add_making(Table &table, const std::string &name, const std::function<riis_status(Handle **)> &make,
                void (*destroy)(Handle **), Handle **made) {
  check(make(made));  // the first call may also make shared objects, such as Embree's device, so it is not timed
  const double seconds = shortest([&] { check(make(made)); }, [&] { destroy(made); });
  destroy(made);
  const double before = allocated();
  check(make(made));
  table.add(name, seconds, allocated() - before);
}

void add_preparing(Table &table, const std::function<void(riis_mesh **)> &make_mesh) {
  for (const std::int32_t n_threads : {1, 2}) {
    riis_mesh *mesh = nullptr;
    make_mesh(&mesh);
    const auto prepare = [&] { check(riis_mesh_prepare(mesh, n_threads)); };
    const double before = allocated();
    prepare();
    const double bytes = allocated() - before;
    const auto renew = [&] {
      riis_mesh_destroy(&mesh);
      make_mesh(&mesh);
    };
    renew();
    table.add(n_threads == 1 ? "`riis_mesh_prepare`, 1 thread" : "`riis_mesh_prepare`, 2 threads",
              shortest(prepare, renew), n_threads == 1 ? bytes : -1);
    riis_mesh_destroy(&mesh);
  }
}

void add_marking(Table &table, const std::string &name, const Surface &surface, riis_mesh *mesh, std::int32_t search) {
  for (const std::int32_t n_threads : {1, 2}) {
    const double before = allocated();
    const Result result = make_result();
    riis_mark_options options;
    check(riis_mark_options_init(&options, sizeof options));
    options.search = search;
    options.n_threads = n_threads;
    const auto mark = [&] { check(riis_mark_nodes(surface.get(), mesh, &options, result.get())); };
    mark();  // allocates the result's memory and makes the mesh's clusters or balls
    const double bytes = allocated() - before;
    table.add("`riis_mark_nodes`, " + name + (n_threads == 1 ? ", 1 thread" : ", 2 threads"), shortest(mark),
              n_threads == 1 ? bytes : -1);
  }
}

void measure(Table &table, const char *kind, const Cylinder &cylinder, std::int64_t about_n_nodes) {
  riis_valve *new_valve = nullptr;
  add_making<riis_valve>(
      table, "`riis_valve_create`", [&](riis_valve **made) { return riis_valve_create(kind, made); },
      riis_valve_destroy, &new_valve);
  const Valve valve(new_valve);
  riis_surface *new_surface = nullptr;
  add_making<riis_surface>(
      table, "`riis_surface_create`",
      [&](riis_surface **made) { return riis_surface_create(valve.get(), nullptr, made); }, riis_surface_destroy,
      &new_surface);
  const Surface surface(new_surface);
  table.add("`riis_surface_update`",
            shortest([&] { check(riis_surface_update(surface.get(), valve.get(), nullptr)); }));

  const CylinderNodes nodes(cylinder, about_n_nodes);
  const double *xyz = nodes.xyz().data();
  const std::int64_t n = nodes.n_nodes();
  riis_mesh *new_mesh = nullptr;
  add_making<riis_mesh>(
      table, "`riis_mesh_create`, `riis_mesh_update`",
      [&](riis_mesh **made) { return riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, made); }, riis_mesh_destroy,
      &new_mesh);
  const Mesh mesh(new_mesh);
  add_preparing(table, [&](riis_mesh **made) { check(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, made)); });
  check(riis_mesh_prepare(mesh.get(), 0));
  add_marking(table, "clusters", surface, mesh.get(), RIIS_SEARCH_CLUSTERS);
  add_marking(table, "exhaustive search", surface, mesh.get(), RIIS_SEARCH_EXHAUSTIVE);

  const std::vector<std::int32_t> tetrahedra = nodes.tetrahedra();
  Adjacency adjacency = adjacency_of(n, tetrahedra, 1);
  const double seconds = shortest([&] { adjacency = adjacency_of(n, tetrahedra, 1); }, [&] { adjacency.reset(); });
  adjacency.reset();
  const double before = allocated();
  adjacency = adjacency_of(n, tetrahedra, 1);
  table.add("`riis_adjacency_create_from_cells`, 1 thread", seconds, allocated() - before);
  riis_csr rows;
  check(riis_adjacency_get_csr(adjacency.get(), &rows, sizeof rows));
  table.add("`riis_mesh_set_adjacency`", shortest([&] { check(riis_mesh_set_adjacency(mesh.get(), &rows)); }));
  add_marking(table, "neighbour search, not its first", surface, mesh.get(), RIIS_SEARCH_NEIGHBOR);

  const Result result = make_result();
  check(riis_mark_nodes(surface.get(), mesh.get(), nullptr, result.get()));
  std::vector<double> distance(static_cast<std::size_t>(n));
  table.add("`riis_marks_get_dense`, distances",
            shortest([&] { get_distances(result.get(), RIIS_FAR_DISTANCE, distance); }));
}

}  // namespace

int main(int argc, char **argv) {
  const std::int64_t about_n_nodes = n_nodes_given(argc, argv, 1, 1);
  Table table;
  for (const int valve : {0, 1}) {
    table.begin(valve);
    measure(table, valve == 0 ? "aortic" : "mitral", cylinders[valve], about_n_nodes);
  }
  table.print();
  return 0;
}
