// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/rod_joints.hpp"

#include <string>
#include <utility>

#include "dynamics/bearing/bearing_laws.hpp"
#include "dynamics/cylinder/crank_pin.hpp"
#include "dynamics/cylinder/cylinder_rod.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/law/joint_laws.hpp"

namespace clatter::dynamics {
namespace {

constexpr int kPin = 0;  // axis of the pins: x

/// The joint of an end of the rod, port b, with what it is joined to.
class RodJoint : public PairElement {
 public:
  /// @param on_rod the histories are of force and moment on the rod.
  RodJoint(const std::string& name, std::unique_ptr<Port> other, std::unique_ptr<Port> rod,
           const JointSpec& spec, bool on_rod);

  /// `<name>_force_y`, `<name>_force_z` [N], `<name>_eccentricity` [m]; with friction also
  /// `<name>_friction_moment` [N m] and `<name>_friction_power`, of a film `_film_power` [W], lost.
  void record(History& history) const override;

 private:
  static std::unique_ptr<PairLaw> law_of(const JointSpec& spec);
  bool has_friction_, has_film_, on_rod_;
};

RodJoint::RodJoint(const std::string& name, std::unique_ptr<Port> other, std::unique_ptr<Port> rod,
                   const JointSpec& spec, bool on_rod)
    : PairElement(name, std::move(other), std::move(rod), law_of(spec)),
      has_friction_(spec.friction.has_value()),
      has_film_(spec.film.has_value()),
      on_rod_(on_rod) {}

std::unique_ptr<PairLaw> RodJoint::law_of(const JointSpec& spec) {
  if (spec.film)
    return std::make_unique<ImpedanceBearing>(BearingPlace{ShaftAxes{kPin}},
                                              BearingFilm(spec.film->size, spec.film->model));
  auto joint = std::make_unique<RadialJoint>(spec.law);
  if (!spec.friction) return joint;
  return std::make_unique<FrictionJoint>(std::move(joint), *spec.friction, kPin);
}

void RodJoint::record(History& history) const {
  const auto& [motion, law, input] = accepted();
  const Eigen::Vector3d force = on_rod_ ? -law.force : law.force;
  history.put(name() + "_force_y", "N", force.y());
  history.put(name() + "_force_z", "N", force.z());
  history.put(name() + "_eccentricity", "m", motion.distance.norm());
  if (!has_friction_ && !has_film_) return;
  const double moment = law.moment(kPin);
  const double on_rod = -moment - motion.distance.cross(law.force)(kPin);
  history.put(name() + "_friction_moment", "N m", on_rod_ ? on_rod : moment);
  if (has_film_) {
    history.put(name() + "_film_power", "W", law.lost);
  } else {
    history.put(name() + "_friction_power", "W", -moment * motion.spin(kPin));
  }
}

}  // namespace

std::unique_ptr<ForceElement> pin_joint(const CylinderBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin) {
  PointWeights centre;
  centre.add(pin[1], 1.0, 0.0);
  centre.add(pin[2], 0.0, 1.0);
  centre.add_turn(pin[3]);
  return std::make_unique<RodJoint>(bodies.spec.name_of("pin"),
                                    std::make_unique<WeightedPort>(std::move(centre)),
                                    rod_end(bodies, crank, true), bodies.spec.small_end, false);
}

std::unique_ptr<ForceElement> crank_joint(const CylinderBodies& bodies, const SliderCrank& crank) {
  auto rod = rod_end(bodies, crank, false);
  return std::make_unique<RodJoint>(bodies.spec.name_of("crank_pin"), crank_pin(bodies, crank),
                                    std::move(rod), bodies.spec.big_end, true);
}

}  // namespace clatter::dynamics
