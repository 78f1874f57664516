// SPDX-License-Identifier: Apache-2.0
// riis-figures FILE.html [PLOTS.json]: draws the geometry, the paper's figures of it first, into one page, and puts the plots that
// the JSON names behind them.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "figures/figures.hpp"
#include "figures/given_figures.hpp"
#include "figures/shapes.hpp"
#include "figures/text.hpp"
#include "vtk/display.hpp"
#include "vtk/vtk_errors.hpp"

namespace {

using namespace riis::figures;

std::string parameter_tables() {
  std::string html = "<section id=\"parameters\">\n<h2>Parameters of the figures</h2>\n";
  for (const char *name : {"aortic", "mitral"}) {
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

void draw_page(const std::string &path, const char *plots, const riis::vtk::CaughtOutput &caught) {
  const riis::vtk::HeldDisplay display;
  begin_page(path);
  const std::vector<Figure> given = plots ? read_figures(plots) : std::vector<Figure>{};
  std::vector<Figure> figures;
  for (Figure (*draw)() : {bezier_figure, coons_figure, aortic_valve_figure, aortic_cusp_figure, mitral_curves_figure,
                           mitral_surfaces_figure, mitral_quads_figure, marking_figure, tolerance_figure,
                           accuracy_figure, accuracy_distribution_figure}) {
    figures.push_back(draw());
    caught.check(path);
    std::printf("figure %zu: %s\n", figures.size(), figures.back().title.c_str());
    std::fflush(stdout);
  }
  figures.insert(figures.end(), given.begin(), given.end());
  write_page(path, figures, parameter_tables());
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 2 && argc != 3) {
    std::fprintf(stderr, "usage: riis-figures FILE.html [PLOTS.json]\n");
    return 2;
  }
  try {
    const riis::FloatEnvironment environment;
    const riis::vtk::CaughtOutput caught;
    draw_page(argv[1], argc == 3 ? argv[2] : nullptr, caught);
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
