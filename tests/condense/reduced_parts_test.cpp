// SPDX-License-Identifier: GPL-3.0-or-later
// Reduced parts in an assembly: against the whole mesh, placed, mirrored, reduced again.
#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "block_mesh.hpp"
#include "condense/condense.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/fe/fe_model.hpp"
#include "core/rom/placement.hpp"
#include "core/mesh/boundary.hpp"
#include "core/modes/analysis.hpp"
#include "sheet.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"
#include "two_parts.hpp"

namespace clatter::condense {
namespace {

using assembly::testing::block_mesh;
using assembly::testing::brick;
using assembly::testing::build_all;
using assembly::testing::free_hz;
using Eigen::Vector3d;
using Eigen::VectorXd;
using mesh::CellType;

const std::string kIron = "E_gpa = 110.0\nnu = 0.26\nrho = 7200.0\n";
const std::string kAluminium = "E_gpa = 70.0\nnu = 0.33\nrho = 2700.0\n";

/// A box from `low` on, of `size` [m].
mesh::Mesh box(const Vector3d& low, const Vector3d& size, const std::array<int, 3>& n,
               CellType type = CellType::kHex20) {
  return block_mesh(
      n, [=](const Vector3d& x) -> Vector3d { return low + x.cwiseProduct(size); },
      {type, false, false});
}

mesh::Mesh block(const std::array<int, 3>& n, CellType type = CellType::kHex20) {
  return box({0.0, 0.0, 0.0}, {0.24, 0.1, 0.06}, n, type);
}

mesh::Mesh plate(const std::array<int, 3>& n, CellType type = CellType::kHex20) {
  return box({0.0, 0.0, 0.06}, {0.24, 0.1, 0.012}, n, type);
}

std::string material(const std::string& region, const std::string& of) {
  return "[material." + region + "]\nregions = [\"" + region + "\"]\n" + of;
}

std::string kept(const std::string& surface) {
  return "[[nodes]]\nname = \"joint\"\nsurface = \"" + surface + "\"\n";
}

/// The file of a part whose `surface` is kept as the set "joint".
std::filesystem::path reduced_file(const std::string& name, const fe::FeModel& model,
                                   CondenseOptions options) {
  set_quiet(true);
  StepClock clock;
  if (options.boundary.empty()) options.boundary = {"joint"};
  options.modes.frequency_error = 0.0;
  const std::filesystem::path path = test::scratch_path(name + ".rom.h5");
  H5File file = H5File::create(path);
  write_provenance(file, {rom::kRomSchema, "", {}});
  rom::write_reduced_model(file, condense(model, options, clock));
  file.commit();
  return path;
}

CondenseOptions below(double hz) {
  CondenseOptions options;
  options.modes.fmax_hz = hz;
  return options;
}

/// All modes of the interior: nothing is lost.
CondenseOptions complete(const fe::FeModel& model) {
  CondenseOptions options;
  options.modes.count = model.size() - static_cast<int>(model.set("joint").dofs.size());
  return options;
}

std::string part(const std::string& name, const std::filesystem::path& file,
                 const std::string& more = "") {
  return fmt::format("[[part]]\nname = \"{}\"\nfile = \"{}\"\n{}", name, file.string(), more);
}

const std::string kTie = "[[tie]]\nslave = \"plate_joint\"\nmaster = \"block_joint\"\n";

assembly::BuiltModel joined(const std::string& toml) {
  mesh::Mesh none;
  none.name = "engine";
  none.nodes.resize(0, 3);
  return build_all(none, toml);
}

fe::FeModel whole(const mesh::Mesh& a, const mesh::Mesh& b) {
  return build_all(assembly::testing::two_parts(a, b),
                   "[material.a]\nregions = [\"a\"]\n" + kIron + "[material.b]\nregions = [\"b\"]\n" +
                       kAluminium + "[[tie]]\nslave = \"b_z0\"\nmaster = \"a_z1\"\n")
      .model;
}

struct TwoFiles {
  std::filesystem::path block, plate;
};

/// The blocks of shells-and-joining, 3.2.
TwoFiles coarse_parts(double hz, const std::array<int, 3>& plate_cells) {
  const fe::FeModel a =
      build_all(block({12, 5, 3}), material("body", kIron) + kept("z1")).model;
  const fe::FeModel b =
      build_all(plate(plate_cells), material("body", kAluminium) + kept("z0")).model;
  return {reduced_file("block", a, below(hz)), reduced_file("plate", b, below(hz))};
}

TEST(ReducedParts, BlockAndPlateHaveTheFrequenciesOfTheirMeshWithinTheTruncation) {
  // The first elastic frequencies of the tied mesh by another program, and the errors of two parts
  // with all modes below 32 kHz.
  const double expected[] = {4018.356, 4558.327, 4974.262, 8265.475,
                             8685.050, 9019.082, 9347.825, 13273.42};
  const TwoFiles files = coarse_parts(32e3, {12, 5, 1});
  const assembly::BuiltModel engine =
      joined(part("block", files.block) + part("plate", files.plate) + kTie);
  EXPECT_EQ(engine.model.size(), 645 + 50);
  const VectorXd hz = free_hz(engine.model, 14);
  EXPECT_LT(hz(5), 0.5);
  for (int k = 0; k < 8; ++k) {
    EXPECT_GE(hz(6 + k), expected[k] * (1.0 - 1e-6)) << k;  // reduced parts are stiffer
    EXPECT_LE(hz(6 + k), expected[k] * (1.0 + 5.2e-3)) << k;
  }
  EXPECT_NEAR(hz(6) / expected[0] - 1.0, 4.4e-4, 2e-5);
  EXPECT_NEAR(hz(9) / expected[3] - 1.0, 2.1e-3, 1e-4);
  EXPECT_LE(engine.certificate.rigid_force_residue.value(), 1e-10);
  EXPECT_LE(engine.certificate.rigid_recovery_error.value(), 1e-12);
  EXPECT_LE(engine.certificate.mass_error.value(), 1e-10);
}

TEST(ReducedParts, FacesThatDoNotMatchAreThoseOfTheMesh) {
  const TwoFiles files = coarse_parts(32e3, {17, 7, 1});
  const VectorXd hz =
      free_hz(joined(part("block", files.block) + part("plate", files.plate) + kTie).model, 14);
  // The mortar of the reference, and the error of the truncation above.
  EXPECT_NEAR(hz(6) / 4018.331 - 1.0, 4.4e-4, 3e-5);
  EXPECT_NEAR(hz(7) / 4558.074 - 1.0, 0.0, 1e-3);
  EXPECT_NEAR(hz(9) / 8265.470 - 1.0, 2.1e-3, 2e-4);
}

/// Parts with all their modes, and the same parts in one mesh.
class CompleteParts : public ::testing::Test {
 protected:
  CompleteParts()
      : a_(build_all(block({4, 2, 2}, CellType::kHex8), material("body", kIron) + kept("z1")).model),
        b_(build_all(plate({3, 2, 1}, CellType::kHex8), material("body", kAluminium) + kept("z0"))
               .model),
        files_{reduced_file("block", a_, complete(a_)), reduced_file("plate", b_, complete(b_))},
        whole_(whole(block({4, 2, 2}, CellType::kHex8), plate({3, 2, 1}, CellType::kHex8))) {}

