// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced parts as CalculiX input.
#include <filesystem>
#include <vector>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// Frequency of the springs that hold rigid motions in the deck: CalculiX needs a K that it can
/// factorise.
inline constexpr double kRigidHoldHz = 1e-3;

/// part.inp, part.K.txt, part.M.txt for "part.inp".
std::vector<std::filesystem::path> calculix_files(const std::filesystem::path& path);

/// For "part.inp":
///
///   part.inp    the part as cards for CalculiX 2.20, for *INCLUDE or with a *STEP added.
///               Its modes K_rr Phi = M_rr Phi Lambda, Phi^T M_rr Phi = I, are nodes of unit mass
///               on springs Lambda to ground, and each boundary coordinate is an *EQUATION q_j =
///               Phi_j eta: exactly the pencil (K_rr, M_rr), with consistent mass, which *MASS
///               alone cannot represent. Springs of rigid motions have kRigidHoldHz.
///   part.K.txt, part.M.txt   lines "node,component,node,component,value", lower triangle, 17
///               digits: *MATRIX INPUT of Abaqus and *MATRIX ASSEMBLE of CalculiX after 2.20.
///
/// Displacements have the nodes and components of the DoF map. Rotations of a node about x, y, z
/// are components 1 to 3 of another node, as those of a ROT NODE; a modal coordinate, or one along
/// another direction, is component 1 of its own. The header of part.inp lists them. New nodes and
/// elements of a part from a deck have numbers after those of the deck. InputError when M_rr is not
/// positive definite; FileError when a file cannot be written.
void export_calculix(const ExportedPart& part, const std::filesystem::path& path);

}  // namespace clatter::condense
