// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case N22: the sound of sheets, alone and where they close a body, and faces that touch.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "recover/skin/exposure.hpp"
#include "recover/skin/panels.hpp"
#include "synthetic.hpp"
#include "tests/observed.hpp"

namespace clatter::recover {
namespace {

using namespace testing;
using Eigen::Vector3d;

/// Faces of a mesh whose centre satisfies a condition, with all of its nodes.
template <typename Where>
Mesh6 part_of(const Mesh6& mesh, const Where& where) {
  Mesh6 part{mesh.nodes, IndexMatrix(0, 6)};
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    Vector3d centre = Vector3d::Zero();
    for (int a = 0; a < 3; ++a) centre += mesh.nodes.row(mesh.triangles(f, a)).transpose() / 3.0;
    if (!where(centre)) continue;
    part.triangles.conservativeResize(part.triangles.rows() + 1, 6);
    part.triangles.bottomRows(1) = mesh.triangles.row(f);
  }
  return part;
}

/// A solid, and below it a sheet with nodes of its own.
rom::Skin joined(const Mesh6& solid, const Mesh6& sheet) {
  rom::Skin skin;
  const Eigen::Index n = solid.nodes.rows(), f = solid.triangles.rows();
  skin.nodes.resize(n + sheet.nodes.rows(), 3);
  skin.nodes << solid.nodes, sheet.nodes;
  skin.triangles.resize(f + sheet.triangles.rows(), 6);
  skin.triangles << solid.triangles, (sheet.triangles.array() + static_cast<int32_t>(n)).matrix();
  for (Eigen::Index k = f; k < skin.triangles.rows(); ++k)
    skin.sheet.push_back(static_cast<int32_t>(k));
  skin.faces["pan_skin"] = skin.sheet;
  return skin;
}

/// Half a unit box of `size` as a solid, the other half below it as a sheet open to the top, `gap`
/// below the solid.
rom::Skin box_on_a_pan(const Vector3d& size, int n, double gap) {
  Mesh6 solid = box(size, n), pan = part_of(box(size, n), [&](const Vector3d&at) {
                                return at.z() < size.z() * (1.0 - 1e-9);
                              });
  pan.nodes.col(2).array() -= size.z() + gap;
  return joined(solid, pan);
}

/// Turns the faces [first, end) inside out.
void turn(rom::Skin& skin, size_t first, size_t end) {
  for (size_t k = first; k < end; ++k) {
    const int32_t face = skin.sheet[k];
    std::swap(skin.triangles(face, 1), skin.triangles(face, 2));
    std::swap(skin.triangles(face, 3), skin.triangles(face, 5));
  }
}

Exposure exposure(const rom::Skin& skin) {
  return exposure_of(skin, measure_skin(skin.nodes, skin.triangles));
}

TEST(HardN22_Sheets, FacesThatTouchAPartAreNotExposedHoweverThinItIs) {
  const Vector3d size(0.3, 0.2, 0.1);
  for (const double gap : {0.0, 7.5e-4, 1e-2}) {
    const rom::Skin skin = box_on_a_pan(size, 4, gap);
    const SkinGeometry geometry = measure_skin(skin.nodes, skin.triangles);
    const Exposure sides = exposure(skin);
    for (Eigen::Index f = 0; f < skin.triangles.rows(); ++f) {
      const bool is_sheet = f >= skin.sheet.front();
      const bool below = geometry.face_centre(f, 2) < 1e-9 && !is_sheet;
      EXPECT_EQ(sides.front[f], !below) << gap << " " << f;
      EXPECT_FALSE(sides.of_back(f)) << gap << " " << f;
    }
  }
  // A flat cover on the box: only its outer side.
  const Mesh6 cover = part_of(box(size, 3), [](const Vector3d& at) { return at.z() < 1e-9; });
  for (const double gap : {0.0, 7.5e-4}) {
    Mesh6 below = cover;
    below.nodes.col(2).array() -= gap;
    const rom::Skin skin = joined(box(size, 4), below);
    const Exposure sides = exposure(skin);
    for (const int32_t face : skin.sheet) {
      EXPECT_TRUE(sides.front[face]) << gap;
      EXPECT_FALSE(sides.of_back(face)) << gap;
    }
    const auto panels =
        choose_panels(default_panels(skin), skin, measure_skin(skin.nodes, skin.triangles));
    EXPECT_EQ(panels.back().name, "pan_skin");
    EXPECT_NEAR(panels.back().area, size.x() * size.y(), 1e-12);
    double exposed = 0.0;
    for (const Panel& panel : panels)
      if (panel.name == "exposed") exposed = panel.area;
    EXPECT_NEAR(exposed, 2.0 * (0.06 + 0.03 + 0.02), 1e-12);
  }
}

TEST(HardN22_Sheets, ASheetThatIsInsideOutIsExposedOnItsOtherSide) {
  rom::Skin skin = box_on_a_pan({0.3, 0.2, 0.1}, 4, 0.0);
  const Exposure before = exposure(skin);
  turn(skin, 0, skin.sheet.size() / 2);
  const Exposure after = exposure(skin);
  for (size_t k = 0; k < skin.sheet.size(); ++k) {
    const int32_t face = skin.sheet[k];
    EXPECT_EQ(after.of_back(face), k < skin.sheet.size() / 2);
    EXPECT_EQ(after.of_face(face), before.of_face(face));
  }
}

TEST(HardN22_Sheets, APanUnderABoxSoundsAsASolidOfBoth) {
  const Vector3d size(0.3, 0.2, 0.1);
  const rom::Skin solid = bare_skin(box({0.3, 0.2, 0.2}, 8));
  rom::Skin parts = box_on_a_pan(size, 8, 0.0), turned = parts;
  turn(turned, 0, turned.sheet.size() / 3);
  const PartSound one = sound_of_rigid(solid, 1500.0);
  double worst = 0.0;
  for (const rom::Skin& skin : {parts, turned}) {
    const PartSound two = sound_of_rigid(skin, 1500.0);
    for (const size_t last : {size_t{0}, size_t{1}}) {
      const auto& a = last ? one.table.samples.back() : one.table.samples.front();
      const auto& b = last ? two.table.samples.back() : two.table.samples.front();
      ASSERT_EQ(a.frequency_hz, b.frequency_hz);
      for (int d = 0; d < 3; ++d)
        worst = std::max(worst, std::abs(10.0 * std::log10(b.R(d, d) / a.R(d, d))));
    }
  }
  test::expect_at_most("pan under a box against a solid of both [dB]", worst, 0.1);
}

/// A flat disc of radius 1 about the origin, of 2 n^2 faces.
Mesh6 disc(int n) {
  Mesh6 mesh = part_of(box({2.0, 2.0, 1.0}, n), [](const Vector3d& at) { return at.z() < 1e-9; });
  for (Eigen::Index k = 0; k < mesh.nodes.rows(); ++k) {
    const double x = mesh.nodes(k, 0) - 1.0, y = mesh.nodes(k, 1) - 1.0;
    mesh.nodes.row(k) << x * std::sqrt(1.0 - 0.5 * y * y), y * std::sqrt(1.0 - 0.5 * x * x), 0.0;
  }
  return mesh;
}

TEST(HardN22_Sheets, ASheetInFreeAirTakesTheAirOfBothSidesAlong) {
  // A disc that is small beside the wavelength: a dipole of the force 8/3 rho a^3 omega v on it
  // (Lamb 1932, section 108).
  constexpr double kRadius = 0.1;
  Mesh6 mesh = disc(12);
  mesh.nodes *= kRadius;
  rom::Skin skin = bare_skin(mesh);
  for (int32_t f = 0; f < mesh.triangles.rows(); ++f) skin.sheet.push_back(f);
  const Exposure sides = exposure(skin);
  for (const int32_t f : skin.sheet) EXPECT_TRUE(sides.front[f] && sides.of_back(f));
  // Of the default skin, whose faces are those of the version of CGAL, 0.53 dB and 0.67 dB.
  for (const auto& [shape_error, limit_db] : {std::pair(0.02, 1.0), std::pair(0.01, 0.2)}) {
    const PartSound sound = sound_of_rigid(skin, 300.0, shape_error);
    const SoundSample& lowest = sound.table.samples.front();
    const sound::Fluid& air = sound.table.fluid;
    const double omega = 2.0 * std::numbers::pi * lowest.frequency_hz,
                 density = air.impedance() / air.sound_speed;
    const double force = 8.0 / 3.0 * density * std::pow(kRadius, 3) * omega;
    const double exact = 2.0 * std::pow(omega * force, 2) /
                         (24.0 * std::numbers::pi * density * std::pow(air.sound_speed, 3));
    test::expect_at_most(
        fmt::format("power of a disc along its axis [dB], shape within {}", shape_error),
        std::abs(10.0 * std::log10(lowest.R(2, 2) / exact)), limit_db);
    // Along its plane it moves no air but that of the wrap's thickness.
    EXPECT_LT(lowest.R(0, 0), 1e-3 * lowest.R(2, 2));
  }
}

}  // namespace
}  // namespace clatter::recover
