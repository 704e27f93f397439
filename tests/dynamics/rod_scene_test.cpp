// SPDX-License-Identifier: GPL-3.0-or-later
// Models of the connecting rod in engine scenes, and the limits in which they agree.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "core/dense/solve.hpp"
#include "dynamics/cylinder/cylinder_component.hpp"
#include "tests/dynamics/rod_truss.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::VectorXd;

/// A dry skirt and joints without clearance: without impacts, after which results of two models
/// differ by when they happened.
constexpr const char* kDryCycle = R"(
[time]
cycles = 1
[contact]
lubrication = "none"
clearance_um = 0.0
asperity_loss_factor = 0.5
[small_end]
clearance_um = 0.0
soft_stiffness_n_m = 0.0
[big_end]
clearance_um = 0.0
soft_stiffness_n_m = 0.0
[accuracy]
tolerance = 1e-5
)";
constexpr const char* kElastic = "[rod]\nmodel = \"elastic\"\nrom = \"rod.rom.h5\"\n";

class RodModels : public testing::SlapScenes {
 protected:
  void write_rod(double stiffness, double skew = 0.0) {
    testing::write_rom(folder_ / "rod.rom.h5",
                       testing::rod_model(testing::rod_truss(stiffness, skew)));
  }
  /// [rod] with the masses of the truss.
  static std::string rigid_twin(const std::string& more = "") {
    const rom::ReducedModel model = testing::rod_model(testing::rod_truss(1e9));
    const Eigen::Matrix<double, 6, 6> M = model.rigid.transpose() * model.M_rr * model.rigid;
    const double centre = M(1, 3) == 0.0 ? 0.0 : -M(1, 3) / M(1, 1);
    return fmt::format("[rod]\nmass_kg = {:.17g}\ninertia_kg_m2 = {:.17g}\ncentre_mm = {:.17g}\n{}",
                       M(1, 1), M(3, 3) - M(1, 1) * centre * centre, 1e3 * centre, more);
  }
  H5File run(const std::string& text, const std::string& name) {
    return recorded(scene(kDryCycle + text), name);
  }
  /// The elastic rod with its rigid motions alone.
  H5File run_without_modes(const std::string& name) {
    const Scene described = scene(std::string(kDryCycle) + kElastic);
    LoadedBodies bodies = load_bodies(described);
    for (LoadedBody& body : bodies) {
      if (body.spec.name != "rod") continue;
      BodySpec spec = body.spec;
      spec.elastic = false;
      rom::ReducedModel model = body.model;
      const std::string hash = body.sha256;
      body = make_loaded_body(spec, model);
      body.sha256 = hash;
    }
    RunControl control;
    control.output = folder_ / (name + ".run.h5");
    result_ = simulate(described, bodies, control);
    EXPECT_TRUE(result_.complete) << result_.failure;
    return testing::finished_file(described, bodies, result_);
  }
};

/// Difference of the piston's motion (y, z, rx), as root of mean squares, relative to its range.
double difference(const H5File& a, const H5File& b) {
  double worst = 0.0;
  const RowMatrix x = a.read_rows("bodies/piston/q"), y = b.read_rows("bodies/piston/q");
  for (const int dof : {1, 2, 3})
    worst = std::max(worst, (x.col(dof) - y.col(dof)).norm() /
                                std::sqrt(static_cast<double>(x.rows())) /
                                (x.col(dof).maxCoeff() - x.col(dof).minCoeff()));
  return worst;
}

TEST_F(RodModels, TwoMassesAreTheRigidRodOfTheirInertiaToTheBit) {
  const RodProperties two = two_mass_rod({210.0 * 1e-3, 2.2, 0.0, 70.0 * 1e-3});
  EXPECT_NEAR(two.inertia, 2.2 / 3.0 * 0.14 * 0.14 + 2.2 * 2.0 / 3.0 * 0.07 * 0.07, 1e-16);
  const H5File a = run("[rod]\nmodel = \"two-mass\"\n", "two");
  const H5File b = run(fmt::format("[rod]\ninertia_kg_m2 = {:.17g}\n", two.inertia), "rigid");
  for (const std::string& name : a.list("history"))
    EXPECT_EQ(a.read_doubles("history/" + name), b.read_doubles("history/" + name)) << name;
  EXPECT_GT(difference(a, run("", "sample")), 1e-4);  // 0.02 kg m2: it matters
}

