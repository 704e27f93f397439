// SPDX-License-Identifier: GPL-3.0-or-later
// Craig-Bampton against hand-computed values, against the full model, and its invariants.
#include <gtest/gtest.h>

#include <cmath>

#include "condense/certify/certificate.hpp"
#include "condense/condense.hpp"
#include "condense/rows/skin_faces.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/dense/cholesky.hpp"
#include "core/rom/rigid_mass.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "tests/condense/box_model.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::box_model;

CondenseOptions options_for(std::vector<std::string> boundary, int count) {
  CondenseOptions options;
  options.boundary = std::move(boundary);
  options.modes.count = count;
  options.skin = {};
  if (count == 0) options.method = "guyan";
  return options;
}

rom::ReducedModel reduce(const fe::FeModel& model, const CondenseOptions& options) {
  set_quiet(true);
  StepClock clock;
  return condense(model, options, clock);
}

/// Free modes of the reduced model, with a shift below the first elastic one.
sparse::EigenResult reduced_modes(const rom::ReducedModel& reduced) {
  const double first = reduced.certificate.first_elastic_hz.value();
  return sparse::solve_dense(reduced.K_rr, reduced.M_rr, -0.1 * sparse::value_of_hz(first));
}

TEST(CraigBamptonTest, TheFourMassChainHasItsHandComputedMatrices) {
  // K = tridiag(-1, 2, -1) with last entry 1, M = diag(2, 2, 2, 1), boundary = last mass.
  const fe::FeModel model = test::held_chain();
  const LocalPart part(model, {"end"});
  ModeRequest request;
  request.count = 3;
  set_quiet(true);
  StepClock clock;
  const CraigBampton result = craig_bampton(part, static_part(part, {}, clock), request, clock);
  const MatrixXd &K_rr = result.K_rr, &M_rr = result.M_rr;
  const double eps = 1e-12;  // a few rounding errors of numbers of order one
  const Eigen::Vector4d expected(0.25, 1.0 - 1.0 / std::sqrt(2.0), 1.0, 1.0 + 1.0 / std::sqrt(2.0));
  EXPECT_LT((K_rr - MatrixXd(expected.asDiagonal())).cwiseAbs().maxCoeff(), eps);
  EXPECT_NEAR(M_rr(0, 0), 2.75, eps);
  EXPECT_NEAR(std::abs(M_rr(0, 1)), (1.0 + std::sqrt(2.0)) / 2.0, eps);
  EXPECT_NEAR(std::abs(M_rr(0, 2)), 0.5, eps);
  EXPECT_NEAR(std::abs(M_rr(0, 3)), (std::sqrt(2.0) - 1.0) / 2.0, eps);  // 0.207107
  EXPECT_LT((M_rr.bottomRightCorner(3, 3) - MatrixXd::Identity(3, 3)).norm(), eps);
}

