// SPDX-License-Identifier: Apache-2.0
#include "program/series.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "program/leaks.hpp"
#include "program/marking_in_pieces.hpp"
#include "program/mesh_marking.hpp"
#include "program/mesh_reading.hpp"
#include "program/moving_valve.hpp"
#include "program/outputs.hpp"
#include "program/pictures.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"
#include "program/series_files.hpp"
#include "program/text.hpp"
#include "program/warnings.hpp"

namespace riis::program {

namespace {

constexpr int32_t series_fields = RIIS_FIELD_NORMAL | RIIS_FIELD_SIDE | RIIS_FIELD_VELOCITY;

int64_t n_nodes_of(const riis_vtk_mesh *file) {
  int64_t n = 0;
  check(riis_vtk_mesh_get_nodes(file, &n, nullptr, nullptr));
  return n;
}

// Returns a text such as "12.3 MB".
std::string bytes_text(double n) {
  const char *const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  for (; n >= 1000 && unit < 5; ++unit) n /= 1000;
  char text[32];
  std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.3g %s", n, units[unit]);
  return text;
}

// The second pass of a series: marks at each time, and writes the files.
class Writing {
 public:
  // `pictures` may be NULL.
  Writing(Case &all, std::vector<MovingValve> &valves, riis_vtk_mesh *part, SeriesPictures *pictures)
      : all_(all),
        valves_(valves),
        part_(part),
        pictures_(pictures),
        nodes_(borrow_nodes(part, all.options.mesh)),
        foam_case_(is_foam_case(all.options.output) ? all.options.output : ""),
        meshes_(foam_case_.empty() ? all.options.output : "", ".vtu", times().size()),
        surfaces_(all.options.surface_output, ".vtp", times().size()),
        table_(all) {}

  // Prints the estimated size of all files. The estimate comes from the first step's file.
  void announce(int64_t n_nodes_of_mesh) {
    if (all_.options.quiet || !meshes_.is_wanted()) return;
    set_arrays(0);
    int64_t n_bytes = 0;
    check(riis_vtk_mesh_get_file_size(part_, &n_bytes));
    const auto n = static_cast<double>(times().size());
    std::fprintf(stderr, "riis: writing %s with %s of %s nodes, %s in all, to %s\n",
                 counted(view(times()).size(), "file").c_str(), grouped(n_nodes_of(part_)).c_str(),
                 grouped(n_nodes_of_mesh).c_str(), bytes_text(n * static_cast<double>(n_bytes)).c_str(),
                 meshes_.folder().c_str());
  }

  // Writes all steps. If a signal waits, stops after the present step.
  void run(Report &report) {
    if (meshes_.is_wanted()) meshes_.make_folder();
    if (surfaces_.is_wanted()) surfaces_.make_folder();
    SeriesLists lists([this](bool is_last) { write_lists(is_last); });
    StepProgress progress("writing", times().size(), all_.options.quiet);
    try {
      for (; n_done_ < times().size() && !UnbrokenWrite::has_signal(); ++n_done_) {
        progress.begin(n_done_);
        do_step(n_done_, lists);
        if (pictures_) pictures_->draw(n_done_, valves_, report);
      }
    } catch (...) {
      lists.end();
      throw;
    }
    lists.end();
    if (pictures_ && !UnbrokenWrite::has_signal()) pictures_->encode(report);
  }

  std::size_t n_done() const { return n_done_; }  // number of steps written
  const SeriesTable &table() const { return table_; }
  const std::string &foam_case() const { return foam_case_; }
  const SeriesFiles &meshes() const { return meshes_; }
  const SeriesFiles &surfaces() const { return surfaces_; }

 private:
  const std::vector<double> &times() const { return all_.options.series.times; }

  void set_arrays(std::size_t step) { set_series_arrays(all_, valves_, nodes_.get(), part_, step); }

  void do_step(std::size_t step, SeriesLists &lists) {
    const Stage marking("", true);
    set_arrays(step);
    const double seconds = marking.seconds();
    if (meshes_.is_wanted()) {
      const std::string path = meshes_.path_of(step, "");
      check(riis_vtk_mesh_write(part_, path.c_str()));
      lists.add([&] { meshes_.add(times()[step], 0, path); });
    }
    if (!foam_case_.empty()) check(riis_vtk_mesh_write(part_, foam_time(foam_case_, times()[step]).c_str()));
    for (std::size_t valve = 0; surfaces_.is_wanted() && valve < valves_.size(); ++valve) {
      const std::string path = surfaces_.path_of(step, all_.part_of(valve));
      check(riis_vtk_surface_write(valves_[valve].surface(), path.c_str()));
      lists.add([&] { surfaces_.add(times()[step], valve, path); });
    }
    lists.add([&] { table_.add(times()[step], valves_, seconds); });
  }

  void write_lists(bool is_last) const {
    for (const SeriesFiles *files : {&meshes_, &surfaces_})
      if (files->n_written() > 0) files->write_list();
    const std::string &table = all_.options.series.table;
    if (!table.empty() && (is_last || can_be_replaced(table))) write_text(table, table_.text());
  }

