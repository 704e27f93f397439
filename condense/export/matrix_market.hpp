// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced matrices in Matrix Market files (Boisvert, Pozo, Remington 1996).
#include <filesystem>
#include <vector>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// part.K.mtx, part.M.mtx, part.dofs.tsv for "part.mtx".
std::vector<std::filesystem::path> matrix_market_files(const std::filesystem::path& path);

/// For "part.mtx": part.K.mtx and part.M.mtx (coordinate real symmetric, 17 digits, so that values
/// are read back exactly) and part.dofs.tsv, the DoF map (core/rom/dof_map.hpp). Damping is in the
/// header of K. FileError when one cannot be written.
void export_matrix_market(const ExportedPart& part, const std::filesystem::path& path);

}  // namespace clatter::condense
