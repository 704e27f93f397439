// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of sheet: the parametric pan, faces of CAD, solids of constant thickness.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/mesh/shell_shape.hpp"
#include "mesh/geometry/sheet_sides.hpp"
#include "mesh_toml.hpp"
#include "support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;
using testing::Folder;
using testing::mesh_toml;

constexpr double kPi = std::numbers::pi;

std::string sheet_of(const std::filesystem::path& source, const std::string& keys = "",
                     double size = 8.0) {
  return fmt::format(
      "name = 'part'\nkind = 'sheet'\n[sheet]\nsource = '{}'\n{}\n[mesh]\nelement_size_mm = {}\n",
      source.string(), keys, size);
}

/// Writes what `build` makes of an empty session.
template <class Build>
void write_part(const std::filesystem::path& path, const Build& build) {
  GmshSession session("made");
  build(session);
  session.write_cad(path, "mm");
}

Vector3d area_vector(const Mesh& mesh, const std::string& surface) {
  return integrate(mesh, mesh.surface(surface)).normal;
}

TEST(Sheet, PanHasItsAreaItsThicknessAndItsOutwardSide) {
  const Mesh mesh =
      mesh_toml(
          "name = 'pan'\nkind = 'pan'\n[pan]\nthickness = 1.5\n[mesh]\nelement_size_mm = 12\n"
          "elements_per_turn = 12\n")
          .part.mesh;
  ASSERT_FALSE(mesh.shells.empty());
  EXPECT_TRUE(mesh.cells.empty());
  for (const ShellBlock& block : mesh.shells) {
    EXPECT_TRUE((block.thickness.array() == 1.5e-3).all());
    EXPECT_EQ(block.offset.size(), 0);
  }
  // Flange without the straight and round edges of its fillets; the bottom likewise.
  const double flange = 340.0 * 240 - (4.0 - kPi) * 60 * 60 - (312.0 * 212 - (4.0 - kPi) * 46 * 46);
  const double bottom = 276.0 * 176 - (4.0 - kPi) * 28 * 28;
  EXPECT_NEAR(area_vector(mesh, "flange").z(), -1e-6 * flange, 1e-8 * flange);
  EXPECT_NEAR(area_vector(mesh, "bottom").z(), -1e-6 * bottom, 1e-8 * bottom);
  // What the closed lid over the flange's edge has, seen from below.
  EXPECT_NEAR(area_vector(mesh, "skin").z(), -1e-6 * (340.0 * 240 - (4.0 - kPi) * 60 * 60), 3e-4);
  for (const int32_t node : mesh.node_set("free_edges")) {
    EXPECT_NEAR(mesh.nodes(node, 2), 0.0, 1e-9);
    EXPECT_GT(std::max(std::abs(mesh.nodes(node, 0)) / 0.15, std::abs(mesh.nodes(node, 1)) / 0.1),
              0.9);
  }
}

TEST(Sheet, QuadraticCellsLieOnTheCurvedSheet) {
  const std::string pan =
      "name = 'pan'\nkind = 'pan'\n[pan]\nthickness = 1.5\n{}[mesh]\nelement_size_mm = 20\n"
      "elements_per_turn = 12\n";
  const auto linear = mesh_toml(fmt::format(fmt::runtime(pan), "")).part;
  const auto curved = mesh_toml(fmt::format(fmt::runtime(pan), "cells = 'quadratic'\n")).part;
  for (const ShellBlock& block : curved.mesh.shells) EXPECT_EQ(traits(block.type).order, 2);
  EXPECT_EQ(curved.certificate.cells, linear.certificate.cells);
  EXPECT_LT(std::abs(*curved.certificate.shell_area_against_cad),
            0.02 * std::abs(*linear.certificate.shell_area_against_cad));
  // A mid-side node for each side of the edge: as many as corners.
  EXPECT_EQ(curved.mesh.node_set("free_edges").size(),
            2 * linear.mesh.node_set("free_edges").size());
  EXPECT_EQ(curved.mesh.surface("skin").faces.back().type, FaceType::kQuad8);
}

