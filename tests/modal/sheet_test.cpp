// SPDX-License-Identifier: GPL-3.0-or-later
// Shells in a model: what is held, joined and loaded turns too.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "block_mesh.hpp"
#include "core/base/artefact.hpp"
#include "core/mesh/boundary.hpp"
#include "modal/statics.hpp"
#include "sheet.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter::modal {
namespace {

using assembly::testing::build_all;
using assembly::testing::kSheetSteel;
using assembly::testing::sheet;

constexpr double kL = 0.4, kB = 0.05, kT = 0.002, kE = 2e11;
constexpr double kI = kB * kT * kT * kT / 12.0;
const std::string kClampedSide =
    "[[support]]\nname = \"wall\"\nnode_set = \"x0\"\n"
    "directions = [\"x\", \"y\", \"z\", \"rx\", \"ry\", \"rz\"]\n";
/// The side x1 follows a point.
const std::string kRigidEnd =
    "[[point]]\nname = \"end\"\nat = [0.4, 0.025, 0.0]\n"
    "[[coupling]]\npoint = \"end\"\ntype = \"rigid\"\nnode_set = \"x1\"\n"
    "directions = [\"x\", \"y\", \"z\", \"rx\", \"ry\", \"rz\"]\n";

fe::FeModel clamped_strip(const std::string& toml) {
  return build_all(sheet(kL, kB, 16, 2), kSheetSteel + kClampedSide + toml).model;
}

StaticCase only_case(const fe::FeModel& model) { return solve_static(model, {}).cases.at(0); }

TEST(Sheet, AClampedStripBendsLikeABeamAndCarriesTheMomentAtItsFaces) {
  const fe::FeModel model =
      clamped_strip(kRigidEnd +
                    "[[load]]\nname = \"tip\"\nkind = \"force\"\nset = \"end\"\n"
                    "force = [0.0, 0.0, 10.0]\n");
  const StaticCase tip = only_case(model);
  const double G = kE / 2.0;
  const double want = 10.0 * kL * kL * kL / (3.0 * kE * kI) + 10.0 * kL / (5.0 / 6.0 * G * kB * kT);
  EXPECT_NEAR(tip.points(2), want, 1e-3 * want);
  EXPECT_NEAR(tip.points(4), -10.0 * kL * kL / (2.0 * kE * kI), 1e-3 * want / kL);
  ASSERT_EQ(tip.rotation.size(), 3 * model.nodes.rows());
  ASSERT_EQ(tip.stress.size(), 2u);
  EXPECT_EQ(tip.stress[0].name, "sheet (outer)");
  // Upward at the tip: the outward side, up, is pressed. The moment is constant in a cell; its mean
  // at the node in the middle of y0 is exact.
  const double bent = 10.0 * 0.5 * kL * 0.5 * kT / kI;
  EXPECT_NEAR(tip.stress[0].stress(8, 0), -bent, 1e-6 * bent);
  EXPECT_NEAR(tip.stress[1].stress(8, 0), bent, 1e-6 * bent);
  EXPECT_NEAR(tip.support_sums(0, 4), 10.0 * kL, 1e-6);
}

TEST(Sheet, APointOnANodeTurnsWithIt) {
  const StaticCase tip = only_case(clamped_strip(
      "[[point]]\nname = \"tip\"\nnode_set = \"tip\"\n"
      "[[load]]\nname = \"twist\"\nkind = \"force\"\nset = \"tip\"\nmoment = [0.0, 1.0, 0.0]\n"));
  const double turn = kL / (kE * kI), sag = -kL * kL / (2.0 * kE * kI);
  EXPECT_NEAR(tip.points(4), turn, 0.05 * turn);  // the moment spreads from one node
  EXPECT_NEAR(tip.points(2), sag, 0.02 * -sag);
  EXPECT_NEAR(tip.support_sums(0, 4), -1.0, 1e-8);
}

TEST(Sheet, WeighsAsAPlateAndItsPressureAndWeightHaveTheirResultants) {
  const fe::FeModel free = build_all(sheet(kL, kB, 4, 2), kSheetSteel).model;
  const double m = 8000.0 * kL * kB * kT;
  EXPECT_NEAR(free.mass.mass, m, 1e-12 * m);
  EXPECT_NEAR(free.mass.centre(0), 0.5 * kL, 1e-12);
  EXPECT_NEAR(free.mass.inertia(0, 0), m * (kB * kB + kT * kT) / 12.0, 1e-12 * m);
  EXPECT_NEAR(free.mass.inertia(2, 2), m * (kB * kB + kL * kL) / 12.0, 1e-12 * m);
  const fe::FeModel loaded =
      build_all(
          sheet(kL, kB, 4, 2),
          kSheetSteel +
              "[[load]]\nname = \"weight\"\nkind = \"acceleration\"\ndirection = [0.0, 0.0, -1.0]\n"
              "[[load]]\nname = \"gas\"\nkind = \"pressure\"\nsurface = \"skin\"\n"
              "[[load]]\nname = \"turns\"\nkind = \"centrifugal\"\naxis_point = [0.0, 0.025, 0.0]\n"
              "axis = [0.0, 0.0, 1.0]\n")
          .model;
  const auto resultant = [&](const std::string& load) -> Eigen::VectorXd {
    return loaded.rigid.transpose() * loaded.loads.at(load);
  };
  EXPECT_NEAR(resultant("weight")(2), -m, 1e-12);
  EXPECT_NEAR(resultant("gas")(2), -kL * kB, 1e-12);
  EXPECT_NEAR(resultant("turns")(0), m * 0.5 * kL, 1e-12);
  EXPECT_NEAR(resultant("turns")(1), 0.0, 1e-12);
}

TEST(Sheet, OffsetMovesTheMassAndBendsByThePullOfItsNodes) {
  const std::string offset = kSheetSteel + "offset = 0.003\n";
  EXPECT_NEAR(build_all(sheet(kL, kB, 4, 2), offset).model.mass.centre(2), 0.003, 1e-12);
  const fe::FeModel model =
      build_all(sheet(kL, kB, 16, 2),
                offset + kClampedSide + kRigidEnd +
                    "[[load]]\nname = \"pull\"\nkind = \"force\"\nset = \"end\"\n"
                    "force = [1000.0, 0.0, 0.0]\n")
          .model;
  const StaticCase pull = only_case(model);
  const double moment = -1000.0 * 0.003;  // about the middle of the sheet
  EXPECT_NEAR(pull.points(4), moment * kL / (kE * kI), 1e-6 * kL / (kE * kI));
  EXPECT_NEAR(pull.points(0),
              1000.0 * kL / (kE * kB * kT) + 0.003 * 0.003 * 1000.0 * kL / (kE * kI), 1e-9);
}

constexpr double kGrows = 1e-5, kKelvin = 80.0, kContracts = 0.3;

/// Of steel that expands.
std::string warm_sheet(double nu, const std::string& section = "") {
  return fmt::format(
      "[material.steel]\nregions = [\"sheet\"]\nE = 2e11\nnu = {:.1f}\nrho = 8000.0\n"
      "expansion = 1e-5\n[[shell]]\nregions = [\"sheet\"]\nthickness = 0.002\n{}",
      nu, section);
}

const std::string kWarmLoad = "[[load]]\nname = \"warm\"\nkind = \"temperature\"\n";

std::string held_side(const std::string& nodes, const std::string& directions) {
  return fmt::format("[[support]]\nname = \"{0}\"\nnode_set = \"{0}\"\ndirections = [{1}]\n", nodes,
                     directions);
}

/// Largest von Mises stress of both faces.
double largest_of(const StaticCase& one) {
  return std::max(one.stress.at(0).von_mises.maxCoeff(), one.stress.at(1).von_mises.maxCoeff());
}

TEST(Sheet, ExpandsFreelyByRegionsAndEverywhere) {
  // A node inside moves off the grid: no cell of its four is a parallelogram. Its sides along the
  // axes slide.
  mesh::Mesh mesh = sheet(kL, kB, 4, 2);
  mesh.nodes.row(7) += Eigen::RowVector3d(0.03, 0.008, 0.0);
  for (const char* rise : {"value = 80.0\n", "regions = { sheet = 80.0 }\n"}) {
    const StaticCase warm = only_case(build_all(mesh, warm_sheet(kContracts) + kWarmLoad + rise +
                                                          held_side("x0", "\"x\", \"z\"") +
                                                          held_side("y0", "\"y\", \"z\""))
                                          .model);
    double error = 0.0;
    for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
      error = std::max(error, (warm.displacement.segment<3>(3 * a) -
                               kGrows * kKelvin * mesh.nodes.row(a).transpose())
                                  .norm());
    EXPECT_LE(error, 1e-10 * kGrows * kKelvin * kL);
    EXPECT_LE(warm.rotation.cwiseAbs().maxCoeff(), 1e-10 * kGrows * kKelvin);
    EXPECT_LE(largest_of(warm), 1e-10 * kE * kGrows * kKelvin);
  }
}

TEST(Sheet, HeldInItsPlaneAndWarmIsPressedFromBothSides) {
  const fe::FeModel model =
      build_all(sheet(kL, kB, 4, 2), warm_sheet(kContracts) + kWarmLoad + "value = 80.0\n" +
                                         held_side("x0", "\"x\", \"z\"") +
                                         held_side("x1", "\"x\", \"z\"") +
                                         held_side("y0", "\"y\"") + held_side("y1", "\"y\""))
          .model;
  const StaticCase warm = only_case(model);
  const double pressed = kE * kGrows * kKelvin / (1.0 - kContracts);
  for (const fe::RegionStress& face : warm.stress)
    for (Eigen::Index a = 0; a < face.stress.rows(); ++a) {
      EXPECT_NEAR(face.stress(a, 0), -pressed, 1e-9 * pressed);
      EXPECT_NEAR(face.stress(a, 1), -pressed, 1e-9 * pressed);
    }
  EXPECT_NEAR(warm.support_sums(0, 0), pressed * kB * kT, 1e-9 * pressed * kB * kT);
}

TEST(Sheet, HeldBesideItsMiddleAndWarmItBends) {
  // Ends held at their nodes, c below the middle, free to turn: with the force N along,
  // L (alpha dT + N / (E A) + N c^2 / (E I)) = 0; the moment is -N c.
  constexpr double c = 0.003;
  const StaticCase warm =
      only_case(build_all(sheet(kL, kB, 16, 2),
                          warm_sheet(0.0, "offset = 0.003\n") + kWarmLoad + "value = 80.0\n" +
                              held_side("x0", "\"x\", \"z\"") + held_side("x1", "\"x\", \"z\"") +
                              held_side("tip", "\"y\""))
                    .model);
  const double N = -kGrows * kKelvin / (1.0 / (kE * kB * kT) + c * c / (kE * kI));
  const double k = -N * c / (kE * kI);
  EXPECT_NEAR(warm.rotation(3 * 16 + 1), 0.5 * kL * k, 1e-8 * kL * k);
  EXPECT_NEAR(warm.displacement(3 * 8 + 2), kL * kL * k / 8.0, 1e-8 * kL * kL * k);
  EXPECT_NEAR(warm.support_sums(0, 0), -N, -1e-8 * N);
  const double bent = 0.5 * kE * kT * k;
  EXPECT_NEAR(warm.stress.at(0).stress(8, 0), N / (kB * kT) + bent, 1e-8 * bent);
  EXPECT_NEAR(warm.stress.at(1).stress(8, 0), N / (kB * kT) - bent, 1e-8 * bent);
}

TEST(Sheet, ASensorHasDisplacementsAlone) {
  const fe::FeModel model =
      clamped_strip("[[sensor]]\nname = \"s\"\nsurface = \"skin\"\nnear = [0.4, 0.0, 0.0]\n");
  EXPECT_EQ(model.sets.at("s").labels, (std::vector<std::string>{"s.x", "s.y", "s.z"}));
}

// The certificate compares M with integrals over the sheet.
TEST(Sheet, MassOfACurvedTaperedSheetIsThatOfItsIntegrals) {
  mesh::Mesh mesh = sheet(kL, kB, 8, 4);
  mesh::ShellBlock& block = mesh.shells[0];
  block.thickness.resize(block.nodes.rows(), 4);
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    mesh.nodes(a, 2) =
        0.02 * std::sin(9.0 * mesh.nodes(a, 0)) + mesh.nodes(a, 0) * mesh.nodes(a, 1);
  for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
    for (Eigen::Index k = 0; k < 4; ++k)
      block.thickness(c, k) = 0.002 + 0.01 * mesh.nodes(block.nodes(c, k), 0);
  const auto built = build_all(mesh, kSheetSteel + "offset = 0.003\narea_mass = 2.0\n");
  EXPECT_LT(*built.certificate.mass_error, 1e-13);
  EXPECT_LT(*built.certificate.centre_error, 1e-12);
  EXPECT_LT(*built.certificate.inertia_error, 1e-12);
}

/// A block with a sheet above it, half a thickness away, tied by the sheet's own faces, or by them
/// turned towards the block.
fe::FeModel on_a_block(bool turned) {
  mesh::Mesh mesh =
      assembly::testing::block_mesh({4, 2, 1}, assembly::testing::brick({0.4, 0.05, 0.02}));
  const auto first = static_cast<int32_t>(mesh.nodes.rows());
  mesh::Mesh above = sheet(0.4, 0.05, 8, 2);
  above.nodes.col(2).setConstant(0.021);
  mesh.nodes.conservativeResize(first + above.nodes.rows(), 3);
  mesh.nodes.bottomRows(above.nodes.rows()) = above.nodes;
  mesh.regions.push_back("sheet");
  mesh::ShellBlock block = above.shells[0];
  block.nodes.array() += first;
  block.region = 1;
  mesh.shells = {block};
  mesh.node_sets.clear();
  mesh.surfaces["skin"] = mesh::skin_of(mesh::boundary_faces(mesh), mesh.shells);
  mesh.surfaces["sheet"] = mesh::shell_surface(mesh);
  if (turned) mesh.surfaces["sheet"].faces[0].nodes.rowwise().reverseInPlace();
  return build_all(mesh, kSheetSteel +
                             "[material.iron]\nregions = [\"body\"]\nE = 1e11\nnu = 0.3\n"
                             "rho = 7000.0\n[[tie]]\nslave = \"sheet\"\nmaster = \"z1\"\n")
      .model;
}

TEST(Sheet, IsTiedByEitherOfItsFaces) {
  const fe::FeModel own = on_a_block(false), turned = on_a_block(true);
  EXPECT_LT(own.size(), own.T.rows() + 3 * static_cast<int64_t>(own.rotations.nodes.size()));
  EXPECT_EQ(own.size(), turned.size());
  EXPECT_LT((own.K - turned.K).norm(), 1e-12 * own.K.norm());
}

TEST(Sheet, ComesBackFromItsFile) {
  const auto path = test::scratch_path("sheet.fe.h5");
  const fe::FeModel model = clamped_strip("");
  H5File file = H5File::create(path);
  write_provenance(file, {fe::kFeSchema, "", {}});
  fe::write_fe_model(file, model);
  file.commit();
  const fe::FeModel back = fe::read_fe_model(path);
  std::filesystem::remove(path);
  EXPECT_EQ(back.rotations.nodes, model.rotations.nodes);
  EXPECT_EQ(back.rotations.T.nonZeros(), model.rotations.T.nonZeros());
  ASSERT_EQ(back.cells.shells.size(), 1u);
  EXPECT_EQ(back.cells.shells[0].nodes, model.cells.shells[0].nodes);
  EXPECT_EQ(back.cells.sections[0].thickness, kT);
}

std::string refused(const std::string& toml) {
  return test::refusal_of([&] { build_all(sheet(kL, kB, 4, 2), toml); });
}

TEST(Sheet, RefusesWhatItIsNot) {
  const std::string steel = kSheetSteel.substr(0, kSheetSteel.find("[[shell]]"));
  test::expect_parts(refused(steel),
                     {"shell: found no thickness of region \"sheet\"", "[[shell]]"});
  test::expect_parts(refused(kSheetSteel + "[[shell]]\nregions = [\"sheet\"]\nthickness = 1.0\n"),
                     {"regions: found \"sheet\" in two [[shell]]"});
  test::expect_parts(refused(kSheetSteel + "[[shell]]\nregions = [\"lid\"]\nthickness = 1.0\n"),
                     {"regions: found \"lid\", expected one of: sheet"});
}

}  // namespace
}  // namespace clatter::modal
