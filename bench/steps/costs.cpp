// SPDX-License-Identifier: Apache-2.0
// Measures the cost of each call for the tables in docs/performance.md. The cost of a call is its shortest time in several
// repetitions, and the memory that the handle keeps. The meshes are cylinders of a million nodes around the valves, and the
// tolerance is 5 %. A second table compares a step with an offset to a step without an offset. The last table has processor times
// of orifices, free edges and coaptation, for surfaces with 60,000 triangles.
//   argv[1]  thousands of nodes, "offset" for the second table alone, or "measures" for the last table alone; optional
#include <riis/riis.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
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

// Collects the table's rows. The columns are filled one valve at a time.
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

// Makes the object as often as the timing needs. To count the bytes from malloc, makes the object once more.
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

void add_moving(Table &table, const char *kind) {
  const Valve valve = make_valve(kind), before = make_valve(kind);
  check(riis_valve_set_scalar(valve.get(), "opening", 0.5));
  check(riis_valve_set_scalar(before.get(), "opening", 0.49));
  const Surface surface = make_surface(valve.get());
  const auto move = [&] {
    check(riis_surface_update_moving(surface.get(), valve.get(), before.get(), 0.01, nullptr, nullptr));
  };
  table.add("`riis_surface_update_moving`, from opening 0.49 to 0.5", shortest(move));
  riis_surface_info info;
  table.add("`riis_surface_get_info`, the first after it",
            shortest([&] { check(riis_surface_get_info(surface.get(), &info, sizeof info)); }, move));
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
  add_moving(table, kind);

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

// ---- The band with an offset ----

// A moving trileaflet valve, in a mesh whose spacing is half of the half thickness. A step is an update with velocities, and a
// marking with K.
class OffsetStep {
 public:
  OffsetStep(double half_thickness, double offset)
      : valve_(make_valve("trileaflet")), before_(make_valve("trileaflet")) {
    check(riis_surface_options_init(&options_, sizeof options_));
    options_.half_thickness = half_thickness;
    options_.offset = offset;
    options_.n_threads = 1;
    check(riis_valve_set_scalar(valve_.get(), "opening", 0.5));
    check(riis_valve_set_scalar(before_.get(), "opening", 0.49));
    surface_ = make_surface(valve_.get(), &options_);
    check(riis_resistance_init(&resistance_, sizeof resistance_));
    resistance_.R = 1e4;
    check(riis_mark_options_init(&marking_, sizeof marking_));
    marking_.resistance = &resistance_;
    marking_.n_threads = 1;
  }

  // Returns the processor time of a step on this mesh, in seconds.
  double seconds_in(riis_mesh *mesh) const {
    const std::clock_t start = std::clock();
    check(riis_surface_update_moving(surface_.get(), valve_.get(), before_.get(), 0.01, &options_, &options_));
    check(riis_mark_nodes(surface_.get(), mesh, &marking_, marks_.get()));
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }

 private:
  Valve valve_, before_;
  Surface surface_;
  Result marks_ = make_result();
  riis_surface_options options_;
  riis_resistance resistance_;
  riis_mark_options marking_;
};

// Compares the processor time of a step with the offset 0.75 with that of a step without an offset. Prints the ratio of the two
// times. The two steps take turns, so other work on the machine slows them equally.
void print_offset() {
  constexpr double half_thickness = 0.1, spacing = half_thickness / 2;
  const Cylinder &around = cylinders[0];
  const double volume = std::acos(-1) * around.radius * around.radius * (around.upper - around.lower);
  const CylinderNodes nodes(around, static_cast<std::int64_t>(volume / (spacing * spacing * spacing)));
  const Mesh mesh = mesh_over(nodes);
  check(riis_mesh_prepare(mesh.get(), 1));
  const OffsetStep steps[2] = {{half_thickness, 0}, {half_thickness, 0.75}};
  double least[2] = {HUGE_VAL, HUGE_VAL};
  for (int n = 0; n < 300; ++n)
    for (std::size_t k = 0; k < 2; ++k) least[k] = std::min(least[k], steps[k].seconds_in(mesh.get()));
  std::printf(
      "\n| moving update and marking with K, 1 thread | offset 0 | offset 0.75 | ratio |\n|---|---|---|---|\n"
      "| trileaflet, nodes at half of the half thickness | %s | %s | %.2f |\n",
      time_text(least[0]).c_str(), time_text(least[1]).c_str(), least[1] / least[0]);
}

// ---- Orifice, free edges and coaptation ----

constexpr double wanted_triangles = 60000;

// Returns options that give at least 60,000 triangles. The number of triangles is nearly proportional to 1 / tolerance.
riis_surface_options fine_options(const riis_valve *valve) {
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  for (;;) {
    const double share = n_triangles_of(make_surface(valve, &options).get()) / wanted_triangles;
    if (share >= 1) return options;
    options.tolerance *= std::min(share, 0.95);
  }
}

// Copies the triangles of a valve's surface. Gives them as arrays, as a solver would, and as two equal frames, as a file would.
class OwnTriangles {
 public:
  explicit OwnTriangles(const riis_surface *surface) {
    const riis_triangles all = triangles_of(surface);
    frames_.assign(all.xyz, all.xyz + 3 * all.n_vertices);
    frames_.insert(frames_.end(), all.xyz, all.xyz + 3 * all.n_vertices);
    vertex_ids_.assign(all.vertex_id, all.vertex_id + 3 * all.n_triangles);
    leaflet_ids_.assign(all.leaflet_id, all.leaflet_id + all.n_triangles);
    check(riis_surface_arrays_init(&arrays_, sizeof arrays_));
    arrays_.n_vertices = all.n_vertices;
    arrays_.x = frames_.data(), arrays_.y = frames_.data() + 1, arrays_.z = frames_.data() + 2;
    arrays_.stride = 3;
    arrays_.n_faces = all.n_triangles;
    arrays_.vertex_ids = vertex_ids_.data();
    arrays_.id_bits = 64;
    arrays_.leaflet_id = leaflet_ids_.data();
    riis_keyframe_arrays frames;
    check(riis_keyframe_arrays_init(&frames, sizeof frames));
    const double times[2] = {0, 1};
    frames.n_keys = 2;
    frames.n_vertices = all.n_vertices;
    frames.time = times;
    frames.xyz = frames_.data();
    riis_keyframes *keyframes = nullptr;
    check(riis_keyframes_create(&arrays_, &frames, &keyframes));
    keyframes_.reset(keyframes);
  }
  Surface from_arrays() const {
    riis_surface *surface = nullptr;
    check(riis_surface_create_from_arrays(&arrays_, nullptr, &surface));
    return Surface(surface);
  }
  Surface from_keyframes() const {
    riis_surface *surface = nullptr;
    check(riis_surface_create_from_keyframes(keyframes_.get(), 0.5, 0, nullptr, &surface));
    return Surface(surface);
  }

 private:
  std::vector<double> frames_;
  std::vector<std::int64_t> vertex_ids_;
  std::vector<std::int32_t> leaflet_ids_;
  riis_surface_arrays arrays_;
  std::unique_ptr<riis_keyframes, Destroy<riis_keyframes, riis_keyframes_destroy>> keyframes_;
};

void get_orifice(const riis_surface *surface) {
  riis_orifice orifice;
  check(riis_surface_get_orifice(surface, nullptr, &orifice, sizeof orifice));
}

// The first call measures the sizes of the leaflets, and the surface keeps these sizes.
void get_leaflets(const riis_surface *surface) {
  riis_leaflet sizes;
  check(riis_surface_get_leaflet(surface, 0, &sizes, sizeof sizes));
}

void get_coaptation(const riis_surface *surface) {
  riis_coaptation coaptation;
  check(riis_surface_get_coaptation(surface, RIIS_AUTO, RIIS_ALL_LEAFLETS, &coaptation, sizeof coaptation));
}

// Returns the processor time in seconds of the shortest of five calls, summed over all threads. Other programs hardly change the
// processor time.
double processor_seconds(const std::function<void()> &call, const std::function<void()> &before) {
  double least = HUGE_VAL;
  for (int n = 0; n < 5; ++n) {
    before();
    const std::clock_t start = std::clock();
    call();
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

// Prints the processor times of the measures. Each printed time is the longer of the times for a closed and for an open valve.
void print_measures() {
  const std::pair<const char *, std::function<void(const riis_surface *)>> calls[] = {
      {"`riis_surface_get_orifice`", get_orifice},
      {"`riis_surface_get_leaflet`, the first", get_leaflets},
      {"`riis_surface_get_coaptation`", get_coaptation},
      {"all three", [](const riis_surface *surface) {
         get_orifice(surface);
         get_leaflets(surface);
         get_coaptation(surface);
       }}};
  constexpr std::size_t n_calls = std::size(calls), n_columns = 6;
  double seconds[n_calls][n_columns] = {}, fewest = HUGE_VAL, most = 0;
  for (const double opening : {0.0, 1.0})
    for (std::size_t kind = 0; kind < 2; ++kind) {
      const Valve valve = make_valve(kind == 0 ? "coapting" : "mitral");
      check(riis_valve_set_scalar(valve.get(), "opening", opening));
      const riis_surface_options options = fine_options(valve.get());
      Surface surface = make_surface(valve.get(), &options);
      const OwnTriangles own(surface.get());
      fewest = std::min(fewest, n_triangles_of(surface.get()));
      most = std::max(most, n_triangles_of(surface.get()));
      const std::function<void()> make[3] = {[&] { surface = make_surface(valve.get(), &options); },
                                             [&] { surface = own.from_arrays(); },
                                             [&] { surface = own.from_keyframes(); }};
      for (std::size_t origin = 0; origin < 3; ++origin)
        for (std::size_t i = 0; i < n_calls; ++i) {
          double &longest = seconds[i][3 * kind + origin];
          longest = std::max(longest, processor_seconds([&] { calls[i].second(surface.get()); }, make[origin]));
        }
    }
  std::printf(
      "\n%.0f to %.0f triangles\n\n| call | coapting | its arrays | its keyframes | mitral | its arrays | its "
      "keyframes |\n"
      "|---|---|---|---|---|---|---|\n",
      fewest, most);
  for (std::size_t i = 0; i < n_calls; ++i) {
    std::printf("| %s |", calls[i].first);
    for (const double time : seconds[i]) std::printf(" %s |", time_text(time).c_str());
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char **argv) {
  if (argc > 1 && std::string(argv[1]) == "measures") {
    print_measures();
    return 0;
  }
  if (argc > 1 && std::string(argv[1]) == "offset") {
    print_offset();
    return 0;
  }
  const std::int64_t about_n_nodes = n_nodes_given(argc, argv, 1, 1);
  Table table;
  for (const int valve : {0, 1}) {
    table.begin(valve);
    measure(table, valve == 0 ? "aortic" : "mitral", cylinders[valve], about_n_nodes);
  }
  table.print();
  print_offset();
  print_measures();
  return 0;
}