TEST(CraigBamptonTest, EveryModeBelowHalfTheCutOffIsWithinATenthOfAPercent) {
  const auto model = box_model();
  CondenseOptions options = options_for({"left", "right", "point"}, 0);
  options.method = "craig-bampton";
  const VectorXd full =
      sparse::solve_dense(sparse::dense_symmetric(model.K), sparse::dense_symmetric(model.M),
                          sparse::default_shift(model.K, model.M))
          .values;
  options.modes.fmax_hz = sparse::hz_of_value(full[70]);
  const rom::ReducedModel reduced = reduce(model, options);
  const VectorXd small = reduced_modes(reduced).values;
  int compared = 0;
  for (Eigen::Index j = 6; sparse::hz_of_value(full[j]) < 0.5 * options.modes.fmax_hz; ++j) {
    const double f = sparse::hz_of_value(full[j]);
    EXPECT_NEAR(sparse::hz_of_value(small[j]), f, 1e-3 * f) << j;
    EXPECT_GE(small[j], full[j] * (1.0 - 1e-9)) << "a subspace cannot lower a mode";
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

TEST(CraigBamptonTest, ResidualModesRemoveTheErrorThatTheEstimateNames) {
  const auto model = box_model();
  const VectorXd full =
      sparse::solve_dense(sparse::dense_symmetric(model.K), sparse::dense_symmetric(model.M),
                          sparse::default_shift(model.K, model.M))
          .values;
  CondenseOptions options = options_for({"left", "right", "point"}, 0);
  options.method = "craig-bampton";
  options.modes.fmax_hz = sparse::hz_of_value(full[70]);
  double without = 0.0, with = 0.0;
  for (const double target : {0.0, 1e-5}) {
    options.modes.frequency_error = target;
    const rom::ReducedModel reduced = reduce(model, options);
    const VectorXd small = reduced_modes(reduced).values;
    double largest = 0.0;
    for (Eigen::Index j = 6; sparse::hz_of_value(full[j]) < 0.5 * options.modes.fmax_hz; ++j)
      largest = std::max(largest, std::sqrt(small[j] / full[j]) - 1.0);
    const double estimate = reduced.certificate.frequency_error_estimate.value();
    // First order in the error, for modes up to half of the cut-off: (f / f_cut)^2 = 1/4 is left.
    EXPECT_NEAR(estimate, largest, 0.4 * largest + 1e-9) << target;
    (target == 0.0 ? without : with) = largest;
    EXPECT_EQ(reduced.certificate.residual_modes.value() > 0.0, target > 0.0);
  }
  EXPECT_LT(with, 1.4e-5);
  EXPECT_GT(without, 10.0 * with);
}

TEST(CraigBamptonTest, AllModesGiveTheFullSpectrum) {
  const auto model = box_model(4, 3, 3);
  const int interior = model.size() - 15;
  const rom::ReducedModel reduced = reduce(model, options_for({"left", "right"}, interior));
  const VectorXd full =
      sparse::solve_dense(sparse::dense_symmetric(model.K), sparse::dense_symmetric(model.M),
                          sparse::default_shift(model.K, model.M))
          .values;
  const VectorXd small = reduced_modes(reduced).values;
  ASSERT_EQ(small.size(), full.size());
  EXPECT_LT((small - full)
                .tail(full.size() - 6)
                .cwiseQuotient(full.tail(full.size() - 6))
                .cwiseAbs()
                .maxCoeff(),
            1e-8);
}

TEST(CraigBamptonTest, GuyanKeepsStaticResponsesExactly) {
  const auto model = box_model();
  const rom::ReducedModel reduced = reduce(model, options_for({"left", "right"}, 0));
  ASSERT_EQ(reduced.size(), 15);
  // Hold "left", pull at "right": the full model's displacement there.
  VectorXd force = VectorXd::Zero(model.size());
  const auto& right = model.sets.at("right").dofs;
  for (size_t k = 0; k < right.size(); ++k) force[right[k]] = 1.0 + static_cast<double>(k);
  MatrixXd held = sparse::dense_symmetric(model.K);
  for (const int dof : model.sets.at("left").dofs) {
    held.row(dof).setZero();
    held.col(dof).setZero();
    held(dof, dof) = 1.0;
  }
  const VectorXd u = dense::Cholesky(held).solve(force);
  const VectorXd expected = u(right);
  const VectorXd f_r = force(right);
  const VectorXd found = dense::Cholesky(reduced.K_rr.bottomRightCorner(6, 6)).solve(f_r);
  EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm());
}

TEST(CraigBamptonTest, LoadsDoTheSameWorkOnEveryBasisVector) {
  const auto model = box_model();
  CondenseOptions options = options_for({"left", "right"}, 20);
  options.skin = {"skin"};
  const rom::ReducedModel reduced = reduce(model, options);
  // A rigid shift by x: the work of the load is its resultant.
  const double resultant = model.loads.at("pull").sum();
  EXPECT_NEAR(reduced.loads.at("pull").dot(reduced.rigid.col(0)), resultant, 1e-9 * resultant);
  const double moment = model.loads.at("pull").dot(model.rigid.col(4));
  EXPECT_NEAR(reduced.loads.at("pull").dot(reduced.rigid.col(4)), moment, 1e-9 * std::abs(moment));
}

TEST(CraigBamptonTest, SkinRowsCarryRigidMotionsToTheirNodes) {
  const auto model = box_model();
  CondenseOptions options = options_for({"left", "right"}, 10);
  options.skin = {"skin"};
  const rom::ReducedModel reduced = reduce(model, options);
  const MatrixXd u = reduced.skin.T * reduced.rigid;
  ASSERT_EQ(reduced.skin.triangles.cols(), 6);
  for (Eigen::Index a = 0; a < reduced.skin.nodes.rows(); ++a) {
    const Eigen::Vector3d r = reduced.skin.nodes.row(a);
    const Eigen::Vector3d turned = Eigen::Vector3d::UnitZ().cross(r);
    EXPECT_LT((u.block<3, 1>(3 * a, 5) - turned).norm(), 1e-11);
    EXPECT_LT((u.block<3, 1>(3 * a, 1) - Eigen::Vector3d::UnitY()).norm(), 1e-11);
  }
}

TEST(CraigBamptonTest, BoundaryCoordinatesAreTheDisplacementsOfTheirDofs) {
  const auto model = box_model();
  const rom::ReducedModel reduced = reduce(model, options_for({"right", "left"}, 5));
  EXPECT_EQ(reduced.set("right").dofs.front(), 0);  // order of the sets as given
  EXPECT_EQ(reduced.set("left").dofs.front(), 6);
  for (const std::string name : {"left", "right"}) {
    const auto& full = model.sets.at(name);
    const auto& small = reduced.set(name);
    EXPECT_EQ(small.labels, full.labels);
    for (size_t k = 0; k < full.dofs.size(); ++k)
      EXPECT_LT((reduced.rigid.row(small.dofs[k]) - model.rigid.row(full.dofs[k])).norm(), 1e-15);
  }
}

TEST(CertificateTest, MassPropertiesOfARigidMassMatrixAreItsOwn) {
  const auto box = test::spring_box(3, 4, 5);
  const MatrixXd rigid_mass = box.rigid.transpose() * MatrixXd(box.M) * box.rigid;
  const rom::MassProperties found = rom::properties_of(rigid_mass);
  EXPECT_LT(compare_mass(found, test::point_mass_properties(box)).largest(), 1e-13);
}

TEST(CertificateTest, SaysWhetherTheCountWasProved) {
  const auto model = box_model();
  CondenseOptions options = options_for({"left", "right"}, 10);
  EXPECT_EQ(reduce(model, options).certificate.count_proved.value(), 1.0);
  options.modes.prove_count = false;
  EXPECT_EQ(reduce(model, options).certificate.count_proved.value(), 0.0);
}

TEST(Skin, TrianglesOfEachSurfaceOfTheModelAreKnown) {
  fe::FeModel model = box_model();
  model.surfaces["quads"].faces = {{mesh::FaceType::kQuad4, IndexMatrix{{10, 11, 17, 16}}}};
  IndexMatrix both = model.surfaces["skin"].faces[0].nodes.topRows(2);
  model.surfaces["part"].faces = {{mesh::FaceType::kTri6, both.bottomRows(1)},
                                  {mesh::FaceType::kQuad4, IndexMatrix{{10, 11, 17, 16}}}};
  model.surfaces["elsewhere"].faces = {{mesh::FaceType::kTri3, IndexMatrix{{0, 1, 2}}}};
  const SkinFaces faces = skin_faces(model, {"quads", "skin"});
  // The quadrilateral is two triangles, the first of the skin; the second triangle of "skin" is row
  // 3. "elsewhere" has no face of this skin.
  ASSERT_EQ(faces.of_surface.size(), 3u);
  EXPECT_EQ(faces.of_surface.at("quads"), (std::vector<int32_t>{0, 1}));
  EXPECT_EQ(faces.of_surface.at("part"), (std::vector<int32_t>{0, 1, 3}));
  EXPECT_EQ(faces.of_surface.at("skin").front(), 2);
  EXPECT_EQ(faces.of_surface.at("skin").size(),
            static_cast<size_t>(model.surfaces["skin"].faces[0].nodes.rows()));
}

TEST(BadInput, UnknownSetsAndSurfacesNameThosePresent) {
  const auto model = box_model();
  try {
    reduce(model, options_for({"left", "rigth"}, 5));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("right"), std::string::npos) << error.what();
  }
  CondenseOptions options = options_for({"left"}, 5);
  options.skin = {"skni"};
  test::expect_parts(test::refusal_of([&] { reduce(model, options); }),
                     {"box: skin: no surface named skni, expected one of: ", "skin"});
}

