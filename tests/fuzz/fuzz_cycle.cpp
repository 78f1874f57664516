// SPDX-License-Identifier: Apache-2.0
// Fuzzes the program's tables of times and openings. An input is refused with an exit status and a message, or its times and
// openings make a law. The opening of this law is from 0 to 1 at every time.
#include <cstddef>
#include <cstdint>

#include "input.hpp"
#include "program/base/refusal.hpp"
#include "program/input/opening_law.hpp"

namespace {

const fuzz::ScratchFile &file() {
  static const fuzz::ScratchFile scratch("input.csv");
  return scratch;
}

void check_law(riis::program::OpeningTable table, double period, std::int32_t interpolation) {
  table.period = period;
  table.interpolation = interpolation;
  const riis::program::OpeningLaw law(table, file().path());
  for (const double time : {table.times.front(), table.times.back(), -1.0, 0.0, 0.37, 1e9}) {
    const double opening = law.at(time);
    EXPECT(opening >= 0 && opening <= 1, "opening %g at %g", opening, time);
  }
}

void read(double period, std::int32_t interpolation) {
  try {
    const riis::program::OpeningTable table = riis::program::read_cycle(file().path());
    EXPECT(!table.times.empty() && table.times.size() == table.openings.size(), "%zu times", table.times.size());
    check_law(table, period, interpolation);
  } catch (const riis::program::Refusal &refusal) {
    EXPECT(refusal.exit_code == riis::program::exit_bad_data, "exit code %d", refusal.exit_code);
    EXPECT(refusal.text.size() > file().path().size() && refusal.text.size() < 2000, "the text '%s'",
           refusal.text.c_str());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size) {
  file().hold(bytes, size);
  for (const std::int32_t interpolation : {RIIS_INTERPOLATION_LINEAR, RIIS_INTERPOLATION_CUBIC}) {
    for (const double period : {0.0, 0.8, 1e6}) read(period, interpolation);
  }
  return 0;
}