  fe::FeModel a_, b_;
  TwoFiles files_;
  fe::FeModel whole_;
};

void expect_same_elastic(const VectorXd& found, const VectorXd& expected, double error) {
  ASSERT_EQ(found.size(), expected.size());
  for (Eigen::Index k = 6; k < found.size(); ++k)
    EXPECT_NEAR(found(k) / expected(k), 1.0, error) << k;
}

TEST_F(CompleteParts, AreTheWholeMesh) {
  const fe::FeModel engine =
      joined(part("block", files_.block) + part("plate", files_.plate) + kTie).model;
  ASSERT_EQ(engine.size(), whole_.size());
  expect_same_elastic(free_hz(engine, engine.size()), free_hz(whole_, whole_.size()), 1e-9);
  EXPECT_NEAR(engine.mass.mass, whole_.mass.mass, 1e-12 * whole_.mass.mass);
  EXPECT_LT((engine.mass.inertia - whole_.mass.inertia).norm(), 1e-12 * whole_.mass.inertia.norm());
}

TEST_F(CompleteParts, DoNotDependOnTheirOrder) {
  const VectorXd one =
      free_hz(joined(part("block", files_.block) + part("plate", files_.plate) + kTie).model, 30);
  const VectorXd other =
      free_hz(joined(part("plate", files_.plate) + part("block", files_.block) + kTie).model, 30);
  expect_same_elastic(one, other, 1e-9);
}

/// Both parts turned together, each with a placement of its own.
TEST_F(CompleteParts, HaveTheSameFrequenciesWhereverTheyStand) {
  const std::string system =
      "[system.there]\norigin = [0.3, -0.2, 0.5]\nz = [0.6, 0.0, 0.8]\nx = [0.0, 1.0, 0.0]\n";
  const std::string there = "system = \"there\"\n";
  const assembly::BuiltModel engine =
      joined(system + part("block", files_.block, there) + part("plate", files_.plate, there) +
             kTie);
  expect_same_elastic(free_hz(engine.model, 40), free_hz(whole_, 40), 1e-9);
  EXPECT_LE(engine.certificate.rigid_force_residue.value(), 1e-10);
  EXPECT_LE(engine.certificate.rigid_recovery_error.value(), 1e-12);
  const Vector3d z(0.6, 0.0, 0.8), x(0.0, 1.0, 0.0);
  Eigen::Matrix3d frame;
  frame << x, z.cross(x), z;
  const Vector3d centre = Vector3d(0.3, -0.2, 0.5) + frame * whole_.mass.centre;
  EXPECT_LT((engine.model.mass.centre - centre).norm(), 1e-12);
}

TEST_F(CompleteParts, HardB10_MirroredPartsAreTheMirroredMesh) {
  // A plate of uneven cells below y = 0, whose reflection stands on the block.
  const mesh::Mesh plain = block_mesh(
      {3, 2, 1},
      [](const Vector3d& x) -> Vector3d {
        return {0.24 * (1.0 - x(0)), -0.1 * std::pow(x(1), 1.3), 0.06 + 0.012 * x(2)};
      },
      {CellType::kHex8, false, false});
  const fe::FeModel b = build_all(plain, material("body", kAluminium) + kept("z0")).model;
  const auto file = reduced_file("left", b, complete(b));
  const assembly::BuiltModel engine = joined(
      part("block", files_.block) + part("plate", file, "mirror = \"y\"\n") + kTie);
  EXPECT_LE(engine.certificate.rigid_force_residue.value(), 1e-10);
  EXPECT_LE(engine.certificate.rigid_recovery_error.value(), 1e-12);
  EXPECT_LE(engine.certificate.mass_error.value(), 1e-10);
  // The same plate meshed where the mirrored one stands.
  mesh::Mesh there = plain;
  there.nodes.col(1) *= -1.0;
  for (mesh::CellBlock& cells : there.cells) {
    const IndexMatrix before = cells.nodes;
    cells.nodes.leftCols(4) = before.rightCols(4);
    cells.nodes.rightCols(4) = before.leftCols(4);
  }
  for (auto& [name, surface] : there.surfaces)
    for (mesh::FaceBlock& faces : surface.faces) faces.nodes.rowwise().reverseInPlace();
  const VectorXd expected = free_hz(whole(block({4, 2, 2}, CellType::kHex8), there), 40);
  expect_same_elastic(free_hz(engine.model, 40), expected, 1e-9);
}

TEST_F(CompleteParts, AreReducedAgainWithTheirSkinsAndCertified) {
  const fe::FeModel engine =
      joined(part("block", files_.block) + part("plate", files_.plate) + kTie +
             "[[nodes]]\nname = \"corner\"\nnode_set = \"block_joint\"\n")
          .model;
  set_quiet(true);
  StepClock clock;
  CondenseOptions options;
  options.boundary = {"corner"};
  options.modes.fmax_hz = 20e3;
  const rom::ReducedModel again = condense(engine, options, clock);
  EXPECT_EQ(again.certificate.rigid_modes.value(), 6.0);
  EXPECT_LE(again.certificate.mass_error.value(), 1e-9);
  EXPECT_EQ(again.certificate.certified.value(), 1.0);
  ASSERT_GT(again.skin.nodes.rows(), 0);
  EXPECT_TRUE(again.skin.faces.contains("plate_skin"));
  EXPECT_TRUE(again.skin.faces.contains("plate_z1"));
  // Rigid motions of the skin by its rows.
  const Eigen::MatrixXd moved = again.skin.T * again.rigid;
  for (Eigen::Index a = 0; a < again.skin.nodes.rows(); ++a) {
    const Vector3d at = again.skin.nodes.row(a).transpose();
    for (int d = 0; d < 3; ++d) {
      EXPECT_LT((moved.block<3, 1>(3 * a, d) - Vector3d::Unit(d)).norm(), 1e-9);
      EXPECT_LT((moved.block<3, 1>(3 * a, 3 + d) - Vector3d::Unit(d).cross(at)).norm(), 1e-9);
    }
  }
}

TEST_F(CompleteParts, HardB17_MassCouplesWhatStiffnessDoesNot) {
  // Modes of a reduced part are coupled with its boundary by M alone; fronts of K have no place for
  // these entries, and they were written beside it.
  const fe::FeModel b_with_top =
      build_all(plate({6, 4, 2}, CellType::kHex8),
                material("body", kAluminium) + kept("z0") +
                    "[[nodes]]\nname = \"top\"\nsurface = \"z1\"\n")
          .model;
  CondenseOptions two_sets = below(40e3);
  two_sets.boundary = {"joint", "top"};
  const fe::FeModel a_fine =
      build_all(block({8, 4, 3}, CellType::kHex8), material("body", kIron) + kept("z1")).model;
  const fe::FeModel engine =
      joined(part("block", reduced_file("fine", a_fine, below(40e3))) +
             part("plate", reduced_file("topped", b_with_top, two_sets)) + kTie)
          .model;
  set_quiet(true);
  StepClock clock;
  CondenseOptions options;
  options.boundary = {"plate_top"};
  options.method = "guyan";
  options.skin = {};
  const rom::ReducedModel guyan = condense(engine, options, clock);
  const Eigen::MatrixXd K = assembly::testing::full(engine.K), M = assembly::testing::full(engine.M);
  const std::vector<int32_t>& b = engine.set("plate_top").dofs;
  std::vector<int32_t> i;
  for (int32_t dof = 0; dof < engine.size(); ++dof)
    if (std::ranges::count(b, dof) == 0) i.push_back(dof);
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(engine.size(), static_cast<Eigen::Index>(b.size()));
  V(b, Eigen::all).setIdentity();
  V(i, Eigen::all) = -K(i, i).ldlt().solve(K(i, b));
  const Eigen::MatrixXd K_rr = V.transpose() * K * V, M_rr = V.transpose() * M * V;
  EXPECT_LT((guyan.M_rr - M_rr).norm(), 1e-10 * M_rr.norm());
  EXPECT_LT((guyan.K_rr - K_rr).norm(), 1e-10 * K_rr.norm());
}

TEST_F(CompleteParts, MoveTheirSkinsAsTheWholeMeshDoes) {
  // A mode shape of the plate's upper side, up to its sign.
  const auto shape_of = [](const fe::FeModel& model, const std::string& surface) {
    const auto eigen = dense::symmetric_eigen(assembly::testing::full(model.K),
                                              assembly::testing::full(model.M));
    const VectorXd u = model.T * eigen.vectors.col(6);
    std::vector<std::pair<std::array<double, 3>, double>> rows;
    for (const int32_t node : mesh::nodes_of(model.surfaces.at(surface))) {
      const Vector3d at = (1e6 * model.nodes.row(node)).array().round();
      rows.push_back({{at(0), at(1), at(2)}, u(3 * node + 2)});
    }
    std::ranges::sort(rows);
    return rows;
  };
  const fe::FeModel engine =
      joined(part("block", files_.block) + part("plate", files_.plate) + kTie).model;
  const auto expected = shape_of(whole_, "b_z1");
  auto found = shape_of(engine, "plate_z1");
  // The skin has nodes in the middle of the edges too.
  size_t matched = 0;
  const double sign = [&] {
    for (const auto& [at, value] : found)
      if (at == expected[0].first) return value * expected[0].second > 0.0 ? 1.0 : -1.0;
    return 0.0;
  }();
  for (const auto& [at, value] : found)
    for (const auto& [other, of_mesh] : expected)
      if (at == other) {
        EXPECT_NEAR(sign * value, of_mesh, 1e-6 * std::abs(expected[0].second) + 1e-9);
        ++matched;
      }
  EXPECT_EQ(matched, expected.size());
}

TEST_F(CompleteParts, HardB11_WhatThePartsWereReducedForIsTheLimitOfTheAssembly) {
  const TwoFiles low{reduced_file("low", a_, below(30e3)), files_.plate};
  const fe::FeModel engine =
      joined(part("block", low.block) + part("plate", low.plate) + kTie +
             "[[nodes]]\nname = \"corner\"\nnode_set = \"block_joint\"\n")
          .model;
  EXPECT_EQ(engine.parts.count, 2);
  EXPECT_NEAR(engine.parts.valid_to_hz, 30e3, 1e-6);
  set_quiet(true);
  StepClock clock;
  CondenseOptions options;
  options.boundary = {"corner"};
  options.modes.fmax_hz = 60e3;
  const rom::ReducedModel again = condense(engine, options, clock);
  EXPECT_LE(again.certificate.cutoff_hz.value(), 30e3 + 1e-6);
  EXPECT_LE(again.valid_to_hz, 30e3 + 1e-6);
  options.modes.fmax_hz = 0.0;
  options.modes.accurate_to_hz = 20e3;
  test::expect_parts(
      test::refusal_of<NumericsError>([&] { (void)condense(engine, options, clock); }),
      {"engine: accurate_to_hz", "20000 Hz", "2 reduced parts", "15000 Hz"});
  // Without a certificate of a part there is none of the assembly.
  CondenseOptions quick = complete(a_);
  quick.certificate = false;
  const auto bare = reduced_file("bare", a_, quick);
  const fe::FeModel doubtful =
      joined(part("block", bare) + part("plate", files_.plate) + kTie +
             "[[nodes]]\nname = \"corner\"\nnode_set = \"block_joint\"\n")
          .model;
  EXPECT_FALSE(doubtful.parts.certified);
  options.modes = {};
  options.modes.fmax_hz = 5e3;
  EXPECT_EQ(condense(doubtful, options, clock).certificate.certified.value(), 0.0);
}

std::string gasket(double normal, double tangential, const std::string& slave = "plate_joint",
                   const std::string& master = "block_joint") {
  return fmt::format(
      "[[gasket]]\nslave = \"{}\"\nmaster = \"{}\"\nnormal_stiffness = {:.1f}\n"
      "tangential_stiffness = {:.1f}\n",
      slave, master, normal, tangential);
}

TEST(Gaskets, BetweenBlockAndPlateGiveTheFrequenciesOfAnotherProgram) {
  // Fine hex20 mesh of the reference; here 12 x 5 x (3 + 1) cells.
  const TwoFiles files = coarse_parts(32e3, {12, 5, 1});
  const std::string parts = part("block", files.block) + part("plate", files.plate);
  const auto compare = [&](double k, std::vector<double> expected, double error) {
    const VectorXd hz = free_hz(joined(parts + gasket(k, 0.1 * k)).model, 14);
    EXPECT_LT(hz(5), 1.0);
    for (size_t j = 0; j < expected.size(); ++j)
      EXPECT_NEAR(hz(static_cast<Eigen::Index>(6 + j)) / expected[j], 1.0, error) << k << " " << j;
  };
  compare(1e10, {914.273, 923.522, 949.334, 2852.055, 2856.546, 2886.564, 2895.540, 3104.95}, 3e-3);
  compare(1e11, {2817.97, 2906.996, 2992.431, 3474.136, 4165.218, 4899.958}, 5e-3);
  compare(1e12, {3726.712, 4116.550, 4956.348, 7679.689, 8200.820, 8222.275}, 5e-3);
  compare(1e14, {4010.957, 4539.350, 4973.513, 8264.332, 8642.573, 8973.118}, 5e-3);
}

TEST_F(CompleteParts, HardB14_AGasketIsATieAtItsStiffestAndTwoBodiesAtItsSoftest) {
  const std::string parts = part("block", files_.block) + part("plate", files_.plate);
  const VectorXd tied = free_hz(joined(parts + kTie).model, 16);
  const auto error = [&](double k) {
    const VectorXd hz = free_hz(joined(parts + gasket(k, k)).model, 16);
    return (hz.tail(10).array() / tied.tail(10).array() - 1.0).abs().maxCoeff();
  };
  // Of first order in 1 / k, until rounding: 1e16 N/m3 on steel is four digits from either.
  EXPECT_NEAR(error(1e14) / error(1e15), 10.0, 0.1);
  EXPECT_LT(error(1e16), 1e-5);
  EXPECT_LT(error(1e17), 1e-6);
  // Soft: both are rigid, and slide and bounce at the closed forms of masses per area.
  const VectorXd soft = free_hz(joined(parts + gasket(1e8, 1e7)).model, 13);
  const double m1 = 0.06 * 7200.0, m2 = 0.012 * 2700.0, mu = m1 * m2 / (m1 + m2);
  const double slide = std::sqrt(1e7 / mu) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(soft(6) / slide, 1.0, 1e-3);
  EXPECT_LT(soft(5), 0.1);
  double nearest = 1.0;
  for (int j = 6; j < 12; ++j)
    nearest = std::min(nearest, std::abs(soft(j) / (std::sqrt(10.0) * slide) - 1.0));
  EXPECT_LT(nearest, 1e-3);
  EXPECT_GT(soft(12), 500.0);
}

TEST_F(CompleteParts, OfTheGasketMeetTheSameGasketOnTheWholeMesh) {
  const fe::FeModel mesh =
      build_all(assembly::testing::two_parts(block({4, 2, 2}, CellType::kHex8),
                                             plate({3, 2, 1}, CellType::kHex8)),
                "[material.a]\nregions = [\"a\"]\n" + kIron + "[material.b]\nregions = [\"b\"]\n" +
                    kAluminium + gasket(1e11, 1e10, "b_z0", "a_z1"))
          .model;
  const VectorXd expected = free_hz(mesh, 40);
  const VectorXd found = free_hz(
      joined(part("block", files_.block) + part("plate", files_.plate) + gasket(1e11, 1e10)).model,
      40);
  expect_same_elastic(found, expected, 1e-9);
}

TEST(Gaskets, LeaveRigidMotionsFreeAcrossAGap) {
  // The plate 3 mm above the block, on slave faces that the block's do not match.
  const mesh::Mesh above = box({0.01, 0.005, 0.063}, {0.22, 0.09, 0.012}, {3, 2, 1});
  const assembly::BuiltModel built =
      build_all(assembly::testing::two_parts(block({4, 2, 2}), above),
                "[material.a]\nregions = [\"a\"]\n" + kIron + "[material.b]\nregions = [\"b\"]\n" +
                    kAluminium + gasket(1e12, 1e11, "b_z0", "a_z1") + "distance = 0.005\n");
  EXPECT_LE(built.certificate.rigid_force_residue.value(), 1e-10);
  EXPECT_EQ(built.certificate.rigid_motions_held_by_equations.value(), 0.0);
  const VectorXd hz = free_hz(built.model, 7);
  EXPECT_LT(hz(5), 1.0);
  EXPECT_GT(hz(6), 100.0);
}

/// The nodes at the corners of a face that both meshes have, each a set of its own too.
std::string corners(const std::string& surface) {
  std::string toml;
  for (int c = 0; c < 4; ++c)
    toml += fmt::format("[[sensor]]\nname = \"corner_{}\"\nsurface = \"{}\"\nnear = [{}, {}, 0.06]\n",
                        c, surface, c % 2 == 0 ? 0.0 : 0.24, c < 2 ? 0.0 : 0.1);
  return toml;
}

TEST(ReducedParts, HardB13_SoftSpringsBetweenThemBounceAtTheClosedForm) {
  const auto reduced = [](const std::string& name, const mesh::Mesh& mesh, const std::string& of,
                          const std::string& surface) {
    const fe::FeModel model =
        build_all(mesh, material("body", of) + kept(surface) + corners(surface)).model;
    CondenseOptions options = complete(model);
    options.boundary = {"joint", "corner_0", "corner_1", "corner_2", "corner_3"};
    return reduced_file(name, model, options);
  };
  std::string toml =
      part("block", reduced("block", block({4, 2, 2}, CellType::kHex8), kIron, "z1")) +
      part("plate", reduced("plate", plate({3, 2, 1}, CellType::kHex8), kAluminium, "z0"));
  const double k = 1e3;
  for (int c = 0; c < 4; ++c)
    toml += fmt::format(
        "[[spring]]\nstiffness = {}\nterms = [{{node_set = \"block_corner_{}\", direction = \"z\", "
        "coefficient = -1.0}}, {{node_set = \"plate_corner_{}\", direction = \"z\"}}]\n",
        k, c, c);
  const fe::FeModel engine = joined(toml).model;
  const VectorXd hz = free_hz(engine, 13);
  // Nine motions are free: three of the assembly in the plane for each part, three of both.
  EXPECT_LT(hz(8), 0.1);
  EXPECT_GT(hz(9), 5.0);
  EXPECT_GT(hz(12), 500.0);
  const double m1 = 0.24 * 0.1 * 0.06 * 7200.0, m2 = 0.24 * 0.1 * 0.012 * 2700.0;
  const double bounce = std::sqrt(4.0 * k * (m1 + m2) / (m1 * m2)) / (2.0 * std::numbers::pi);
  double nearest = 1.0;
  for (int j = 9; j < 12; ++j) nearest = std::min(nearest, std::abs(hz(j) / bounce - 1.0));
  EXPECT_LT(nearest, 2e-4);
}

TEST_F(CompleteParts, HardB12_WhatCannotStandInAnAssemblyIsRefused) {
  const auto refused = [](const std::string& toml) {
    return test::refusal_of([&] { (void)joined(toml); });
  };
  const std::string both = part("block", files_.block) + part("plate", files_.plate);
  test::expect_parts(refused(part("block", files_.block, "keeps_names = true\n") +
                             part("plate", files_.plate, "keeps_names = true\n")),
                     {"\"joint\"", "twice", "keeps_names"});
  test::expect_parts(refused(both + kTie + "[[load]]\nname = \"turns\"\nkind = \"centrifugal\"\n"
                                           "axis_point = [0.0, 0.0, 0.0]\naxis = [0.0, 0.0, 1.0]\n"),
                     {"load[0].kind", "beside a reduced part"});
  test::expect_parts(
      refused("[system.round]\nkind = \"cylindrical\"\norigin = [0.0, 0.0, 0.0]\nz = [0.0, 0.0, "
              "1.0]\n" +
              part("block", files_.block, "system = \"round\"\n")),
      {"part[0].system", "not rectangular"});
  test::expect_parts(refused(both + "[[tie]]\nslave = \"plate_joint\"\nmaster = \"pan_joint\"\n"),
                     {"pan_joint", "block_joint"});
  test::expect_parts(refused(both + gasket(0.0, 0.0)), {"gasket[0].normal_stiffness", "one above"});
  test::expect_parts(refused(both + gasket(1e10, 1e9, "pan_joint")),
                     {"gasket[0].slave", "pan_joint", "plate_joint"});
  const fe::FeModel held =
      build_all(block({4, 2, 2}, CellType::kHex8),
                material("body", kIron) + kept("z1") + "[[support]]\nsurface = \"z0\"\n")
          .model;
  test::expect_parts(refused(part("block", reduced_file("held", held, below(20e3)))),
                     {"part[0].file", "held.rom.h5", "[[support]] holds the assembly"});
  fe::FeModel damped = b_;
  damped.alpha = 1e-5;
  const auto other = reduced_file("damped", damped, complete(damped));
  const std::string differs = part("block", files_.block) + part("plate", other) + kTie;
  test::expect_parts(refused(differs), {"alpha 1e-05", "[damping] of the assembly"});
  EXPECT_EQ(joined(differs + "[damping]\nalpha = 2e-6\n").model.alpha, 2e-6);
}

/// A sheet whose left half lies on a block, and the block.
class SheetOnABlock : public ::testing::Test {
 protected:
  static constexpr const char* kWithoutNormal =
      "directions = [\"x\", \"y\", \"z\", \"rx\", \"ry\"]\n";
  static constexpr double kHigh = 0.021;  // half a thickness above the block

