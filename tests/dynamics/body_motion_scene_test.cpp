// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with reduced parts that have large motion: in space, and in the frame of a drive.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <numbers>

#include "dynamics/body/floating_body.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/law/joint_laws.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/dynamics/truss.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The set of the three displacements of a node.
rom::DofSet node_set(const std::string& name, int node, const Vector3d& position) {
  rom::DofSet set;
  set.kind = "node";
  set.position.resize(3, 3);
  set.direction = Eigen::MatrixXd::Identity(3, 3);
  for (int k = 0; k < 3; ++k) {
    set.dofs.push_back(3 * node + k);
    set.labels.push_back(name + "." + "xyz"[k]);
    set.is_rotation.push_back(0);
    set.position.row(k) = position;
  }
  return set;
}

void set_mass(const testing::Truss& truss, rom::ReducedModel& model) {
  auto& mass = model.mass;
  for (size_t i = 0; i < truss.node.size(); ++i)
    mass.centre += truss.mass[i] * truss.node[i] / mass.mass;
  for (size_t i = 0; i < truss.node.size(); ++i) {
    const Vector3d x = truss.node[i] - mass.centre;
    mass.inertia +=
        truss.mass[i] * (x.squaredNorm() * Eigen::Matrix3d::Identity() - x * x.transpose());
  }
}

/// A mass on springs in a frame, at `place`.
rom::ReducedModel mass_on_springs(double mass, const Vector3d& place, double stiffness) {
  testing::Truss one;
  one.node = {place};
  one.mass = {mass};
  rom::ReducedModel model = one.model();
  model.name = "mass";
  model.K_rr = stiffness * Eigen::MatrixXd::Identity(3, 3);
  model.mass.centre = place;
  model.mass.inertia = 1e-9 * Eigen::Matrix3d::Identity();
  model.sets["point"] = node_set("point", 0, place);
  return model;
}

class PartMotion : public ::testing::Test {
 protected:
  Scene scene(const std::string& text) {
    std::ofstream(folder_ / "motion.run.toml") << text;
    return read_scene(folder_ / "motion.run.toml");
  }
  H5File recorded(const std::string& text) {
    return testing::complete_file(scene(text), folder_ / "motion.run.h5", result_);
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] {
      const Scene described = scene(text);
      build_model(described, load_bodies(described));
    });
  }
  rom::ReducedModel truss_model(const testing::Truss& truss) {
    rom::ReducedModel model = truss.model();
    set_mass(truss, model);
    model.sets["hook"] = node_set("hook", 2, truss.node[2]);
    return model;
  }
  void write(const std::string& name, const rom::ReducedModel& model) {
    testing::write_rom(folder_ / name, model);
  }
  std::filesystem::path folder_ = testing::test_folder();
  RunResult result_;
};

constexpr const char* kFineTime =
    "output_step_us = 500\nlargest_step_us = 1000\n[accuracy]\n"
    "tolerance = 1e-5\ndisplacement_um = 1000\nvelocity_m_s = 0.1\n"
    "arm_mm = 200\n";

