// SPDX-License-Identifier: GPL-3.0-or-later
// The block with parent bores and with a timing side, against closed forms.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "mesh/geometry/block_geometry.hpp"
#include "mesh_toml.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::mesh_toml;
using testing::Meshed;

// A twin that no sample has; its camshafts differ in height, its half length is 109.
constexpr const char* kTwin =
    "name = 'twin'\nkind = 'block'\n[block]\ncylinders = 2\nbores = 'parent'\nbore = 80\n"
    "stroke = 80\nrod_length = 130\ncylinder_pitch = 90\ndeck_height = 205\ndeck_thickness = 14\n"
    "liner_wall = 7\nliner_length = 125\njacket_thickness = 8\njacket_depth = 95\nouter_wall = 6\n"
    "end_wall = 9\ncolumn_width = 18\ncolumn_reach = 58\ncrankcase_half_width = 84\n"
    "crankcase_wall = 7\nshoulder_height = 45\ncrankcase_top = 110\nskirt_depth = 65\n"
    "flange_width = 12\nflange_thickness = 10\nbearing_wall = 9\nbearing_bore = 50\n"
    "bearing_boss = 80\nbearing_width = 22\nmount_length = 50\nmount_height = 36\n"
    "mount_thickness = 12\n";
constexpr const char* kTiming =
    "[block.timing]\ncam_intake = [-52, 300]\ncam_exhaust = [56, 306]\nguide_bolt_1 = [58, 85]\n"
    "guide_bolt_2 = [95, 220]\narm_pivot = [-80, 225]\ntensioner = [-78, 150]\ncam_bore = 22\n"
    "cam_boss = 42\ncam_bearing_width = 18\ncam_seal = 30\nfire_deck = 13\nhead_jacket = 40\n"
    "cam_deck = 9\nplug_tower = 26\nboss_length = 7\n";
constexpr double kHalfLength = 109, kHeadTop = 300, kHeadHalfWidth = 84, kPlateHalfWidth = 110;
constexpr double kSeats = 2 * pi * 9 * 9 + pi * 12 * 12 + 40 * 36;

// Of a disc of radius R, the part above a line at height h over its centre.
double segment_area(double R, double h) {
  return R * R * std::acos(h / R) - h * std::sqrt(R * R - h * h);
}

class Twin : public ::testing::Test {
 protected:
  Solids build(const std::string& text) {
    const Config config = Config::parse(text, "twin.toml");
    return build_block(session_, block_keys().read(config.table("block"))).regions.front().solids;
  }
  double volume_within(const Solids& solids, Solid window) {
    return session_.volume(session_.intersect(session_.copy(solids), {window}));
  }
  GmshSession session_{"twin"};
};

// Booleans keep volumes to about 1e-7.
constexpr double kRounding = 1e-6;

TEST_F(Twin, TheHeadAboveTheDeckHasTheVolumeOfItsParts) {
  const double height = kHeadTop - 205, cam_space = kHeadTop - (205 + 13 + 40 + 9);
  const double bay = (90 - 18) * 2 * (kHeadHalfWidth - 7);
  double expected = 4 * kHalfLength * kHeadHalfWidth * height;
  expected += 2 * (kPlateHalfWidth - kHeadHalfWidth) * 12 * height;
  expected -= 2 * (bay * (40 + cam_space) - pi * 13 * 13 * 40);
  const double end = kHalfLength - (90 - 9), seal = kHalfLength - (90 + 9);
  for (double above : {0.0, -6.0}) {
    expected += segment_area(21, above) * (2 * end + 18);
    expected -= pi * 11 * 11 * 3 * 18 + pi * 15 * 15 * 2 * seal;
  }
  expected += pi * (9 * 9 + 12 * 12) * 7;  // seats of guide_bolt_2 and arm_pivot
  const Solids block = build(std::string(kTwin) + kTiming);
  const double found = volume_within(block, session_.box({-1e3, -1e3, 205}, {1e3, 1e3, 1e3}));
  EXPECT_NEAR(found / expected, 1.0, kRounding);
}

TEST_F(Twin, OnlyTheSeatsAreBeforeTheFrontFace) {
  const Solids block = build(std::string(kTwin) + kTiming);
  const double found =
      volume_within(block, session_.box({-1e3, -1e3, -1e3}, {-kHalfLength, 1e3, 1e3}));
  EXPECT_NEAR(found / (kSeats * 7), 1.0, kRounding);
}

