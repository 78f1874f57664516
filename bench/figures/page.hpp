// SPDX-License-Identifier: Apache-2.0
// One HTML file that holds everything. Pictures are base64, styles are inline, and there are no scripts and nothing to load.
// In: figures with their pictures and texts (HTML). Out: the file.
#pragma once

#include <string>
#include <vector>

#include "figures/picture.hpp"

namespace riis::figures {

struct Panel {
  Png picture;
  std::string caption;
};

// A colour and its meaning.
struct KeyEntry {
  Colour colour;
  std::string text;
};

struct Figure {
  std::string title;
  std::vector<Panel> panels;
  int columns;
  std::vector<KeyEntry> key;
  std::string caption;
  std::string paper;  // the part of the paper that the figure shows
  std::string table;  // below the pictures; may be empty
};

// Returns a table of texts. The first row is its head.
std::string html_table(const std::vector<std::vector<std::string>> &rows);

// Makes an empty file, so that a path that cannot be written is refused before anything is drawn. Both functions throw a
// std::runtime_error that names the path.
void begin_page(const std::string &path);

// left_out has a text (HTML) for each figure that the page lacks, with the way to get it. appendix is HTML after the last figure.
void write_page(const std::string &path, const std::vector<Figure> &figures, const std::vector<std::string> &left_out,
                const std::string &appendix);

}  // namespace riis::figures
