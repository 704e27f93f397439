// SPDX-License-Identifier: GPL-3.0-or-later
// tri3, MITC3+: the membrane has constant strain; rotations have a bubble 27 r s (1 - r - s), and
// the shear strains are tied at six points inside (Lee, Lee and Bathe 2014).
#include <Eigen/Geometry>

#include "core/fe/shell_kinematics.hpp"

namespace clatter::fe {
namespace {

constexpr double kThird = 1.0 / 3.0;

}  // namespace

TriangleShell::TriangleShell(const MidSurface& mid)
    : ShellTheory(mid, Eigen::Vector2d::Constant(kThird), 2) {
  membrane_ = membrane(centre_);
  const ShellRows<2> A = shear_at(1.0 / 6.0, 2.0 / 3.0), B = shear_at(2.0 / 3.0, 1.0 / 6.0),
                     C = shear_at(1.0 / 6.0, 1.0 / 6.0);
  mean_r_ = 2.0 / 3.0 * (B.row(0) - 0.5 * B.row(1)) + kThird * (C.row(0) + C.row(1));
  mean_s_ = 2.0 / 3.0 * (A.row(1) - 0.5 * A.row(0)) + kThird * (C.row(0) + C.row(1));
  constexpr double d = 1e-4;  // of the points D, E, F to the centre: the authors' value
  twist_ = shear_at(kThird + d, kThird + d).row(0) - shear_at(kThird + d, kThird - 2.0 * d).row(0) -
           shear_at(kThird + d, kThird + d).row(1) + shear_at(kThird - 2.0 * d, kThird + d).row(1);
}

ShellRows<2> TriangleShell::shear_at(double r, double s) const {
  const SurfacePoint p(mid_, {r, s});
  ShellRows<2> out(2, columns());
  for (int i = 0; i < 2; ++i) {
    ShellRow row = shear(p, i);
    add_bubble(i == 0 ? p.x_r : p.x_s, bubble(p.at), row);
    out.row(i) = row;
  }
  return out;
}

ShellStrain TriangleShell::strain(const SurfacePoint& p) const {
  const double r = p.at(0), s = p.at(1);
  ShellRows<3> bent = curvature(p);
  add_bubble(p, bent);
  ShellRows<2> tied(2, columns());
  tied.row(0) = mean_r_ + (s - kThird) * twist_;
  tied.row(1) = mean_s_ + (kThird - r) * twist_;
  return in_axes(p, membrane_, bent, tied);
}

}  // namespace clatter::fe
