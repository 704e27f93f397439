// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Partition of a model's DoFs into boundary (retained) and interior ones.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/fe/fe_model.hpp"
#include "core/fe/free_motions.hpp"

namespace clatter::condense {

/// Boundary DoFs b in the order of the reduced coordinates; interior DoFs i ascending, in a
/// team those of this process in the order of its rows.
struct DofPartition {
  std::vector<int32_t> boundary;            // n_b indices into the model
  std::vector<int32_t> interior;            // n_i indices into the model
  std::map<std::string, rom::DofSet> sets;  // the boundary sets; `dofs` index the reduced model
  std::map<std::string, rom::ContactGrid> grids;  // of those sets that are contact grids
  std::vector<std::string> repeated;              // labels of DoFs that were already retained
};

/// Boundary = the DoFs of the named sets, set by set. A DoF in several sets gets one shared
/// coordinate (hard case B3). InputError for an unknown or empty set, or when no interior DoF is
/// left.
DofPartition partition_dofs(const fe::FeModel& model, const std::vector<std::string>& set_names);

/// InputError for a boundary that leaves one of the free motions possible, naming the motion.
void check_boundary_holds(const fe::FeModel& model, const DofPartition& partition,
                          const fe::FreeMotions& free);

}  // namespace clatter::condense