TEST(BadInput, ABoundaryThatDoesNotHoldTheBodyIsRefusedWithTheMotion) {
  const auto model = box_model();
  try {
    reduce(model, options_for({"point"}, 5));  // one node: three rotations stay free
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("rotation"), std::string::npos) << error.what();
  }
}

TEST(BadInput, AnUnconnectedPartIsNamedByItsPosition) {
  auto model = box_model(4, 3, 3);
  const int n = model.size();
  // A second, free body.
  const auto both = test::twice({model.K, model.M});
  model.K = both.K;
  model.M = both.M;
  model.nodes.conservativeResize(2 * n / 3, 3);
  model.nodes.bottomRows(n / 3) = model.nodes.topRows(n / 3).array() + 1.0;
  model.rigid.conservativeResize(2 * n, 6);
  for (int a = n / 3; a < 2 * n / 3; ++a) {
    const Eigen::RowVector3d r = model.nodes.row(a);
    model.rigid.block<3, 3>(3 * a, 0).setIdentity();
    model.rigid.block<3, 3>(3 * a, 3) << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  }
  model.T.resize(2 * n, 2 * n);
  model.T.setIdentity();
  try {
    reduce(model, options_for({"left"}, 5));
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("6 of the 2 bodies' 12 rigid motions"), std::string::npos) << text;
    EXPECT_NE(text.find("not connected"), std::string::npos) << text;
    EXPECT_NE(text.find("largest at node"), std::string::npos) << text;
  }
}