TEST_F(RodModels, AMasslessRodIsTheLimitOfALightOne) {
  const H5File massless = run("[rod]\nmodel = \"massless\"\n", "massless");
  EXPECT_LT(result_.energy_residue, 1e-4);
  std::vector<double> off;
  for (const double share : {0.08, 0.04, 0.02})
    off.push_back(difference(
        run(fmt::format("[rod]\nmass_kg = {}\ninertia_kg_m2 = {}\n", 2.2 * share, 0.02 * share),
            "light"),
        massless));
  EXPECT_NEAR(off[0] / off[1], 2.0, 0.1) << off[0] << " " << off[1];
  EXPECT_NEAR(off[1] / off[2], 2.0, 0.1) << off[1] << " " << off[2];
}

TEST_F(RodModels, AnElasticRodWithoutModesIsTheRigidOne) {
  write_rod(1e9);
  const H5File rigid = run(rigid_twin(), "rigid");
  const H5File elastic = run_without_modes("elastic");
  EXPECT_LT(difference(rigid, elastic), 1e-6);
  EXPECT_LT(elastic.read_rows("bodies/rod/q").cwiseAbs().maxCoeff(), 1e-15);
}

TEST_F(RodModels, AStiffElasticRodIsTheRigidOneInFirstOrderOfItsCompliance) {
  const H5File rigid = run(rigid_twin(), "rigid");
  std::vector<double> off;
  for (const double stiffness : {1e10, 2e10, 1e13}) {
    write_rod(stiffness);
    off.push_back(difference(rigid, run(kElastic, "elastic")));
  }
  EXPECT_NEAR(off[0] / off[1], 2.0, 0.2) << off[0] << " " << off[1];
  EXPECT_LT(off[2], 1e-5);
}

TEST_F(RodModels, UnderStaticGasForceARodIsShorterByItsCompliance) {
  const double stiffness = 2e8;
  write_rod(stiffness);
  std::ofstream(folder_ / "constant.csv") << "crank_angle [deg], pressure [bar]\n";
  for (int degrees = -360; degrees <= 360; degrees += 10)
    std::ofstream(folder_ / "constant.csv", std::ios::app) << degrees << ", 60\n";
  const H5File file =
      run(std::string("[engine]\nspeed_rpm = 40\n[gas]\ntable = \"constant.csv\"\n") + kElastic,
          "slow");
  // The truss alone, held at the big end in three directions and pulled at the small end.
  const testing::Truss truss = testing::rod_truss(stiffness);
  Eigen::MatrixXd K = truss.stiffness_matrix();
  const double typical = K.trace() / static_cast<double>(K.rows());
  const rom::ReducedModel model = truss.model();
  K += typical * model.rigid * model.rigid.transpose();  // rigid motions are held; loads have none
  VectorXd pull = VectorXd::Zero(truss.size());
  pull(5) = 1.0;
  pull(2) = -1.0;
  const double compliance = pull.dot(dense::solve(K, pull).col(0));
  const Eigen::MatrixXd q = file.read_rows("bodies/rod/q");
  const std::vector<double> y = file.read_doubles("history/pin_force_y"),
                            z = file.read_doubles("history/pin_force_z");
  // At both ends of the cycle, where the rod is upright: histories are at steps, samples are not.
  const double force = std::hypot(y.back(), z.back());
  const Eigen::Index end = q.rows() - 1;
  EXPECT_NEAR(force, 59e5 * 8.992e-3, 100.0);
  EXPECT_NEAR(q(end, 5) - q(end, 2), -force * compliance, 1e-4 * force * compliance);
}

