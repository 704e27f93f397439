// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/acoustic_velocity.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "recover/field/field_file.hpp"
#include "recover/field/field_values.hpp"

namespace clatter::recover {
namespace {

constexpr const char* kPerReduced = "skin/normal_velocity";
constexpr const char* kLines = "lines/acoustic_normal_velocity_";

void require_columns(const H5File& file, const std::string& name, int64_t rows, int64_t columns) {
  const std::vector<int64_t> shape = file.shape(name);
  if (shape.size() != 2 || shape[1] != columns || (rows >= 0 && shape[0] != rows))
    throw InputError(fmt::format("{}: {}: found shape ({}), expected ({}, {})",
                                 file.path().string(), name, fmt::join(shape, ", "),
                                 rows >= 0 ? std::to_string(rows) : "rows", columns));
}

}  // namespace

Eigen::MatrixXd triangle_means(const Eigen::MatrixXd& at_corners) {
  Eigen::MatrixXd means(at_corners.rows() / 3, at_corners.cols());
  for (Eigen::Index c = 0; c < means.rows(); ++c)
    means.row(c) = at_corners.middleRows(3 * c, 3).colwise().mean();
  return means;
}

std::optional<AcousticVelocity> read_acoustic_velocity(const std::filesystem::path& path,
                                                       int size) {
  const H5File file = H5File::open(path);
  if (!file.has(kPerReduced)) return std::nullopt;
  require_columns(file, "skin/nodes", -1, 3);
  require_columns(file, "skin/triangles", -1, 3);
  AcousticVelocity found{.nodes = file.read_rows("skin/nodes"),
                         .triangles = file.read_index_matrix("skin/triangles")};
  require_columns(file, kPerReduced, found.triangles.rows(), size);
  found.per_reduced = file.read_matrix(kPerReduced);
  const auto n_v = static_cast<int32_t>(found.nodes.rows());
  if (found.triangles.size() > 0 &&
      (found.triangles.minCoeff() < 0 || found.triangles.maxCoeff() >= n_v))
    throw InputError(
        fmt::format("{}: skin/triangles: found nodes outside of 0 to {}", path.string(), n_v - 1));
  if (!found.nodes.allFinite() || !found.per_reduced.allFinite())
    throw InputError(fmt::format("{}: {}: found NaN or infinity, expected finite values",
                                 path.string(), kPerReduced));
  return found;
}

void write_acoustic_lines(H5File& file, const AcousticVelocity& acoustic,
                          const LineSpectrum& velocity, const std::vector<ChosenLine>& lines) {
  if (lines.empty()) return;
  put(file, "acoustic/nodes", acoustic.nodes, "m", "of the acoustic skin, which is closed");
  put(file, "acoustic/triangles", acoustic.triangles, "1", "flat, outward");
  for (size_t k = 0; k < lines.size(); ++k) {
    const Eigen::VectorXcd v =
        acoustic.per_reduced * velocity.amplitude.row(lines[k].index).transpose();
    file.write(fmt::format("{}re/{}", kLines, member_name(k)), Eigen::VectorXd(v.real()));
    file.write(fmt::format("{}im/{}", kLines, member_name(k)), Eigen::VectorXd(v.imag()));
  }
  for (const char* part : {"re", "im"}) {
    file.set(std::string(kLines) + part, "unit", "m/s");
    file.set(std::string(kLines) + part, "meaning",
             "one dataset a line: mean outward normal velocity of each triangle of the acoustic "
             "skin, peak");
  }
}

}  // namespace clatter::recover
