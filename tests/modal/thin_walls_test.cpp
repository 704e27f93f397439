// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases N15 and N16: sheets, strips, jumps of stiffness and of mass, many bodies, no mass.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/fe/free_motions.hpp"
#include "core/modes/analysis.hpp"
#include "core/modes/compare.hpp"
#include "modal/statics.hpp"
#include "tests/assembly/small_solver.hpp"
#include "tests/condense/solid_model.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/observed.hpp"

namespace clatter::modal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using fe::FeModel;
using ::testing::HasSubstr;

constexpr sparse::EigenMethod kAll[] = {sparse::EigenMethod::kBlockLanczos,
                                        sparse::EigenMethod::kArpack, sparse::EigenMethod::kAmls};
constexpr const char* kClamp = "[[support]]\nname = \"wall\"\nnode_set = \"x0\"\n";

FeModel sheet(double thickness, double nu, const std::string& more = "", int cells = 10) {
  const bool thin = thickness < 0.05;
  return test::solid_bar({0.2, 0.2, thickness}, {cells, cells, thin ? 1 : 4}, nu, more,
                         mesh::CellType::kHex20);
}

sparse::ModeSet modes_of(const FeModel& model, sparse::EigenMethod method, int count) {
  modes::ModesOptions options;
  options.count = count;
  options.method = method;
  return modes::analyse(model, options).modes;
}

TEST(HardN15, SolvesDoNotGrowAsASheetGetsThinAndItsFrequenciesAreThoseOfThePlate) {
  constexpr int kCount = 14;
  for (const sparse::EigenMethod method : kAll) {
    const int64_t compact = modes_of(sheet(0.1, 0.3), method, kCount).solves;
    for (const double t : {5e-3, 1e-3, 1e-4}) {
      const sparse::ModeSet modes = modes_of(sheet(t, 0.3), method, kCount);
      test::expect_at_most("solves of a thin sheet, of those of a compact body",
                           static_cast<double>(modes.solves) / static_cast<double>(compact), 1.5);
      EXPECT_TRUE(modes.proof.proved) << sparse::name_of(method) << " t = " << t;
      EXPECT_EQ(modes.rigid, 6);
      // Free square plate, nu = 0.3 (Leissa 1973): 13.4682 / a^2 sqrt(D / rho t).
      const double D = 2.0e11 * t * t * t / (12.0 * (1.0 - 0.09));
      const double hz = 13.4682 / 0.04 * std::sqrt(D / (8000.0 * t)) / (2.0 * std::numbers::pi);
      // A mesh of ten cells a side, the shear of a plate of t / a = 1 / 40, rounding at t = 0.1 mm.
      EXPECT_NEAR(modes.frequencies_hz()[6], hz, 0.01 * hz)
          << sparse::name_of(method) << " t = " << t;
    }
  }
}

/// A body of 1.35 kg whose motion along z is a coordinate of its own, with a stiff mode.
rom::ReducedModel sliding_body(double stiffness) {
  rom::ReducedModel model;
  model.name = "body";
  model.n_boundary = 1;
  model.M_rr = Eigen::Vector2d(1.35, 1.0).asDiagonal();
  model.K_rr = Eigen::Vector2d(stiffness, 1.5e11).asDiagonal();
  model.rigid = MatrixXd::Zero(2, 6);
  model.rigid(0, 2) = 1.0;
  return model;
}

TEST(HardB4, ARowOfRoundingIsARigidMotion) {
  for (const double rounding : {1.6e-7, -1.6e-7, 0.0}) {
    const rom::ReducedModel model = sliding_body(rounding);
    EXPECT_EQ(fe::free_motions(model, {0, 1}).cols(), 1) << rounding;
    modes::ModesOptions options;
    options.count = 2;
    const sparse::ModeSet found = modes::analyse(model, options).modes;
    EXPECT_EQ(found.rigid, 1) << rounding;
    EXPECT_EQ(found.known_rigid, 1) << rounding;
    EXPECT_LE(found.residuals[0], 1e-6) << rounding;
  }
  // A support of 0.03 Hz is one.
  EXPECT_EQ(fe::free_motions(sliding_body(0.05), {0, 1}).cols(), 0);
}

