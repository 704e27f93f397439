// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The modes file of a part, schema "clatter/modes/2":
//   frequency_hz, eigenvalue [rad2/s2], residual, rounding (m); shapes (m x n x 3, single
//   precision, unit modal mass [1/sqrt(kg)]), nodes (n x 3 [m]), surfaces/<name>/<face type>;
//   attributes name, source, rigid_modes; certificate with the proved count.
#include <filesystem>
#include <string>

#include "core/modes/analysis.hpp"

namespace clatter::modal {

inline constexpr const char* kModesSchema = "clatter/modes/2";

/// Writes into an open file; provenance and timing are left to the caller.
void write_modes(H5File& file, const modes::PartModes& part);

/// Frequencies of a modes file.
struct ModeTable {
  std::string name;
  int rigid = 0;
  Eigen::VectorXd frequency_hz;
  Eigen::VectorXd residual;
};

/// Reads and checks the table; InputError for another schema or invalid values.
ModeTable read_mode_table(const std::filesystem::path& path);

}  // namespace clatter::modal
