// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes that are added to bore and skirt.
#include "dynamics/cylinder/shape_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/base/artefact.hpp"
#include "core/base/h5_file.hpp"
#include "core/base/radial_shape_layout.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

class SurfaceShape : public testing::SlapScenes {
 protected:
  std::vector<film::LinerShape> shapes(const std::string& entries) {
    std::ofstream(folder_ / "contact.toml") << entries;
    std::vector<film::LinerShape> found;
    for (const Config& table : Config::load(folder_ / "contact.toml").tables("bore_shape"))
      found.push_back(shape_keys().read(table).shape);
    return found;
  }

  /// A shape file about an axis at z = 0.1 m: order 2 of 10 um, largest toward +y, growing with the
  /// height, and order 1. @param axis +z or -z; @param zero_deg the pad angle of its angle 0
  void write_shape(double axis, double zero_deg) {
    const Eigen::Index angles = 72, heights = 5;
    Eigen::VectorXd angle(angles), height = Eigen::VectorXd::LinSpaced(heights, 0.0, 0.2);
    RowMatrix deviation(heights, angles);
    for (Eigen::Index i = 0; i < angles; ++i) {
      angle(i) = 5.0 * kDeg * static_cast<double>(i);
      const double pad = zero_deg * kDeg + axis * angle(i);
      for (Eigen::Index k = 0; k < heights; ++k)
        deviation(k, i) = exact(pad, 0.1 + axis * height(k));
    }
    H5File file = H5File::create(folder_ / "bore.shape.h5");
    write_provenance(file, {kShapeSchema, "", {}});
    file.write(kShapeAxisPoint, Eigen::VectorXd(Eigen::Vector3d(0.195, 0.0, 0.1)));
    file.write(kShapeAxis, Eigen::VectorXd(Eigen::Vector3d(0.0, 0.0, axis)));
    file.write(kShapeZeroAngle, Eigen::VectorXd(film::pad_normal(zero_deg * kDeg)));
    file.write(kShapeHeight, height);
    file.write(kShapeAngle, angle);
    file.write("cases/thermal/deviation", deviation);
    file.commit();
  }
  static double exact(double pad_angle, double z) {
    return 1e-5 * (1.0 + z) * std::cos(2.0 * pad_angle) + 3e-6 * std::sin(pad_angle);
  }
};

TEST_F(SurfaceShape, OfAFileIsTurnedIntoThePadsAngles) {
  for (const double axis : {1.0, -1.0}) {
    for (const double zero : {0.0, 90.0, 200.0}) {
      write_shape(axis, zero);
      const auto found = shapes("[[bore_shape]]\nfile = \"bore.shape.h5\"\ncase = \"thermal\"\n");
      ASSERT_EQ(found.size(), 1U);
      const film::LinerShape& shape = found[0];
      for (Eigen::Index i = 0; i < shape.angle.size(); ++i) {
        EXPECT_TRUE(i == 0 || shape.angle(i) > shape.angle(i - 1));
        for (Eigen::Index k = 0; k < shape.height.size(); ++k) {
          EXPECT_TRUE(k == 0 || shape.height(k) > shape.height(k - 1));
          EXPECT_NEAR(shape.deviation(i, k), exact(shape.angle(i), shape.height(k)), 1e-18)
              << axis << " " << zero;
        }
      }
    }
  }
}

