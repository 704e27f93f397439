#pragma once
// What stands before BEGIN BULK: executive and case control.
//
// Read: SOL, SUBCASE, SPC, MPC, LOAD, TEMPERATURE, METHOD, PARAM. Requests for output, titles and
// other commands that change no model pass without a word (harmless_* in nastran_control.cpp);
// anything else is refused by name unless the user ignores it.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesh/deck/nastran/source.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::nastran {

/// Sets that a subcase chooses; 0: none.
struct Choice {
  int32_t spc = 0, mpc = 0, load = 0, temperature = 0, method = 0;
};

struct Subcase {
  int32_t id = 1;
  Origin origin = 0;
  Choice choice;
};

/// The names that the user lets go, in capitals, with how often each came.
class Ignored {
 public:
  explicit Ignored(const std::vector<std::string>& names);
  /// True, and counted, when `name` (capitals) is one of them.
  bool skip(std::string_view name);
  bool lists(std::string_view name) const { return counts_.find(name) != counts_.end(); }
  /// Those that came.
  std::map<std::string, int64_t> counts() const;

 private:
  std::map<std::string, int64_t, std::less<>> counts_;
};

struct Control {
  bool has_cases = false;  // there is a case control: it alone chooses sets
  int32_t solution = 0;    // SOL; 0: not said
  int32_t initial_temperature = 0;
  double mass_factor = 1.0;       // PARAM, WTMASS
  std::vector<Subcase> subcases;  // one at least when has_cases
};

/// Reads up to and with BEGIN BULK; reads nothing when the deck begins with bulk data.
Control read_control(Source& source, Ignored& ignored, Refusals& refusals);

/// What a PARAM of that name and value means; others than WTMASS are harmless.
void read_parameter(Control& control, std::string_view name, std::string_view value,
                    const Source& source, Origin origin);

}  // namespace clatter::mesh::deck::nastran
