// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From an assembled model to a reduced one.
#include <string>
#include <vector>

#include "condense/basis/craig_bampton.hpp"
#include "condense/basis/modal_damping.hpp"
#include "condense/interface/interface_modes.hpp"
#include "core/base/config.hpp"
#include "core/base/json_line.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fe/fe_model.hpp"
#include "core/rom/damping_table.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// The `.rom.toml` with its defaults.
struct CondenseOptions {
  std::string method = "craig-bampton";      // or "craig-chang", "guyan"
  std::vector<std::string> boundary;         // set names; their order is that of the coordinates
  ModeRequest modes;                         // shapes of the interior
  bool certificate = true;                   // false: without its costly part (certificate.hpp)
  std::vector<std::string> skin = {"skin"};  // surfaces whose displacement can be recovered
  std::vector<std::string> rows;    // sets, besides the boundary, whose displacement is kept
  rom::EliminationOrder order;      // of K_ii, reused where it fits
  bool inertia_invariants = false;  // of a body that rotates, eq. (9)
  std::optional<InterfaceOptions> interface;  // second reduction, of the boundary
  std::vector<DampingRow> damping_rows;       // which give
  rom::DampingTable modal_damping;  // by eigenmodes of the body, in addition to alpha and beta
};

/// The keys of a rom.toml.
const keys::Keys<CondenseOptions>& condense_keys();

/// Reduces `model` by Guyan, Craig-Bampton (eq. 13, 14) or Craig-Chang and certifies the result.
/// Steps and their times go to `clock`. Throws InputError (boundary, surfaces) and NumericsError
/// (eigen-solver, count of modes, rigid motions or mass lost).
rom::ReducedModel condense(const fe::FeModel& model, const CondenseOptions& options,
                           StepClock& clock);

/// The same for a part in blocks, which a team may share: then rank 0 receives the complete model,
/// the others one without rows of the skin and of sets besides the boundary.
rom::ReducedModel condense(const PartitionedModel& part, const CondenseOptions& options,
                           StepClock& clock);

/// Lines for the user on the contents of the reduced model and what was verified.
std::vector<std::string> describe(const rom::ReducedModel& reduced);

/// For --json: method, boundary, size, valid_to_hz, count_proved, rigid_modes (null where they were
/// not counted), certified.
JsonMembers json_of(const rom::ReducedModel& reduced);

}  // namespace clatter::condense
