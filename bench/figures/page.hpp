// SPDX-License-Identifier: Apache-2.0
// Writes one HTML file that contains everything: pictures as base64 and inline styles. It has no scripts and loads nothing.
// Input: figures with their pictures and texts (HTML). Output: the file.
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
  std::string table;  // a table below the pictures; may be empty
};

// Returns an HTML table of texts. The first row is its head.
std::string html_table(const std::vector<std::vector<std::string>> &rows);

// Makes an empty file, so that a bad path is refused before anything is drawn. This function and write_page throw a
// std::runtime_error that names the path.
void begin_page(const std::string &path);

// left_out has a text (HTML) for each figure that the page lacks, with the command that makes it. appendix is HTML after the last
// figure.
void write_page(const std::string &path, const std::vector<Figure> &figures, const std::vector<std::string> &left_out,
                const std::string &appendix);

}  // namespace riis::figures
