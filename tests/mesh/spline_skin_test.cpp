// SPDX-License-Identifier: GPL-3.0-or-later
// HardG2: a block whose skin is one wavy spline, with ridges of 1 mm radius and walls of 1.5 mm to
// bolt holes, becomes a valid quadratic mesh.
#include <fmt/format.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh_toml.hpp"
#include "support.hpp"

namespace clatter::mesh {
namespace {

using std::numbers::pi;
using testing::Folder;
using testing::mesh_toml;
using testing::Meshed;

constexpr double kHeight = 20.0, kBore = 18.0, kBolt = 2.5, kValleys = 33.0,
                 kWall = 1.5;  // mm

/// The block as BREP in `file`; returns its volume [mm3], of the area within 400 000 chords.
double write_wavy_block(const std::string& file) {
  namespace occ = gmsh::model::occ;
  GmshSession session("wavy");
  constexpr int kPoints = 360;
  std::vector<int> points;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * pi * i / kPoints,
                 radius = kValleys + 1.2 * (1.0 + std::cos(30.0 * angle));
    points.push_back(occ::addPoint(radius * std::cos(angle), radius * std::sin(angle), 0.0));
  }
  points.push_back(points.front());
  const int outline = occ::addSpline(points);
  occ::synchronize();
  std::vector<double> from, to, along, at;
  gmsh::model::getParametrizationBounds(1, outline, from, to);
  constexpr int kChords = 400000;
  for (int i = 0; i <= kChords; ++i) along.push_back(from[0] + (to[0] - from[0]) * i / kChords);
  gmsh::model::getValue(1, outline, along, at);
  double twice_area = 0.0;
  for (size_t i = 0; i + 5 < at.size(); i += 3)
    twice_area += at[i] * at[i + 4] - at[i + 3] * at[i + 1];
  gmsh::vectorpair extruded;
  occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop({outline})})}}, 0.0, 0.0, kHeight,
               extruded);
  Solids block, holes;
  for (const auto& [dim, tag] : extruded)
    if (dim == 3) block.push_back(tag);
  holes.push_back(session.cylinder({0, 0, -1}, {0, 0, kHeight + 2}, kBore));
  for (int i = 0; i < 6; ++i) {
    const double angle = 2.0 * pi * (i + 0.5) / 6.0, radius = kValleys - kWall - kBolt;
    holes.push_back(session.cylinder({radius * std::cos(angle), radius * std::sin(angle), -1},
                                     {0, 0, kHeight + 2}, kBolt));
  }
  occ::synchronize();
  gmsh::vectorpair out;
  std::vector<gmsh::vectorpair> map;
  gmsh::vectorpair tools;
  for (const Solid hole : holes) tools.emplace_back(3, hole);
  // Not by session.cut(), which trusts OpenCASCADE's integral over the spline.
  occ::cut({{3, block.at(0)}}, tools, out, map);
  occ::synchronize();
  gmsh::write(file);
  return kHeight * (0.5 * std::abs(twice_area) - pi * kBore * kBore - 6.0 * pi * kBolt * kBolt);
}

std::string block_toml(const std::string& file, double size) {
  return fmt::format(
      "name = 'block'\nkind = 'cad'\n[cad]\nsource = '{}'\n[mesh]\nelement_size_mm = {}\n", file,
      size);
}

TEST(HardG2SplineSkin, MeshesIntoCellsProvedValid) {
  const Folder folder;
  const std::string file = (folder / "block.brep").string();
  const double volume = 1e-9 * write_wavy_block(file);
  const Meshed m = mesh_toml(block_toml(file, 4.0));
  const auto& proof = m.part.certificate;
  EXPECT_GT(proof.invalid_cells_before_repair.value(), 0.0);
  EXPECT_GT(proof.min_scaled_jacobian, 0.05);
  EXPECT_GE(proof.min_dihedral_deg, 8.0);
  EXPECT_NEAR(proof.volume_m3 / volume, 1.0, 3e-4);  // chords of 4 mm
  EXPECT_LT(proof.largest_distance_off_geometry_m.value(), 1e-4);
  // OpenCASCADE's integral over the spline is far off: the mesher uses a finer skin.
  EXPECT_GT(std::abs(proof.occ_volume_m3.value() / volume - 1.0), 0.01);
}

}  // namespace
}  // namespace clatter::mesh
