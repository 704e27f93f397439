// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced parts as arrays of Exudyn's ObjectFFRFreducedOrderInterface.
#include <filesystem>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// For "part.npy": the file that ObjectFFRFreducedOrderInterface.LoadFromFile reads (version 1 of
/// its SaveToFile: NumPy arrays one after the other). Its mesh nodes are those of the boundary
/// coordinates by number, then those of the skin with its triangles; its modes are the elastic ones
/// with unit modal masses, in the part's own frame. Matrices as in Zwoelfer and Gerstmayr 2021,
/// psi_j the modes, tilde(a) b = a x b:
///
///   mPsiTildePsi       3 m x m   rows 3 j: integral of rho tilde(psi_j)^T psi_k
///   mPsiTildePsiTilde  3 m x 3 m           of rho tilde(psi_j)^T tilde(psi_k)
///   mPhitTPsi          3 x m               of rho psi_k;       mPhitTPsiTilde    3 x 3 m  its
///   tilde mXRefTildePsi      3 x m               of rho tilde(x)^T psi_k mXRefTildePsiTilde 3 x 3
///   m             of rho tilde(x)^T tilde(psi_k)
///
/// The file has no damping: AddObjectFFRFreducedOrder... takes alpha and beta. InputError without
/// inertia invariants; FileError when it cannot be written.
void export_exudyn(const ExportedPart& part, const std::filesystem::path& path);

}  // namespace clatter::condense