TEST(HardN15, ACompactBodyPaysNothingForTheSearchOfItsShift) {
  const FeModel model = sheet(0.1, 0.3, "", 6);
  sparse::EigenOptions options;
  options.count = 14;
  options.rigid = fe::free_motions(model).q;
  const sparse::ModeSet found = sparse::solve_modes(model.K, model.M, options);
  options.sigma = found.sigma;
  const sparse::ModeSet given = sparse::solve_modes(model.K, model.M, options);
  EXPECT_EQ(found.factors, 1);
  EXPECT_EQ(found.solves, given.solves);
  EXPECT_EQ(found.values, given.values);
  EXPECT_EQ(found.vectors, given.vectors);
}

TEST(HardN15, SolvesDoNotGrowAsAMaterialBecomesIncompressible) {
  for (const sparse::EigenMethod method : kAll) {
    const int64_t compact = modes_of(sheet(0.1, 0.3, "", 6), method, 14).solves;
    for (const double nu : {0.4999, 0.499999}) {
      const sparse::ModeSet modes = modes_of(sheet(0.1, nu, "", 6), method, 14);
      EXPECT_LE(modes.solves, 3 * compact / 2) << sparse::name_of(method) << " nu = " << nu;
      EXPECT_TRUE(modes.proof.proved);
    }
  }
}

TEST(HardN15, AClampedSheetHasTheFrequenciesOfAllSolvers) {
  const FeModel model = sheet(1e-3, 0.3, kClamp);
  const VectorXd exact = modes_of(model, sparse::EigenMethod::kArpack, 10).frequencies_hz();
  EXPECT_EQ(modes_of(model, sparse::EigenMethod::kArpack, 10).rigid, 0);
  for (const sparse::EigenMethod method : kAll) {
    const VectorXd hz = modes_of(model, method, 10).frequencies_hz();
    const double accuracy = method == sparse::EigenMethod::kAmls ? 5e-3 : 1e-6;  // rounding: 1e-6
    for (int j = 0; j < 10; ++j) EXPECT_NEAR(hz[j], exact[j], accuracy * exact[j]) << j;
  }
}

TEST(HardN15, JumpsOfStiffnessDoNotGrowTheSolvesAnyFurther) {
  mesh::Mesh mesh =
      assembly::testing::block_mesh({8, 8, 3}, assembly::testing::brick({0.2, 0.2, 0.06}),
                                    {mesh::CellType::kHex20, false, false});
  mesh.regions = {"steel", "rubber"};
  const mesh::CellBlock all = mesh.cells.front();
  std::vector<Eigen::Index> in[2];
  for (Eigen::Index c = 0; c < all.nodes.rows(); ++c) {
    double z = 0.0;
    for (Eigen::Index k = 0; k < 8; ++k) z += mesh.nodes(all.nodes(c, k), 2) / 8.0;
    in[z > 0.02 && z < 0.04 ? 1 : 0].push_back(c);
  }
  mesh.cells.clear();
  for (int32_t region = 0; region < 2; ++region)
    mesh.cells.push_back({all.type, region, all.nodes(in[region], Eigen::all), {}});
  set_quiet(true);
  const auto model_of = [&](double jump) {
    const std::string toml = fmt::format(
        "[material.steel]\nregions = [\"steel\"]\nE = 2.0e11\nnu = 0.3\nrho = 8000.0\n"
        "[material.rubber]\nregions = [\"rubber\"]\nE = {}\nnu = 0.3\nrho = 8000.0\n",
        2.0e11 * jump);
    StepClock clock;
    const Config config = Config::parse(toml, "jump.fe.toml");
    return assembly::build_fe_model(mesh, assembly::read_recipe(config, mesh), clock).model;
  };
  for (const sparse::EigenMethod method : kAll) {
    // Frequencies scale with the rubber's alone once the plates are rigid beside it.
    const sparse::ModeSet soft = modes_of(model_of(1e-6), method, 12);
    const sparse::ModeSet softer = modes_of(model_of(1e-10), method, 12);
    EXPECT_TRUE(soft.proof.proved && softer.proof.proved) << sparse::name_of(method);
    // AMLS also counts vectors in substructures, whose number depends on its density estimate.
    EXPECT_LE(softer.solves, (method == sparse::EigenMethod::kAmls ? 4 : 3) * soft.solves / 2)
        << sparse::name_of(method);
    EXPECT_EQ(softer.rigid, 6);  // not twelve: the plates on the rubber are elastic
    for (int j = 6; j < 12; ++j) {
      const double ratio = softer.frequencies_hz()[j] / soft.frequencies_hz()[j];
      // AMLS within its accuracy; else what the plates' own stiffness adds, about 1e-5, and
      // rounding.
      EXPECT_NEAR(ratio, 1e-2, 1e-2 * (method == sparse::EigenMethod::kAmls ? 1e-2 : 1e-3)) << j;
    }
  }
}

