// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Table [matrices] of a fe.toml: matrices of another program, instead of all other tables.
#include <filesystem>
#include <string>

#include "core/keys/keys.hpp"

namespace clatter::assembly {

/// The files, and what their numbers mean.
struct MatrixFiles {
  std::filesystem::path K, M;      // Matrix Market or "i j value" (core/base/matrix_text.hpp)
  std::filesystem::path dofs;      // DoF map (core/rom/dof_map.hpp); empty: the nodes of the mesh
  std::string name;                // of the part; empty: the mesh's
  UnitSystem units;                // of K and M; positions of a map or mesh are in m
  double alpha = 0.0, beta = 0.0;  // D = alpha K + beta M [s], [1/s]
};

const keys::Keys<MatrixFiles>& matrix_files_keys();

}  // namespace clatter::assembly
