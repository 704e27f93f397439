// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/synthetic_engine.hpp"

#include <Eigen/Geometry>
#include <numbers>

#include "dynamics/component/body_component.hpp"
#include "dynamics/component/mount_component.hpp"
#include "tests/dynamics/synthetic.hpp"

namespace clatter::dynamics::testing {
namespace {

constexpr double kRadius = 0.0535;

void load(const BodySpec& spec, const rom::ReducedModel& model, LoadedBodies& bodies) {
  bodies.push_back(make_loaded_body(spec, model));
}

film::PistonLinerOptions contact_of(const EngineVariant& variant) {
  film::PistonLinerOptions contact;
  contact.bore_radius = kRadius;
  contact.effects = {variant.film, true, true, true};
  contact.clearance = variant.film ? 12e-6 : variant.dry_clearance;
  contact.skirt.barrel_top = 10e-6;
  contact.cells_around = contact.cells_along = 6;
  film::LinerShape widening;  // slopes along the stroke: an axial part of the pressure
  widening.angle = Eigen::VectorXd::Zero(1);
  widening.height = Eigen::Vector2d(0.12, 0.34);
  widening.deviation = Eigen::RowVector2d(0.0, variant.film ? 8e-6 : 1e-6);
  contact.bore = widening;
  return contact;
}

}  // namespace

SyntheticEngine::SyntheticEngine(const EngineVariant& variant) {
  scene.clock = CrankClock{2000.0 * std::numbers::pi / 30.0};
  cylinder.engine =
      EngineSpec{{0.130, variant.pin_offset, variant.balanced, Rotation::kForward, {}},
                 *scene.clock,
                 RodProperties{0.210, 2.2, 0.02, 0.07},
                 0.0,
                 {}};
  PistonSpec& piston = cylinder.piston;
  piston.name = "piston";
  piston.elastic = variant.elastic_piston;
  BodySpec block;
  block.name = "block";
  cylinder.bore =
      BoreSpec{"liner_4", variant.liner_axial ? "liner_4_axial" : "", variant.bearings, ""};
  if (variant.contact) cylinder.contact = contact_of(variant);
  if (variant.rings) {
    RingSpec ring;
    ring.height = 45e-3;
    ring.face_radius = 20e-3;
    ring.load = 1000.0;
    ring.mass = 0.03;
    ring.boundary = ring.groove = 0.1;
    cylinder.rings = {ring};
    cylinder.small_end.friction = PinFriction{2e-3, 0.5};
  }
  const MountSpec mount{"block", "", {"mounts"}, {1e5, 1e5, 2e5}, {1e3, 1e3, 2e3}};
  scene.components = {std::make_shared<CylinderComponent>(cylinder),
                      std::make_shared<BlockComponent>(block),
                      std::make_shared<MountComponent>(std::vector{mount}, false)};
  load(piston,
       variant.elastic_piston ? elastic_piston(kRadius, 4, 4, -variant.pin_offset)
                              : rigid_piston(1.9, 4e-3, 9e-3),
       bodies);
  load(block, elastic_block(kRadius, 8, 6, {2e-3, -1e-3}), bodies);
}

Eigen::MatrixXd modal_rigid_motions(const Model& model, const SyntheticEngine& engine,
                                    double time) {
  const SliderCrank& crank = cylinder_of(model).crank();
  const double x = engine.bodies[1].model.grid("liner_4").axis_point.x();
  const Eigen::Vector2d rod = crank.rod_point(time, engine.cylinder.engine.rod.centre).position;
  const System& system = model.system;
  Eigen::MatrixXd motions(system.modes(), 6);
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
    const ModalBody& body = system.bodies()[b];
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    if (body.name == "piston") place = {x, crank.pin_offset(), crank.piston_pin(time).position};
    if (body.name == "rod") place = {x, rod.x(), rod.y()};
    Eigen::Matrix<double, 6, 6> motion = Eigen::Matrix<double, 6, 6>::Identity();
    for (int k = 0; k < 3; ++k)
      motion.topRightCorner<3, 3>().col(k) = Eigen::Vector3d::Unit(k).cross(place);
    motions.middleRows(system.mode_offset(b), body.modes()) = body.rigid * motion;
  }
  return motions;
}

Eigen::MatrixXd rigid_motions(const Model& model, const SyntheticEngine& engine, double time) {
  const Eigen::MatrixXd motions = modal_rigid_motions(model, engine, time);
  Eigen::MatrixXd V(model.system.interface_size(), 6);
  for (int k = 0; k < 6; ++k) V.col(k) = model.system.interface(Eigen::VectorXd(motions.col(k)));
  return V;
}

}  // namespace clatter::dynamics::testing
