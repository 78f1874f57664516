// SPDX-License-Identifier: Apache-2.0
// Fuzzes the program's JSON files. Each input is read in three ways: as a valve from patches, as parameters of four kinds of
// valves, and as the opening of a valve in a case. The input is refused with an exit status and a message, or gives a valve or a
// law. If a valve's parameters are printed and read again, they must be unchanged.
#include <cstddef>
#include <cstdint>
#include <functional>

#include "input.hpp"
#include "program/base/refusal.hpp"
#include "program/input/case.hpp"
#include "program/input/json.hpp"
#include "program/input/parameters.hpp"
#include "program/input/valve_source.hpp"

namespace {

using riis::Valve;

const fuzz::ScratchFile &file() {
  static const fuzz::ScratchFile scratch("input.json");
  return scratch;
}

// Returns whether the file was accepted.
bool is_taken(const std::function<void()> &read) {
  try {
    read();
    return true;
  } catch (const riis::program::Refusal &refusal) {
    EXPECT(refusal.exit_code == riis::program::exit_bad_data || refusal.exit_code == riis::program::exit_wrong_usage,
           "exit code %d", refusal.exit_code);
    EXPECT(refusal.text.size() > file().path().size() && refusal.text.size() < 2000, "the text '%s'",
           refusal.text.c_str());
    return false;
  }
}

Valve made(const char *kind) {
  riis_valve *valve = nullptr;
  EXPECT(riis_valve_create(kind, &valve) == RIIS_OK, "%s", riis_last_error());
  return Valve(valve);
}

void read_parameters(const char *kind) {
  const Valve valve = made(kind), twin = made(kind);
  if (!is_taken([&] { riis::program::set_from_json_file(valve.get(), file().path()); })) return;
  const std::string printed = riis::program::json_template(valve.get());
  file().hold(reinterpret_cast<const std::uint8_t *>(printed.data()), printed.size());
  EXPECT(is_taken([&] { riis::program::set_from_json_file(twin.get(), file().path()); }),
         "printed parameters are refused");
  EXPECT(riis::program::json_template(twin.get()) == printed, "printed parameters read back as others");
}

void read_valve() {
  is_taken([] {
    riis::program::NewValve fresh(file().path(), "");
    EXPECT(riis_valve_set_scalar(fresh, "opening", 0.5) == RIIS_OK, "%s", riis_last_error());
    const Valve valve = fresh.take();
    double opening = -1;
    EXPECT(riis_valve_get(valve.get(), "opening", 1, &opening) == RIIS_OK && opening == 0.5, "opening %g", opening);
  });
}

void read_opening() {
  is_taken([] {
    const riis::program::Json root = riis::program::parse_json_file(file().path(), "a case");
    const riis::program::CaseValues values(file().path(), "valve 0", root, {"opening"});
    // No input may name a file of this machine.
    const riis::program::CaseOpening found =
        riis::program::case_opening(values, [](const std::string &) { return file().path() + ".none"; });
    for (const double time : {-1.0, 0.0, 0.37, 1e9}) {
      const double opening = found.law.at(time);
      EXPECT(opening >= 0 && opening <= 1, "opening %g at %g", opening, time);
    }
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size) {
  file().hold(bytes, size);
  read_valve();
  read_opening();
  for (const char *kind : {"aortic", "mitral", "trileaflet", "coapting"}) {
    file().hold(bytes, size);
    read_parameters(kind);
  }
  return 0;
}