TEST(BadInput, InvalidOptionsAreRefused) {
  const auto parse = [](const std::string& text) {
    return condense_keys().read(Config::parse(text, "box.rom.toml"));
  };
  EXPECT_NO_THROW(parse("boundary = [\"left\"]\nfmax_hz = 1000.0\n"));
  test::expect_parts(test::refusal_of([&] { parse("boundary = [\"left\"]\n"); }),
                     {"box.rom.toml:1: fmax_hz: give fmax_hz, count or accurate_to_hz"});
  test::expect_parts(test::refusal_of([&] { parse("boundary = [\"left\"]\nfmax_hz = -5.0\n"); }),
                     {"box.rom.toml:2: fmax_hz: found -5.0, expected a number above 0"});
  test::expect_parts(test::refusal_of([&] { parse("boundary = [\"left\"]\nfmax_hz = nan\n"); }),
                     {"box.rom.toml:2: fmax_hz: found nan, expected a number above 0"});
  test::expect_parts(
      test::refusal_of([&] { parse("boundary = [\"left\"]\nfmax_hz = 10.0\ncount = 4\n"); }),
      {"box.rom.toml:2: fmax_hz: fmax_hz and count exclude each other"});
  test::expect_parts(test::refusal_of([&] { parse("boundary = []\nfmax_hz = 10.0\n"); }),
                     {"box.rom.toml:1: boundary: found none, expected one or more names"});
  test::expect_parts(
      test::refusal_of([&] { parse("boundary = [\"left\"]\nmethod = \"guyan\"\ncount = 4\n"); }),
      {"box.rom.toml:3: count: needs method = \"craig-bampton\" or \"craig-chang\": guyan has no "
       "modes"});
  test::expect_parts(
      test::refusal_of([&] { parse("boundary = [\"left\"]\nfmaxhz = 10.0\nfmax_hz = 10.0\n"); }),
      {"box.rom.toml:2: fmaxhz: unknown key, did you mean fmax_hz?"});
}

}  // namespace
}  // namespace clatter::condense
