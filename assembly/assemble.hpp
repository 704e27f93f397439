// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From the files of a part to its checked FE model.
#include <filesystem>
#include <string>
#include <vector>

#include "assembly/model/build.hpp"
#include "core/base/artefact.hpp"
#include "core/base/json_line.hpp"
#include "core/base/stopwatch.hpp"

namespace clatter::assembly {

/// A model and its origin.
struct AssembledPart {
  BuiltModel built;
  Provenance provenance;
};

/// Assembles on a mesh as the part.fe.toml `config_path` says, or imports the matrices of other
/// programs that it names ([matrices]); `mesh_path` is empty where these have a DoF map. Warns
/// about materials and sizes that suggest a wrong unit. InputError for an invalid file; other
/// errors as of build_fe_model() and import_matrices().
AssembledPart assemble(const std::filesystem::path& mesh_path,
                       const std::filesystem::path& config_path, StepClock& clock);

/// Summary lines for the user: size, mass properties.
std::vector<std::string> describe(const fe::FeModel& model);

/// For --json: name, dofs, nonzeros_K, mass_kg.
JsonMembers json_of(const fe::FeModel& model);

}  // namespace clatter::assembly
