// SPDX-License-Identifier: GPL-3.0-or-later
// What the modes that reduced parts lack cost their assembly: the estimate against whole meshes.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "condense/basis/craig_bampton.hpp"
#include "condense/basis/truncation.hpp"
#include "core/base/error.hpp"
#include "core/fe/part_errors.hpp"
#include "core/modes/analysis.hpp"
#include "tests/condense/part_files.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

using namespace testing;
using assembly::testing::full;

CondenseOptions stating(CondenseOptions options) {
  options.joined_error = true;
  return options;
}

/// By dense matrices: K_ii^{-1} in the place of its factor.
Eigen::MatrixXd dense_truncation(const fe::FeModel& model, const std::vector<int32_t>& b,
                                 const Eigen::MatrixXd& shapes) {
  std::vector<int32_t> i;
  for (int32_t dof = 0; dof < model.size(); ++dof)
    if (std::ranges::count(b, dof) == 0) i.push_back(dof);
  const Eigen::MatrixXd K = full(model.K), M = full(model.M);
  const Eigen::MatrixXd inverse = Eigen::MatrixXd(K(i, i)).inverse();
  const Eigen::MatrixXd H = M(i, b) - M(i, i) * inverse * K(i, b);
  const Eigen::MatrixXd stiffness = shapes.transpose() * K(i, i) * shapes;
  const Eigen::MatrixXd of_shapes = shapes.transpose() * H;
  return H.transpose() * inverse * H - of_shapes.transpose() * stiffness.inverse() * of_shapes;
}

class Truncation : public ::testing::TestWithParam<std::string> {};

TEST_P(Truncation, IsThatOfDenseMatrices) {
  set_quiet(true);
  const fe::FeModel model =
      build_all(block({4, 2, 2}, CellType::kHex8), material("body", kIron) + kept("z1")).model;
  const LocalPart part(model, {"joint"});
  StepClock clock;
  const StaticPart statics = static_part(part, {}, clock);
  ModeRequest request;
  if (GetParam() != "none") request.count = 7;
  request.own_modes = GetParam() == "own modes";
  request.frequency_error = GetParam() == "residual modes" ? 1e-6 : 0.0;
  const CraigBampton reduced = craig_bampton(part, statics, request, clock);
  EXPECT_EQ(reduced.residual.hz.size() > 0, GetParam() == "residual modes");
  const Eigen::MatrixXd found = truncation(reduced, *statics.factor_ii, part);
  const auto n_b = static_cast<Eigen::Index>(part.dofs.boundary.size());
  const Eigen::MatrixXd expected =
      dense_truncation(model, part.dofs.boundary, reduced.basis.shapes);
  EXPECT_LT((found.topLeftCorner(n_b, n_b) - expected).norm(), 1e-9 * expected.norm());
  EXPECT_EQ(found.bottomRows(found.rows() - n_b).norm(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Truncation,
                         ::testing::Values("none", "modes", "residual modes", "own modes"),
                         [](const auto& of) {
                           std::string name = of.param;
                           std::ranges::replace(name, ' ', '_');
                           return name;
                         });

/// The elastic frequencies of a mesh, or of an assembly with the errors that it states.
struct Elastic {
  VectorXd hz, stated;
};

Elastic elastic(const fe::FeModel& model, int count) {
  modes::ModesOptions options;
  options.count = 6 + count;
  const modes::PartModes found = modes::analyse(model, options);
  EXPECT_EQ(found.modes.rigid, 6);
  Elastic out{found.modes.frequencies_hz().tail(count), {}};
  if (found.part_errors.rows() > 0)
    out.stated = found.part_errors.bottomRows(count).rowwise().sum();
  return out;
}

/// Errors below 1 % are stated within a factor of two.
void expect_stated(const Elastic& joined, const Elastic& exact) {
  ASSERT_EQ(joined.stated.size(), exact.hz.size());
  for (Eigen::Index k = 0; k < exact.hz.size(); ++k) {
    const double error = joined.hz(k) / exact.hz(k) - 1.0;
    if (error > 0.01) {
      EXPECT_GT(joined.stated(k), 0.005) << k;
      continue;
    }
    EXPECT_LT(joined.stated(k), 2.0 * error + 1e-9) << k;
    EXPECT_GT(joined.stated(k), 0.5 * error - 1e-9) << k;
  }
}

class BlockAndPlate : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    block_ = build_all(block({12, 5, 3}), material("body", kIron) + kept("z1")).model;
    plate_ = build_all(plate({12, 5, 1}), material("body", kAluminium) + kept("z0") +
                                              "[[nodes]]\nname = \"top\"\nsurface = \"z1\"\n")
                 .model;
    exact_ = elastic(whole(block({12, 5, 3}), plate({12, 5, 1})), 12);
  }

  static TwoFiles files(double hz, const std::vector<std::string>& of_plate = {"joint"}) {
    CondenseOptions options = stating(below(hz));
    const auto block = reduced_file("block", block_, options);
    options.boundary = of_plate;
    return {block, reduced_file("plate", plate_, options)};
  }
  static std::string engine_of(const TwoFiles& files) {
    return part("block", files.block) + part("plate", files.plate) + kTie;
  }

  static inline fe::FeModel block_, plate_;
  static inline Elastic exact_;
};