TEST_F(PartMotion, InSpaceAPartMovesLikeTheFloatingBodyOfTheLibrary) {
  const testing::Truss truss = testing::octahedron(2e4);
  write("truss.rom.h5", truss_model(truss));
  const Vector3d anchor(0.1, 0.5, 0.2), spin(4.0, 7.0, -3.0), velocity(0.4, 0.1, -0.3);
  const AngleAxisd turn(0.8, Vector3d(1.0, -2.0, 0.5).normalized());
  const Eigen::Quaterniond q(turn);
  const double end = 0.2;
  const H5File file = recorded(fmt::format(
      "gravity_m_s2 = 9.81\n[time]\nend_s = {}\n{}"
      "[[body]]\nname = \"truss\"\nrom = \"truss.rom.h5\"\nmotion = \"space\"\n"
      "centre_mm = [300, -100, 200]\nquaternion = [{:.17g}, {:.17g}, {:.17g}, {:.17g}]\n"
      "start_velocity_m_s = [0.4, 0.1, -0.3]\nstart_spin_rad_s = [4, 7, -3]\n"
      "[[bushing]]\na = {{ body = \"truss\", set = \"hook\" }}\nb = {{ at_mm = [100, 500, 200] }}\n"
      "stiffness_n_m = 500\ndamping_n_s_m = 1\n",
      end, kFineTime, q.w(), q.x(), q.y(), q.z()));

  const ModalBody free = make_modal_body(truss.model(), {});
  const ElasticShapes shapes = mean_axis_shapes(free, truss.invariants());
  ElasticStart start;
  start.frame.rotation = q;
  start.frame.spin = spin;
  start.frame.centre = Vector3d(0.3, -0.1, 0.2) - q * shapes.centre;
  start.frame.velocity = velocity - q * spin.cross(shapes.centre);
  const FloatingBody floating = make_floating_body("truss", shapes, start);
  System system;
  const SpatialBody body = add_spatial_body(system, floating.body);
  const Matrix3X hook = floating.shape(free.shapes.rightCols(12).middleRows<3>(6));
  system.add_element(std::make_unique<PairElement>(
      "hook", body.port(floating.arm(truss.node[2]), hook), std::make_unique<GroundPort>(anchor),
      linear_joint(500.0, 1.0)));
  system.add_load({"weight", 0, -system.bodies()[0].rigid.col(2), [](double) { return 9.81; }});
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy = {1e-5, 1e-3, 0.1, 0.2};
  const auto method = testing::started(system, options);
  while (method->state().time < end) method->step(end);

  const char* axes[] = {"x", "y", "z"};
  // The library's run starts 1e-7 s earlier, at up to 3 m/s.
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(file.read_doubles(std::string("history/truss_") + axes[k]).back(),
                method->state().y(body.coordinates[k]), 1e-6);
  const Eigen::Vector4d attitude = body.quaternion(method->state());
  const char* parts[] = {"w", "x", "y", "z"};
  double dot = 0.0;
  for (int k = 0; k < 4; ++k)
    dot += attitude(k) * file.read_doubles(std::string("history/truss_q") + parts[k]).back();
  EXPECT_NEAR(std::abs(dot), 1.0, 1e-10);
  // The samples are the deformation in the mean axes: displacements of the nodes.
  const VectorXd u = free.shapes.rightCols(12) * floating.W * method->state().eta.tail(12);
  const RowMatrix samples = file.read_rows("bodies/truss/q", 0, file.shape("bodies/truss/q")[0]);
  const VectorXd last = samples.bottomRows(1).transpose();
  EXPECT_GT(u.norm(), 1e-3);
  EXPECT_LT((last - u).norm(), 1e-3 * u.norm());
  EXPECT_LT((free.rigid.transpose() * free.shapes.transpose() * truss.model().M_rr * last).norm(),
            1e-12);
  EXPECT_EQ(file.get_string("bodies/truss", "frame"), "space");
  EXPECT_LT(result_.energy_residue, 1e-4);
}

/// A mass in a frame that a drive with two orders turns about the y axis through (20, 0, 30) mm.
std::string on_drive(double end, const std::string& more) {
  return fmt::format(
             "{}\n[time]\nend_s = {}\n{}[[drive]]\nname = \"rotor\"\naxis = \"y\"\nspeed_rpm = 80\n"
             "start_deg = 35\ncentre_mm = [20, 0, 30]\n[[drive.order]]\norder = 2\namplitude_rpm = "
             "15\n"
             "phase_deg = 20\n[[body]]\nname = \"mass\"\nrom = \"mass.rom.h5\"\ndrive = "
             "\"rotor\"\n",
             more.substr(0, more.find('\n')), end, kFineTime) +
         more.substr(more.find('\n') + 1);
}

Drive rotor() {
  constexpr double kRpm = std::numbers::pi / 30.0, kDegree = std::numbers::pi / 180.0;
  return Drive(80.0 * kRpm, 35.0 * kDegree, {{2.0, 15.0 * kRpm, 20.0 * kDegree}});
}

