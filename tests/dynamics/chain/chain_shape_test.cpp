// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of a chain in the run file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "tests/dynamics/chain/timing_drive.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using testing::TimingDrive;

constexpr int kDriveLinks = 130;

class ChainShape : public ::testing::Test {
 protected:
  Scene scene(const TimingDrive& drive) {
    std::ofstream(folder_ / "drive.run.toml") << drive.scene();
    return read_scene(folder_ / "drive.run.toml");
  }
  H5File recorded(const TimingDrive& drive) {
    const Scene read = scene(drive);
    return testing::complete_file(read, folder_ / "drive.run.h5", result_);
  }
  /// A short run at 3400 rpm with these keys of [[chain]].
  TimingDrive running(const std::string& keys, double end_s) const {
    TimingDrive drive;
    drive.rpm = 3400.0;
    drive.end_s = end_s;
    drive.chain_keys = keys;
    return drive;
  }
  std::filesystem::path folder_ = testing::test_folder();
  RunResult result_;
};

Vector2d turned(double angle, const Vector2d& a) {
  return {std::cos(angle) * a.x() - std::sin(angle) * a.y(),
          std::sin(angle) * a.x() + std::cos(angle) * a.y()};
}

/// A point in the axes of a place (x, y, angle).
Vector2d moved(const Eigen::Vector3d& place, const Vector2d& a) {
  return place.head<2>() + turned(place(2), a);
}

TEST_F(ChainShape, IsThatOfTheLinksAndOfWhatTheyRunOver) {
  const H5File file = recorded(running("shape_every_us = 50.0", 4e-4));
  const auto time = file.read_doubles("chain/chain/time");
  ASSERT_EQ(time.size(), 8U);
  // The first accepted step at or after each multiple; the largest step is 20 us.
  for (size_t k = 0; k < time.size(); ++k) {
    EXPECT_GE(time[k], 5e-5 * static_cast<double>(k));
    EXPECT_LE(time[k], 5e-5 * static_cast<double>(k) + 2.0e-5);
  }
  const std::vector<int64_t> expected{8, kDriveLinks};
  for (const char* field : {"x", "y", "angle", "tension"})
    EXPECT_EQ(file.shape(std::string("chain/chain/") + field), expected);
  EXPECT_EQ(file.get_string("chain/chain", "plane"), "xy");
  const auto inner = file.read_ints("chain/chain/inner");
  const auto pitch = file.read_doubles("chain/chain/pitch");
  EXPECT_EQ(inner[0], 0);
  EXPECT_EQ(inner[1], 1);
  EXPECT_EQ(pitch[0], 8e-3);

  // Neighbours are joined, and the joint's force stretches it by 0.1 um per newton.
  const RowMatrix x = file.read_rows("chain/chain/x"), y = file.read_rows("chain/chain/y"),
                  angle = file.read_rows("chain/chain/angle"),
                  tension = file.read_rows("chain/chain/tension");
  const auto link = [&](int j) { return Eigen::Vector3d(x(7, j), y(7, j), angle(7, j)); };
  for (int j = 0; j < kDriveLinks; ++j) {
    const int next = (j + 1) % kDriveLinks;
    const Vector2d gap = moved(link(next), {-4e-3, 0.0}) - moved(link(j), {4e-3, 0.0});
    // Single precision resolves 3e-8 m; damping of 200 N s/m adds some newtons.
    EXPECT_NEAR(gap.norm(), 1e-7 * std::abs(tension(7, j)), 3e-6) << j;
  }
  // Both ends of the tensions are those of the histories at that step.
  const auto steps = file.read_doubles("history/time"),
             most = file.read_doubles("history/chain_tension_max"),
             least = file.read_doubles("history/chain_tension_min");
  const auto step = std::find(steps.begin(), steps.end(), time[7]) - steps.begin();
  ASSERT_LT(step, std::ssize(steps));
  EXPECT_NEAR(tension.row(7).maxCoeff(), most[step], 1e-4);
  EXPECT_NEAR(tension.row(7).minCoeff(), least[step], 1e-4);
}

