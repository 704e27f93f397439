// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Normal velocity of the acoustic skin, for other boundary element codes.
#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/h5_file.hpp"
#include "recover/spectrum/lines.hpp"

namespace clatter::recover {

/// The acoustic skin of a part, and how its triangles move per reduced velocity.
struct AcousticVelocity {
  RowMatrix nodes{};        // n_v x 3 [m]
  IndexMatrix triangles{};  // n_c x 3, flat, outward
  Eigen::MatrixXd
      per_reduced{};  // n_c x r: mean normal velocity of each triangle per reduced velocity
};

/// Means over the triangles of a velocity that is linear on each.
/// @param at_corners 3 n_c x r, row 3 c + b is corner b of triangle c
Eigen::MatrixXd triangle_means(const Eigen::MatrixXd& at_corners);

/// Reads what a sound file says of its acoustic skin; nothing of a file written before it said so.
/// @param size number of reduced coordinates
/// @throws InputError for shapes that do not fit or values that are not finite
std::optional<AcousticVelocity> read_acoustic_velocity(const std::filesystem::path& path, int size);

/// Writes `acoustic/` and `lines/acoustic_normal_velocity_re`, `_im`, one dataset a line (n_c
/// [m/s], peak), beside the lines of the body's own skin.
void write_acoustic_lines(H5File& file, const AcousticVelocity& acoustic,
                          const LineSpectrum& velocity, const std::vector<ChosenLine>& lines);

}  // namespace clatter::recover
