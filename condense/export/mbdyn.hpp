// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced parts as input of MBDyn's modal joint.
#include <filesystem>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// For "part.fem" (MBDyn input manual, "FEM file format", record groups 1 to 10, 12 and 13): nodes
/// at the positions of the boundary coordinates, the elastic modes K_rr Phi = M_rr Phi Lambda with
/// unit modal masses, their damping alpha Lambda + beta I with
/// the table of modal damping added, and the mass properties. Rigid motions
/// are left out, as the joint's own node makes them. A coordinate along direction d moves its node
/// by d times its value; directions without a coordinate are zero. Comments in the header list row,
/// node and direction of the coordinates. 17 digits. InputError when M_rr is not positive definite
/// or no boundary coordinate has a position; FileError when the file cannot be written.
void export_mbdyn(const ExportedPart& part, const std::filesystem::path& path);

}  // namespace clatter::condense
