// SPDX-License-Identifier: GPL-3.0-or-later
// quad4, MITC4+ with enhanced strains. The mid-surface is x = x_0 + r x_r + s x_s + r s x_d, and so
// are the displacements; then the membrane strains are
//   rr: constant_r + s linear_r + s^2 bilinear,  ss: constant_s + r linear_s + r^2 bilinear,
//   rs: constant_rs + (r linear_r + s linear_s) / 2 + r s bilinear,
// bilinear = x_d . u_d. Of a warped cell that is a strain which bending without stretching cannot
// avoid; what varies of it is replaced by a combination of strains at the middles of the sides and
// the centre, which vanish then (Ko, Lee and Bathe 2017).
#include <cmath>

#include "core/fe/shell_kinematics.hpp"

namespace clatter::fe {
namespace {

const ShellWeights kAlongR = Eigen::Vector4d(-0.25, 0.25, 0.25, -0.25);
const ShellWeights kAlongS = Eigen::Vector4d(-0.25, -0.25, 0.25, 0.25);
const ShellWeights kWarp = Eigen::Vector4d(0.25, -0.25, 0.25, -0.25);

}  // namespace

QuadShell::QuadShell(const MidSurface& mid) : ShellTheory(mid, Eigen::Vector2d::Zero(), 4) {
  const Eigen::Vector3d &x_r = centre_.x_r, &x_s = centre_.x_s;
  const Eigen::Vector3d x_d = mid.x.transpose() * kWarp;
  constant_r_ = translation(x_r, kAlongR);
  constant_s_ = translation(x_s, kAlongS);
  constant_rs_ = 0.5 * (translation(x_r, kAlongS) + translation(x_s, kAlongR));
  linear_r_ = translation(x_r, kWarp) + translation(x_d, kAlongR);
  linear_s_ = translation(x_s, kWarp) + translation(x_d, kAlongS);
  bilinear_ = translation(x_d, kWarp);
  skew_ = centre_.to_axes.transpose() * (centre_.axes.leftCols<2>().transpose() * x_d);
  replace_warp();
  const auto tied = [&](double r, double s, int i) { return shear(SurfacePoint(mid, {r, s}), i); };
  shear_a_ = tied(0.0, 1.0, 0);
  shear_c_ = tied(0.0, -1.0, 0);
  shear_d_ = tied(1.0, 0.0, 1);
  shear_b_ = tied(-1.0, 0.0, 1);
}

void QuadShell::replace_warp() {
  const double r = skew_(0), s = skew_(1);
  const ShellRow at_a = constant_r_ + bilinear_ + linear_r_;
  const ShellRow at_c = constant_r_ + bilinear_ - linear_r_;
  const ShellRow at_d = constant_s_ + bilinear_ + linear_s_;
  const ShellRow at_b = constant_s_ + bilinear_ - linear_s_;
  replaced_ = 0.5 * (r * (r - 1.0) * at_a + r * (r + 1.0) * at_c + s * (s - 1.0) * at_d +
                     s * (s + 1.0) * at_b) +
              2.0 * r * s * constant_rs_;
  replaced_ /= skew_.squaredNorm() - 1.0;
}

bool QuadShell::is_shell() const {
  // At 1 two sides are one line; from there on the cell is concave. Towards it replace_warp()
  // divides by zero.
  constexpr double kSkew = 0.9;
  return ShellTheory::is_shell() && skew_.lpNorm<1>() <= kSkew;
}

ShellRows<3> QuadShell::unwarped(const Eigen::Vector2d& at) const {
  const double r = at(0), s = at(1);
  ShellRows<3> e(3, columns());
  e.row(0) = constant_r_ + bilinear_ + s * linear_r_ + (s * s - 1.0) * replaced_;
  e.row(1) = constant_s_ + bilinear_ + r * linear_s_ + (r * r - 1.0) * replaced_;
  e.row(2) = constant_rs_ + 0.5 * (r * linear_r_ + s * linear_s_) + r * s * replaced_;
  return e;
}

ShellStrain QuadShell::strain(const SurfacePoint& p) const {
  const double r = p.at(0), s = p.at(1);
  ShellRows<2> shear(2, columns());
  shear.row(0) = 0.5 * ((1.0 + s) * shear_a_ + (1.0 - s) * shear_c_);
  shear.row(1) = 0.5 * ((1.0 + r) * shear_d_ + (1.0 - r) * shear_b_);
  ShellStrain strain = in_axes(p, unwarped(p.at), curvature(p), shear);
  // Enhanced strains have the mean zero over the cell, thus pass patch tests (Simo and Rifai 1990).
  Eigen::Matrix<double, 3, 4> enhanced;
  enhanced << r, 0.0, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, 0.0, 0.5 * r, 0.5 * s;
  strain.topRightCorner<3, 4>() = centre_.area / p.area * centre_.strain_map * enhanced;
  return strain;
}

}  // namespace clatter::fe
