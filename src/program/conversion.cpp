// SPDX-License-Identifier: Apache-2.0
#include "program/conversion.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

namespace riis::program {
namespace {

namespace fs = std::filesystem;

// Every ending here was tried. tests/cli/test_cli_conversions.c tries it again if the tool is installed.
const std::set<std::string> meshes_of_gmsh = {".msh", ".unv", ".bdf", ".nas", ".mesh"};
const std::set<std::string> meshes_of_meshio = {".inp", ".su2"};
const std::set<std::string> surfaces_of_gmsh = {".msh", ".unv", ".bdf", ".nas", ".mesh", ".ply", ".ply2", ".vtk"};
const std::set<std::string> surfaces_of_meshio = {".obj", ".off"};
const std::set<std::string> surfaces_only = {".stl", ".vtp", ".ply", ".ply2", ".obj", ".off"};

std::string ending_of(const std::string &path) {
  std::string ending = fs::path(path).extension().string();
  for (char &c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

// Quotes the path so that a shell takes it for one word, and a program does not take it for an option.
std::string shell_word(std::string path) {
  if (path[0] == '-') path.insert(0, "./");
  const auto is_plain = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c >= 128 ||
           std::string("_-./+,:@%").find(static_cast<char>(c)) != std::string::npos;
  };
  if (std::all_of(path.begin(), path.end(), is_plain)) return path;
  std::string quoted = "'";
  for (const char c : path) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string with_ending(const std::string &path, const char *ending) {
  return shell_word(fs::path(path).replace_extension(ending).string());
}

std::string by_gmsh(const std::string &path, const char *format) {
  return "; gmsh converts it: gmsh -save " + shell_word(path) + " -format " + format + " -o " +
         with_ending(path, format);
}

std::string by_meshio(const std::string &path, const char *format) {
  return "; meshio converts it: meshio convert " + shell_word(path) + " " + with_ending(path, format);
}

}  // namespace

std::string conversion_hint(const std::string &path, Content wanted) {
  const std::string ending = ending_of(path);
  // Control characters would not survive in the one line of a refusal.
  if (std::any_of(path.begin(), path.end(), [](unsigned char c) { return c < ' ' || c == 127; })) return "";
  if (wanted == Content::mesh) {
    if (meshes_of_gmsh.count(ending) != 0) return by_gmsh(path, "vtk");
    if (meshes_of_meshio.count(ending) != 0) return by_meshio(path, "vtu");
    return surfaces_only.count(ending) != 0 ? "; --surface takes a surface" : "";
  }
  if (surfaces_of_gmsh.count(ending) != 0) return by_gmsh(path, "stl");
  return surfaces_of_meshio.count(ending) != 0 ? by_meshio(path, "stl") : "";
}

}  // namespace riis::program
