// SPDX-License-Identifier: GPL-3.0-or-later
// tri6. Membrane strains along each side are linear between three points, two Gauss points of the
// side and one inside, as in MITC6 (Lee and Bathe 2004). Bending is that of MITC7 (Bathe, Brezzi
// and Cho 1989): rotations have a bubble; shear strains are tied along the sides at their Gauss
// points, and by their means. Without the bubble a thin plate of coarse cells is too stiff.
#include <Eigen/LU>
#include <cmath>

#include "core/fe/shell_kinematics.hpp"

namespace clatter::fe {
namespace {

using Shear = Eigen::Matrix<double, 8, 1>;

const double kNear = 0.5 - 0.5 / std::sqrt(3.0), kFar = 1.0 - kNear, kAway = 1.0 / std::sqrt(3.0);

/// Points of the strains along r, along s, and along the third side.
const std::array<std::array<Eigen::Vector2d, 3>, 3> kPoints = {{
    {{{kNear, 0.0}, {kFar, 0.0}, {kNear, kAway}}},
    {{{0.0, kNear}, {0.0, kFar}, {kAway, kNear}}},
    {{{kFar, kNear}, {kNear, kFar}, {kNear, kNear}}},
}};

/// The functions of r and s that are 1 at one of three points.
Eigen::Vector3d through(const std::array<Eigen::Vector2d, 3>& points, const Eigen::Vector2d& at) {
  Eigen::Matrix3d values;
  for (int i = 0; i < 3; ++i) values.col(i) << 1.0, points[i](0), points[i](1);
  return values.inverse() * Eigen::Vector3d(1.0, at(0), at(1));
}

/// The space of the shear strains: linear ones, and two more whose component along each side is
/// linear on it.
std::array<Shear, 2> shear_functions(double r, double s) {
  std::array<Shear, 2> along;
  along[0] << 1.0, r, s, 0.0, 0.0, 0.0, s * r, s * s;
  along[1] << 0.0, 0.0, 0.0, 1.0, r, s, -r * r, -r * s;
  return along;
}

/// Where a component along a side is tied: its direction is `by_r` along r plus `by_s` along s.
struct Tie {
  double r, s, by_r, by_s;
};

const std::array<Tie, 6> kTies = {{{kNear, 0.0, 1.0, 0.0},
                                   {kFar, 0.0, 1.0, 0.0},
                                   {0.0, kNear, 0.0, 1.0},
                                   {0.0, kFar, 0.0, 1.0},
                                   {kFar, kNear, -1.0, 1.0},
                                   {kNear, kFar, -1.0, 1.0}}};

/// Coefficients of the functions by what is tied: the six, and the means along r and s.
const Eigen::Matrix<double, 8, 8>& by_ties() {
  static const Eigen::Matrix<double, 8, 8> inverse = [] {
    Eigen::Matrix<double, 8, 8> values;
    values.setZero();
    for (int t = 0; t < 6; ++t) {
      const Tie& tie = kTies[t];
      const auto along = shear_functions(tie.r, tie.s);
      values.row(t) = (tie.by_r * along[0] + tie.by_s * along[1]).transpose();
    }
    const mesh::FaceRule& rule = mesh::triangle_rule_6();
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const auto along = shear_functions(rule.points(q, 0), rule.points(q, 1));
      for (int i = 0; i < 2; ++i) values.row(6 + i) += rule.weights(q) * along[i].transpose();
    }
    return Eigen::Matrix<double, 8, 8>(values.inverse());
  }();
  return inverse;
}

}  // namespace

Triangle6Shell::Triangle6Shell(const MidSurface& mid)
    : ShellTheory(mid, Eigen::Vector2d::Constant(1.0 / 3.0), 2) {
  // Along the third side: half of rr - 2 rs + ss.
  const std::array<Eigen::RowVector3d, 3> along = {
      {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.5, 0.5, -1.0}}};
  for (size_t side = 0; side < 3; ++side) {
    sides_[side].resize(3, columns());
    for (int i = 0; i < 3; ++i)
      sides_[side].row(i) = along[side].lazyProduct(membrane(SurfacePoint(mid, kPoints[side][i])));
  }
  const auto sheared = [&](const SurfacePoint& p, int i) {
    ShellRow row = shear(p, i);
    add_bubble(i == 0 ? p.x_r : p.x_s, bubble(p.at), row);
    return row;
  };
  ShellRows<8> tied = ShellRows<8>::Zero(8, columns());
  for (int t = 0; t < 6; ++t) {
    const SurfacePoint p(mid, {kTies[t].r, kTies[t].s});
    tied.row(t) = kTies[t].by_r * sheared(p, 0) + kTies[t].by_s * sheared(p, 1);
  }
  for (Eigen::Index q = 0; q < rule().weights.size(); ++q) {
    const SurfacePoint p(mid, rule().points.row(q).transpose());
    for (int i = 0; i < 2; ++i) tied.row(6 + i) += rule().weights(q) * sheared(p, i);
  }
  shear_ = by_ties().lazyProduct(tied);
}

ShellStrain Triangle6Shell::strain(const SurfacePoint& p) const {
  std::array<ShellRow, 3> along;
  for (size_t side = 0; side < 3; ++side)
    along[side] = through(kPoints[side], p.at).transpose().lazyProduct(sides_[side]);
  ShellRows<3> in_plane(3, columns());
  in_plane << along[0], along[1], 0.5 * (along[0] + along[1]) - along[2];
  ShellRows<3> bent = curvature(p);
  add_bubble(p, bent);
  const auto functions = shear_functions(p.at(0), p.at(1));
  ShellRows<2> shear(2, columns());
  shear << functions[0].transpose().lazyProduct(shear_),
      functions[1].transpose().lazyProduct(shear_);
  return in_axes(p, in_plane, bent, shear);
}

}  // namespace clatter::fe
