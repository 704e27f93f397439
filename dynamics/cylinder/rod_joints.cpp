// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/rod_joints.hpp"

#include <optional>
#include <utility>

#include "dynamics/cylinder/crank_pin.hpp"
#include "dynamics/cylinder/cylinder_rod.hpp"
#include "dynamics/cylinder/journal_joint.hpp"
#include "dynamics/force/joint.hpp"
#include "dynamics/force/joint_friction.hpp"

namespace clatter::dynamics {
namespace {

/// An end of the rod with its rotation, of which the ideal one is prescribed; of an elastic rod
/// that of its rigid motion. A massless one has no coordinate, and no friction.
JournalSide rod_side(const CylinderBodies& bodies, const SliderCrank& crank, bool small) {
  auto point = rod_end(bodies, crank, small);
  std::optional<int> turn;
  if (bodies.spec.rod.model != RodModel::kMassless)
    turn = bodies.model.system.coordinate(bodies.rod_index(), 2);
  return {std::move(point),
          {turn, [crank](double time) { return crank.rod_angle(time).velocity; }}};
}

/// The sides of a joint on which forces are recorded, and the other one.
struct JointSides {
  JournalSide a, b;
};

/// The joint by its law. @param journal_first side a is the journal, else b.
std::unique_ptr<ForceElement> rod_joint(const std::string& name, const JointSpec& spec,
                                        JointSides sides, bool journal_first) {
  if (spec.film) {
    const BearingFilm film(spec.film->size, spec.film->model);
    if (!journal_first) std::swap(sides.a, sides.b);
    return std::make_unique<JournalJoint>(name, std::move(sides.a), std::move(sides.b), film,
                                          journal_first ? 1.0 : -1.0);
  }
  if (spec.friction)
    return std::make_unique<FrictionJoint>(name, std::move(sides.a.point), std::move(sides.b.point),
                                           spec.law, *spec.friction, sides.a.rotation,
                                           sides.b.rotation);
  return std::make_unique<Joint>(name, std::move(sides.a.point), std::move(sides.b.point),
                                 spec.law);
}

}  // namespace

std::unique_ptr<ForceElement> pin_joint(const CylinderBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin) {
  PointWeights centre;
  centre.add(pin[1], 1.0, 0.0);
  centre.add(pin[2], 0.0, 1.0);
  JournalSide piston{std::make_unique<LinearAnchor>(std::move(centre)), {pin[3], {}}};
  return rod_joint(bodies.spec.name_of("pin"), bodies.spec.small_end,
                   {std::move(piston), rod_side(bodies, crank, true)}, true);
}

std::unique_ptr<ForceElement> crank_joint(const CylinderBodies& bodies, const SliderCrank& crank) {
  JournalSide rod = rod_side(bodies, crank, false);
  auto centre = crank_pin(bodies, crank);
  std::optional<int> turn;
  if (bodies.spec.has_free_crank())
    turn = bodies.model.system.coordinate(bodies.model.body(CrankBody::kName),
                                          bodies.spec.crankshaft->turn());
  JournalSide shaft{std::move(centre), {turn, [crank](double time) { return crank.spin(time); }}};
  return rod_joint(bodies.spec.name_of("crank_pin"), bodies.spec.big_end,
                   {std::move(rod), std::move(shaft)}, false);
}

}  // namespace clatter::dynamics
