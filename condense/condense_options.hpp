// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The request of a reduction.
#include <optional>
#include <string>
#include <vector>

#include "condense/basis/modal_damping.hpp"
#include "condense/basis/mode_request.hpp"
#include "condense/interface/interface_modes.hpp"
#include "core/keys/keys.hpp"
#include "core/rom/damping_table.hpp"
#include "core/rom/elimination_order.hpp"

namespace clatter::condense {

/// The `.rom.toml` with its defaults.
struct CondenseOptions {
  std::string method = "craig-bampton";      // or "craig-chang", "guyan"
  std::vector<std::string> boundary;         // set names; their order is that of the coordinates
  ModeRequest modes;                         // shapes of the interior
  bool certificate = true;                   // false: without its costly part (certificate.hpp)
  std::optional<double> verify_hz;           // the full model's modes are compared up to it
  std::vector<std::string> skin = {"skin"};  // surfaces whose displacement can be recovered
  std::vector<std::string> rows;    // sets, besides the boundary, whose displacement is kept
  rom::EliminationOrder order;      // of K_ii, reused where it fits
  bool inertia_invariants = false;  // of a body that rotates, eq. (9)
  bool joined_error = false;        // whether ReducedModel::truncation is computed
  std::optional<InterfaceOptions> interface;  // second reduction, of the boundary
  std::vector<DampingRow> damping_rows;       // which give
  rom::DampingTable modal_damping;  // by eigenmodes of the body, in addition to alpha and beta
};

/// The keys of a rom.toml.
const keys::Keys<CondenseOptions>& condense_keys();

}  // namespace clatter::condense