TEST(Sheet, PanWithASumpIsOnePiece) {
  const auto part = mesh_toml(
                        "name = 'pan'\nkind = 'pan'\n[pan]\nlength = 400\nsump_depth = 150\n"
                        "sump_length = 150\ncells = 'triangles'\n[mesh]\nelement_size_mm = 20\n")
                        .part;
  EXPECT_EQ(part.certificate.shell_triangles, part.certificate.cells);
  EXPECT_LT(area_vector(part.mesh, "sump").z(), 0.0);
  EXPECT_LT(area_vector(part.mesh, "bottom").z(), 0.0);
  EXPECT_LT(std::abs(*part.certificate.shell_area_against_cad), 0.02);
  double highest = 0.0;
  for (const int32_t node : part.mesh.node_set("free_edges"))
    highest = std::max(highest, std::abs(part.mesh.nodes(node, 2)));
  EXPECT_LT(highest, 1e-9);
}

TEST(Sheet, SolidOfConstantThicknessIsMeshedFromItsOuterSide) {
  const Folder folder;
  write_part(folder / "tube.step", [](GmshSession& session) {
    const Solids outer = {session.cylinder(Vector3d::Zero(), {0, 0, 200}, 50)};
    session.cut(outer, {session.cylinder({0, 0, -1}, {0, 0, 202}, 48)});
  });
  const Mesh mesh = mesh_toml(sheet_of(folder / "tube.step")).part.mesh;
  for (const ShellBlock& block : mesh.shells) {
    EXPECT_LT((block.thickness.array() - 2e-3).abs().maxCoeff(), 1e-12);
    EXPECT_LT((block.offset.array() + 1e-3).abs().maxCoeff(), 1e-12);
    for (const auto& cell : block.nodes.rowwise()) {
      const Vector3d a = mesh.nodes.row(cell(0)), b = mesh.nodes.row(cell(1)),
                     c = mesh.nodes.row(cell(2));
      const Vector3d normal = (b - a).cross(c - a);
      EXPECT_GT(normal.dot(Vector3d(a.x(), a.y(), 0.0)), 0.0);
      EXPECT_NEAR(std::hypot(a.x(), a.y()), 0.05, 1e-9);
    }
  }
  const double area = integrate(mesh, mesh.surface("skin")).area;
  EXPECT_NEAR(area, 1e-6 * 2 * kPi * 50 * 200, 1e-3 * area * 10);
}

TEST(Sheet, SharpBendsAreOfASideToo) {
  // A box of 3 mm sheet without fillets, open above, walls ten thicknesses high.
  const Folder folder;
  write_part(folder / "box.step", [](GmshSession& session) {
    session.cut({session.box({0, 0, 0}, {120, 100, 30})}, {session.box({3, 3, 3}, {117, 97, 40})});
  });
  const Mesh mesh = mesh_toml(sheet_of(folder / "box.step")).part.mesh;
  EXPECT_NEAR(integrate(mesh, mesh.surface("skin")).area, 1e-6 * (12000 + 440 * 30), 1e-12);
  EXPECT_NEAR(area_vector(mesh, "skin").z(), -0.012, 1e-12);
  EXPECT_EQ(mesh.shells[0].offset(0), -1.5e-3);
}

TEST(Sheet, EachPieceHasTheOutwardSideOfItsSolid) {
  // Tops and sides of two blocks that do not touch; gmsh may turn the faces of one the other way.
  const Folder folder;
  write_part(folder / "two.step", [](GmshSession& session) {
    session.box({0, 0, 0}, {60, 50, 40});
    session.rotate({session.box({100, 0, 0}, {160, 50, 40})}, {130, 25, 20}, {1, 0, 0}, 180);
  });
  const Mesh mesh = mesh_toml(sheet_of(folder / "two.step",
                                       "thickness = 1\nside = 'outer'\n[sheet.faces]\n"
                                       "box = { min = [-1, -1, -1], max = [200, 60, 60] }"))
                        .part.mesh;
  Vector3d middle = 1e-3 * Vector3d(30, 25, 20);
  for (const ShellBlock& block : mesh.shells)
    for (const auto& cell : block.nodes.rowwise()) {
      const Vector3d a = mesh.nodes.row(cell(0)), b = mesh.nodes.row(cell(1)),
                     c = mesh.nodes.row(cell(2));
      middle.x() = a.x() < 0.08 ? 0.03 : 0.13;  // of its block
      EXPECT_GT((b - a).cross(c - a).dot(a - middle), 0.0);
    }
}

