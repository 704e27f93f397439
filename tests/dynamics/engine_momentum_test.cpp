// SPDX-License-Identifier: GPL-3.0-or-later
// The momentum of a whole engine - block, pistons, rods and ideal crank - and the impulses on it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "dynamics/cylinder/cylinder_component.hpp"
#include "dynamics/cylinder/cylinder_rod.hpp"
#include "dynamics/element/mount.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/integrate/dirk.hpp"
#include "dynamics/run/model.hpp"
#include "tests/dynamics/rod_truss.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Wrench6 = Eigen::Matrix<double, 6, 1>;

/// Modal coordinates of the unit motions of the whole about the engine's origin, N x 6, with every
/// body at its ideal position.
MatrixXd motions_of_whole(const Model& model, double time) {
  const System& system = model.system;
  std::map<int, Vector3d> frames;
  for (const MovingFrames* moving : components_of<MovingFrames>(model))
    frames.merge(moving->frames(time));
  MatrixXd motions(system.modes(), 6);
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
    Eigen::Matrix<double, 6, 6> motion = Eigen::Matrix<double, 6, 6>::Identity();
    if (frames.count(b) > 0)
      for (int k = 0; k < 3; ++k)
        motion.topRightCorner<3, 3>().col(k) = Vector3d::Unit(k).cross(frames.at(b));
    const ModalBody& body = system.bodies()[b];
    motions.middleRows(system.mode_offset(b), body.modes()) = body.rigid * motion;
  }
  return motions;
}

