// SPDX-License-Identifier: GPL-3.0-or-later
// Action equals reaction: when the entire engine moves as one rigid body, no element does work.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>

#include "dynamics/element/pair_element.hpp"
#include "tests/dynamics/synthetic_engine.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::dynamics {
namespace {

using testing::EngineVariant;
using testing::SyntheticEngine;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Largest values of one element over all positions of the crank.
struct Balance {
  double force = 0.0, moment = 0.0, worst = 0.0;
};

/// Displacements and velocities of all coordinates.
struct Motion12 {
  Eigen::VectorXd y, v;
};

/// Random motion around the ideal position, in which lever arms are those of the ideal position:
/// the rod is not turned and the skirt is at its ideal height. (Elsewhere they differ by the
/// deviations, some micrometres.)
Motion12 random_motion(const Model& model, const SyntheticEngine& engine, unsigned seed) {
  const System& system = model.system;
  const int n = system.interface_size();
  Motion12 at{1.5e-6 * test::random_vector(n, seed), 0.02 * test::random_vector(n, seed + 1)};
  for (int i = 0; i < n; ++i)
    if (system.is_rotation(i)) at.y(i) *= 10.0;
  at.y(system.rows(2)[2]) = 0.0;  // the rod's rotation
  // Pin x, y, z, rx, ry, rz, then the liner's axial coordinate.
  const std::vector<int>& contact = testing::cylinder_of(model).contact()->coordinates();
  const auto pin = std::find(contact.begin(), contact.end(), testing::cylinder_of(model).pin()[1]) -
                   contact.begin() - 1;
  const auto y_of = [&](long k) -> double& { return at.y(contact[pin + k]); };
  const rom::ReducedModel& block = engine.bodies[1].model;
  Eigen::Vector2d arm = block.grid("liner_4").axis_point.head<2>();
  if (!engine.cylinder.bore->liner_axial.empty())
    arm = block.set("liner_4_axial").position.row(0).head<2>();
  arm -= Eigen::Vector2d(block.grid("liner_4").axis_point.x(),
                         testing::cylinder_of(model).crank().pin_offset());
  y_of(2) = -(arm.y() * y_of(3) - arm.x() * y_of(4));
  if (pin + 6 < std::ssize(contact)) y_of(6) = 0.0;
  return at;
}

class ActionReaction : public ::testing::TestWithParam<EngineVariant> {};

TEST_P(ActionReaction, RigidMotionsOfTheWholeDoNoWorkButThatOfTheDrive) {
  const SyntheticEngine engine(GetParam());
  const double omega = engine.cylinder.engine.clock.speed;
  std::map<std::string, Balance> balance;
  for (const double degrees : {-310.0, -90.0, 0.0, 35.0, 130.0, 181.0}) {
    const double time = degrees * std::numbers::pi / 180.0 / omega;
    const auto model = engine.model();
    const Motion12 at = random_motion(*model, engine, 7);
    const Eigen::MatrixXd V = testing::rigid_motions(*model, engine, time);
    for (int e = 0; e < model->system.elements(); ++e) {
      ForceElement& element = model->system.element(e);
      const std::vector<int>& rows = element.coordinates();
      const Eigen::VectorXd y = gather(at.y, rows), v = gather(at.v, rows);
      Response response;
      // The stroke follows the method within a step: one of 1e-8 s ends at the ideal height.
      element.begin_step(time - 1e-8);
      element.evaluate({time, 1e-8, 0, {}}, y, v, false, response);
      const Eigen::VectorXd& f = response.force;
      const Eigen::MatrixXd V_e = V(rows, Eigen::all);
      Vector6 work = V_e.transpose() * f;
      const Vector6 terms = V_e.cwiseAbs().transpose() * f.cwiseAbs();
      EXPECT_GT(f.norm(), 0.01) << element.name();
      if (element.name() == "mount 1") continue;  // the ground is external
      if (element.name() == "crank_pin") {
        // External is the torque that drives the crank at constant speed, and nothing else.
        const Eigen::Vector2d pin = testing::cylinder_of(*model).crank().crank_pin(time).position;
        const Eigen::Vector2d on_rod = f.segment<2>(f.size() - 3);
        const double torque = pin.x() * on_rod.y() - pin.y() * on_rod.x();
        EXPECT_GT(std::abs(torque), 1e-3 * terms(3));
        work(3) -= torque;
      }
      // The reaction of a joint acts where the force does, d from its own point.
      if (const auto* joint = dynamic_cast<const PairElement*>(&element))
        work(3) += joint->last().motion.distance.cross(joint->last().force.force).x();
      // Some motions move an element by rounding only.
      const double worst =
          (work.cwiseAbs().array() / terms.array().max(1e-3 * terms.maxCoeff())).maxCoeff();
      Balance& sum = balance[element.name()];
      sum.force = std::max(sum.force, f.norm());
      sum.moment = std::max(sum.moment, work.tail<3>().cwiseAbs().maxCoeff());
      sum.worst = std::max(sum.worst, worst);
      EXPECT_LT(worst, 1e-10) << element.name() << " at " << degrees
                              << " deg: " << work.transpose();
    }
  }
  for (const auto& [name, sum] : balance) {
    std::printf("%-26s %-12s |f| %8.3g N, moment left %8.2g N m, relative %.1e\n",
                GetParam().name.c_str(), name.c_str(), sum.force, sum.moment, sum.worst);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Engines, ActionReaction,
    ::testing::Values(EngineVariant{.name = "elastic"},
                      EngineVariant{.name = "elastic_without_axial_set", .liner_axial = false},
                      EngineVariant{.name = "elastic_offset", .pin_offset = 1.2e-3},
                      EngineVariant{.name = "rigid_offset",
                                    .elastic_piston = false,
                                    .liner_axial = false,
                                    .pin_offset = -0.8e-3},
                      EngineVariant{.name = "rigid_dry", .elastic_piston = false, .film = false},
                      EngineVariant{.name = "dry_offset", .film = false, .pin_offset = 1.2e-3},
                      EngineVariant{.name = "one_bearing", .bearings = {"main_4"}},
                      EngineVariant{.name = "off_axis", .bearings = {"main_4", "main_5", "sensor"}},
                      EngineVariant{.name = "rings", .rings = true, .pin_offset = 1.2e-3},
                      EngineVariant{
                          .name = "rings_without_axial_set", .liner_axial = false, .rings = true},
                      EngineVariant{.name = "no_bearing", .pin_offset = 1e-3, .bearings = {}}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace clatter::dynamics
