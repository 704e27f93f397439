// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Executive and case control, before BEGIN BULK.
//
// Read: SOL, SUBCASE, SPC, MPC, LOAD, TEMPERATURE, METHOD, PARAM. Requests for output, titles and
// other commands that do not change the model are skipped silently (harmless_* in control.cpp);
// anything else is refused by name unless the user ignores it.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/deck/ignore.hpp"
#include "mesh/deck/nastran/source.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::nastran {

/// Sets that a subcase selects; 0: none.
struct Choice {
  int32_t spc = 0, mpc = 0, load = 0, temperature = 0, method = 0;
};

struct Subcase {
  int32_t id = 1;
  Origin origin = 0;
  Choice choice;
};

struct Control {
  bool has_cases = false;  // there is a case control: it alone selects sets
  int32_t solution = 0;    // SOL; 0: not given
  int32_t initial_temperature = 0;
  double mass_factor = 1.0;       // PARAM, WTMASS
  std::vector<Subcase> subcases;  // one at least when has_cases
};

/// Reads up to and including BEGIN BULK; reads nothing when the deck begins with bulk data.
Control read_control(Source& source, Ignore& ignore, Refusals& refusals);

/// Applies a PARAM; false for parameters other than WTMASS, which are passed over.
bool read_parameter(Control& control, std::string_view name, std::string_view value,
                    const Source& source, Origin origin);

/// All commands that are not refused, by their full names.
std::vector<Listed> listed_commands();

}  // namespace clatter::mesh::deck::nastran