/// Linear momentum of the ideal motion of all pistons and rods [N s]; their rate [N].
Motion<Vector3d> ideal_momentum(const Model& model, double time) {
  Motion<Vector3d> sum{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  for (const CylinderComponent* cylinder : components_of<CylinderComponent>(model)) {
    const std::string prefix = cylinder->name().empty() ? "" : cylinder->name() + "_";
    const SliderCrank& crank = cylinder->crank();
    for (const ModalBody& body : model.system.bodies()) {
      if (body.name == prefix + "piston") {
        const auto stroke = crank.piston_pin(time);
        sum.position.z() += body.mass * stroke.velocity;
        sum.velocity.z() += body.mass * stroke.acceleration;
      } else if (body.name == prefix + "rod") {
        const auto centre = rod_centre(cylinder->spec().engine.rod, crank, time);
        sum.position.tail<2>() += body.mass * centre.velocity;
        sum.velocity.tail<2>() += body.mass * centre.acceleration;
      }
    }
  }
  return sum;
}

/// Sums the forces of the mounts, and of them and the frames' inertia, over a run with the weights
/// of the method.
class Impulses : public StageObserver {
 public:
  Impulses(const Model& model, const Tableau& method) : model_(model), method_(method) {}

  void stage(int index, const StageState& state) override {
    Stage3& at = stages_[index];
    at.mounts = mounts(state.time);
    at.inertia = -ideal_momentum(model_, state.time).velocity;
  }
  void accept(double dt) override {
    for (int i = 0; i <= method_.stages; ++i) {
      const double weight = dt * method_.b[i];
      of_mounts += weight * stages_[i].mounts.head<3>();
      of_inertia += weight * stages_[i].inertia;
      size += std::abs(weight) *
              (stages_[i].mounts.head<3>().cwiseAbs() + stages_[i].inertia.cwiseAbs());
    }
    stages_[0] = stages_[method_.stages];
  }
  /// Forces of the ground on the engine in the last stage, passed on.
  Wrench6 mounts(double time) const {
    const System& system = model_.system;
    Wrench6 sum = Wrench6::Zero();
    const MatrixXd motions = motions_of_whole(model_, time);
    for (int e = 0; e < system.elements(); ++e) {
      if (dynamic_cast<const Mount*>(&system.element(e)) == nullptr) continue;
      if (system.passed_force(e).size() == 0) continue;  // before the first stage
      VectorXd f = VectorXd::Zero(system.interface_size());
      scatter_add(system.passed_force(e), system.element(e).coordinates(), f);
      VectorXd g = VectorXd::Zero(system.modes());
      system.add_interface_force(f, g);
      sum += motions.transpose() * g;
    }
    return sum;
  }

  Vector3d of_mounts = Vector3d::Zero(), of_inertia = of_mounts, size = of_mounts;  // [N s]

 private:
  struct Stage3 {
    Wrench6 mounts = Wrench6::Zero();
    Vector3d inertia = Vector3d::Zero();
  };
  const Model& model_;
  const Tableau& method_;
  Stage3 stages_[3];
};

struct Engine {
  std::string name;
  int cylinders;
  std::string rod;
};

class EngineMomentum : public ::testing::TestWithParam<Engine> {
 protected:
  void SetUp() override {
    testing::write_slap_scene(folder_);
    testing::write_rom(folder_ / "block.rom.h5", testing::four_bore_block(0.0535, 4, 3));
    testing::write_rom(folder_ / "piston.rom.h5",
                       testing::rigid_piston(1.9, 4e-3, std::numbers::pi * 0.0535 * 0.0535));
    testing::write_rom(folder_ / "rod.rom.h5", testing::rod_model(testing::rod_truss(2e9, 0.3)));
    std::string text = "[time]\nramp_deg = 20\n" + testing::dry_engine(1e3) + GetParam().rod;
    for (int k = 1; k <= GetParam().cylinders; ++k) text += testing::in_line_cylinder(k);
    scene_ = std::make_unique<Scene>(testing::changed_scene(folder_, text));
    bodies_ = load_bodies(*scene_);
  }

  /// From rest to 6 ms after the ramp of the start in steps of at most `step`, those of `exact`
  /// equations equal; `each` gets what comes after the ramp.
  template <class EachStep>
  void run(double step, EachStep each, bool exact = false) {
    model_ = build_model(*scene_, bodies_);
    model_->system.keep_forces();
    StepOptions options;
    options.method = &sdirk2();
    options.largest = step;
    options.fixed = exact;
    options.accuracy = {exact ? 1e-7 : 1e-2, 1e-5, 0.1, 0.05};
    Dirk method(model_->system, options);
    Impulses impulses(*model_, sdirk2());
    method.set_observer(&impulses);
    const double begin = scene_->time.begin, ramp = begin + scene_->time.ramp, end = ramp + 6e-3;
    const VectorXd rest = VectorXd::Zero(model_->system.modes());
    method.start(begin, rest, rest);
    while (method.state().time < ramp) method.step(ramp);
    each(method.state(), impulses);
    while (method.state().time < end) {
      method.step(end);
      each(method.state(), impulses);
    }
  }
  Vector3d momentum(const StageState& state) const {
    return (motions_of_whole(*model_, state.time).leftCols<3>().transpose() *
            model_->system.inertia().cwiseProduct(state.v));
  }

  /// The joint of an end of the rod, and what it has passed on to the rod, (y, z) [N].
  struct RodEnd {
    const PairElement* joint;
    Eigen::Vector2d force;
  };
  RodEnd rod_end(const CylinderComponent& cylinder, bool small) const {
    const std::string name = cylinder.name() + (small ? "_pin" : "_crank_pin");
    const System& system = model_->system;
    for (int e = 0; e < system.elements(); ++e) {
      const auto* joint = dynamic_cast<const PairElement*>(&system.element(e));
      if (joint == nullptr || joint->name() != name) continue;
      const VectorXd& passed = system.passed_force(e);  // the rod's coordinates are the last
      const int of_rod = GetParam().rod.empty() ? 3 : 5;
      return {joint, passed.segment<2>(passed.size() - of_rod)};
    }
    throw std::runtime_error(name);
  }
  /// What the rod's own rotation, and its deformation, add to the lever arm of one of its ends [m].
  Eigen::Vector2d turned_arm(const CylinderComponent& cylinder, bool small,
                             const StageState& now) const {
    const RodProperties& rod = cylinder.spec().engine.rod;
    const System& system = model_->system;
    const int body = body_of(cylinder.name() + "_rod");
    const int at = system.mode_offset(body);
    const ModalBody& modal = system.bodies()[body];
    const Eigen::VectorXd dofs = modal.shapes * now.eta.segment(at, modal.modes());
    const double phi = cylinder.crank().rod_angle(now.time).position;
    const auto in_space = [](double angle, const Eigen::Vector2d& own) -> Eigen::Vector2d {
      return Eigen::Rotation2Dd(angle) * own;
    };
    const Eigen::Vector2d arm(-rod.offset, small ? rod.small_arm() : rod.big_arm());
    Eigen::Vector2d bent = Eigen::Vector2d::Zero();
    if (dofs.size() > 3) bent = dofs.segment<2>(3 + (small ? 4 : 1));
    return in_space(phi + dofs(2), arm + bent) - in_space(phi, arm);
  }
  /// Moment of the side force by the skirt's height over the liner beyond the ideal one [N m].
  double height_moment(const CylinderComponent& cylinder, const StageState& now) const {
    const System& system = model_->system;
    const std::vector<int>& at = cylinder.contact()->coordinates();
    const auto lateral = std::find(at.begin(), at.end(), cylinder.pin()[1]) - at.begin();
    for (int e = 0; e < system.elements(); ++e)
      if (&system.element(e) == cylinder.contact())  // the pin's six, then the liner along z
        return system.passed_force(e)(lateral) * (now.y(cylinder.pin()[2]) - now.y(at.back()));
    throw std::runtime_error("no contact");
  }
  /// Moment about x of what a rod's small motions do in its turning frame, which is inertia [N m].
  double frame_moment(const CylinderComponent& cylinder, const MatrixXd& motions) const {
    const System& system = model_->system;
    double sum = 0.0;
    for (int e = 0; e < system.elements(); ++e) {
      if (system.element(e).name() != cylinder.name() + "_rod frame") continue;
      VectorXd f = VectorXd::Zero(system.interface_size()), g = VectorXd::Zero(system.modes());
      scatter_add(system.passed_force(e), system.element(e).coordinates(), f);
      system.add_interface_force(f, g);
      sum += motions.col(3).dot(g);
    }
    return sum;
  }
  int body_of(const std::string& name) const {
    const auto& bodies = model_->system.bodies();
    return static_cast<int>(std::find_if(bodies.begin(), bodies.end(),
                                         [&](const ModalBody& one) { return one.name == name; }) -
                            bodies.begin());
  }

  std::filesystem::path folder_ = testing::test_folder();
  std::unique_ptr<Scene> scene_;
  LoadedBodies bodies_;
  std::unique_ptr<Model> model_;
};

/// The largest change since the first call.
class Drift {
 public:
  void add(const Vector3d& value) {
    if (!first_) first_ = value;
    largest = std::max(largest, (value - *first_).norm());
  }
  double largest = 0.0;

 private:
  std::optional<Vector3d> first_;
};

TEST_P(EngineMomentum, LinearMomentumIsTheImpulseOfTheMounts) {
  std::vector<double> off;
  double worst = 0.0, size = 0.0;
  for (const double step : {4e-5, 2e-5}) {
    Drift deviations, all;
    run(step, [&](const StageState& now, const Impulses& sum) {
      // By the weights of the method: to rounding. With the ideal motion, whose momentum is known:
      // to the order of the method.
      deviations.add(momentum(now) - sum.of_mounts - sum.of_inertia);
      all.add(momentum(now) + ideal_momentum(*model_, now.time).position - sum.of_mounts);
      size = sum.size.norm();
    });
    worst = std::max(worst, deviations.largest);
    off.push_back(all.largest);
  }
  EXPECT_GT(size, 1.0);
  EXPECT_LT(worst, 1e-9 * size);
  EXPECT_LT(off[0], 1e-3 * size);
  EXPECT_GT(off[0] / off[1], 3.0) << off[0] << " " << off[1];
  std::printf("%-16s deviations %.1e, with the ideal motion %.1e, %.1e of %.1f N s\n",
              GetParam().name.c_str(), worst, off[0], off[1], size);
}

TEST_P(EngineMomentum, AngularMomentumLacksLeverArmsOfDeviationsAndNothingElse) {
  // Its rate about the crank's axis is the moment of the mounts and the torque of the drive, crank
  // pin x force. Block and piston have lever arms of the ideal positions, the rod those of its own
  // direction, the liner's pressure that of the skirt where it is: what is left is force x
  // deviation. The forces that are passed on contain a tangent times what Newton's iteration has
  // left, so its equations are solved to their last digits here; the
  // stroke of the skirt follows the tableau, off by 4e-10 m in steps of 40 us.
  double left = 0.0, worst = 0.0, torque = 0.0;
  run(
      2e-5,
      [&](const StageState& now, const Impulses& sum) {
        const System& system = model_->system;
        const MatrixXd motions = motions_of_whole(*model_, now.time);
        VectorXd loads;
        system.load_force(now.time, loads);
        const Wrench6 rate = motions.transpose() * (system.inertia().cwiseProduct(now.a) - loads) -
                             sum.mounts(now.time);
        double drive = 0.0, arms = 0.0;
        for (const CylinderComponent* cylinder : components_of<CylinderComponent>(*model_)) {
          const Eigen::Vector2d crank = cylinder->crank().crank_pin(now.time).position;
          for (const bool small : {false, true}) {
            const auto [joint, force] = rod_end(*cylinder, small);
            if (!small) drive += crank.x() * force.y() - crank.y() * force.x();
            const Eigen::Vector2d arm = turned_arm(*cylinder, small, now);
            arms += arm.x() * force.y() - arm.y() * force.x();
            // The force on the rod acts where that on the pin does, d from the rod's end.
            const Eigen::Vector2d d = joint->last().motion.distance.tail<2>();
            arms += d.x() * force.y() - d.y() * force.x();
          }
          arms += height_moment(*cylinder, now) + frame_moment(*cylinder, motions);
        }
        left = std::max(left, std::abs(rate(3) - drive));
        worst = std::max(worst, std::abs(rate(3) - drive - arms));
        torque = std::max(torque, std::abs(drive));
      },
      true);
  std::printf(
      "%-16s moment left %.2g N m, without those lever arms %.1e, of a torque of %.0f N m\n",
      GetParam().name.c_str(), left, worst, torque);
  EXPECT_GT(torque, 100.0);
  EXPECT_LT(left, 0.02 * torque);
  EXPECT_LT(worst, 1e-9 * torque);
}

INSTANTIATE_TEST_SUITE_P(
    Engines, EngineMomentum,
    ::testing::Values(Engine{"one_cylinder", 1, ""}, Engine{"four_cylinders", 4, ""},
                      Engine{"elastic_rods", 2,
                             "[rod]\nmodel = \"elastic\"\nrom = \"rod.rom.h5\"\n"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace clatter::dynamics