TEST_F(BlockAndPlate, HardB19_TheErrorOfAJoinedModeIsStatedByPart) {
  // The table of shells-and-joining, 3.2: parts to eight times the first frequency.
  const fe::FeModel engine = joined(engine_of(files(32e3))).model;
  const Elastic found = elastic(engine, 12);
  expect_stated(found, exact_);
  EXPECT_NEAR(found.stated(0), 4.4e-4, 1e-5);
  EXPECT_NEAR(found.stated(3), 2.1e-3, 1.5e-4);
  // The block lacks most.
  modes::ModesOptions options;
  options.count = 18;
  const modes::PartModes modes = modes::analyse(engine, options);
  EXPECT_EQ(modes.parts, (std::vector<std::string>{"block", "plate"}));
  EXPECT_GT(modes.part_errors(6, 0), 2.0 * modes.part_errors(6, 1));
  const std::vector<std::string> lines = modes::describe(modes);
  EXPECT_TRUE(std::ranges::any_of(lines, [](const std::string& line) {
    return line.find("parts 4.") != std::string::npos && line.find("(block)") != std::string::npos;
  }));
}

TEST_F(BlockAndPlate, HardB19_TwiceTheFrequencyIsNotEnoughAndTheAssemblySaysSo) {
  // Modes to 16 kHz for frequencies from 4 kHz: 1.3 %, 2.1 % and 23 % too high.
  const fe::FeModel engine =
      joined(engine_of(files(16e3)) + "[[nodes]]\nname = \"corner\"\nnode_set = \"block_joint\"\n")
          .model;
  const Elastic found = elastic(engine, 12);
  EXPECT_NEAR(found.stated(0), 1.2e-2, 2e-3);
  EXPECT_NEAR(found.hz(0) / exact_.hz(0) - 1.0, 1.3e-2, 1e-3);
  // Not asked for a frequency, the reduction is accurate as far as the parts are.
  const rom::ReducedModel again = reduced_again(engine, "corner", below(16e3));
  const rom::ReducedCertificate& certificate = again.certificate;
  EXPECT_LE(certificate.accurate_to_hz.value(), 8e3);
  EXPECT_GT(certificate.frequency_error_parts.value(), 0.01);
  // Asked for one, it is refused with the part.
  CondenseOptions accurate;
  accurate.modes.accurate_to_hz = 7e3;
  test::expect_parts(
      test::refusal_of<NumericsError>([&] { (void)reduced_again(engine, "corner", accurate); }),
      {"engine: the frequency of 40", "part block", "at most 0.05 %", "higher cut-off"});
  // Parts with fewer still: the first frequency is wrong, and the assembly is accurate for none.
  const fe::FeModel poor =
      joined(engine_of(files(9e3)) + "[[nodes]]\nname = \"corner\"\nnode_set = \"block_joint\"\n")
          .model;
  const rom::ReducedModel limited = reduced_again(poor, "corner", below(16e3));
  EXPECT_LE(limited.certificate.accurate_to_hz.value(), 4.5e3);
}