TEST(HardN15, AStripIsSolvedToWhatRoundingAllowsAndSaysHowMuchThatIs) {
  for (const auto& [length, thickness, cells] :
       {std::tuple{0.1, 2e-3, 10}, {1.0, 2e-3, 50}, {3.0, 1e-3, 100}}) {
    const FeModel model =
        test::solid_bar({length, 0.02, thickness}, {cells, 1, 1}, 0.0,
                        std::string(kClamp) +
                            "[[load]]\nname = \"tip\"\nkind = \"resultant\"\nsurface = "
                            "\"x1\"\ndirection = [0.0, 0.0, "
                            "1.0]\ntotal = 1.0\n",
                        mesh::CellType::kHex20);
    EXPECT_EQ(fe::free_motions(model).count(), 0);
    const StaticCase tip = solve_static(model, {}).cases[0];
    const double I = 0.02 * std::pow(thickness, 3) / 12.0;
    const double exact = std::pow(length, 3) / (3.0 * 2.0e11 * I);
    double found = 0.0;
    for (Eigen::Index a = 0; a < model.nodes.rows(); ++a)
      found = std::max(found, tip.displacement[3 * a + 2]);
    test::expect_at_most("backward error of a strip", tip.backward_error, 1e-15);
    // Shear contributes (t / l)^2, the full clamp and the mesh about 1e-3; the rest is due to the
    // condition number.
    EXPECT_NEAR(found, exact, (2e-3 + tip.forward_error) * exact) << length;
    EXPECT_LT(tip.forward_error, 1.0) << length;
    EXPECT_GT(tip.forward_error, 1e-16 * std::pow(length / thickness, 2)) << length;
  }
}

TEST(HardN16, AHeavyTipMassLeavesElasticModesThatAreElastic) {
  const FeModel model = test::solid_bar(
      {0.5, 0.02, 0.02}, {20, 2, 2}, 0.3,
      std::string(kClamp) +
          "[[coupling]]\nname = \"tip\"\ntype = \"rigid\"\nsurface = \"x1\"\n"
          "[[point_mass]]\non = \"tip\"\nmass = 1.0e7\ninertia = [1e3, 1e3, 1e3]\n");
  const sparse::ModeSet modes = modes_of(model, sparse::EigenMethod::kBlockLanczos, 10);
  EXPECT_EQ(modes.rigid, 0);
  EXPECT_TRUE(modes.proof.proved);
  const VectorXd hz = modes.frequencies_hz();
  // Massless cantilever with the mass at its end: sqrt(3 E I / m l^3) in the lowest two.
  const double I = std::pow(0.02, 4) / 12.0;
  const double tip = std::sqrt(3.0 * 2e11 * I / (1e7 * 0.125)) / (2.0 * std::numbers::pi);
  test::expect_at_most("error of the first frequency", std::abs(hz[0] / tip - 1.0), 0.02);
  EXPECT_NEAR(hz[1], tip, 0.02 * tip);
  for (int j = 0; j < 6; ++j) EXPECT_LT(hz[j], 5.0);
  test::expect_at_least("first frequency of the beam itself [Hz]", hz[6], 100.0);  // the beam's own
  modes::ModesOptions lowest;
  lowest.count = 6;
  for (const std::string& line : modes::describe(modes::analyse(model, lowest)))
    EXPECT_THAT(line, ::testing::Not(HasSubstr("  rigid"))) << line;
}

