// SPDX-License-Identifier: Apache-2.0
// The search for Python. study.py tries it in a 0D model of the heart, and tests/solvers/test_left_heart.py tries it with an
// invented model of the blood.
#include "volumeSearch.H"

extern "C" {
volumeSearch *search_new(double leastSlope, double largestSlope, double jump, double volume, double pressure,
                         int safeguards) {
  auto *search = new volumeSearch;
  search->leastSlope = leastSlope;
  search->largestSlope = search->slope = largestSlope;
  search->jump = jump;
  search->safeguards = safeguards != 0;
  search->drift = search->flow = 0;
  search->volume = volume;
  search->pressure = pressure;
  return search;
}
void search_delete(volumeSearch *search) { delete search; }
double search_begin(volumeSearch *search, double timeStep, double elastance, double unstressedVolume) {
  return search->begin(timeStep, elastance, unstressedVolume);
}
void search_measured(volumeSearch *search, double pressure) { search->measured(pressure); }
double search_next(volumeSearch *search) { return search->next(); }
double search_residual(const volumeSearch *search) { return search->residual(); }
double search_miss(const volumeSearch *search) { return search->miss(); }
double search_slope(const volumeSearch *search) { return search->slope; }
double search_echo(const volumeSearch *search) { return search->echo; }
}