  Case &all_;
  std::vector<MovingValve> &valves_;
  riis_vtk_mesh *part_;
  SeriesPictures *pictures_;
  Mesh nodes_;
  const std::string foam_case_;  // the case of OpenFOAM that gets fields, or ""
  SeriesFiles meshes_, surfaces_;
  SeriesTable table_;
  std::size_t n_done_ = 0;
};

MeshFile copy_of(const riis_vtk_mesh *file) {
  std::vector<int64_t> all(static_cast<std::size_t>(n_nodes_of(file)));
  std::iota(all.begin(), all.end(), 0);
  return part_of(file, all);
}

// Warns of leaks at the time when each valve is least open. An open valve is not meant to stop the flow.
void look_for_closed_leaks(const Case &all, std::vector<MovingValve> &valves, riis_mesh *mesh,
                           const riis_vtk_mesh *file, Report &report) {
  move_to_least_openings(all, valves);
  for (MovingValve &valve : valves) valve.mark(mesh, 0);
  look_for_leaks_of(all, valves, mesh, file);
  check_passage_of(all, valves, mesh, file, report);
  measure_bands(all, valves, mesh, file, report);
  measure_largest_orifices(all, valves, report);
}

// Warns of suspicious marks. Judges each valve at the time when it marks most nodes.
void warn_of_sweep(const Case &all, const Sweep &sweep, const riis_vtk_mesh *file) {
  riis_mark_stats marks{};
  std::vector<Warning> warnings;
  for (std::size_t valve = 0; valve < all.valves.size(); ++valve) {
    marks.n_marked = sweep.most_marked[valve];
    auto warning = warning_of(situation_of(all.valves[valve].options, sweep.surface[valve], marks, file));
    if (!warning) continue;
    const std::string part = all.part_of(valve);
    warning->text.insert(0, part.empty() ? "" : part + ": ");
    warnings.push_back(*warning);
  }
  warn(warnings);
}

}  // namespace

std::vector<std::string> names_of_series(const Case &all) {
  std::vector<std::string> names;
  for (const ValveSource &valve : all.valves) {
    const std::vector<std::string> own = names_of_marks(valve.options.prefix, series_fields);
    names.insert(names.end(), own.begin(), own.end());
  }
  if (all.has_resistance()) {
    names.push_back(all.options.prefix + "_K");
    names.push_back(all.options.prefix + "_K_u_surface");
  }
  if (!all.options.series.all_cells) names.emplace_back("riis_node_id");
  return names;
}

MeshFile part_of(const riis_vtk_mesh *file, const std::vector<int64_t> &node_ids) {
  riis_vtk_mesh *part = nullptr;
  check(riis_vtk_mesh_extract(file, view(node_ids).size(), node_ids.data(), &part));
  return MeshFile(part);
}

double time_before(const Case &all, std::size_t step) {
  const std::vector<double> &times = all.options.series.times;
  return step == 0 ? times[0] - (times[1] - times[0]) : times[step - 1];
}

namespace {

// Moves each valve to the time at which its opening comes first in an order, and to the first such time if there are several.
template <class Order>
void move_to_first(const Case &all, std::vector<MovingValve> &valves, Order order) {
  const std::vector<double> &times = all.options.series.times;
  for (MovingValve &valve : valves) {
    const OpeningLaw &law = valve.source().law;
    valve.move_to(
        *std::min_element(times.begin(), times.end(), [&](double a, double b) { return order(law.at(a), law.at(b)); }));
  }
}

}  // namespace

void move_to_least_openings(const Case &all, std::vector<MovingValve> &valves) {
  move_to_first(all, valves, std::less<>());
}

void measure_largest_orifices(const Case &all, std::vector<MovingValve> &valves, Report &report) {
  if (!all.options.check_leaks) return;
  move_to_first(all, valves, std::greater<>());
  measure_orifices(all, valves, report);
}

void set_series_arrays(const Case &all, std::vector<MovingValve> &valves, const riis_mesh *nodes, riis_vtk_mesh *part,
                       std::size_t step) {
  ResistanceSum resistance(n_nodes_of(part), ResistanceSum::WithVelocity::yes);
  for (MovingValve &valve : valves) {
    valve.move_to(all.options.series.times[step], time_before(all, step));
    valve.mark(nodes, series_fields);
    set_marks(valve.options(), valve.result(), series_fields, part);
    resistance.add(valve.options(), valve.result());
  }
  resistance.set_arrays(all.options.prefix, part);
}

void print_summary(const Case &all, const SeriesTable &table, const std::vector<const SeriesFiles *> &lists,
                   const std::string &foam_case, std::int64_t n_nodes, std::optional<std::int64_t> n_written,
                   Report &report) {
  if (all.options.quiet) return;
  const std::vector<double> &times = all.options.series.times;
  std::string text = take_notes() + "times     " + counted(view(times).size(), "time") + " from " +
                     shown(times.front()) + " to " + shown(times.back()) + "\n";
  text += "mesh      " + all.options.mesh + ": " + counted(n_nodes, "node") +
          (n_written ? ", " + grouped(*n_written) + " written\n" : "\n");
  text += table.summary();
  text += line_of_passage(report.leaks) + lines_of_valve_flows(report);
  for (const SeriesFiles *files : lists) {
    if (!files->is_wanted()) continue;
    report.written.push_back(files->pvd() + ", " + counted(static_cast<int64_t>(files->n_written()), "file") + " in " +
                             files->folder());
  }
  if (!foam_case.empty()) report.written.push_back(foam_case + ", fields of " + counted(view(times).size(), "time"));
  if (!all.options.series.table.empty()) report.written.push_back(all.options.series.table);
  for (const std::string &path : report.written) text += "written   " + path + "\n";
  write_text("-", text);
}

ExitCode run_series(Case &all) {
  const MarkOptions &options = all.options;
  std::vector<MovingValve> valves = moving_valves(all);
  Report report;
  MeshFile file = read_mesh(options, report.seconds);
  check_new_arrays(options, names_of_series(all), file.get());
  const int64_t n_nodes = n_nodes_of(file.get());
  Sweep sweep;
  {
    const Mesh mesh = borrow_nodes(file.get(), options.mesh);
    sweep = sweep_of(valves, options.series.times, mesh.get(), n_nodes, options.quiet);
    warn_of_sweep(all, sweep, file.get());
    look_for_closed_leaks(all, valves, mesh.get(), file.get(), report);
  }
  // From here on, a signal such as Ctrl-C waits for the end of a step. So even then the lists are written and the movie's frames
  // are removed.
  const UnbrokenWrite unbroken;
  const MeshFile part = options.series.all_cells ? nullptr : part_of(file.get(), sweep.node_ids);
  riis_vtk_mesh *const written = part ? part.get() : file.get();
  std::optional<SeriesPictures> pictures;
  if (SeriesPictures::are_wanted(options)) {
    // Pictures get a mesh of their own, because they show the whole mesh and store other arrays in it.
    MeshFile drawn = part ? std::move(file) : copy_of(file.get());
    pictures.emplace(all, std::move(drawn), sweep.box);
  } else if (part) {
    file.reset();
  }
  Writing writing(all, valves, written, pictures ? &*pictures : nullptr);
  writing.announce(n_nodes);
  const int64_t n_written = n_nodes_of(written);
  writing.run(report);
  if (UnbrokenWrite::has_signal())
    std::fprintf(stderr, "riis: interrupted: %zu of %zu written\n", writing.n_done(), options.series.times.size());
  else
    print_summary(all, writing.table(), {&writing.meshes(), &writing.surfaces()}, writing.foam_case(), n_nodes,
                  writing.meshes().is_wanted() ? std::optional(n_written) : std::nullopt, report);
  return writing.table().most_marked() == 0 && !options.allow_none ? exit_none_marked : exit_fine;
}

// ---- Sweep ----

namespace {

void grow(Box &box, const riis_surface_info &surface) {
  grow(box, surface.lower);
  grow(box, surface.upper);
}

void note_nodes(const riis_marks *result, std::vector<std::uint8_t> &is_near) {
  const riis_mark_list within = list_of(result, RIIS_LIST_WITHIN_LIMIT);
  for (int64_t i = 0; i < within.n_nodes; ++i) view(is_near)[within.node_id[i]] = 1;
}

void note_valve(const MovingValve &valve, std::size_t at, Sweep &sweep) {
  riis_surface_info info;
  check(riis_surface_get_info(valve.surface(), &info, sizeof info));
  grow(sweep.box, info);
  const std::int64_t n_marked = valve.stats().n_marked;
  if (n_marked <= sweep.most_marked[at]) return;
  sweep.most_marked[at] = n_marked;
  sweep.surface[at] = info;
}

}  // namespace

Sweep sweep_of(std::vector<MovingValve> &valves, const std::vector<double> &times, const riis_mesh *mesh,
               std::int64_t n_nodes, bool quiet, const std::function<void(std::size_t, std::size_t)> &note) {
  Sweep sweep{
      {}, empty_box(), std::vector<std::int64_t>(valves.size(), -1), std::vector<riis_surface_info>(valves.size())};
  std::vector<std::uint8_t> is_near(static_cast<std::size_t>(n_nodes));
  StepProgress progress("finding the nodes near the sweep", times.size(), quiet);
  for (std::size_t step = 0; step < times.size(); ++step) {
    progress.begin(step);
    for (std::size_t at = 0; at < valves.size(); ++at) {
      valves[at].move_to(times[step]);
      valves[at].mark(mesh, 0);
      note_nodes(valves[at].result(), is_near);
      note_valve(valves[at], at, sweep);
      if (note) note(step, at);
    }
  }
  for (std::int64_t node = 0; node < n_nodes; ++node)
    if (view(is_near)[node]) sweep.node_ids.push_back(node);
  return sweep;
}

}  // namespace riis::program
