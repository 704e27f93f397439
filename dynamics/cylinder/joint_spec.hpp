// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [small_end] and [big_end]: the joints of the rod.
#include <filesystem>
#include <optional>
#include <vector>

#include "core/keys/table.hpp"
#include "dynamics/bearing/bearing_film.hpp"
#include "dynamics/law/joint_laws.hpp"
#include "dynamics/law/radial_table.hpp"

namespace clatter::dynamics {

/// An oil film as the joint.
struct JournalSpec {
  BearingModel model = BearingModel::kMoes;
  BearingSize size;
};

/// What holds pin and rod, or rod and crank pin, together.
struct JointSpec {
  RadialForce law = RadialLaw{};             // without a film
  std::optional<PinFriction> friction;       // dry; none: without friction
  std::optional<JournalSpec> film;           // instead of law and friction
  std::vector<std::filesystem::path> files;  // of its tables
};

/// Reads the table `key`; the default joint without it, as by an empty one. InputError "file:line:
/// key: ...".
JointSpec read_joint(const Config& tables, std::string_view key);
/// Its keys.
const keys::Table& joint_table();

}  // namespace clatter::dynamics