TEST_F(BlockAndPlate, AnAssemblyThatIsReducedAgainStatesTheErrorOfBothReductions) {
  const fe::FeModel engine = joined(engine_of(files(32e3, {"joint", "top"})) +
                                    "[[nodes]]\nname = \"joint\"\nnode_set = \"plate_top\"\n")
                                 .model;
  const auto file = reduced_file("engine", engine, stating(below(24e3)));
  const Elastic found = elastic(joined(part("engine", file)).model, 12);
  expect_stated(found, exact_);
  const Elastic once = elastic(engine, 12);
  EXPECT_GT(found.stated(0), once.stated(0));
}

TEST_F(BlockAndPlate, SupportsLeaveTheStatedErrorsTrue) {
  const std::string held = "[[support]]\nname = \"held\"\nsurface = \"";
  const fe::FeModel engine =
      joined(engine_of(files(32e3, {"joint", "top"})) + held + "plate_top\"\ndirections = \"z\"\n")
          .model;
  const fe::FeModel exact =
      build_all(assembly::testing::two_parts(block({12, 5, 3}), plate({12, 5, 1})),
                "[material.a]\nregions = [\"a\"]\n" + kIron + "[material.b]\nregions = [\"b\"]\n" +
                    kAluminium + "[[tie]]\nslave = \"b_z0\"\nmaster = \"a_z1\"\n" + held +
                    "b_z1\"\ndirections = \"z\"\n")
          .model;
  modes::ModesOptions options;
  options.count = 9;  // three motions in the plane of the support are free
  const modes::PartModes found = modes::analyse(engine, options),
                         of_mesh = modes::analyse(exact, options);
  ASSERT_EQ(found.modes.rigid, 3);
  for (Eigen::Index k = 3; k < 9; ++k) {
    const double error = found.modes.frequencies_hz()(k) / of_mesh.modes.frequencies_hz()(k) - 1.0;
    const double stated = found.part_errors.row(k).sum();
    if (error > 0.01) continue;
    EXPECT_LT(stated, 2.0 * error + 1e-9) << k;
    EXPECT_GT(stated, 0.5 * error - 1e-9) << k;
  }
}

/// Without its limits a model of an earlier version would look like one of a mesh.
TEST_F(CompleteParts, OfAnEarlierVersionAreRefused) {
  const auto path = test::scratch_path("earlier.fe.h5");
  H5File file = H5File::create(path);
  write_provenance(file, {fe::kFeSchema, "", {}});
  fe::write_fe_model(file, a_);
  file.set("parts", "count", int64_t{2});
  file.commit();
  test::expect_parts(test::refusal_of([&] { (void)fe::read_fe_model(path); }),
                     {"earlier.fe.h5", "parts", "earlier version", "clatter-assembly makes again"});
}

TEST_F(CompleteParts, LackNothing) {
  const TwoFiles known{reduced_file("block", a_, stating(complete(a_))),
                       reduced_file("plate", b_, stating(complete(b_)))};
  const fe::FeModel engine =
      joined(part("block", known.block) + part("plate", known.plate) + kTie).model;
  EXPECT_LT(elastic(engine, 30).stated.maxCoeff(), 1e-10);
}

TEST_F(CompleteParts, HardB19_APartThatDoesNotKnowItsErrorIsNamed) {
  const auto known = reduced_file("block", a_, stating(complete(a_)));
  const fe::FeModel engine = joined(part("block", known) + part("plate", files_.plate) + kTie +
                                    "[[nodes]]\nname = \"corner\"\nnode_set = \"block_joint\"\n")
                                 .model;
  EXPECT_EQ(fe::parts_without_truncation(engine.parts), "plate");
  modes::ModesOptions options;
  options.count = 10;
  const modes::PartModes found = modes::analyse(engine, options);
  EXPECT_TRUE(found.part_errors.col(1).array().isNaN().all());
  EXPECT_TRUE(found.part_errors.col(0).allFinite());
  EXPECT_FALSE(reduced_again(engine, "corner", below(10e3)).certificate.frequency_error_parts);
  test::expect_parts(
      test::refusal_of([&] { (void)reduced_again(engine, "corner", stating(below(10e3))); }),
      {"engine: joined_error", "plate", "joined_error = true"});
}

}  // namespace
}  // namespace clatter::condense
