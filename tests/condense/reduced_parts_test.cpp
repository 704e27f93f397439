// SPDX-License-Identifier: GPL-3.0-or-later
// Reduced parts in an assembly: against the whole mesh, placed, mirrored, reduced again.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "tests/condense/part_files.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

using namespace testing;

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
  const assembly::BuiltModel engine = joined(system + part("block", files_.block, there) +
                                             part("plate", files_.plate, there) + kTie);
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
  const mesh::Mesh plain =
      block_mesh({3, 2, 1},
                 [](const Vector3d& x) -> Vector3d {
                   return {0.24 * (1.0 - x(0)), -0.1 * std::pow(x(1), 1.3), 0.06 + 0.012 * x(2)};
                 },
                 {CellType::kHex8, false, false});
  const fe::FeModel b = build_all(plain, material("body", kAluminium) + kept("z0")).model;
  const auto file = reduced_file("left", b, complete(b));
  const assembly::BuiltModel engine =
      joined(part("block", files_.block) + part("plate", file, "mirror = \"y\"\n") + kTie);
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
  const rom::ReducedModel again = reduced_again(engine, "corner", below(20e3));
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

TEST_F(CompleteParts, KeepTheirNamesWhereOneOfThemIsAskedTo) {
  const fe::FeModel engine =
      joined(part("block", files_.block, "keeps_names = true\n") + part("plate", files_.plate) +
             "[[tie]]\nslave = \"plate_joint\"\nmaster = \"joint\"\n")
          .model;
  EXPECT_TRUE(engine.sets.contains("joint"));
  EXPECT_EQ(engine.sets.at("joint").labels[0], "joint[0].x");
  const auto faces = [&](const std::string& name) { return engine.surfaces.at(name).face_count(); };
  // The skin is that of both, not of the part that keeps its names.
  EXPECT_EQ(faces("skin"), faces("block_skin") + faces("plate_skin"));
  EXPECT_GT(faces("x0"), 0);
  EXPECT_GT(faces("plate_x0"), 0);
  fe::FeModel other = b_;
  other.sets["foot"] = other.sets.at("joint");
  other.sets.erase("joint");
  CondenseOptions by_foot = below(20e3);
  by_foot.boundary = {"foot"};
  const auto twice = [&] {
    (void)joined(part("block", files_.block, "keeps_names = true\n") +
                 part("plate", reduced_file("foot", other, by_foot), "keeps_names = true\n"));
  };
  test::expect_parts(test::refusal_of(twice), {"part[1].keeps_names", "surface", "twice"});
}

TEST(ReducedParts, HardB18_FacesAreStoredWhereNodesAreCountedByTheirPositionAlone) {
  set_quiet(true);
  const std::string iron = material("body", kIron);
  const mesh::Mesh mesh = block({2, 1, 1}, CellType::kHex8);
  const auto faces = [&](const std::string& nodes) {
    return build_all(mesh, iron + "[[nodes]]\nname = \"joint\"\n" + nodes).model.set("joint").faces;
  };
  const auto term = [](const std::string& directions) {
    return "[[nodes.term]]\nsurface = \"z1\"\ndirections = \"" + directions + "\"\n";
  };
  EXPECT_EQ(faces(term("xyz")).at("quad4").rows(), 2);
  // All displacements are kept, but not node by node.
  EXPECT_TRUE(faces(term("xy") + term("z")).empty());
  // Two bodies that touch: nodes of both are at one position, one after the other.
  mesh::Mesh both = assembly::testing::two_parts(mesh, plate({2, 1, 1}, CellType::kHex8));
  const auto touching =
      build_all(both, "[material.iron]\nregions = [\"a\", \"b\"]\n" + kIron +
                          "[[nodes]]\nname = \"joint\"\n" + "[[nodes.term]]\nsurface = \"a_z1\"\n" +
                          "[[nodes.term]]\nsurface = \"b_z0\"\n")
          .model;
  for (const auto& [type, found] : touching.set("joint").faces)
    EXPECT_LT(found.maxCoeff(),
              static_cast<int32_t>(rom::nodes_of_set(touching.set("joint")).size()));
}

