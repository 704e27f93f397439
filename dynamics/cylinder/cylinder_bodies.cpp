// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/cylinder_bodies.hpp"

#include <optional>

namespace clatter::dynamics {

const LoadedBody& CylinderBodies::piston() const {
  return *find_body(model.loaded, spec.name_of("piston"));
}

const LoadedBody* CylinderBodies::block() const {
  return spec.bore ? find_body(model.loaded, "block") : nullptr;
}

CylinderAxes CylinderBodies::axes() const {
  const auto axis_of = [](const LoadedBody* body, const std::string& grid) {
    std::optional<Eigen::Vector2d> axis;
    if (body == nullptr) return axis;
    const auto found = body->model.grids.find(grid);
    if (found != body->model.grids.end()) axis = found->second.axis_point.head<2>();
    return axis;
  };
  const double offset = spec.engine.pin_offset;
  const Eigen::Vector2d skirt =
      axis_of(&piston(), spec.piston.skirt).value_or(Eigen::Vector2d(0, -offset));
  Eigen::Vector2d bore(skirt.x(), skirt.y() + offset);
  if (block() != nullptr) {
    double x = 0.0;
    for (const auto& set : spec.bore->bearings) {
      x += block()->model.set(set).position(0, 0) / static_cast<double>(spec.bore->bearings.size());
    }
    bore.x() += x;
    bore = axis_of(block(), spec.bore->liner).value_or(bore);
  }
  return {bore, {bore.x() - skirt.x(), offset}};
}

CrankAngle CylinderBodies::crank_angle(const SliderCrank& crank) const {
  if (!spec.has_free_crank()) return {};
  return {crank, model.system.coordinate(model.body(CrankBody::kName), spec.crankshaft->turn())};
}

}  // namespace clatter::dynamics
