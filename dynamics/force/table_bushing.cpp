// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/table_bushing.hpp"

namespace clatter::dynamics {

PairForce TableBushing::force(double, const PairMotion& motion) const {
  const Eigen::Vector3d& d = motion.distance;
  const double e = d.norm(), damping = law_.damping_at(e), slope = law_.slope(e);
  const double across = e > 0.0 ? law_.force(e) / e : slope;  // F / e
  PairForce law;
  law.force = -across * d - damping * motion.velocity;
  law.moment.setZero();
  law.by_distance.setZero();
  law.by_rate.setZero();
  auto by_distance = law.by_distance.topLeftCorner<3, 3>();
  by_distance.diagonal().setConstant(-across);
  if (e > 0.0) {
    const Eigen::Vector3d n = d / e;
    by_distance -= ((slope - across) * n + law_.damping_slope(e) * motion.velocity) * n.transpose();
  }
  law.by_rate.diagonal().head<3>().setConstant(-damping);
  law.stored = law_.energy(e);
  law.lost = damping * motion.velocity.squaredNorm();
  return law;
}

}  // namespace clatter::dynamics
