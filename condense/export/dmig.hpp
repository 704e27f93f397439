// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced parts as Nastran bulk data.
#include <filesystem>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// For "part.pch": a bulk data file for INCLUDE, with K2GG = KCLATTR and M2GG = MCLATTR in the case
/// control. GRIDs at the nodes of the DoF map with permanent constraints (PS) on the components
/// that no coordinate has, SPOINTs for coordinates along other directions and the modal ones, and
/// DMIG* of the lower triangles in double precision (type 2, form 6). A field of 16 columns holds
/// 10 to 12 digits of a negative or small number: relative errors are at most 5e-10.
/// Comments in the header list row, node and component. FileError when it cannot be written.
std::vector<std::filesystem::path> export_dmig(const rom::ReducedModel& model,
                                               const std::filesystem::path& path);

/// A number in a field of 16 columns, with a D exponent and as many digits as fit.
std::string nastran_number(double value);

}  // namespace clatter::condense