TEST_F(SurfaceShape, OfATableAndOfAnOrderHaveTheirValues) {
  std::ofstream(folder_ / "bore.csv") << "height [mm], a [um], b [um], c [um]\n100, 1, 2, 3\n"
                                         "200, 4, 5, 6\n";
  const auto found = shapes(R"(
[[bore_shape]]
table = "bore.csv"
columns = ["c", "a"]
angle_deg = [-30, 90]
factor = 2
[[bore_shape]]
order = 3
phase_deg = 20
height_mm = [0, 100]
amplitude_um = [1, 5]
)");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].angle(0), 90.0 * kDeg, 1e-15);
  EXPECT_NEAR(found[0].angle(1), 330.0 * kDeg, 1e-15);
  EXPECT_NEAR(found[0].height(1), 0.2, 1e-15);
  EXPECT_NEAR(found[0].deviation(0, 1), 8e-6, 1e-18);
  EXPECT_NEAR(found[0].deviation(1, 0), 6e-6, 1e-18);
  const film::LinerShape& order = found[1];
  for (Eigen::Index i = 0; i < order.angle.size(); ++i)
    EXPECT_NEAR(order.deviation(i, 1), 5e-6 * std::cos(3.0 * (order.angle(i) - 20.0 * kDeg)),
                1e-18);
}

// A bore that is wider everywhere, and a skirt that is smaller, are more clearance.
TEST_F(SurfaceShape, WidensTheGap) {
  const std::string rest = "[time]\ncycles = 1\n[contact]\ncavitation = false\nclearance_um = ";
  const auto motion = [&](const std::string& contact, const std::string& name) {
    return recorded(scene(rest + contact), name).read_rows("bodies/piston/q");
  };
  const char* shape = "\norder = 0\nheight_mm = [0]\namplitude_um = [";
  const RowMatrix plain = motion("25\n", "plain");
  const RowMatrix bore = motion(fmt::format("20\n[[contact.bore_shape]]{}5]\n", shape), "bore");
  const RowMatrix skirt = motion(fmt::format("20\n[[contact.skirt_shape]]{}-5]\n", shape), "skirt");
  const double size = plain.cwiseAbs().maxCoeff();
  EXPECT_LT((bore - plain).cwiseAbs().maxCoeff(), 1e-9 * size);
  EXPECT_LT((skirt - plain).cwiseAbs().maxCoeff(), 1e-9 * size);
  EXPECT_GT((motion("20\n", "narrow") - plain).cwiseAbs().maxCoeff(), 1e-2 * size);
}

// Ovality by the key and as an order: o sin^2 f = o / 2 - o / 2 cos 2 f inward.
TEST_F(SurfaceShape, OfOrderTwoIsOvality) {
  const std::string rest = "[time]\ncycles = 1\n[contact]\ncavitation = false\novality_um = ";
  const RowMatrix key = recorded(scene(rest + "30\n"), "key").read_rows("bodies/piston/q");
  const RowMatrix order = recorded(scene(rest + R"(0
clearance_um = 35
[[contact.skirt_shape]]
order = 2
height_mm = [0]
amplitude_um = [15]
)"),
                                   "order")
                              .read_rows("bodies/piston/q");
  // Linear between 2 degrees: 15 um (2 deg)^2 / 2 of it is lost, 1e-8 m.
  EXPECT_LT((key - order).cwiseAbs().maxCoeff(), 1e-3 * key.cwiseAbs().maxCoeff());
}

TEST_F(SurfaceShape, AreRefusedByWhatIsWrong) {
  write_shape(1.0, 0.0);
  const auto refused = [&](const std::string& entry) {
    return test::refusal_of([&] { shapes("[[bore_shape]]\n" + entry); });
  };
  test::expect_parts(refused("file = \"bore.shape.h5\"\ncase = \"cold\"\n"),
                     {"contact.toml:3", "case: found \"cold\", expected one of", "thermal"});
  test::expect_parts(refused("factor = 1\n"), {"give file or table or order"});
  test::expect_parts(refused("order = 2\nheight_mm = [2, 1]\namplitude_um = [1, 2]\n"),
                     {"height_mm: found 1 after 2, expected ascending values"});
  test::expect_parts(refused("order = 2\nheight_mm = [1, 2]\namplitude_um = [1]\n"),
                     {"amplitude_um: found 1 values, expected as many as height_mm, 2"});
  test::expect_parts(refused("order = 2\nheight_mm = [1]\namplitude_um = [1e5]\n"),
                     {"factor: found deviations of 100 mm, expected at most 10"});
}

}  // namespace
}  // namespace clatter::dynamics
