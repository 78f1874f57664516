// SPDX-License-Identifier: Apache-2.0
// riis-figures FILE.html [GIVEN.json|KIND.csv...] draws the geometry into one page, beginning with the paper's figures. Next come
// valves at the openings in the KIND.csv tables of `riis states`, then the pictures that the GIVEN.json files name.
// riis-figures --curves FILE.json writes the valves' parameters and curves, for parameters/draw.py.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "figures/curves_json.hpp"
#include "figures/figures.hpp"
#include "figures/given_figures.hpp"
#include "figures/shapes.hpp"
#include "figures/state_figures.hpp"
#include "figures/text.hpp"
#include "riis_vtk/base/vtk_errors.hpp"
#include "riis_vtk/picture/drawing.hpp"

namespace {

using namespace riis::figures;

std::string parameter_tables() {
  std::string html = "<section id=\"parameters\">\n<h2>Parameters of the figures</h2>\n";
  for (const char *name : kinds_with_states) {
    const riis::ValveKind &kind = riis::find_valve_kind(name);
    std::vector<std::vector<std::string>> rows = {{"parameter", "value", "unit", "what it is"}};
    for (const riis::ParameterSpec &spec : kind.parameters) {
      std::string values;
      for (int i = 0; i < spec.n_values; ++i)
        values += (i ? ", " : "") + number(spec.default_values[static_cast<std::size_t>(i)], 6);
      rows.push_back({"<code>" + spec.name + "</code>", values, spec.unit, spec.description});
    }
    html += "<details><summary>" + std::string(name) + " valve: " + count(kind.parameters.size()) +
            " parameters</summary>\n" + html_table(rows) + "</details>\n";
  }
  return html + "</section>\n";
}

// The content of the given files.
struct Given {
  std::vector<StateTable> states;
  std::vector<Figure> figures;
  std::vector<std::string> left_out;
};

bool is_table(const std::string &path) { return path.size() > 4 && path.compare(path.size() - 4, 4, ".csv") == 0; }

Given read_given(const std::vector<std::string> &paths) {
  Given given;
  for (const std::string &path : paths) {
    if (is_table(path)) {
      given.states.push_back(read_state_table(path));
      check_table(given.states.back());
      continue;
    }
    const GivenFigures read = read_figures(path);
    given.figures.insert(given.figures.end(), read.figures.begin(), read.figures.end());
    given.left_out.insert(given.left_out.end(), read.left_out.begin(), read.left_out.end());
  }
  for (const std::string kind : kinds_with_states) {
    const auto is_of_kind = [&](const StateTable &table) { return table.kind == kind; };
    if (std::none_of(given.states.begin(), given.states.end(), is_of_kind))
      given.left_out.push_back(how_to_show_states(kind));
  }
  return given;
}

void draw_page(const std::string &path, const std::vector<std::string> &given_paths,
               const riis::vtk::CaughtOutput &caught) {
  const riis::vtk::HeldDisplay display;
  begin_page(path);
  const Given given = read_given(given_paths);
  std::vector<Figure> figures;
  const auto add = [&](Figure figure) {
    figures.push_back(std::move(figure));
    caught.check(path);
    std::printf("figure %zu: %s\n", figures.size(), figures.back().title.c_str());
    std::fflush(stdout);
  };
  for (Figure (*draw)() : {bezier_figure, coons_figure, aortic_valve_figure, aortic_cusp_figure, mitral_curves_figure,
                           mitral_surfaces_figure, mitral_quads_figure, marking_figure, tolerance_figure,
                           accuracy_figure, accuracy_distribution_figure})
    add(draw());
  for (const StateTable &table : given.states) add(states_figure(table));
  figures.insert(figures.end(), given.figures.begin(), given.figures.end());
  write_page(path, figures, given.left_out, parameter_tables());
}

}  // namespace

int main(int argc, char **argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool only_curves = !words.empty() && words[0] == "--curves";
  if (words.empty() || (only_curves && words.size() != 2)) {
    std::fprintf(stderr,
                 "usage: riis-figures FILE.html [GIVEN.json|KIND.csv...]\n       riis-figures --curves FILE.json\n");
    return 2;
  }
  try {
    const riis::FloatEnvironment environment;
    if (only_curves) {
      write_curves(words[1]);
      return 0;
    }
    const riis::vtk::CaughtOutput caught;
    draw_page(words[0], {words.begin() + 1, words.end()}, caught);
    return 0;
  } catch (const riis::Error &error) {
    std::fprintf(stderr, "riis-figures: %s\n", error.message.text());
  } catch (const riis::vtk::Failure &failure) {
    std::fprintf(stderr, "riis-figures: %s\n", failure.text.c_str());
  } catch (const std::exception &exception) {
    std::fprintf(stderr, "riis-figures: %s\n", exception.what());
  }
  return 1;
}
