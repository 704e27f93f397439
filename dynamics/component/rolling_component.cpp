// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/rolling_component.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/integrate/spatial_body.hpp"

namespace clatter::dynamics {
namespace {

/// Cosine of the angle between the disc's axis and the normal from which it has no lowest point.
constexpr double kFlat = 1.0 - 1e-9;

}  // namespace

void RollingComponent::add_elements(ModelBuilder& model) {
  for (const RollingDiscSpec& disc : discs_) {
    const auto frame = model.has_body(disc.body)
                           ? model.system.bodies()[model.body(disc.body)].frame
                           : std::shared_ptr<SpatialFrame>();
    if (!frame || frame->modes() > 0)
      throw InputError(
          fmt::format("{}: body: found \"{}\", expected a [[rigid_body]] with motion = "
                      "\"space\"",
                      disc.where, disc.body));
    if (std::abs(disc.axis.dot(disc.plane.normal)) > kFlat)
      throw InputError(disc.where +
                       ": axis: found that of the normal, expected a disc that stands or leans");
    PointSpec centre;
    centre.body = disc.body;
    centre.where = disc.where;
    const auto port = model.port(centre, Eigen::Vector3d::Zero());
    const Eigen::Vector3d axis = model.at_start(*port).rotation.transpose() * disc.axis;
    model.system.add_element(std::make_unique<DiscContact>(
        disc.name, coordinates_in_space(model.system, model.body(disc.body)), frame, axis,
        disc.radius, disc.plane));
  }
}

void RollingComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  if (!discs_.empty())
    effects.add(find_effect(kComponentEffects, "rolling discs"), true, "[[rolling_disc]]",
                "rolling_disc");
}

const Keys<RollingDiscSpec>& rolling_disc_keys() {
  static const Keys<RollingDiscSpec> keys(
      "rolling_disc", "the sharp edge of a disc on a plane at rest, on which it rolls or slides",
      [](auto& key, RollingDiscSpec& disc) {
        key.where(disc.where);
        name_row(key, disc.name);
        key.text("body", disc.body,
                 "a [[rigid_body]] in space; its centre of mass is that of the disc")
            .required();
        key.direction("axis", disc.axis, "axis of the disc at the start").required();
        key.number("radius_mm", disc.radius, Range::between(1e-3, 1e6), "radius of its edge")
            .required();
        key.vector("point_mm", disc.plane.point, kPositionMm, "a point of the plane");
        key.direction("normal", disc.plane.normal, "normal of the plane, to the side of the disc");
        key.number("stiffness_n_m", disc.plane.stiffness, Range::between(1e-3, 1e20),
                   "force over the depth of the edge's lowest point")
            .required();
        key.number("chi_s_m", disc.chi, Range::between(0.0, 1e9),
                   "damping by the rate of the depth: the force is times 1 + chi rate");
        key.number("friction", disc.plane.friction, Range::between(0.0, 10.0),
                   "coefficient of friction");
        key.number(
               "slip_speed_m_s", disc.plane.slip_speed, Range::between(1e-9, 1e3),
               "slip at which friction has 71 % of its limit; a disc that rolls creeps below it")
            .needs("friction");
        key.check([](const Config&, RollingDiscSpec& found) {
          found.plane.damping = found.chi * found.plane.stiffness;
        });
      });
  return keys;
}

ComponentList read_rolling_discs(const Config& root) {
  return {
      std::make_shared<RollingComponent>(read_elements(root, "rolling_disc", rolling_disc_keys()))};
}

}  // namespace clatter::dynamics
