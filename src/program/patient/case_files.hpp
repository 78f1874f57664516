// SPDX-License-Identifier: Apache-2.0
// The writers of cases share these parts: checks of a SolverCase, the solver's folder, and the replacement of names such as
// @NAME@ in texts. The file also has the physiological defaults of one beat.
#pragma once

#include <cmath>
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
// A case must have one inlet, one wall, at least one outlet, and lengths in this unit. Refuses other cases.
Ends ends_of(const SolverCase &solver, Unit unit);

// Makes the solver's folder. Refuses a folder that already contains a case.
void make_case_folder(const SolverCase &solver);
// Copies a file from the case's folder into the solver's folder. The new name may contain folders.
void copy_into(const SolverCase &solver, const std::string &from, const std::string &to);
// Writes a text to a file in the solver's folder.
void write_into(const SolverCase &solver, const std::string &name, const std::string &text);
void make_runnable(const SolverCase &solver, const std::string &name);
// Writes beat_table.py, report.py, and the script `run`, which runs the case. `of` is the folder that holds the scripts in
// case_texts.
void write_scripts(const SolverCase &solver, const std::string &of, const std::string &run);
// Writes orifice.json, from which beat_table.py takes the areas of the open valve.
void write_orifice(const SolverCase &solver);

// A solver's time step, and its processor time per cell and step. The times were measured: docs/patient_openfoam.md,
// docs/patient_svmultiphysics.md, "What it costs", and docs/patient_fenicsx.md, "What was run".
struct SolverCost {
  const char *program;
  double step, seconds;
};
inline constexpr SolverCost openfoam_cost{"OpenFOAM", 1e-3, 5e-6}, svmultiphysics_cost{"svMultiPhysics", 0.002, 7e-5},
    dolfinx_cost{"dolfinx", 0.002, 4e-5};
// Returns words for the processor time of a beat, such as "3 minutes".
std::string time_of_beat(const SolverCost &cost, double n_cells, double period);
// Prints how long a beat takes.
void announce_beat(const SolverCase &solver, const SolverCost &cost);

// Replaces each @NAME@ by the text that belongs to the name. Every name in the text must be in the list of names.
std::string filled(std::string text, const std::map<std::string, std::string> &names);

// Returns the texts of beat_table.py, of the files in the folders fenicsx, openfoam and svmultiphysics, and of uris_flow.py. A
// key is a path relative to the folder of this header, such as "openfoam/Allrun". CMake writes these texts into the program, so
// the program needs no path to the files.
const std::map<std::string, std::string> &case_texts();

// The physiological defaults of one beat, in SI units: the pressures in a heart at rest, and the body behind the aorta.

inline constexpr double mmHg = 133.322;      // Pa
inline constexpr double usual_period = 0.8;  // s
// The time between two files. The duration of a beat is a multiple of this time, so that a file is written at the end of a run.
inline constexpr double seconds_between_files = 0.02;
inline constexpr double motion_seconds = 0.04;  // in which a valve opens, and in which it closes
// The dwell time of the law of opening. Closing leaflets push blood back, and the pressure of this blood must not open the valve
// again. Each motion of the leaflets therefore ends before the next motion may begin, as in svMultiPhysics.
inline constexpr double dwell_seconds = motion_seconds;
// The opening pressure in Pa. It is larger than the rounding error of the difference between two equal pressures.
inline constexpr double opening_pressure = 50;
// A mitral valve closes when the flow falls below this value, in m3/s, so that less blood returns.
inline constexpr double closing_flow_of_mitral = 1e-4;

// Returns the length of the systole in a beat of the given period, divided by the length of the systole in a usual beat. At N
// beats a minute, the time from the Q wave to the second heart sound is 546 ms - 2.1 ms N (A. M. Weissler et al., Circulation 37,
// 1968, 149-159, for men).
inline double systole_at(double period) {
  const auto seconds = [](double duration) { return 0.546 - 2.1e-3 * 60 / duration; };
  return seconds(period) / seconds(usual_period);
}

// A pressure as a function of time, which is linear between its keys. The function repeats, and the time of its last key is its
// period.
struct PressureCurve {
  struct Key {
    double time, pressure;  // s, mmHg
  };
  std::vector<Key> keys;

  // Returns the curve of a beat of another duration. The beat consists of a systole and a diastole, which meet at the time
  // `middle`. systole_at changes the length of the systole, and the diastole takes the rest of the beat.
  PressureCurve lasting(double period, double middle, bool is_systole_first) const {
    if (period == usual_period) return *this;
    const double rest = usual_period - middle, factor = systole_at(period);
    const double new_middle = is_systole_first ? factor * middle : period - factor * rest;
    PressureCurve made = *this;
    for (Key &key : made.keys) {
      const double time = key.time <= middle ? key.time * new_middle / middle
                                             : new_middle + (key.time - middle) * (period - new_middle) / rest;
      key.time = std::round(1e4 * time) / 1e4;
    }
    return made;
  }

  double at(double time) const {  // in Pa, from 0 to the period
    std::size_t i = 1;
    while (i + 1 < keys.size() && keys[i].time < time) ++i;
    const Key &a = keys[i - 1], &b = keys[i];
    return mmHg * (a.pressure + (b.pressure - a.pressure) * (time - a.time) / (b.time - a.time));
  }
};

// The pressure of the ventricle in a beat that begins at the end of diastole. This pressure drives an aortic valve.
inline PressureCurve pressure_of_left_ventricle(double period) {
  const PressureCurve curve{
      {{0, 8}, {0.04, 8}, {0.09, 78}, {0.14, 108}, {0.2, 120}, {0.27, 112}, {0.32, 95}, {0.38, 8}, {0.8, 8}}};
  return curve.lasting(period, 0.38, true);
}
// The pressure of the ventricle in a beat that begins before the ventricle is filled. Blood from the atrium fills the ventricle
// through a mitral valve.
inline PressureCurve pressure_of_filling_ventricle(double period) {
  const PressureCurve curve{{{0, 12}, {0.03, 12}, {0.08, 4}, {0.4, 4}, {0.5, 100}, {0.76, 100}, {0.8, 12}}};
  return curve.lasting(period, 0.4, false);
}
inline constexpr double pressure_of_left_atrium = 10 * mmHg;

// The body behind the aorta: a Windkessel with three elements.
struct Windkessel {
  double proximal_resistance = 6.67e6, distal_resistance = 1.9e8;  // Pa s/m3
  double compliance = 1.05e-8;                                     // m3/Pa
  double distal_pressure = 0, initial_pressure = 80 * mmHg;        // Pa
};

}  // namespace riis::program
