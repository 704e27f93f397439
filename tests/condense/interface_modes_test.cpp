// SPDX-License-Identifier: GPL-3.0-or-later
// Reduction of the boundary: characteristic constraint modes and the work of a film.
#include "condense/interface/interface_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "condense/condense.hpp"
#include "condense/export/export.hpp"
#include "condense/interface/film_work.hpp"
#include "core/base/artefact.hpp"
#include "core/base/log.hpp"
#include "core/dense/solve.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/modes/analysis.hpp"
#include "tests/condense/box_model.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The box with a patch grid "liner": each patch is one node's displacement along y or -y, a 2 x 8
/// grid on the sides y = 0 and y = 5 of the cells nearest to z = 0.
fe::FeModel lined_box() {
  fe::FeModel model = test::box_model();
  rom::DofSet set;
  set.kind = "contact_grid";
  rom::ContactGrid grid;
  grid.zero_angle = Eigen::Vector3d::UnitY();
  grid.radius = 0.05;
  grid.angle = Eigen::Vector2d(0.0, std::numbers::pi);
  grid.angle_edges = Eigen::Vector4d(-0.5, 0.5, std::numbers::pi - 0.5, std::numbers::pi + 0.5);
  grid.axial = VectorXd::LinSpaced(8, 0.5, 7.5);
  grid.axial_edges = VectorXd::LinSpaced(9, 0.0, 8.0);
  set.position.resize(16, 3);
  set.direction.resize(16, 3);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 8; ++j) {
      const int node = ((2 * 6) + (i == 0 ? 5 : 0)) * 8 + j;  // z = 2
      set.dofs.push_back(3 * node + 1);
      set.labels.push_back("liner[" + std::to_string(i) + "," + std::to_string(j) + "]");
      set.position.row(8 * i + j) = model.nodes.row(node);
      set.direction.row(8 * i + j) = Eigen::RowVector3d::UnitY();
      set.is_rotation.push_back(0);
    }
  model.sets["liner"] = set;
  model.grids["liner"] = grid;
  return model;
}

rom::ReducedModel reduce_with_modes(const fe::FeModel& model, std::vector<std::string> boundary,
                                    std::optional<InterfaceOptions> interface) {
  CondenseOptions options;
  options.boundary = std::move(boundary);
  options.modes.count = 20;
  options.interface = std::move(interface);
  options.inertia_invariants = true;
  set_quiet(true);
  StepClock clock;
  return condense(model, options, clock);
}

VectorXd spectrum(const rom::ReducedModel& model) {
  return dense::symmetric_eigen(model.K_rr, model.M_rr, dense::EigenParts::kValues).values;
}

