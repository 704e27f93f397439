#pragma once
// The modes of a part as a file, schema "clatter/modes/2":
//   frequency_hz, eigenvalue [rad2/s2], residual, rounding (m); shapes (m x n x 3, single
//   precision, unit modal mass [1/sqrt(kg)]), nodes (n x 3 [m]), surfaces/<name>/<face type>;
//   attributes name, source, rigid_modes; certificate with the count that was proved.
#include <filesystem>
#include <string>

#include "core/modes/analysis.hpp"

namespace clatter::modal {

inline constexpr const char* kModesSchema = "clatter/modes/2";

/// Writes into an open file; provenance and timing are the caller's.
void write_modes(H5File& file, const modes::PartModes& part);

/// What a reader of frequencies needs.
struct ModeTable {
  std::string name;
  int rigid = 0;
  Eigen::VectorXd frequency_hz;
  Eigen::VectorXd residual;
};

/// Reads and checks the table; InputError for another schema or values that make no sense.
ModeTable read_mode_table(const std::filesystem::path& path);

}  // namespace clatter::modal
