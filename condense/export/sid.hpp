// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced parts as standard input data of flexible bodies (SID).
#include <filesystem>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// For "part.SID_FEM" (Wallrapp 1994; quantities as in table 6.9 of Schwertassek and Wallrapp
/// 1999): the elastic modes in the part's own frame as elastic coordinates, with unit modal masses.
/// Taylor expansions in them, m0 + sum_k m1_k q_k, of the integrals over the mass, with deformed
/// positions x + sum_k phi_k q_k:
///
///   mdCM  mass times centre           Ct  of phi_i            Cr  of (x + u) x phi_i
///   J     of inertia about the frame  Me  unit matrix         Gr, Ge  gyroscopic, Gr order 0
///   Oe    centrifugal, of (w1 w1, w2 w2, w3 w3, w1 w2, w2 w3, w1 w3)
///   Ke, De  diagonal                  ksigma  0: no prestress, no geometric stiffening
///
/// and position, phi, psi, orientation of each node. InputError without inertia invariants;
/// FileError when it cannot be written.
void export_sid(const ExportedPart& part, const std::filesystem::path& path);

}  // namespace clatter::condense