TEST_F(RodModels, EnergyBalancesWithEachOfThemOnAnElasticBlock) {
  write_rod(2e8, 0.3);
  const std::string engine = std::string(testing::kElasticBlock) +
                             "[[mount]]\nsets = [\"mounts\"]\nstiffness_n_m = [1e5, 1e5, 2e5]\n"
                             "damping_n_s_m = [1e3, 1e3, 2e3]\n";
  for (const std::string& rod :
       {std::string("[rod]\nmodel = \"massless\"\n"), std::string("[rod]\nmodel = \"two-mass\"\n"),
        std::string(kElastic)}) {
    run(engine + rod, "block");
    EXPECT_LT(result_.energy_residue, 1e-4) << rod;
    std::printf("energy residue %.1e with %s\n", result_.energy_residue, rod.c_str());
  }
}

TEST_F(RodModels, AreReportedWithWhatTheyDoNotUse) {
  write_rod(2e8);
  const auto effects = [&](const std::string& rod) {
    const Scene described = scene(rod);
    std::string all;
    for (const auto& line : build_model(described, load_bodies(described))->effects.lines(false))
      all += line + "\n";
    return all;
  };
  const auto expect = [&](const std::string& rod, const std::string& said) {
    EXPECT_NE(effects(rod).find(said), std::string::npos) << effects(rod);
  };
  expect("[rod]\nmodel = \"two-mass\"\n", "0.02156 kg m2, +7.8 % of rod.inertia_kg_m2");
  expect("[rod]\nmodel = \"massless\"\n", "rod.model = \"massless\": a bar between its joints");
  expect(kElastic, "rod.model = \"elastic\": eq. (9), turning frame; 2.2 kg, 0.0");
  expect(kElastic, "elastic rod");
}

TEST_F(RodModels, AreRefusedWithTheKeyThatIsWrong) {
  write_rod(2e8);
  const auto expect = [&](const std::string& rod, const std::string& said) {
    EXPECT_NE(refusal("[rod]\n" + rod).find(said), std::string::npos) << refusal("[rod]\n" + rod);
  };
  expect("model = \"stiff\"\n", "changed.run.toml:3: rod.model: found \"stiff\"");
  expect("model = \"elastic\"\n", "rod.rom: ");
  expect("model = \"two-mass\"\ncentre_mm = 0\n",
         "changed.run.toml:4: rod.centre_mm: found 0 with model = \"two-mass\"");
  expect("model = \"massless\"\nmass_kg = -1\n", "changed.run.toml:4: rod.mass_kg: found -1");
  expect("model = \"elastic\"\nrom = \"rod.rom.h5\"\nlength_mm = 211\n",
         "changed.run.toml:5: rod.length_mm: found 211, but in ");
  expect(
      "model = \"elastic\"\nrom = \"rod.rom.h5\"\nbig_end = \"small_end\"\nsmall_end = "
      "\"big_end\"\n",
      "is at (0, 0, -210) mm from the big end \"small_end\", expected (0, 0, 210)");
  expect("model = \"elastic\"\nrom = \"rod.rom.h5\"\nbig_end = \"eye\"\n",
         "rod: no set named eye, expected one of: big_end");
  expect("model = \"elastic\"\nrom = \"piston.rom.h5\"\n", "found no inertia invariants");
  expect("model = \"elastic\"\nrom = \"bar.rom.h5\"\n", "rigid modes, expected the 6 of a rod");
  expect("model = \"elastic\"\nrom = \"rod.rom.h5\"\nmode_limit_hz = -1\n",
         "rod.mode_limit_hz: found -1");
  expect("model = \"massless\"\n[small_end]\nfriction_coefficient = 0.1\ndiameter_mm = 40\n",
         "small_end: friction or an oil film and rod.model = \"massless\" exclude each other");
  expect("model = \"massless\"\n[crank]\nspeed = \"free\"\npolar_kg_m2 = 1\n",
         "rod.model: model = \"massless\" and crank.speed = \"free\" exclude each other");
  EXPECT_EQ(refusal("[rod]\nmodel = \"massless\"\n"), "accepted");
}

}  // namespace
}  // namespace clatter::dynamics