TEST_F(Twin, ParentBoresAreInOneCastingOfWhichTheJacketLeavesTheJoinedWalls) {
  const Solids block = build(kTwin);
  const double height = 95, R = 47, d = 90;
  const double lens = 2 * segment_area(R, 0.5 * d);
  const double expected = (2 * pi * R * R - lens - 2 * pi * 40 * 40) * height;
  const Solids jacket = session_.fuse({session_.cylinder({-45, 0, 96}, {0, 0, height}, 55)},
                                      {session_.cylinder({45, 0, 96}, {0, 0, height}, 55)});
  EXPECT_NEAR(volume_within(block, jacket.front()) / expected, 1.0, kRounding);
}

std::string with(std::string text, const std::string& key, const std::string& value) {
  const size_t at = text.find("\n" + key + " =") + 1;
  return text.replace(at, text.find('\n', at) - at, key + " = " + value);
}

TEST_F(Twin, ThickBearingWallsAreRelievedWhereThePistonsPass) {
  const Solids block = build(with(kTwin, "bearing_wall", "20"));
  // From the piston's lowest skirt, 130 - 40 - 40, to the roof; the chambers end 35 from each
  // bore's axis.
  const double expected = (20 * 60 - 2 * segment_area(0.52 * 80, 35)) * (80 - 50);
  EXPECT_NEAR(volume_within(block, session_.box({-10, -30, 50}, {10, 30, 80})) / expected, 1.0,
              kRounding);
}

// Quadratic facets of 30 degrees: the area of a cylinder is off by 2e-4.
constexpr double kFacets = 5e-4;

TEST(TimingSide, SurfacesLieWhereTheFrontViewPutsThemAndHaveTheirAreas) {
  const Meshed m = mesh_toml(std::string(kTwin) + kTiming +
                             "[mesh]\nelement_size_mm = 30\nelements_per_turn = 12\n");
  const auto surface = [&](const std::string& name) {
    return integrate(m.part.mesh, m.part.mesh.surface(name));
  };
  const auto expect_area = [&](const std::string& name, double mm2) {
    EXPECT_NEAR(surface(name).area / (1e-6 * mm2), 1.0, kFacets) << name;
  };
  const auto expect_centre = [&](const std::string& name, double x, double X, double Y) {
    // Facets are on both sides of the true surface alike; what remains is their asymmetry.
    EXPECT_LT((surface(name).centre - 1e-3 * Vector3d(x, -X, Y)).norm(), 2e-5) << name;
  };
  for (int k = 1; k <= 3; ++k) {
    expect_area(fmt::format("cam_intake_{}", k), pi * 22 * 18);
    expect_centre(fmt::format("cam_intake_{}", k), 90 * (k - 2), -52, 300);
    expect_area(fmt::format("cam_exhaust_{}", k), pi * 22 * 18);
    expect_centre(fmt::format("cam_exhaust_{}", k), 90 * (k - 2), 56, 306);
  }
  expect_area("bearing_1", pi * 50 * 22);
  expect_centre("bearing_1", -90, 0, 0);
  const struct {
    const char* name;
    double X, Y, area;
  } seats[] = {{"guide_bolt_1", 58, 85, pi * 9 * 9},
               {"guide_bolt_2", 95, 220, pi * 9 * 9},
               {"arm_pivot", -80, 225, pi * 12 * 12},
               {"tensioner", -78, 150, 40 * 36}};
  for (const auto& seat : seats) {
    expect_area(seat.name, seat.area);
    expect_centre(seat.name, -kHalfLength - 7, seat.X, seat.Y);
    const SurfaceIntegrals found = surface(seat.name);
    EXPECT_LT((found.normal + found.area * Vector3d::UnitX()).norm(), 1e-9 * found.area);
  }
  expect_area("timing_face", 2 * kPlateHalfWidth * (kHeadTop + 65) + segment_area(21, 0) +
                                 segment_area(21, -6) - pi * 32.5 * 32.5 - 2 * pi * 15 * 15 -
                                 kSeats);
  for (int i = 1; i <= 2; ++i) {
    expect_area(fmt::format("liner_{}_bore", i), pi * 80 * 125);
    expect_area(fmt::format("head_{}", i), pi * 40 * 40);
    expect_centre(fmt::format("head_{}", i), 90 * (i - 1.5), 0, 205);
  }
  for (const char* name : {"mount_1", "mount_4", "pan_flange", "outer", "skin"})
    EXPECT_GT(m.part.mesh.surface(name).face_count(), 0) << name;
  EXPECT_EQ(m.part.mesh.surfaces.count("deck"), 0u);
  EXPECT_EQ(m.part.mesh.regions, std::vector<std::string>{"block"});
}

