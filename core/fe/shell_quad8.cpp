// SPDX-License-Identifier: GPL-3.0-or-later
// quad8, MITC9: of the eight nodes and the centre. A strain along r varies as the motion's gradient
// does, linearly along r and quadratically across, once it is tied at the points where a bent cell
// has none that is not its own: two Gauss points along r, three across; likewise along s. The shear
// strain in the plane is tied at 2 x 2 points (Bucalem and Bathe 1993). Where opposite sides are
// not parallel the mean of the tied strains is not that of the motion, and cells of different
// shapes would fail the patch test: the difference is added.
#include <cmath>

#include "core/fe/shell_kinematics.hpp"

namespace clatter::fe {
namespace {

const double kTwo = 1.0 / std::sqrt(3.0), kThree = std::sqrt(0.6);  // Gauss points

/// The functions along a line that are 1 at one of two, or three, points.
Eigen::Vector2d through_two(double x) { return {0.5 * (1.0 - x / kTwo), 0.5 * (1.0 + x / kTwo)}; }

Eigen::Vector3d through_three(double x) {
  const double y = x / kThree;
  return {0.5 * y * (y - 1.0), 1.0 - y * y, 0.5 * y * (y + 1.0)};
}

}  // namespace

Quad8Shell::Quad8Shell(const MidSurface& mid)
    : ShellTheory(mid, Eigen::Vector2d::Zero(), kShellInner) {
  const auto rows = [&](double r, double s, int i) {
    const SurfacePoint p(mid, {r, s});
    TiedRows out(3, columns());
    out << membrane(p).row(i), curvature(p).row(i), shear(p, i);
    return out;
  };
  const std::array<double, 2> two = {-kTwo, kTwo};
  const std::array<double, 3> three = {-kThree, 0.0, kThree};
  for (size_t i = 0; i < 2; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      along_r_[3 * i + j] = rows(two[i], three[j], 0);
      along_s_[3 * i + j] = rows(three[j], two[i], 1);
    }
    for (size_t j = 0; j < 2; ++j) {
      const SurfacePoint p(mid, {two[i], two[j]});
      across_[2 * i + j].resize(2, columns());
      across_[2 * i + j] << membrane(p).row(2), curvature(p).row(2);
    }
  }
  missing_ = ShellRows<6>::Zero(6, columns());
  double area = 0.0;
  for (Eigen::Index q = 0; q < rule().weights.size(); ++q) {
    const SurfacePoint p(mid, rule().points.row(q).transpose());
    const double weight = rule().weights(q) * p.area;
    area += weight;
    missing_ -= weight * tied(p).topRows<6>();
    missing_.topRows<3>() += weight * p.strain_map.lazyProduct(membrane(p));
    missing_.bottomRows<3>() += weight * p.strain_map.lazyProduct(curvature(p));
  }
  missing_ /= area;
}

ShellStrain Quad8Shell::tied(const SurfacePoint& p) const {
  const Eigen::Vector2d two_r = through_two(p.at(0)), two_s = through_two(p.at(1));
  const Eigen::Vector3d three_r = through_three(p.at(0)), three_s = through_three(p.at(1));
  TiedRows r = TiedRows::Zero(3, columns()), s = r;
  ShellRows<2> rs = ShellRows<2>::Zero(2, columns());
  for (size_t i = 0; i < 2; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      r += two_r[i] * three_s[j] * along_r_[3 * i + j];
      s += two_s[i] * three_r[j] * along_s_[3 * i + j];
    }
    for (size_t j = 0; j < 2; ++j) rs += two_r[i] * two_s[j] * across_[2 * i + j];
  }
  ShellRows<3> in_plane(3, columns()), bent(3, columns());
  ShellRows<2> shear(2, columns());
  in_plane << r.row(0), s.row(0), rs.row(0);
  bent << r.row(1), s.row(1), rs.row(1);
  shear << r.row(2), s.row(2);
  return in_axes(p, in_plane, bent, shear);
}

ShellStrain Quad8Shell::strain(const SurfacePoint& p) const {
  ShellStrain out = tied(p);
  out.topRows<6>() += missing_;
  return out;
}

}  // namespace clatter::fe