  static mesh::Mesh the_block() { return block_mesh({4, 2, 1}, brick({0.4, 0.05, 0.02})); }
  static mesh::Mesh the_sheet() {
    mesh::Mesh mesh = assembly::testing::sheet(0.5, 0.05, 10, 2);
    mesh.nodes.col(2).setConstant(kHigh);
    for (int32_t a = 0; a < mesh.nodes.rows(); ++a)
      if (mesh.nodes(a, 0) < 0.26) mesh.node_sets["foot"].push_back(a);
    return mesh;
  }

  static std::string tie(const std::string& slave, const std::string& master) {
    return "[[tie]]\nslave = \"" + slave + "\"\nmaster = \"" + master + "\"\ndistance = 0.002\n";
  }

  static const std::string& iron() {
    static const std::string toml = material("body", kIron);
    return toml;
  }

  /// Both in one mesh.
  static VectorXd of_one_mesh() {
    mesh::Mesh mesh = the_block();
    const mesh::Mesh above = the_sheet();
    const auto first = static_cast<int32_t>(mesh.nodes.rows());
    mesh.nodes.conservativeResize(first + above.nodes.rows(), 3);
    mesh.nodes.bottomRows(above.nodes.rows()) = above.nodes;
    mesh.regions.push_back("sheet");
    mesh::ShellBlock shells = above.shells[0];
    shells.region = 1;
    shells.nodes.array() += first;
    mesh.shells = {shells};
    mesh.node_sets.clear();
    mesh.surfaces["skin"] = mesh::skin_of(mesh::boundary_faces(mesh), mesh.shells);
    mesh::FaceBlock foot{mesh::FaceType::kQuad4, IndexMatrix(10, 4)};
    for (int j = 0; j < 2; ++j) foot.nodes.middleRows(5 * j, 5) = shells.nodes.middleRows(10 * j, 5);
    mesh.surfaces["foot"].faces = {foot};
    return elastic_hz(build_all(mesh, assembly::testing::kSheetSteel + iron() + tie("foot", "z1")).model);
  }