TEST(Sheet, HardU8_SolidsThatAreNoSheetAreRefusedWithThePlace) {
  const Folder folder;
  const auto boxes = [](const Vector3d& min, const Vector3d& max) {
    return [=](GmshSession& session) {
      session.fuse({session.box({0, 0, 0}, {100, 100, 2})}, {session.box(min, max)});
    };
  };
  write_part(folder / "stepped.step", boxes({100, 0, 0}, {200, 100, 4}));
  EXPECT_THAT(
      test::refusal_of<NumericsError>([&] { mesh_toml(sheet_of(folder / "stepped.step")); }),
      ::testing::HasSubstr("the sheet is not 4 mm thick everywhere: 2 to 4 behind face"));
  write_part(folder / "ribbed.step", boxes({49, 0, 2}, {51, 100, 40}));
  EXPECT_THAT(test::refusal_of<NumericsError>([&] { mesh_toml(sheet_of(folder / "ribbed.step")); }),
              ::testing::HasSubstr("found 3 connected sides of 2 mm of thickness"));
  write_part(folder / "block.step", [](GmshSession& session) {
    session.box({0, 0, 0}, {100, 80, 60});
  });
  EXPECT_THAT(test::refusal_of<NumericsError>([&] { mesh_toml(sheet_of(folder / "block.step")); }),
              ::testing::HasSubstr("expected a sheet: kind = \"cad\" meshes solids"));
}

TEST(Sheet, FacesOfASolidAreChosenByPositionAndLieInTheSheetAsSaid) {
  const Folder folder;
  write_part(folder / "box.step", [](GmshSession& session) {
    session.box({0, 0, 0}, {100, 80, 60});
  });
  const std::string faces =
      "thickness = 2\nside = '{}'\n[sheet.faces]\noutside = {{ min = [-1, -1, 59], max = [101, 81, "
      "61] }}"
      "\n[edge.rim]\nplane = {{ normal = [0, 0, 1], height = 60 }}";
  const Mesh mesh =
      mesh_toml(sheet_of(folder / "box.step", fmt::format(fmt::runtime(faces), "inner"))).part.mesh;
  EXPECT_NEAR(integrate(mesh, mesh.surface("skin")).area, 1e-6 * (2 * 60 * 180 + 8000), 1e-12);
  EXPECT_NEAR(area_vector(mesh, "skin").z(), -8e-3, 1e-12);  // open above
  EXPECT_EQ(mesh.shells[0].offset(0), 1e-3);
  EXPECT_EQ(mesh.node_set("rim"), mesh.node_set("free_edges"));
  EXPECT_FALSE(mesh.node_set("rim").empty());
  const Mesh outer =
      mesh_toml(sheet_of(folder / "box.step", fmt::format(fmt::runtime(faces), "outer"))).part.mesh;
  EXPECT_EQ(outer.shells[0].offset(0), -1e-3);
}

TEST(Sheet, HardU9_FacesThatOnlyTouchAreJoined) {
  const Folder folder;
  // Two faces of boxes as a tee: no common edge in the file.
  write_part(folder / "tee.brep", [](GmshSession& session) {
    session.box({0, 0, -50}, {100, 80, 0});
    session.box({0, 40, 0}, {100, 90, 30});
    std::vector<int> kept;
    for (const FaceFacts& face : session.boundary_faces())
      if ((face.centre - Vector3d(50, 40, 0)).norm() < 1e-6 ||
          (face.centre - Vector3d(50, 40, 15)).norm() < 1e-6)
        kept.push_back(face.tag);
    ASSERT_EQ(kept.size(), 2U);
    session.keep_faces(kept);
  });
  const Mesh mesh = mesh_toml(sheet_of(folder / "tee.brep", "thickness = 1")).part.mesh;
  std::map<std::pair<int32_t, int32_t>, int> cells;
  for (const ShellBlock& block : mesh.shells)
    for (const auto& cell : block.nodes.rowwise())
      for (Eigen::Index i = 0; i < cell.size(); ++i)
        ++cells[std::minmax(cell(i), cell((i + 1) % cell.size()))];
  double length = 0.0;
  for (const auto& [edge, count] : cells)
    if (count == 3) length += (mesh.nodes.row(edge.first) - mesh.nodes.row(edge.second)).norm();
  EXPECT_NEAR(length, 0.1, 1e-12);
}

