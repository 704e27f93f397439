// SPDX-License-Identifier: GPL-3.0-or-later
// From films to the shape of a bore: a hollow cylinder with a logarithmic temperature (Timoshenko
// and Goodier, long cylinder held at its ends).
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "block_mesh.hpp"
#include "core/base/artefact.hpp"
#include "modal/shape.hpp"
#include "modal/statics.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter::modal {
namespace {

constexpr double kInner = 0.05, kOuter = 0.08;
constexpr double kNu = 0.26, kExpansion = 1.1e-5;

const std::string kWarm = R"(
[material.iron]
regions = ["body"]
E = 1.1e11
nu = 0.26
rho = 7200.0
expansion = 1.1e-5
conductivity = 48.0
[system.bore]
kind = "cylindrical"
[[support]]
name = "floor"
surface = "z0"
directions = "z"
[[support]]
name = "roof"
surface = "z1"
directions = "z"
[[support]]
name = "no_turn"
node_set = "all"
directions = "y"
system = "bore"
[[contact]]
name = "liner"
surface = "y0"
axis_point = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
zero_angle = [0.0, 1.0, 0.0]
axial = [0.0, 0.04]
rows = 1
[[contact.sector]]
centre_deg = 0.0
half_width_deg = 90.0
strips = 1
[[heat]]
name = "running"
[[heat.film]]
surface = "y0"
coefficient = 900.0
temperature_c = 600.0
[[heat.film]]
surface = "y1"
coefficient = 5000.0
temperature_c = 90.0
[[load]]
name = "warm"
kind = "temperature"
heat = "running"
reference_c = 20.0
)";

fe::FeModel cylinder(mesh::CellType type, int cells) {
  assembly::testing::BlockOptions options;
  options.type = type;
  options.curved = true;
  options.wrap_x = true;
  return assembly::testing::build_all(
             assembly::testing::block_mesh({12 * cells, cells, 1},
                                           assembly::testing::ring(kInner, kOuter, 0.04), options),
             kWarm)
      .model;
}

/// int_a^r T r dr of T = A + B ln(r / a), above the reference.
struct LogProfile {
  double A, B;
  LogProfile() {
    const double k = 48.0, h_in = 900.0, h_out = 5000.0;
    const double resistance =
        1.0 / (kInner * h_in) + std::log(kOuter / kInner) / k + 1.0 / (kOuter * h_out);
    const double heat = 510.0 / resistance;  // per length and 2 pi
    A = 600.0 - heat / (kInner * h_in) - 20.0;
    B = -heat / k;
  }
  double integral(double r) const {
    const double a = kInner;
    return 0.5 * A * (r * r - a * a) + B * (0.5 * r * r * std::log(r / a) - 0.25 * (r * r - a * a));
  }
  /// Plane strain, both surfaces free.
  double displacement(double r) const {
    const double a = kInner, b = kOuter;
    return (1.0 + kNu) / (1.0 - kNu) * kExpansion / r *
           (integral(r) + ((1.0 - 2.0 * kNu) * r * r + a * a) / (b * b - a * a) * integral(b));
  }
};

double bore_error(mesh::CellType type, int cells) {
  const fe::FeModel model = cylinder(type, cells);
  const StaticSolution solution = solve_static(model, {"warm"});
  const double exact = LogProfile().displacement(kInner);
  double worst = 0.0;
  for (Eigen::Index a = 0; a < model.nodes.rows(); ++a) {
    const Eigen::Vector2d across = model.nodes.row(a).head<2>();
    if (std::abs(across.norm() - kInner) > 1e-9) continue;
    const double u = solution.cases[0].displacement.segment<2>(3 * a).dot(across.normalized());
    worst = std::max(worst, std::abs(u / exact - 1.0));
  }
  return worst;
}

TEST(WarmCylinder, WidensByTheClosedForm) {
  // 62 um; measured 4e-3 and 2e-6.
  EXPECT_LT(bore_error(mesh::CellType::kHex8, 4), 1e-2);
  EXPECT_LT(bore_error(mesh::CellType::kHex20, 2), 1e-3);
  const double linear = std::log2(bore_error(mesh::CellType::kHex8, 2) /  //
                                  bore_error(mesh::CellType::kHex8, 4));
  EXPECT_GT(linear, 1.7);
  EXPECT_LT(linear, 2.4);
  EXPECT_GT(std::log2(bore_error(mesh::CellType::kHex20, 1) /  //
                      bore_error(mesh::CellType::kHex20, 2)),
            2.7);
}

class ShapeFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch_path("shape");
    std::filesystem::create_directory(folder_);
    const fe::FeModel model = cylinder(mesh::CellType::kHex20, 2);
    H5File file = H5File::create(folder_ / "part.static.h5");
    write_provenance(file, {fe::kStaticSchema, "", {}});
    write_static(file, model, solve_static(model, {}));
    file.commit();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(ShapeFile, OfTheWarmBoreIsItsWideningInTheAxesOfTheContactGrid) {
  ShapeOptions options;
  options.surface = "y0";
  const Shape shape = shape_from_file(folder_ / "part.static.h5", options);
  EXPECT_EQ(shape.axes.zero_angle, Eigen::Vector3d::UnitY());
  ASSERT_EQ(shape.cases.size(), 1u);
  const double exact = LogProfile().displacement(kInner);
  EXPECT_GT(exact, 0.0);  // wider is positive
  EXPECT_LT((shape.cases[0].order_re.col(0).array() / exact - 1.0).abs().maxCoeff(), 1e-3);
  EXPECT_LT(shape.cases[0].order_re.rightCols(8).cwiseAbs().maxCoeff(), 1e-3 * exact);
  const std::string csv = csv_of(shape);
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "height_m,angle_deg,covered,warm_um");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 41 * 72);

  H5File file = H5File::create(folder_ / "bore.shape.h5");
  write_provenance(file, {kShapeSchema, "", {}});
  write_shape(file, shape);
  file.commit();
  const H5File back = open_artefact(folder_ / "bore.shape.h5", kShapeSchema);
  EXPECT_EQ(back.read_matrix("cases/warm/deviation"), shape.cases[0].deviation);
  EXPECT_EQ(back.read_vector("height"), shape.height);
  EXPECT_EQ(back.get_string("/", "surface"), "y0");
}

TEST_F(ShapeFile, WrongNamesAndMissingAxesAreRefused) {
  const auto refusal = [&](const std::string& surface, const std::string& name) {
    ShapeOptions options;
    options.surface = surface;
    if (!name.empty()) options.cases = {name};
    return test::refusal_of([&] { shape_from_file(folder_ / "part.static.h5", options); });
  };
  test::expect_parts(refusal("bore", ""), {"--surface: found \"bore\", expected one of: ", "y0"});
  test::expect_parts(refusal("y0", "wram"), {"--case: found \"wram\", expected one of: warm"});
  test::expect_parts(refusal("y1", ""),
                     {"surface y1: found 0 contact grids on this surface (liner), expected one; "
                      "give --axis-point"});
}

}  // namespace
}  // namespace clatter::modal
