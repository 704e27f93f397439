// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/crank_pin.hpp"

#include "dynamics/body/mechanism_port.hpp"
#include "dynamics/cylinder/crank_centre.hpp"

namespace clatter::dynamics {
namespace {

/// The point of the crankshaft's axis in the cylinder's plane.
PointWeights crank_axis(const CylinderBodies& bodies, const CrankBody& crankshaft) {
  System& system = bodies.model.system;
  const int body = bodies.model.body(CrankBody::kName);
  const double arm = bodies.axes().pin.x() - crankshaft.centre;
  PointWeights point;
  point.add(system.coordinate(body, CrankBody::kY), 1.0, 0.0);
  point.add(system.coordinate(body, CrankBody::kZ), 0.0, 1.0);
  point.add(system.coordinate(body, CrankBody::kTiltY), 0.0, -arm);
  point.add(system.coordinate(body, CrankBody::kTiltZ), arm, 0.0);
  return point;
}

}  // namespace

std::unique_ptr<Port> crank_pin(const CylinderBodies& bodies, const SliderCrank& crank) {
  const std::optional<CrankBody>& crankshaft = bodies.spec.crankshaft;
  PointWeights centre;
  if (crankshaft && crankshaft->in_bearings) {
    centre = crank_axis(bodies, *crankshaft);
  } else if (bodies.block() != nullptr) {
    centre = crank_centre(bodies);
  }
  std::optional<int> turn;
  if (crankshaft && crankshaft->is_free)
    turn = bodies.model.system.coordinate(bodies.model.body(CrankBody::kName), crankshaft->turn());
  return std::make_unique<CrankPinPort>(std::move(centre), turn, crank);
}

}  // namespace clatter::dynamics
