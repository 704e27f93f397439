// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/spectrum/piece_samples.hpp"

#include <cmath>

#include "recover/run/resample.hpp"

namespace clatter::recover {

std::optional<RowMatrix> piece_samples(const RunBody& body, const Piece& piece,
                                       const std::string& quantity, int64_t offset, int64_t count) {
  const RunClock& clock = body.clock();
  const int64_t n_t = clock.time.size();
  if (piece.domain == Domain::kTime) {
    const int64_t first = piece.first + offset;
    if (first < 0 || first + count > n_t) return std::nullopt;
    return body.samples(quantity, first, count);
  }
  const double from_deg = piece.first_deg + static_cast<double>(offset) * piece.step_deg;
  const double to_deg = from_deg + static_cast<double>(count - 1) * piece.step_deg;
  constexpr double kSlack = 1e-9;  // of a step: the piece may begin exactly at a sample
  if (n_t < 2 * kHalfWidth + 2 || from_deg < clock.angle_deg[kHalfWidth] - kSlack ||
      to_deg > clock.angle_deg[n_t - 1 - kHalfWidth] + kSlack)
    return std::nullopt;
  const Eigen::VectorXd at = positions(clock, piece, offset, count);
  const int64_t first = static_cast<int64_t>(std::floor(at[0])) - kHalfWidth;
  const int64_t last = static_cast<int64_t>(std::floor(at[count - 1])) + kHalfWidth + 1;
  const int64_t begin = std::max<int64_t>(first, 0), end = std::min<int64_t>(last + 1, n_t);
  return resample(body.samples(quantity, begin, end - begin),
                  at.array() - static_cast<double>(begin));
}

RowMatrix piece_samples(const RunBody& body, const Piece& piece, const std::string& quantity) {
  return piece_samples(body, piece, quantity, 0, piece.count).value();
}

}  // namespace clatter::recover