TEST(Sheet, RefusalsSayWhatIsMissing) {
  const Folder folder;
  write_part(folder / "two.step", [](GmshSession& session) {
    session.box({0, 0, 0}, {100, 80, 1});
    session.box({0, 0, 10}, {100, 80, 11});
  });
  EXPECT_THAT(test::refusal_of([&] { mesh_toml(sheet_of(folder / "two.step")); }),
              ::testing::HasSubstr("found 2 solids, expected one sheet; [sheet.faces] chooses"));
  const std::string bottom =
      "[sheet.faces]\nplane = { normal = [0, 0, 1], height = 0 }\n[edge.free_edges]\n"
      "plane = { normal = [0, 1, 0], height = 0 }";
  EXPECT_THAT(test::refusal_of([&] { mesh_toml(sheet_of(folder / "two.step", bottom)); }),
              ::testing::HasSubstr("found no thickness, expected that of the sheet"));
  EXPECT_THAT(test::refusal_of(
                  [&] { mesh_toml(sheet_of(folder / "two.step", "thickness = 1\n" + bottom)); }),
              ::testing::HasSubstr("edge.free_edges: found a surface or a set of this name"));
  EXPECT_THAT(test::refusal_of([&] {
                part_keys().read(Config::parse(
                    "name = 'b'\nkind = 'box'\n[box]\nsize = [1, 1, 1]\n[edge.rim]\n", "b.toml"));
              }),
              ::testing::HasSubstr("edge"));
  write_part(folder / "faces.step", [](GmshSession& session) {
    session.box({0, 0, 0}, {100, 80, 1});
    session.keep_faces({1});
  });
  EXPECT_THAT(test::refusal_of([&] {
                mesh_toml(fmt::format("name = 'c'\nkind = 'cad'\n[cad]\nsource = '{}'\n",
                                      (folder / "faces.step").string()));
              }),
              ::testing::HasSubstr("kind = \"sheet\" meshes its faces as shells"));
  EXPECT_THAT(
      test::refusal_of([&] {
        part_keys().read(Config::parse("name = 'p'\nkind = 'pan'\n[pan]\ndepth = 15\n", "p.toml"));
      }),
      ::testing::HasSubstr("pan.depth: expected more than both fillets"));
}

/// A face with the same depth behind all its points but the last `others`.
FaceDepths face_of(int tag, double area, double depth, int others = 0) {
  FaceDepths face;
  face.face = tag;
  face.area = area;
  face.centre.setZero();
  for (int i = 0; i < 10; ++i)
    face.depth.push_back(i + others < 10 ? depth : std::numeric_limits<double>::infinity());
  return face;
}

TEST(SheetSides, AreTheFacesWithTheThicknessBehindThem) {
  // Two sides of two faces each, which share curves 1 and 2; the rim shares one with all.
  const std::map<int, std::vector<int>> curves = {
      {1, {1, 10}}, {2, {1, 11}}, {3, {2, 12}}, {4, {2, 13}}, {5, {10, 11, 12, 13}}};
  const std::vector<FaceDepths> faces = {face_of(1, 600, 2), face_of(2, 450, 2.01, 1),
                                         face_of(3, 500, 2), face_of(4, 450, 1.99),
                                         face_of(5, 80, 70)};
  const SheetSides sides = find_sides(faces, curves, 2000.0, {}, "mm");
  EXPECT_EQ(sides.thickness, 2.0);
  EXPECT_EQ(sides.outer, (std::vector{1, 2}));
  EXPECT_EQ(sides.inner, (std::vector{3, 4}));
  EXPECT_EQ(sides.rims, std::vector{5});
  EXPECT_THAT(test::refusal_of<NumericsError>([&] { find_sides(faces, curves, 2600.0, {}, "mm"); }),
              ::testing::HasSubstr("no sheet of 2 mm: its volume is +0.3 of its area"));
}

TEST(ShellShape, OfCellsThatAreKnown) {
  const std::vector<Vector3d> square = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  const ShellShape of_square = shape_of_shell(square);
  EXPECT_NEAR(of_square.jacobian, 1.0, 1e-15);
  EXPECT_EQ(of_square.warp, 0.0);
  EXPECT_EQ(of_square.aspect, 1.0);
  const std::vector<Vector3d> triangle = {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  EXPECT_NEAR(shape_of_shell(triangle).jacobian, 1.0, 1e-15);
  const std::vector<Vector3d> warped = {{0, 0, 0}, {1, 0, 0.1}, {1, 1, 0}, {0, 1, 0.1}};
  EXPECT_NEAR(shape_of_shell(warped).warp, 0.1, 1e-15);
  const std::vector<Vector3d> concave = {{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}};
  EXPECT_LT(shape_of_shell(concave).corner, 0.0);
  EXPECT_LT(shape_of_shell(concave).jacobian, 0.0);
}

}  // namespace
}  // namespace clatter::mesh
