// SPDX-License-Identifier: Apache-2.0
#include "program/patient/case_files.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {

namespace fs = std::filesystem;

namespace {

bool is_outlet(const std::string &name) { return name == "outlet" || name.rfind("outlet_", 0) == 0; }

[[noreturn]] void refuse_copy(const std::string &path, const std::string &reason) {
  refuse_data(path + ": cannot be copied: " + reason);
}

}  // namespace

Ends ends_of(const SolverCase &solver, Unit unit) {
  if (solver.unit != unit)
    refuse_data(solver.folder + ": its mesh is in " + words_of(solver.unit) + ", and this solver needs " +
                words_of(unit));
  Ends ends;
  int n_inlets = 0, n_walls = 0;
  for (const Boundary &boundary : solver.boundaries) {
    if (boundary.name == "inlet") {
      ends.inlet = boundary;
      ++n_inlets;
    } else if (boundary.name == "wall") {
      ends.wall = boundary;
      ++n_walls;
    } else if (is_outlet(boundary.name)) {
      ends.outlets.push_back(boundary);
      ends.outlet_area += boundary.area;
    } else {
      refuse_data(solver.folder + ": its boundary '" + boundary.name + "' is neither inlet, outlet nor wall");
    }
  }
  if (n_inlets != 1 || n_walls != 1 || ends.outlets.empty())
    refuse_data(solver.folder + ": a case needs one inlet, one wall and at least one outlet, not " +
                std::to_string(n_inlets) + ", " + std::to_string(n_walls) + " and " +
                std::to_string(ends.outlets.size()));
  return ends;
}

void make_case_folder(const SolverCase &solver) {
  std::error_code error;
  if (fs::exists(solver.solver, error) && !fs::is_empty(solver.solver, error))
    refuse_data(solver.solver + ": a case is there already: remove this folder, or choose another --output");
  fs::create_directories(solver.solver, error);
  if (error) refuse_data(solver.solver + ": cannot be made: " + error.message());
}

void copy_into(const SolverCase &solver, const std::string &from, const std::string &to) {
  const fs::path source = fs::path(solver.folder) / from, target = fs::path(solver.solver) / to;
  std::error_code error;
  fs::create_directories(target.parent_path(), error);
  if (error) refuse_copy(target.string(), error.message());
  fs::copy_file(source, target, error);
  if (error) refuse_copy(source.string(), error.message());
}

void write_into(const SolverCase &solver, const std::string &name, const std::string &text) {
  const fs::path path = fs::path(solver.solver) / name;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) refuse_data(path.parent_path().string() + ": cannot be made: " + error.message());
  write_text(path.string(), text);
}

void make_runnable(const SolverCase &solver, const std::string &name) {
  const std::string path = (fs::path(solver.solver) / name).string();
  std::error_code error;
  fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec, fs::perm_options::add,
                  error);
  if (error) refuse_data(path + ": cannot be made a program: " + error.message());
}

void write_scripts(const SolverCase &solver, const std::string &of, const std::string &run) {
  write_into(solver, "beat_table.py", case_texts().at("beat_table.py"));
  write_orifice(solver);
  for (const std::string &name : {run, std::string("report.py")}) {
    write_into(solver, name, case_texts().at(of + "/" + name));
    make_runnable(solver, name);
  }
}

std::string filled(std::string text, const std::map<std::string, std::string> &names) {
  for (const auto &[name, value] : names) {
    const std::string mark = '@' + name + '@';
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  }
  for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@', at + 1)) {
    const std::size_t end = text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_", at + 1);
    if (end != std::string::npos && end > at + 1 && text[end] == '@')
      throw std::logic_error(text.substr(at, end - at + 1) + " is left in the text of a case");
  }
  return text;
}

void write_orifice(const SolverCase &solver) {
  if (!solver.open_area) return;
  const OpenArea &open = *solver.open_area;
  Json json = {{"area_m2", open.orifice}, {"free_m2", open.free}};
  if (!open.cure.empty()) json["cure"] = open.cure;
  write_into(solver, "orifice.json", json.dump(1) + "\n");
}

std::string time_of_beat(const SolverCost &cost, double n_cells, double period) {
  const double seconds = cost.seconds * n_cells * std::round(period / cost.step);
  return seconds < 90     ? shown(std::ceil(seconds)) + " seconds"
         : seconds < 5400 ? shown(std::ceil(seconds / 60)) + " minutes"
                          : printed("%.1f", seconds / 3600) + " hours";
}

void announce_beat(const SolverCase &solver, const SolverCost &cost) {
  print_line("a beat has " + printed("%.0f", solver.period / cost.step) + " steps of " + shortest(cost.step) + " s; " +
             cost.program + " needs about " + time_of_beat(cost, static_cast<double>(solver.n_cells), solver.period) +
             " on one processor");
}

}  // namespace riis::program
