// SPDX-License-Identifier: Apache-2.0
// The common parts of the writers of cases: checks of a SolverCase, the folder, and texts with names such as @NAME@.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "program/patient/solver_case.hpp"

namespace riis::program {

// The ends of the blood and its wall. Blood enters at the inlet.
struct Ends {
  Boundary inlet, wall;
  std::vector<Boundary> outlets;
  double outlet_area = 0;
};
// Refuses a case without exactly one inlet, one wall, and an outlet, and a case in another unit.
Ends ends_of(const SolverCase &solver, Unit unit);

// Makes the solver's folder. Refuses a folder that holds a case already.
void make_case_folder(const SolverCase &solver);
// Copies a file of the case's folder into the solver's folder, under a name that may begin with folders.
void copy_into(const SolverCase &solver, const std::string &from, const std::string &to);
// Writes a file of the solver's folder.
void write_into(const SolverCase &solver, const std::string &name, const std::string &text);
void make_runnable(const SolverCase &solver, const std::string &name);

// Replaces @NAME@ by its text. Every name in the text must be among the names.
std::string filled(std::string text, const std::map<std::string, std::string> &names);

// Returns a duration for a message, such as "12 minutes".
std::string duration_text(double seconds);

// The texts of beat_table.py and of the files in the folders fenicsx, openfoam and svmultiphysics, by names such as
// "openfoam/Allrun". CMake writes the texts into the program, so the program needs no path to the texts.
const std::map<std::string, std::string> &case_texts();

}  // namespace riis::program
