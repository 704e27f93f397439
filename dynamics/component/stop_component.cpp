// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/stop_component.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

/// Of positions given as decimal numbers: a point so far behind the plane is on it [m].
constexpr double kRounding = 1e-9;

std::unique_ptr<Stop> make_stop(const StopSpec& stop, ModelBuilder& model,
                                std::vector<const RigidStop*>& rigid) {
  auto a = model.port(stop.a), b = model.port(stop.b, model.position(stop.a, std::nullopt));
  if (a->size() + b->size() == 0)
    throw InputError(stop.where + ": a and b: found no body that can move, expected one");
  const PortState point = model.at_start(*a), plane = model.at_start(*b);
  const double gap = stop.normal.dot(point.position - plane.position);
  const Eigen::Vector3d normal = plane.rotation.transpose() * stop.normal;
  PointOnPlane pair(std::move(a), std::move(b), normal);
  constexpr double kDeep = 1e-3;  // [m]
  if (!stop.restitution && gap < -kDeep)
    warn(
        fmt::format("{}: starts {:.4g} mm behind the plane, pushed with {:.3g} N: the side that "
                    "normal points to is free",
                    stop.a.where, -gap / kMilli, stop.stiffness * std::pow(-gap, stop.exponent)));
  if (!stop.restitution)
    return std::make_unique<CompliantStop>(stop.name, std::move(pair), stop.stiffness,
                                           stop.exponent, stop.chi, stop.friction);
  if (gap < -kRounding)
    throw InputError(
        fmt::format("{}: found {:.4g} mm behind the plane at the start, expected on the side to "
                    "which normal points",
                    stop.a.where, -gap / kMilli));
  auto made = std::make_unique<RigidStop>(stop.name, std::move(pair), *stop.restitution,
                                          stop.rest_stiffness, stop.friction);
  rigid.push_back(made.get());
  return made;
}

std::tuple<std::string, std::string, std::array<double, 3>> place_of(const PointSpec& point) {
  const Eigen::Vector3d at = point.at.value_or(Eigen::Vector3d::Zero());
  return {point.body, point.set, {at.x(), at.y(), at.z()}};
}

/// Of two elastic bodies that stick, over that along the normal: 2 (1 - nu) / (2 - nu) (Mindlin
/// 1949).
constexpr double kPlaneOverNormal = 0.8;

double stick_stiffness(const StopSpec& stop) {
  const double normal =
      stop.restitution ? stop.rest_stiffness
                       : stop.exponent * stop.stiffness * std::pow(kMicro, stop.exponent - 1.0);
  return kPlaneOverNormal * normal;
}

bool comes_before(const StopSpec* one, const StopSpec* other) {
  const auto place = [](const StopSpec& stop) {
    return std::tuple(place_of(stop.a), place_of(stop.b),
                      std::array{stop.normal.x(), stop.normal.y(), stop.normal.z()});
  };
  return place(*one) < place(*other);
}

}  // namespace

const Keys<StopSpec>& stop_keys() {
  static const Keys<StopSpec> keys(
      "stop", "contact of a point with a plane, rigid by impacts or compliant",
      [](auto& key, StopSpec& stop) {
        const Range stiffness = Range::between(1e-3, 1e20), coefficient = Range::between(0.0, 10.0);
        key.where(stop.where);
        name_row(key, stop.name);
        key.table("a", stop.a, point_keys(), "the point").required();
        key.table("b", stop.b, point_keys(), "a point of the plane, which moves with its body")
            .required();
        key.direction("normal", stop.normal, "normal of the plane at the start, to the side of a")
            .required();
        key.number("restitution", stop.restitution, Range::between(0.0, 1.0),
                   "of a rigid contact: speed after over speed before an impact");
        key.number("rest_stiffness_n_m", stop.rest_stiffness, stiffness,
                   "of a rigid contact: spring that holds a point where impacts have died out")
            .needs("restitution");
        key.number("stiffness_n_m", stop.stiffness, stiffness,
                   "of a compliant contact: force over depth^exponent")
            .shown_in("N/m^exponent");
        key.one_of({"stiffness_n_m", "restitution"});
        key.all_need("stiffness_n_m", {}, "a rigid contact has no depth", [&] {
          key.number("exponent", stop.exponent, Range::between(1.0, 4.0), "of the depth");
          key.number("chi_s_m", stop.chi, Range::between(0.0, 1e9),
                     "damping by the rate of the depth: the force is times 1 + chi rate");
        });
        key.number("friction", stop.friction.kinetic, coefficient,
                   "coefficient of friction, of impulses as well");
        key.number("static_friction", stop.static_friction, coefficient,
                   "coefficient before the point slides; that of friction without it")
            .needs("friction");
        key.number("stick_stiffness_n_m", stop.stick_stiffness, stiffness,
                   "in the plane, of a point that sticks; without it 0.8 times that along the "
                   "normal (of an exponent above 1 at a depth of 1 um), as of two elastic bodies")
            .needs("friction");
        key.number("stick_damping_us", stop.friction.damping_time, Range::between(0.01, 1e9),
                   "damping of a point that sticks, over its stiffness")
            .needs("friction");
        key.number("slip_speed_m_s", stop.friction.slip_speed, Range::between(1e-9, 1e3),
                   "the point does not stick: it creeps below its limit of friction, and reaches "
                   "the limit at this speed")
            .needs("friction")
            .excludes("stick_stiffness_n_m")
            .excludes("stick_damping_us");
        key.check([](const Config& table, StopSpec& found) {
          FrictionLaw& law = found.friction;
          law.at_rest = found.static_friction.value_or(law.kinetic);
          law.stiffness = found.stick_stiffness.value_or(stick_stiffness(found));
          if (law.at_rest < law.kinetic)
            table.fail("static_friction",
                       fmt::format("found {:g}, expected at least friction, {:g}", law.at_rest,
                                   law.kinetic));
        });
      });
  return keys;
}

/// The order of the tables has no influence, not even on rounding: stops are added in that of their
/// places.
void StopComponent::add_elements(ModelBuilder& model) {
  std::vector<const StopSpec*> ordered;
  for (const StopSpec& stop : stops_) ordered.push_back(&stop);
  std::stable_sort(ordered.begin(), ordered.end(), comes_before);
  for (const StopSpec* stop : ordered) {
    auto made = make_stop(*stop, model, rigid_);
    model.system.add_element(std::move(made));
  }
}

std::vector<std::string> StopComponent::warnings() const {
  std::vector<std::string> found;
  for (const RigidStop* stop : rigid_) {
    if (!stop->has_sunk()) continue;
    found.push_back(fmt::format(
        "{}: impacts followed each other too closely to be computed, and the spring "
        "rest_stiffness_n_m = {:g} that holds the point then let it sink {:.3g} um into the "
        "plane: set a higher one, or a compliant contact by stiffness_n_m",
        stop->name(), stop->rest_stiffness(), stop->deepest() / kMicro));
  }
  return found;
}

void StopComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  if (stops_.empty()) return;
  const auto rigid = std::count_if(stops_.begin(), stops_.end(), [](const StopSpec& stop) {
    return stop.restitution.has_value();
  });
  effects.add(find_effect(kComponentEffects, "stops"), true,
              fmt::format("[[stop]]: {} rigid with impacts, {} compliant", rigid,
                          static_cast<long>(stops_.size()) - rigid),
              "stop");
}

ComponentList read_stops(const Config& root) {
  return {std::make_shared<StopComponent>(read_elements(root, "stop", stop_keys()))};
}

}  // namespace clatter::dynamics
