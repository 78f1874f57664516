// SPDX-License-Identifier: Apache-2.0
// The common parts of the writers of cases: checks of a SolverCase, the solver's folder, and the replacement of names such as
// @NAME@ in texts.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "program/patient/solver_case.hpp"

namespace riis::program {

// The boundaries of the blood: its ends and its wall. Blood enters the vessel at the inlet.
struct Ends {
  Boundary inlet, wall;
  std::vector<Boundary> outlets;
  double outlet_area = 0;
};
// Refuses a case that does not have exactly one inlet, one wall and at least one outlet. Also refuses a case whose lengths have
// another unit.
Ends ends_of(const SolverCase &solver, Unit unit);

// Makes the solver's folder. Refuses a folder that already contains a case.
void make_case_folder(const SolverCase &solver);
// Copies a file from the case's folder into the solver's folder. The new name may contain folders.
void copy_into(const SolverCase &solver, const std::string &from, const std::string &to);
// Writes a text as a file of the solver's folder.
void write_into(const SolverCase &solver, const std::string &name, const std::string &text);
void make_runnable(const SolverCase &solver, const std::string &name);

// Replaces each @NAME@ by the text that belongs to the name. Every name in the text must be in the list of names.
std::string filled(std::string text, const std::map<std::string, std::string> &names);

// Returns a duration for a message, such as "12 minutes".
std::string duration_text(double seconds);

// Returns the texts of beat_table.py, of the files in the folders fenicsx, openfoam and svmultiphysics, and of uris_flow.py. A
// key is a path from this folder, such as "openfoam/Allrun". CMake writes these texts into the program, so the program needs no
// path to the files.
const std::map<std::string, std::string> &case_texts();

}  // namespace riis::program