/// A set that was recovered, or whose interface was reduced, is a combination of coordinates.
TEST_F(CompleteParts, LeaveOutSetsThatAreNoCoordinates) {
  CondenseOptions with_rows = below(20e3);
  const fe::FeModel b = build_all(plate({3, 2, 3}, CellType::kHex8),
                                  material("body", kAluminium) + kept("z0") +
                                      "[[nodes]]\nname = \"top\"\nsurface = \"z1\"\n[[coupling]]\n"
                                      "name = \"end\"\nsurface = \"x1\"\n")
                            .model;
  with_rows.rows = {"top", "end"};
  const fe::FeModel engine =
      joined(part("block", files_.block) + part("plate", reduced_file("rows", b, with_rows)) + kTie)
          .model;
  EXPECT_TRUE(engine.sets.contains("block_joint"));
  EXPECT_FALSE(engine.sets.contains("plate_top"));
  EXPECT_FALSE(engine.sets.contains("plate_end"));
  // A grid stays only with its set: a file with one alone is refused.
  rom::ReducedModel lined = rom::read_reduced_model(files_.plate);
  lined.combined = Eigen::MatrixXd::Zero(1, lined.size());
  rom::DofSet& patch = lined.sets["liner"];
  patch = {.kind = "contact_grid",
           .dofs = {lined.size()},
           .labels = {"liner[0,0]"},
           .position = Eigen::RowVector3d(0.0, 0.0, 0.06),
           .direction = Eigen::RowVector3d(0.0, 0.0, 1.0),
           .is_rotation = {0}};
  rom::ContactGrid& grid = lined.grids["liner"];
  grid.angle = grid.axial = Eigen::VectorXd::Zero(1);
  grid.angle_edges = grid.axial_edges = Eigen::Vector2d(0.0, 1.0);
  const auto path = test::scratch_path("lined.rom.h5");
  H5File file = H5File::create(path);
  write_provenance(file, {rom::kRomSchema, "", {}});
  rom::write_reduced_model(file, lined);
  file.commit();
  EXPECT_TRUE(joined(part("plate", path)).model.grids.empty());
  EXPECT_TRUE(engine.surfaces.contains("plate_x0"));
}

TEST_F(CompleteParts, HardB17_MassCouplesWhatStiffnessDoesNot) {
  // Modes of a reduced part are coupled with its boundary by M alone; fronts of K have no place for
  // these entries, and they were written beside it.
  const fe::FeModel b_with_top = build_all(plate({6, 4, 2}, CellType::kHex8),
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
  CondenseOptions statically;
  statically.method = "guyan";
  const rom::ReducedModel guyan = reduced_again(engine, "plate_top", statically);
  const Eigen::MatrixXd K = assembly::testing::full(engine.K),
                        M = assembly::testing::full(engine.M);
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
    const auto eigen =
        dense::symmetric_eigen(assembly::testing::full(model.K), assembly::testing::full(model.M));
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
  const fe::FeModel engine = joined(part("block", low.block) + part("plate", low.plate) + kTie +
                                    "[[nodes]]\nname = \"corner\"\nnode_set = \"block_joint\"\n")
                                 .model;
  EXPECT_EQ(engine.parts.list.size(), 2);
  EXPECT_NEAR(engine.parts.valid_to_hz(), 30e3, 1e-6);
  const rom::ReducedModel again = reduced_again(engine, "corner", below(60e3));
  EXPECT_LE(again.certificate.cutoff_hz.value(), 30e3 + 1e-6);
  EXPECT_LE(again.valid_to_hz, 30e3 + 1e-6);
  CondenseOptions accurate;
  accurate.modes.accurate_to_hz = 20e3;
  test::expect_parts(
      test::refusal_of<NumericsError>([&] { (void)reduced_again(engine, "corner", accurate); }),
      {"engine: accurate_to_hz", "20000 Hz", "2 reduced parts", "15000 Hz"});
  // Without a certificate of a part there is none of the assembly.
  CondenseOptions quick = complete(a_);
  quick.certificate = false;
  const auto bare = reduced_file("bare", a_, quick);
  const fe::FeModel doubtful = joined(part("block", bare) + part("plate", files_.plate) + kTie +
                                      "[[nodes]]\nname = \"corner\"\nnode_set = \"block_joint\"\n")
                                   .model;
  EXPECT_FALSE(doubtful.parts.certified());
  EXPECT_EQ(reduced_again(doubtful, "corner", below(5e3)).certificate.certified.value(), 0.0);
}

TEST_F(CompleteParts, HardB12_WhatCannotStandInAnAssemblyIsRefused) {
  const auto refused = [](const std::string& toml) {
    return test::refusal_of([&] { (void)joined(toml); });
  };
  const std::string both = part("block", files_.block) + part("plate", files_.plate);
  test::expect_parts(refused(part("block", files_.block, "keeps_names = true\n") +
                             part("plate", files_.plate, "keeps_names = true\n")),
                     {"\"joint\"", "twice", "keeps_names"});
  test::expect_parts(refused(both + kTie +
                             "[[load]]\nname = \"turns\"\nkind = \"centrifugal\"\n"
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

}  // namespace
}  // namespace clatter::condense
