// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A part in blocks whose matrices the ranks of an MPI program share.
#include <filesystem>

#include "condense/basis/dof_partition.hpp"
#include "core/ranks/ranks.hpp"
#include "core/rom/elimination_order.hpp"

namespace clatter::condense {

/// Reads the matrices of `path` in parts and partitions the model; each rank has the rows of its
/// part of the elimination order. InputError as partition_model and read_fe_model.
/// @param model without matrices, of the same file; must outlive the result.
/// @param order reused when it fits K_ii.
PartitionedModel share_part(const ranks::Ranks& all, const std::filesystem::path& path,
                            const fe::FeModel& model, const std::vector<std::string>& boundary,
                            const rom::EliminationOrder& order);

}  // namespace clatter::condense
