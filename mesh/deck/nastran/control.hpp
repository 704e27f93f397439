// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Executive and case control, before BEGIN BULK.
//
// Read: SOL, SUBCASE, SPC, MPC, LOAD, TEMPERATURE, METHOD, ANALYSIS, BGSET, K2GG, M2GG, PARAM.
// Requests for output, titles and other commands that do not change the model are passed over
// (kHarmless* in control.cpp); anything else is refused by name unless the user ignores it.
#include <cstdint>
#include <map>
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
  int32_t analysis = 0;  // ANALYSIS: 101 statics, 103 modes; 0: as SOL says
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
  int32_t glue = 0;                                // BGSET
  std::map<std::string, double> direct_stiffness;  // K2GG, K2PP: factors by name of DMIG
  std::map<std::string, double> direct_mass;       // M2GG, M2PP
  double direct_stiffness_factor = 1.0, direct_mass_factor = 1.0;     // PARAM, CK2 and CM2
  double mass_factor = 1.0;                                           // PARAM, WTMASS
  bool coupled_mass = false;                                          // PARAM, COUPMASS
  double mass_damping = 0.0, stiffness_damping = 0.0;                 // PARAM, ALPHA1 and ALPHA2
  double loss_factor = 0.0;                                           // PARAM, G
  bool inertia_relief = false;                                        // PARAM, INREL
  std::vector<Origin> preloads, combinations, material_temperatures;  // of such commands
  std::vector<Subcase> subcases;                                      // one at least when has_cases
};

/// Reads up to and including BEGIN BULK; reads nothing when the deck begins with bulk data.
Control read_control(Source& source, Ignore& ignore, Refusals& refusals);

/// Applies a PARAM; false for those that change neither stiffness nor mass.
bool read_parameter(Control& control, std::string_view name, std::string_view value,
                    const Source& source, Origin origin);

/// All commands that are not refused, by their full names.
std::vector<Listed> listed_commands();

}  // namespace clatter::mesh::deck::nastran