TEST_F(PartMotion, OnADriveAFreeMassFallsStraightWhateverItsFrameDoes) {
  // Springs of nearly nothing: in space the mass goes on with the speed of its place, and falls.
  const Vector3d place(0.3, 0.1, -0.2), centre(0.02, 0.0, 0.03), axis = Vector3d::UnitY();
  write("mass.rom.h5", mass_on_springs(2.0, place, 1e-9));
  const double end = 0.3;
  const H5File file = recorded(on_drive(end, "gravity_m_s2 = 9.81\n"));
  const Vector3d arm = place - centre;
  const Vector3d fall(0.0, 0.0, -0.5 * 9.81 * end * end);
  const Vector3d in_space = arm + rotor().at(0.0).velocity * axis.cross(arm) * end + fall;
  const double angle = rotor().at(end).position - rotor().at(0.0).position;
  const Vector3d expected = AngleAxisd(-angle, axis) * in_space - arm;
  const RowMatrix q = file.read_rows("bodies/mass/q", 0, file.shape("bodies/mass/q")[0]);
  EXPECT_GT(expected.norm(), 0.3);
  EXPECT_LT((q.bottomRows(1).transpose() - expected).norm(), 1e-4 * expected.norm());
  EXPECT_EQ(file.get_string("bodies/mass", "frame"), "drive");
  EXPECT_LT(result_.energy_residue, 1e-5);
}

TEST_F(PartMotion, OnADriveAPointIsWhereItsFrameAndItsDeformationPutIt) {
  // The same mass on a spring to the ground: in space a harmonic oscillator about its anchor.
  const Vector3d place(0.3, 0.1, -0.2), centre(0.02, 0.0, 0.03), axis = Vector3d::UnitY();
  const double mass = 2.0, k = 300.0, end = 0.3;
  write("mass.rom.h5", mass_on_springs(mass, place, 1e-9));
  const H5File file = recorded(on_drive(
      end,
      "\n[[bushing]]\na = { body = \"mass\", set = \"point\" }\nb = { at_mm = [300, 150, -200] }\n"
      "stiffness_n_m = 300\n"));
  const Vector3d anchor(0.3, 0.15, -0.2), arm = place - centre;
  const double w = std::sqrt(k / mass);
  const Vector3d v = rotor().at(0.0).velocity * axis.cross(arm);
  const Vector3d in_space =
      anchor + (place - anchor) * std::cos(w * end) + v * std::sin(w * end) / w;
  const double angle = rotor().at(end).position - rotor().at(0.0).position;
  const Vector3d expected = AngleAxisd(-angle, axis) * (in_space - centre) - arm;
  const RowMatrix q = file.read_rows("bodies/mass/q", 0, file.shape("bodies/mass/q")[0]);
  EXPECT_LT((q.bottomRows(1).transpose() - expected).norm(), 1e-4 * expected.norm());
  EXPECT_LT(result_.energy_residue, 1e-4);  // the drive works against part of the force
}

TEST(TurningNode, TangentsOfAJointAreTheDifferenceQuotientsOfItsForce) {
  const Drive drive(8.0, 0.3, {{1.0, 1.5, 0.3}});
  std::vector<int> y{0, 1, 2, 3, 4, 5};
  PairElement bushing(
      "joint",
      std::make_unique<TurningNodePort>(drive, Vector3d(0.1, 0.0, 0.2), Vector3d::UnitY(), 0.3,
                                        Vector3d(0.4, 0.3, -0.1), y),
      std::make_unique<GroundPort>(Vector3d(0.2, 0.3, 0.1)), linear_joint(3.0, 0.7));
  EXPECT_LT(testing::tangent_error(bushing, testing::arbitrary(6, 1), testing::arbitrary(6, 2)),
            1e-8);
}