TEST(TimingSide, AHeadClosesWetLinersToo) {
  const Meshed m = mesh_toml(
      "name = 'single'\nkind = 'block'\n[block]\ncylinders = 1\nbearing_width = "
      "22\n[block.timing]\n"
      "cam_intake = [-70, 470]\ncam_exhaust = [70, 470]\nguide_bolt_1 = [75, 95]\n"
      "guide_bolt_2 = [110, 380]\narm_pivot = [-100, 390]\ntensioner = [-100, 250]\n"
      "[mesh]\nelement_size_mm = 30\nelements_per_turn = 16\n");
  const double liner = pi * (60.5 * 60.5 - 53.5 * 53.5) * 230;
  EXPECT_NEAR(m.volume("liner") / (1e-9 * liner), 1.0, 1e-4);  // facets of 22.5 degrees
  const double roof = integrate(m.part.mesh, m.part.mesh.surface("head_1")).area;
  EXPECT_NEAR(roof / (1e-6 * pi * 53.5 * 53.5), 1.0, kFacets);
}

TEST(TimingSide, DimensionsThatDoNotFitAreRefusedWithFileLineAndKey) {
  // The value in place of the one of the same key, or added; more lines may follow it.
  const auto refused = [](const std::string& key, const std::string& value,
                          const std::vector<std::string>& parts) {
    std::string timing = kTiming;
    const size_t at = timing.find("\n" + key + " =");
    if (at != std::string::npos) timing.erase(at + 1, timing.find('\n', at + 1) - at);
    const Config config =
        Config::parse(std::string(kTwin) + timing + key + " = " + value + "\n", "twin.toml");
    std::vector<std::string> all = {"twin.toml:", ": block.timing." + key + ": "};
    all.insert(all.end(), parts.begin(), parts.end());
    test::expect_parts(test::refusal_of([&] { block_keys().read(config.table("block")); }), all);
  };
  refused("cam_intake", "[-52, 270]", {"found a bearing down to Y = 259", "cam deck at 267"});
  refused("cam_exhaust", "[56, 320]", {"found 20 above the other", "0.35 cam_boss = 14.7"});
  refused("cam_exhaust", "[56]", {"found 1 numbers, expected 2"});
  refused("head_half_width", "70", {"found 70, expected more than 73"});
  refused("cam_boss", "110", {"less than the distance of the camshafts"});
  refused("cam_seal", "20", {"expected more than cam_bore"});
  refused("cam_seal", "45", {"expected less than cam_boss"});
  refused("plug_tower", "80", {"found 80, expected less than the 72 between two bulkheads"});
  refused("cam_bearing_width", "40", {"expected the end bearings inside the block"});
  refused("head_wall", "75\nhead_half_width = 84", {"to the head's side"});
  refused("plate_thickness", "40", {"expected to end before the first bore"});
  refused("crank_seal", "90", {"found 90, expected between bearing_bore and bearing_boss"});
  refused("guide_bolt_2", "[95, 297]", {"from Y = 288 to 306, expected between -65 and 300"});
  refused("guide_bolt_2", "[95, 220]\nplate_half_width = 100",
          {"from X = 86 to 104, expected within plate_half_width = 100"});
  refused("tensioner", "[-80, 200]", {"expected a gap between its seat and arm_pivot"});
  refused("guide_bolt_1", "[30, 20]", {"expected a gap between its seat and the crankshaft"});
  refused("boss_length", "0", {"expected"});
  const auto block_refused = [](const std::string& key, const std::string& value,
                                const std::string& part) {
    const Config config =
        Config::parse(with(with(kTwin, "bearing_wall", "20"), key, value), "twin.toml");
    test::expect_parts(test::refusal_of([&] { block_keys().read(config.table("block")); }),
                       {"twin.toml:", part});
  };
  block_refused("bearing_wall", "40", "found 40, expected less than 0.4 pitch = 36");
  block_refused("cylinder_pitch", "82", "a pitch below 83.2 leaves no wall where the pistons pass");
  block_refused("bearing_boss", "104", "bearing_boss: found 104, expected less than 100");
  block_refused("cylinder_pitch", "79", "found 79, expected more than the bore 80");
  const Config protruding = Config::parse(std::string(kTwin) + "liner_protrusion = 5\n", "t.toml");
  test::expect_parts(test::refusal_of([&] { block_keys().read(protruding.table("block")); }),
                     {"t.toml:34: block.liner_protrusion: needs bores = \"wet_liner\""});
}

}  // namespace
}  // namespace clatter::mesh
