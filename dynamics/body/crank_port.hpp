// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Points on the axis of a crankshaft.
#include <vector>

#include "dynamics/body/port.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// Angle, angular velocity and acceleration of a clock about +x [rad], [rad/s], [rad/s2].
Motion<double> turn_about_x(const CrankClock& clock, Rotation rotation, double time);

/// A journal of a crankshaft: a point of its axis at `arm` along x from its centre of mass,
///
///   position (x, y + rz arm, z - ry arm),   spin (w + rx', ry', rz')
///
/// to first order in tilt, with the prescribed angular velocity w of the clock.
class CrankPort : public Port {
 public:
  /// @param coordinates y indices of y, z, ry, rz and, of a crank that is free, rx. @param x of the
  /// point [m]. @param arm [m].
  CrankPort(std::vector<int> coordinates, double x, double arm, CrankClock clock,
            Rotation rotation);
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  bool is_driven() const override { return true; }

 private:
  double x_, arm_;
  CrankClock clock_;
  Rotation rotation_;
};

}  // namespace clatter::dynamics