TEST(HardN16, TwoPartsInOneMeshHaveTwelveRigidMotions) {
  const auto one = test::spring_box(5, 4, 4);
  const test::Pencil both = test::twice(one);
  MatrixXd rigid(2 * one.rigid.rows(), 6);
  rigid << one.rigid, one.rigid;
  const fe::FreeMotions free = fe::free_motions(both.K, both.M, rigid);
  EXPECT_EQ(free.bodies, 2);
  EXPECT_EQ(free.count(), 12);
  EXPECT_TRUE(free.all_free());
  const MatrixXd gram = free.q.transpose() * multiply_symmetric(both.M, free.q);
  test::expect_at_most("error of twelve rigid motions",
                       (gram - MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff(), 1e-12);
  for (const sparse::EigenMethod method : kAll) {
    sparse::EigenOptions options = test::by_count(16, method);
    options.rigid = free.q;
    const sparse::ModeSet modes = sparse::solve_modes(both.K, both.M, options);
    EXPECT_EQ(modes.rigid, 12);
    EXPECT_EQ(modes.values.head(12).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_NEAR(modes.values[12] / modes.values[13], 1.0, 1e-12);  // twice, AMLS too
  }
}

TEST(HardN16, ASoftMountHoldsABody) {
  auto box = test::spring_box(5, 4, 4);
  for (int d = 0; d < 3; ++d) box.K.coeffRef(d, d) *= 1.0 + 1e-8;  // springs to the ground
  const fe::FreeMotions free = fe::free_motions(box.K, box.M, box.rigid);
  EXPECT_EQ(free.count(), 3);  // rotations about the supported point
  EXPECT_FALSE(free.all_free());
}

TEST(MasslessUnknowns, GiveInfiniteEigenvaluesThatAreCountedAndLeftOut) {
  // A chain with every second mass removed: springs k / 2 between the others.
  constexpr int n = 801;
  const auto chain = test::free_chain(n);
  SparseMatrix M = chain.M;
  for (int i = 1; i < n; i += 2) M.coeffRef(i, i) = 0.0;
  M.prune(0.0);
  const auto exact = [](int masses, int j) {
    return 4.0 * 5e6 / 0.1 * std::pow(std::sin(j * std::numbers::pi / (2.0 * masses)), 2);
  };
  const MatrixXd motion = VectorXd::Ones(n);
  for (const int limit : {300, 500}) {  // iterative, and condensed onto the 401 masses
    for (const sparse::EigenMethod method : test::kBoth) {
      sparse::EigenOptions options = test::by_count(8, method);
      options.rigid = motion;
      options.dense_limit = limit;
      const sparse::ModeSet modes = sparse::solve_modes(chain.K, M, options);
      EXPECT_EQ(modes.massless, n / 2);
      EXPECT_EQ(modes.rigid, 1);
      EXPECT_TRUE(modes.proof.proved);
      for (int j = 1; j < 8; ++j)
        EXPECT_NEAR(modes.values[j], exact((n + 1) / 2, j), 1e-8 * exact((n + 1) / 2, j)) << j;
    }
  }
}

TEST(FactorFailure, NamesTheNodeTheDirectionAndTheCause) {
  FeModel model = sheet(0.1, 0.3, kClamp, 2);
  model.K.coeffRef(7, 7) = 0.0;
  for (int j = 0; j < model.K.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(model.K, j); it; ++it)
      if (it.row() == 7 || j == 7) it.valueRef() = 0.0;
  model.M.coeffRef(7, 7) = 0.0;
  for (int j = 0; j < model.M.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(model.M, j); it; ++it)
      if (it.row() == 7 || j == 7) it.valueRef() = 0.0;
  try {
    modes_of(model, sparse::EigenMethod::kBlockLanczos, 3);
    FAIL();
  } catch (const sparse::NotPositiveDefinite& error) {
    EXPECT_THAT(error.what(), HasSubstr("at node"));
    EXPECT_THAT(error.what(), HasSubstr("direction"));
    EXPECT_THAT(error.what(), HasSubstr("it has no stiffness and no mass"));
  }
}

}  // namespace
}  // namespace clatter::modal