TEST_F(ChainShape, HasOutlinesWithTheirPlaces) {
  const H5File file = recorded(running("shape_every_us = 100.0", 3e-4));
  const auto time = file.read_doubles("chain/chain/time");
  const std::string over = "chain/chain/over/";
  EXPECT_EQ(file.get_int(over + "crank", "teeth"), 20);
  EXPECT_EQ(file.get_int(over + "arm", "teeth"), 0);
  EXPECT_EQ(file.get_int(over + "guide", "order"), 4);
  EXPECT_EQ(file.get_string(over + "intake", "turn"), "clockwise");

  // The crank turns by its speed about its centre; a tooth gap was at the angle given.
  const double speed = -3400.0 * std::numbers::pi / 30.0;
  for (const int64_t k : {0, 2}) {
    const Eigen::Vector3d place = file.read_rows(over + "crank/place").row(k);
    EXPECT_NEAR(place(0), 0.0, 1e-9);
    EXPECT_NEAR(place(1), 0.0, 1e-9);
    const double turn = -20.94 * std::numbers::pi / 180.0 + speed * time[k];
    EXPECT_NEAR(std::remainder(place(2) - turn, 2.0 * std::numbers::pi / 20.0), 0.0, 1e-6);
  }
  // Of 20 teeth: mean tip circle and root circle of the reference, 54.81963 and about 51.13963 less
  // twice the seat's radius.
  const RowMatrix crank = file.read_rows(over + "crank/outline");
  EXPECT_NEAR(crank.rowwise().norm().maxCoeff(), 27.409815e-3, 2e-5);
  EXPECT_NEAR(crank.rowwise().norm().minCoeff(), 25.569815e-3 - 2.58399e-3, 1e-5);
  EXPECT_NEAR((crank.row(0) - crank.bottomRows(1)).norm(), 0.0, 1e-9);
  // The guide is on the ground: an arc of 1200 mm in the scene's axes, from y = 250 to 60 mm.
  const RowMatrix guide = file.read_rows(over + "guide/outline");
  const Eigen::Vector3d place = file.read_rows(over + "guide/place").row(2);
  for (Eigen::Index i = 0; i < guide.rows(); ++i) {
    const Vector2d point = moved(place, guide.row(i).transpose());
    EXPECT_NEAR((point - Vector2d(1.2218, -0.1525)).norm(), 1.2, 1e-7);
  }
  EXPECT_NEAR(moved(place, guide.row(0).transpose()).y(), 0.25, 1e-6);
  EXPECT_NEAR(moved(place, guide.bottomRows(1).transpose()).y(), 0.06, 1e-6);

  // Sprockets' speeds are recorded forwards: the cams' start at half of the crank's.
  const auto crank_speed = file.read_doubles("history/chain_crank_speed"),
             cam_speed = file.read_doubles("history/chain_intake_speed");
  EXPECT_NEAR(crank_speed.back(), -speed, 1e-9);
  EXPECT_NEAR(cam_speed.front(), -0.5 * speed, 1.0);
  EXPECT_FALSE(file.has("history/chain_arm_speed"));
}

TEST_F(ChainShape, IsRecordedAsOftenAsAsked) {
  // 5.2 deg of the crank at 3400 rpm take 255 us: after 0, 255, 510, 765 us.
  EXPECT_EQ(recorded(running("shape_every_deg = 5.2", 1e-3)).shape("chain/chain/x")[0], 4);
  const H5File none = recorded(running("shape_every_us = 0", 1e-4));
  EXPECT_FALSE(none.has("chain"));
  // Without a key 300 of a span.
  const auto model = build_model(scene(running("", 1e-3)), {});
  double interval = 0.0;
  for (const FieldSource* source : components_of<FieldSource>(*model))
    interval = source->field_plan().interval(0.03);
  EXPECT_DOUBLE_EQ(interval, 1e-4);
}

TEST_F(ChainShape, IntervalsThatMeanNothingAreRefused) {
  const auto refused = [&](const TimingDrive& drive, const std::vector<std::string>& parts) {
    test::expect_parts(test::refusal_of([&] { build_model(scene(drive), {}); }), parts);
  };
  refused(running("shape_every_us = -1", 1e-3), {"drive.run.toml:", "shape_every_us: found -1"});
  refused(running("shape_every_us = 10\nshape_every_deg = 1", 1e-3),
          {"shape_every_deg: shape_every_deg and shape_every_us exclude each other"});
  TimingDrive rest = running("shape_every_deg = 1", 1e-3);
  rest.rpm = 0.0;
  refused(rest, {"drive.run.toml:", "shape_every_deg: crank does not turn at the start"});
}

TEST_F(ChainShape, TwoSprocketsOfOneNameAreRefused) {
  TimingDrive drive;
  drive.more = R"([[chain.over]]
sprocket = "intake"
on = { body = "intake", at_mm = [200, 0, 0] }
teeth = 20
contact = { bed_n_m3 = 5e12, width_mm = 4.6 }
)";
  test::expect_parts(test::refusal_of([&] { scene(drive); }),
                     {"sprocket: found \"intake\" for the second time"});
}

}  // namespace
}  // namespace clatter::dynamics
