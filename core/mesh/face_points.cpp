// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/face_points.hpp"

#include "core/mesh/cell.hpp"

namespace clatter::mesh {

FaceRule divided_face_rule(FaceType type, int n) {
  const FaceRule& rule = face_rule(type);
  const bool triangle = traits(type).corners == 3;
  const double edge = triangle ? 1.0 : 2.0, first = triangle ? 0.0 : -1.0;  // of the reference face
  const Eigen::Index m = rule.weights.size();
  FaceRule all{decltype(rule.points)(m * n * n, 2), Eigen::VectorXd(m * n * n)};
  Eigen::Index at = 0;
  const auto add = [&](const Eigen::RowVector2d& corner, double scale) {
    all.points.middleRows(at, m) =
        (scale * (rule.points.array() - first)).matrix().rowwise() + corner;
    all.weights.segment(at, m) = rule.weights * scale * scale;
    at += m;
  };
  const double step = edge / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < (triangle ? n - i : n); ++j) {
      add({first + i * step, first + j * step}, 1.0 / n);
      // The triangle that stands on its head shares the opposite edge.
      if (triangle && j + 1 < n - i) add({(i + 1) * step, (j + 1) * step}, -1.0 / n);
    }
  return all;
}

}  // namespace clatter::mesh