  static VectorXd elastic_hz(const fe::FeModel& model) {
    modes::ModesOptions options;
    options.count = 16;
    const modes::PartModes found = modes::analyse(model, options);
    return found.modes.frequencies_hz();
  }

  static std::filesystem::path sheet_file(const std::string& directions = kWithoutNormal) {
    const fe::FeModel model =
        build_all(the_sheet(), assembly::testing::kSheetSteel +
                                   "[[nodes]]\nname = \"joint\"\n[[nodes.term]]\nnode_set = \"foot\"\n" +
                                   directions)
            .model;
    return reduced_file("sheet", model, below(5e4));
  }

  static std::filesystem::path block_file() {
    const fe::FeModel model = build_all(the_block(), iron() + kept("z1")).model;
    return reduced_file("base", model, complete(model));
  }
};

TEST_F(SheetOnABlock, IsTheSameAsOneMeshAsAMeshWithAPartAndAsTwoParts) {
  const VectorXd expected = of_one_mesh();
  const std::string sheet = part("sheet", sheet_file());
  const std::string base = part("block", block_file());
  // Against one mesh by what the modes of the sheet above 50 kHz would add.
  const VectorXd parts =
      elastic_hz(joined(sheet + base + tie("sheet_joint", "block_joint")).model);
  expect_same_elastic(parts, expected, 1e-5);
  expect_same_elastic(
      elastic_hz(build_all(the_block(), iron() + sheet + tie("sheet_joint", "z1")).model), parts,
      1e-8);
  // Without rotations the sheet's face turns as the block's, which is stiffer on large cells.
  const VectorXd plain =
      elastic_hz(joined(part("sheet", sheet_file("directions = \"xyz\"\n")) + base +
                        tie("sheet_joint", "block_joint"))
                     .model);
  expect_same_elastic(plain, expected, 0.03);
  mesh::Mesh mesh = the_sheet();
  const fe::FeModel onto =
      build_all(mesh, assembly::testing::kSheetSteel + base +
                          "[[nodes]]\nname = \"end\"\nnode_set = \"tip\"\n")
          .model;
  // Not joined: each has its own rigid motions.
  EXPECT_LT(elastic_hz(onto)(11), 1e-2);
  EXPECT_GT(elastic_hz(onto)(12), 1.0);
}

TEST_F(SheetOnABlock, HardB16_RotationsAboutItsNormalMoveNoMassAndAreNamed) {
  test::expect_parts(test::refusal_of<NumericsError>([] { (void)sheet_file(""); }),
                     {"M_rr is not positive definite", ".rz moves no mass", "rotation about its normal"});
}

TEST_F(SheetOnABlock, HardB15_ItsSkinStaysASheetInTheAssembly) {
  const fe::FeModel engine =
      joined(part("sheet", sheet_file()) + part("block", block_file()) +
             tie("sheet_joint", "block_joint") +
             "[[nodes]]\nname = \"held\"\nnode_set = \"block_joint\"\n")
          .model;
  set_quiet(true);
  StepClock clock;
  CondenseOptions options;
  options.boundary = {"held"};
  options.modes.fmax_hz = 5e3;
  const rom::ReducedModel again = condense(engine, options, clock);
  EXPECT_EQ(again.skin.sheet.size(), 40U);  // 20 quadrilaterals of two triangles
  EXPECT_EQ(again.skin.sheet, again.skin.faces.at("sheet_skin"));
  options.skin = {"block_skin"};
  EXPECT_TRUE(condense(engine, options, clock).skin.sheet.empty());
}

TEST(Placement, TurnsSetsMotionsMassAndSkins) {
  rom::ReducedModel model;
  model.M_rr = model.K_rr = Eigen::MatrixXd::Identity(2, 2);
  rom::DofSet& set = model.sets["node"];
  set.dofs = {0, 1};
  set.labels = {"node.x", "node.rx"};
  set.is_rotation = {0, 1};
  set.position = Eigen::RowVector3d(1.0, 2.0, 3.0).replicate(2, 1);
  set.direction = Eigen::RowVector3d::UnitX().replicate(2, 1);
  set.faces["tri6"] = (IndexMatrix(1, 6) << 0, 1, 2, 3, 4, 5).finished();
  model.rigid = Eigen::MatrixXd::Zero(2, 6);
  model.rigid.row(0) << 1, 0, 0, 0, 3, -2;  // x at (1, 2, 3)
  model.rigid(1, 3) = 1.0;
  Eigen::Matrix3d frame = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal();
  const rom::ReducedModel placed = rom::placed(model, {Vector3d(10.0, 0.0, 0.0), frame});
  const rom::DofSet& there = placed.set("node");
  EXPECT_EQ(Vector3d(there.position.row(0)), Vector3d(9.0, 2.0, 3.0));
  EXPECT_EQ(Vector3d(there.direction.row(0)), Vector3d(-1.0, 0.0, 0.0));
  EXPECT_EQ(Vector3d(there.direction.row(1)), Vector3d(1.0, 0.0, 0.0));  // an axial vector
  // u . (-x) at (9, 2, 3): -(t + w x r)_x = -(t_x + w_y 3 - w_z 2).
  const Eigen::RowVectorXd expected =
      (Eigen::RowVectorXd(6) << -1, 0, 0, 0, -3, 2).finished();
  EXPECT_EQ(Eigen::RowVectorXd(placed.rigid.row(0)), expected);
  EXPECT_EQ(placed.rigid(1, 3), 1.0);
  // Seen from the other side, with the middles of the same edges.
  const IndexMatrix turned = (IndexMatrix(1, 6) << 2, 1, 0, 4, 3, 5).finished();
  EXPECT_EQ(there.faces.at("tri6"), turned);
}

}  // namespace
}  // namespace clatter::condense