TEST(InterfaceModes, AllOfThemGiveTheSameModelInOtherCoordinates) {
  const auto model = lined_box();
  const rom::ReducedModel whole = reduce_with_modes(model, {"left", "liner"}, std::nullopt);
  for (const std::vector<std::string>& sets :
       {std::vector<std::string>{"liner"}, std::vector<std::string>{"left", "liner"}}) {
    const rom::ReducedModel turned =
        reduce_with_modes(model, {"left", "liner"}, InterfaceOptions{sets, 1000});
    ASSERT_EQ(turned.size(), whole.size());
    const VectorXd a = spectrum(whole).tail(whole.size() - 6);
    const VectorXd b = spectrum(turned).tail(whole.size() - 6);
    EXPECT_LT((a - b).cwiseQuotient(a).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT(turned.certificate.interface_film_work_error.value(), 1e-9);
    EXPECT_LT(turned.certificate.interface_frequency_error.value(), 1e-9);
    // The static response to opposite forces on two patches: the displacements of these patches.
    const auto answer = [](const rom::ReducedModel& reduced) {
      const auto& dofs = reduced.set("liner").dofs;
      const MatrixXd rows =
          (MatrixXd(2, reduced.size()) << reduced.row_of(dofs[2]), reduced.row_of(dofs[11]))
              .finished();
      const auto& left = reduced.set("left").dofs;
      MatrixXd held(static_cast<Eigen::Index>(left.size()), reduced.size());
      for (size_t k = 0; k < left.size(); ++k)
        held.row(static_cast<Eigen::Index>(k)) = reduced.row_of(left[k]);
      const double stiff = 1e6 * reduced.K_rr.diagonal().maxCoeff();
      const MatrixXd K = reduced.K_rr + stiff * held.transpose() * held;
      return VectorXd(rows *
                      dense::solve_symmetric(K, rows.transpose() * Eigen::Vector2d(1.0, -2.0)));
    };
    // A held coordinate is a spring of 1e6 times the stiffness in both.
    EXPECT_LT((answer(whole) - answer(turned)).norm(), 1e-6 * answer(whole).norm());
  }
}

TEST(InterfaceModes, ErrorsFallWithTheirNumberAndFrequenciesComeFromAbove) {
  const auto model = lined_box();
  const rom::ReducedModel whole = reduce_with_modes(model, {"left", "liner"}, std::nullopt);
  const VectorXd exact = spectrum(whole);
  double last_frequency = 1.0, last_work = 1.0;
  for (const int count : {2, 6, 12}) {
    const rom::ReducedModel small =
        reduce_with_modes(model, {"left", "liner"}, InterfaceOptions{{"liner"}, count});
    EXPECT_EQ(small.size(), whole.size() - 16 + count);
    EXPECT_EQ(small.n_boundary, 9);
    const VectorXd found = spectrum(small);
    for (Eigen::Index j = 6; j < 20; ++j) EXPECT_GE(found[j], exact[j] * (1.0 - 1e-9)) << j;
    const double frequency = small.certificate.interface_frequency_error.value();
    const double work = small.certificate.interface_film_work_error.value();
    EXPECT_LE(frequency, last_frequency);
    EXPECT_LT(work, last_work);
    last_frequency = frequency;
    last_work = work;
  }
  EXPECT_LT(last_work, 0.05);
}

TEST(InterfaceModes, KeepRigidMotionsMassInvariantsAndLoads) {
  const auto model = lined_box();
  for (const std::vector<std::string>& sets :
       {std::vector<std::string>{"liner"}, std::vector<std::string>{"left", "liner"}}) {
    const rom::ReducedModel small =
        reduce_with_modes(model, {"left", "liner"}, InterfaceOptions{sets, 5});
    EXPECT_EQ(small.certificate.rigid_modes.value(), 6.0);
    EXPECT_LT(small.certificate.mass_error.value(), 1e-11);
    EXPECT_LT(small.certificate.inertia_invariants_error.value(), 1e-10);
    const VectorXd resultant = small.rigid.transpose() * small.loads.at("pull");
    const VectorXd expected = model.rigid.transpose() * model.loads.at("pull");
    EXPECT_LT((resultant - expected).norm(), 1e-10 * expected.norm());
    // A patch that was a coordinate moves with the body, and so does the skin.
    const auto& dofs = small.set("liner").dofs;
    for (size_t k = 0; k < dofs.size(); ++k)
      EXPECT_LT((small.row_of(dofs[k]) * small.rigid - model.rigid.row(model.set("liner").dofs[k]))
                    .norm(),
                1e-10);
    const MatrixXd moved = small.skin.T * small.rigid.leftCols(3);
    EXPECT_LT((moved.topRows(3) - MatrixXd::Identity(3, 3)).norm(), 1e-10);
  }
}

TEST(InterfaceModes, TwoMassesOnTheBoundaryHaveTheirHandComputedMode) {
  // Coordinates (a, b, c), a stays; K_SS of (b, c) = [3 -1; -1 3], M_SS = I: modes (1, 1) with 2
  // and (1, -1) with 4. K_SR = (-2, 0), so Psi = K_SS^{-1} (2, 0) = (3, 1) / 4.
  rom::ReducedModel model;
  model.name = "three";
  model.n_boundary = 3;
  model.K_rr = MatrixXd{{2.0, -2.0, 0.0}, {-2.0, 3.0, -1.0}, {0.0, -1.0, 3.0}};
  model.M_rr = MatrixXd::Identity(3, 3);
  model.rigid = MatrixXd::Zero(3, 6);
  model.sets["a"].dofs = {0};
  model.sets["bc"].dofs = {1, 2};
  const auto [small, motions, report] =
      reduce_interface(model, InterfaceOptions{{"bc"}, 1}, MatrixXd(3, 0), 1.0, 1.0);
  EXPECT_EQ(report.modes, 1);
  EXPECT_EQ(motions.rows(), 2);
  EXPECT_NEAR(report.cutoff_hz, std::sqrt(4.0) / (2.0 * std::numbers::pi), 1e-12);
  ASSERT_EQ(small.size(), 2);
  EXPECT_EQ(small.set("a").dofs, (std::vector<int32_t>{0}));
  EXPECT_EQ(small.set("bc").dofs, (std::vector<int32_t>{2, 3}));
  EXPECT_NEAR(small.combined(0, 0), 0.75, 1e-14);
  EXPECT_NEAR(small.combined(1, 0), 0.25, 1e-14);
  EXPECT_NEAR(std::abs(small.combined(0, 1)), 1.0 / std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(small.combined(0, 1), small.combined(1, 1), 1e-14);
  EXPECT_NEAR(small.K_rr(0, 0), 2.0 - 2.0 * 0.75, 1e-14);  // Guyan's stiffness of a
  EXPECT_NEAR(small.K_rr(1, 1), 2.0, 1e-14);
  EXPECT_NEAR(small.K_rr(0, 1), 0.0, 1e-14);
}

TEST(FilmWork, OfAPatchIsForceTimesItsDisplacement) {
  // One patch of 0.05 m * 1 rad by 8 m on a spring of 1 kN/m: W = (p A)^2 / k.
  rom::ReducedModel model;
  model.name = "patch";
  model.n_boundary = 1;
  model.K_rr = MatrixXd::Constant(1, 1, 1000.0);
  model.M_rr = MatrixXd::Identity(1, 1);
  model.sets["liner"].dofs = {0};
  rom::ContactGrid grid;
  grid.radius = 0.05;
  grid.angle = VectorXd::Zero(1);
  grid.angle_edges = Eigen::Vector2d(-0.5, 0.5);
  grid.axial = VectorXd::Constant(1, 4.0);
  grid.axial_edges = Eigen::Vector2d(0.0, 8.0);
  model.grids["liner"] = grid;
  const MatrixXd forces = film_forces(model, "liner");
  EXPECT_NEAR(forces(0, 2), 0.05 * 8.0, 1e-15);  // peak of the middle field on the patch
  EXPECT_EQ(forces.rightCols(5).norm(), 0.0);    // zero on the other side
  const VectorXd work = static_work(model.K_rr, model.M_rr, MatrixXd(1, 0), forces);
  EXPECT_NEAR(work[2], 0.4 * 0.4 / 1000.0, 1e-18);
}

/// The most static work that four interface modes can miss, of all pressures p with p^T A p = 1
/// on the liner while the rest of the boundary is held.
double worst_missed_work(bool by_area) {
  const auto model = lined_box();
  const rom::ReducedModel whole = reduce_with_modes(model, {"left", "liner"}, std::nullopt);
  const rom::ReducedModel small =
      reduce_with_modes(model, {"left", "liner"}, InterfaceOptions{{"liner"}, 4, 0.0, by_area});
  const MatrixXd K = whole.K_rr.block(9, 9, 16, 16), Phi = small.combined.middleCols(9, 4);
  const MatrixXd kept = Phi * dense::solve_symmetric(Phi.transpose() * K * Phi, Phi.transpose());
  const MatrixXd missed = dense::solve_symmetric(K, MatrixXd::Identity(16, 16)) - kept;
  const VectorXd root = patch_areas(model.grids.at("liner")).cwiseSqrt();
  const MatrixXd weighted = root.asDiagonal() * missed * root.asDiagonal();
  return dense::symmetric_eigen(weighted, dense::EigenParts::kValues).values.maxCoeff();
}

TEST(InterfaceModes, ByAreaMissTheLeastWorkOfAnyPressure) {
  // Of all bases of four vectors the one by area has the smallest worst case: Eckart and Young.
  EXPECT_LE(worst_missed_work(true), (1.0 + 1e-9) * worst_missed_work(false));
  EXPECT_GT(worst_missed_work(true), 0.0);
}

TEST(InterfaceModes, RoundTripInTheFileAndKeepPlacesInRange) {
  const std::filesystem::path path =
      std::filesystem::path(::testing::TempDir()) / "clatter_interface.rom.h5";
  const rom::ReducedModel small =
      reduce_with_modes(lined_box(), {"left", "liner"}, InterfaceOptions{{"liner"}, 5});
  H5File file = H5File::create(path);
  write_provenance(file, {"clatter/rom/1", "", {}});
  rom::write_reduced_model(file, small);
  file.commit();
  const rom::ReducedModel back = rom::read_reduced_model(path);
  EXPECT_EQ(back.combined, small.combined);
  EXPECT_EQ(back.set("liner").dofs, small.set("liner").dofs);
  EXPECT_EQ(back.grid("liner").radius, 0.05);
  EXPECT_EQ(back.dof_count(), small.size() + 16);
}

TEST(BadInput, OtherProgramsAndFixedSetsDoNotGetAReducedInterface) {
  const rom::ReducedModel small =
      reduce_with_modes(lined_box(), {"left", "liner"}, InterfaceOptions{{"liner"}, 5});
  test::expect_parts(test::refusal_of([&] { export_reduced(small, "part.mtx"); }),
                     {"16", "interface modes", "[interface]"});
  modes::ModesOptions modes;
  modes.count = 2;
  modes.fixed = {"liner"};
  test::expect_parts(test::refusal_of([&] { modes::analyse(small, modes); }),
                     {"liner", "interface modes"});
}

TEST(BadInput, InterfacesThatMakeNoSenseAreRefused) {
  const auto parse = [](const std::string& table) {
    return test::refusal_of([&] {
      condense_keys().read(Config::parse(
          "boundary = [\"left\", \"liner\"]\ncount = 4\n[interface]\n" + table, "box.rom.toml"));
    });
  };
  EXPECT_EQ(parse("modes = 3\n"), "accepted");
  test::expect_parts(parse("modes = 3\nfmax_hz = 3.0\n"), {"modes", "fmax_hz"});
  test::expect_parts(parse("sets = [\"liner\"]\n"), {"modes", "fmax_hz"});
  test::expect_parts(parse("sets = [\"lin\"]\nmodes = 3\n"), {"box.rom.toml:4", "lin", "left"});
  test::expect_parts(parse("fmax_hz = 3.0\nweight = \"area\"\n"), {"area", "fmax_hz"});
  test::expect_parts(parse("modes = 3\nsize = 2\n"), {"size"});
  const auto reduced = [](std::vector<std::string> sets, bool by_area) {
    return test::refusal_of([&] {
      reduce_with_modes(lined_box(), {"left", "point", "liner"},
                        InterfaceOptions{std::move(sets), 3, 0.0, by_area});
    });
  };
  test::expect_parts(reduced({"left", "liner"}, false), {"interface.sets", "3 of 6"});
  test::expect_parts(reduced({"point"}, true), {"area", "point", "contact grids"});
}

}  // namespace
}  // namespace clatter::condense