TEST_F(PartMotion, OfThePartsIsPrintedWithTheEffects) {
  write("mass.rom.h5", mass_on_springs(2.0, {0.3, 0.1, -0.2}, 1e3));
  write("truss.rom.h5", truss_model(testing::octahedron(2e4)));
  const Scene described = scene(on_drive(0.1,
                                         "\n[[body]]\nname = \"truss\"\nrom = \"truss.rom.h5\"\n"
                                         "motion = \"space\"\n"));
  std::string all;
  for (const auto& line : build_model(described, load_bodies(described))->effects.lines(false))
    all += line + "\n";
  EXPECT_NE(all.find("large motion of mass"), std::string::npos) << all;
  EXPECT_NE(all.find("drive = \"rotor\": eq. (9), prescribed"), std::string::npos) << all;
  EXPECT_NE(all.find("motion = \"space\": eq. (9), mean axes"), std::string::npos) << all;
}

TEST_F(PartMotion, OfPartsThatCannotHaveItIsRefused) {
  const testing::Truss truss = testing::octahedron(2e4);
  rom::ReducedModel model = truss_model(truss);
  write("truss.rom.h5", model);
  model.inertia = {};
  write("bare.rom.h5", model);
  write("held.rom.h5", mass_on_springs(2.0, {0.3, 0.1, -0.2}, 1e3));
  const auto body = [](const std::string& rom, const std::string& keys) {
    return "[time]\nend_s = 0.1\n[[body]]\nname = \"part\"\nrom = \"" + rom + "\"\n" + keys;
  };
  const std::string drive = "[[drive]]\nname = \"rotor\"\naxis = \"x\"\nspeed_rpm = 60\n";
  const std::string space = "motion = \"space\"\n";
  const auto expect = [&](const std::string& text, const std::string& said) {
    EXPECT_NE(refusal(text).find(said), std::string::npos) << refusal(text);
  };
  EXPECT_EQ(refusal(body("truss.rom.h5", space)), "accepted");
  EXPECT_EQ(refusal(body("held.rom.h5", "drive = \"rotor\"\n" + drive)), "accepted");
  expect(body("bare.rom.h5", space), "motion.run.toml:3: part: found no inertia invariants");
  expect(body("bare.rom.h5", "drive = \"rotor\"\n" + drive),
         "bare.rom.h5: found no inertia invariants, expected those of a frame that turns");
  expect(body("held.rom.h5", space),
         "motion.run.toml:3: part: found 0 rigid modes, expected the 6");
  expect(body("held.rom.h5", "drive = \"rotr\"\n" + drive),
         "motion.run.toml:3: drive: no [[drive]] \"rotr\" in the scene, found: rotor");
  expect(body("truss.rom.h5", space + "drive = \"rotor\"\n" + drive),
         "body[0].drive: needs motion = \"rest\"");
  expect(body("truss.rom.h5", "centre_mm = [0, 0, 0]\n"),
         "body[0].centre_mm: needs motion = \"space\"");
  expect(body("truss.rom.h5", space + "model = \"rigid\"\n"),
         "model: model = \"rigid\" and motion = \"space\" exclude each other");
  expect(body("truss.rom.h5", space + "mode_limit_hz = 100\n"),
         "body[0].mode_limit_hz: mode_limit_hz and motion");
  expect(body("truss.rom.h5", space + "quaternion = [1, 1, 0, 0]\n"),
         "body[0].quaternion: found length 1.41421, expected 1");
  expect(
      body("truss.rom.h5", space + "[[load]]\nbody = \"part\"\nset = \"hook\"\ncomponent = \"x\"\n"
                                   "value = 1\n"),
      "load.set: \"part\" moves in space, expected component only, at its centre of mass");
  expect(body("truss.rom.h5", space + "[[mount]]\nbody = \"part\"\nsets = [\"hook\"]\n"
                                      "stiffness_n_m = [1, 1, 1]\n"),
         "mount.body: \"part\" has large motion");
  expect(body("truss.rom.h5", space + "[[bushing]]\na = { body = \"part\" }\nb = {}\n"
                                      "stiffness_n_m = 1\n"),
         "bushing[0].a.set: found nothing, expected a set of the reduced model of \"part\"");
}

}  // namespace
}  // namespace clatter::dynamics
