// SPDX-License-Identifier: GPL-3.0-or-later
// Momentum and energy of the whole timing drive.
#include <gtest/gtest.h>

#include <array>

#include "dynamics/run/energy.hpp"
#include "tests/dynamics/chain/running_drive.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using testing::RunningDrive;
using testing::TimingDrive;

TimingDrive running() {
  TimingDrive drive;
  drive.rpm = 3400.0;
  drive.friction = 0.08;
  drive.joint_clearance_um = 12.5;
  return drive;
}

/// Sum of an element's forces on bodies in a plane: by whether a coordinate is along x or y.
Vector2d sum_of(const System& system, int element) {
  const VectorXd& force = system.response(element).force;
  Vector2d sum = Vector2d::Zero();
  for (Eigen::Index i = 0; i < force.size(); i += 3) sum += force.segment<2>(i);
  return sum;
}

double size_of(const System& system, int element) {
  return system.response(element).force.cwiseAbs().maxCoeff();
}

/// The impulse of all that acts between bodies and ground, with the method's own weights.
class GroundImpulse : public StageObserver {
 public:
  GroundImpulse(const System& system, const Tableau& method) : system_(system), method_(method) {}
  void stage(int index, const StageState&) override {
    Vector2d& sum = forces_[index];
    sum.setZero();
    for (int e = 0; e < system_.elements(); ++e) sum += sum_of(system_, e);
  }
  void accept(double dt) override {
    for (int i = 0; i <= method_.stages; ++i) {
      impulse += dt * method_.b[i] * forces_[i];
      size += dt * std::abs(method_.b[i]) * forces_[i].norm();
    }
    forces_[0] = forces_[method_.stages];
  }
  Vector2d impulse = Vector2d::Zero();
  double size = 0.0;

 private:
  const System& system_;
  const Tableau& method_;
  std::array<Vector2d, 3> forces_;
};

Vector2d momentum(const System& system, const StageState& state) {
  Vector2d sum = Vector2d::Zero();
  for (size_t b = 0; b < system.bodies().size(); ++b) {
    const std::vector<int>& rows = system.rows(static_cast<int>(b));
    sum += system.bodies()[b].mass * Vector2d(state.v_y(rows[0]), state.v_y(rows[1]));
  }
  return sum;
}

TEST(DriveInvariant, MomentumChangesByTheForcesOnTheGroundAlone) {
  RunningDrive drive(running());
  const System& system = drive.model->system;
  GroundImpulse ground(system, *drive.scene.steps.method);
  drive.method->set_observer(&ground);
  drive.start();
  const Vector2d begin = momentum(system, drive.method->state());
  drive.run(5e-4);
  const Vector2d change = momentum(system, drive.method->state()) - begin;
  // The last evaluation of a stage is at the state that is kept to 5 % of the error limit,
  // 5e-5 of its scales.
  EXPECT_LT((ground.impulse - change).norm(), 1e-5 * ground.size);

  // Between bodies action equals reaction, and the rest is what is reported.
  Vector2d on_bodies = Vector2d::Zero();
  for (int e = 0; e < system.elements(); ++e) {
    const std::string& name = system.element(e).name();
    const Vector2d sum = sum_of(system, e);
    if (name == "chain joints" || name == "chain arm" || name == "chain intake" ||
        name == "chain exhaust") {
      EXPECT_LT(sum.norm(), 1e-12 * (1.0 + size_of(system, e))) << name;
    }
    on_bodies += sum;
  }
  Vector2d on_ground = Vector2d::Zero();
  for (int k : {0, 1}) {
    const std::string axis = k == 0 ? "_x" : "_y";
    for (const char* name : {"chain_crank", "chain_guide", "spring_tensioner"})
      on_ground(k) += drive.history(name + ("_force" + axis));
    for (const char* name : {"intake", "exhaust", "arm"})
      on_ground(k) -= drive.history("bushing_" + (name + ("_force" + axis)));
  }
  EXPECT_LT((on_ground + on_bodies).norm(), 1e-9 * on_bodies.norm());
}

TEST(DriveInvariant, EnergyIsInputLessLosses) {
  RunningDrive drive(running());
  EnergyBalance energy(drive.model->system, *drive.scene.steps.method);
  drive.method->set_observer(&energy);
  drive.start();
  drive.run(2e-3);
  EXPECT_LT(energy.residue(), 1e-4);
}

}  // namespace
}  // namespace clatter::dynamics
