// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced models as text files of other programs.
#include <filesystem>
#include <vector>

#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// The files that export_reduced() writes for `path`; InputError for another extension.
std::vector<std::filesystem::path> exported_files(const std::filesystem::path& path);

/// Writes `model` in the format that the extension of `path` names; returns the files written.
///   part.mtx  part.K.mtx, part.M.mtx (Matrix Market) and part.dofs.tsv (DoF map)
///   part.inp  CalculiX (calculix.hpp), part.K.txt, part.M.txt
///   part.pch  Nastran bulk data with DMIG (dmig.hpp)
///   part.fem  MBDyn's modal joint (mbdyn.hpp)
/// InputError for another extension, FileError when a file cannot be written.
std::vector<std::filesystem::path> export_reduced(const rom::ReducedModel& model,
                                                  const std::filesystem::path& path);

}  // namespace clatter::condense
