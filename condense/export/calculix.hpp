// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced parts as CalculiX input.
#include <filesystem>
#include <vector>

#include "core/rom/reduced_model.hpp"

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
/// Nodes and components are those of the DoF map with displacements only: rotations and modal
/// coordinates are component 1 of a node of their own. The header of part.inp lists them.
/// InputError when M_rr is not positive definite; FileError when a file cannot be written.
std::vector<std::filesystem::path> export_calculix(const rom::ReducedModel& model,
                                                   const std::filesystem::path& path);

}  // namespace clatter::condense
