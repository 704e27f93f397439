// SPDX-License-Identifier: GPL-3.0-or-later
// The film around the entire skirt: closed around, exact squeeze of a full bearing, rough limits.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "film_march.hpp"
#include "piston_scene.hpp"

namespace clatter::film {
namespace {

PistonLinerOptions whole_scene() {
  PistonLinerOptions options;
  options.span = SkirtSpan::kWhole;
  options.cells_around = 24;
  options.cells_along = 9;
  options.clearance = 10e-6;
  options.skirt.barrel_top = 15e-6;
  options.skirt.barrel_bottom = 10e-6;
  return options;
}

/// Forces after a start at `y` with `v` and one stage of 2 us that continues the motion.
Eigen::VectorXd force_of(PistonLiner& element, const Eigen::VectorXd& y, const Eigen::VectorXd& v) {
  dynamics::Response response;
  const dynamics::Stage first{2e-3, 1e-10, 0, {}};
  element.begin_step(first.time);
  element.evaluate(first, y, v, false, response);
  element.finish_stage(first);
  element.accept_step(first.time);
  element.begin_step(first.time);
  const double kappa = 2e-6;
  element.evaluate({2e-3 + kappa, kappa, 1, {0.0}}, y + kappa * v, v, false, response);
  return response.force;
}

TEST(WholeSkirt, ATurnedStateHasTheTurnedForceWhereverTheFilmIsClosed) {
  // A round skirt: the direction of the motion turns by whole cells, over the pin side as well.
  const auto run = [](int cells) {
    const auto element = make_element(whole_scene(), false);
    const double f = 2.0 * std::numbers::pi * cells / 24.0, s = std::sin(f), c = std::cos(f);
    Eigen::VectorXd y(6), v(6);
    y << -9e-6 * s, 9e-6 * c, 0.0, 3e-5 * c, 3e-5 * s, 0.0;
    v << -0.02 * s, 0.02 * c, 0.0, 0.2 * c, 0.2 * s, 0.0;
    const Eigen::VectorXd force = force_of(*element, y, v);
    double cavitated = 0.0, contact = 0.0;
    for (const PadSnapshot& pad : element->snapshot()) {
      EXPECT_EQ(pad.name, "skirt");
      cavitated += (pad.fill.array() < 1.0).cast<double>().mean();
      contact += pad.contact_pressure.sum();
    }
    EXPECT_GT(cavitated, 0.1);
    EXPECT_LT(cavitated, 0.9);
    EXPECT_GT(contact, 0.0);
    Eigen::VectorXd back(6);  // turned back by f about z
    back << c * force[0] + s * force[1], -s * force[0] + c * force[1], force[2],
        c * force[3] + s * force[4], -s * force[3] + c * force[4], force[5];
    return back;
  };
  const Eigen::VectorXd one = run(0);
  EXPECT_LT(one[1], -1.0);
  for (const int cells : {1, 6, 7, 12, 17, 23})
    EXPECT_LT((run(cells) - one).norm(), 1e-8 * one.norm());  // rounding times the film's stiffness
}

TEST(WholeSkirt, TwoHalvesAreTheWholeWhereNoOilCrossesBetweenThem) {
  // A thin layer on the liner: beside the pin the gap is not full, so there is no pressure.
  PistonLinerOptions options = whole_scene();
  options.cells_around = 32;
  options.oil_thickness = 4e-6;
  options.skirt.ovality = 20e-6;
  const auto whole = make_element(options, false);
  options.span = SkirtSpan::kPads;
  options.pad_span = std::numbers::pi;
  options.cells_around = 16;
  const auto halves = make_element(options, false);
  Eigen::VectorXd y(6), v(6);
  y << 1e-6, 8e-6, 0.0, 5e-5, 0.0, 0.0;
  v << 0.0, 0.03, 0.0, 0.3, 0.0, 0.0;
  const Eigen::VectorXd one = force_of(*whole, y, v), other = force_of(*halves, y, v);
  EXPECT_LT(one[1], -10.0);
  EXPECT_LT((one - other).norm(), 1e-9 * one.norm());
  const PadSnapshot skirt = whole->snapshot().front();
  ASSERT_EQ(halves->snapshot().size(), 2U);
  EXPECT_GT(skirt.pressure.maxCoeff(), 1e5);
  int row = 0;
  for (const PadSnapshot& pad : halves->snapshot()) {
    EXPECT_LT((skirt.pressure.middleRows(row, 16) - pad.pressure).cwiseAbs().maxCoeff(),
              1e-9 * skirt.pressure.maxCoeff());
    row += 16;
  }
}

TEST(WholeSkirt, OilPassesThePinOfAFullGap) {
  // The squeezed side feeds the other one: two halves with open sides lose that pressure.
  PistonLinerOptions options = whole_scene();
  options.effects.cavitation = false;
  options.bulk_modulus = 0.0;
  const auto whole = make_element(options, false);
  options.span = SkirtSpan::kPads;
  options.pad_span = std::numbers::pi;
  options.cells_around = 12;
  const auto halves = make_element(options, false);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(6), v = y;
  v[0] = 0.02;  // along the pin
  const double one = force_of(*whole, y, v)[0], other = force_of(*halves, y, v)[0];
  EXPECT_LT(one, 0.0);
  EXPECT_LT(std::abs(other), 0.75 * std::abs(one));
}

/// Force on a centred skirt that moves across a full film at `v`, over mu v R^3 L / c^3.
double squeeze(PistonLinerOptions options, double ratio, int around, int along) {
  options.span = SkirtSpan::kWhole;
  options.cells_around = around;
  options.cells_along = along;
  options.skirt_bottom = -ratio * options.bore_radius;
  options.skirt_top = ratio * options.bore_radius;
  options.bulk_modulus = 0.0;
  options.effects = {true, false, false, false};
  PistonLinerBodies bodies;
  bodies.stroke = [](double) { return StrokeState{0.2, 0.0}; };
  PistonLiner element(options, bodies, {0, 1, 2, 3, 4, 5});
  Eigen::VectorXd y = Eigen::VectorXd::Zero(6), v = y;
  v[1] = 1e-3;
  dynamics::Response response;
  const dynamics::Stage stage{0.0, 1e-9, 0, {}};
  element.begin_step(0.0);
  element.evaluate(stage, y, v, false, response);
  const double length = options.skirt_top - options.skirt_bottom;
  return -response.force[1] * std::pow(options.clearance, 3) /
         (options.viscosity * v[1] * std::pow(options.bore_radius, 3) * length);
}

PistonLinerOptions smooth_round() {
  PistonLinerOptions options;
  options.clearance = 20e-6;
  options.roughness = {0.0, 0.0, 1.0, false};
  return options;
}

TEST(WholeSkirt, TheSqueezeOfAFullBearingOfAnyLengthIsExact) {
  // p = 12 mu V R^2 cos f / c^3 (1 - cosh(z/R) / cosh(x)), x = L/D:
  // F = 12 pi mu V R^3 L / c^3 (1 - tanh(x) / x); short: 4 pi x^2, long: 12 pi.
  for (const double x : {0.05, 0.5, 1.0, 4.0, 50.0}) {
    const double exact = 12.0 * std::numbers::pi * (1.0 - std::tanh(x) / x);
    double last = 0.0;
    for (const int n : {1, 2, 4}) {
      const double error = squeeze(smooth_round(), x, 16 * n, 16 * n) / exact - 1.0;
      std::printf("    L/D %5.2f, %2d x %2d cells: force %+.2e (order %.2f)\n", x, 16 * n, 16 * n,
                  error, n > 1 ? order(last, error) : 0.0);
      if (n == 4) {
        // At 50 a cell is thicker than the layer R at the ends in which the pressure falls.
        EXPECT_LT(std::abs(error), x > 10.0 ? 6e-3 : 2e-3);
        EXPECT_GT(order(last, error), x > 10.0 ? 1.0 : 1.9);
      }
      last = error;
    }
  }
}

TEST(WholeSkirt, RoughWallsOfEveryPatternSqueezeByTheirFlowFactors) {
  // With phi_f around and phi_z along the stroke, 1 - cosh(k z/R) / cosh(k x) where
  // k^2 = phi_f / phi_z, and F = 12 pi / phi_f (1 - tanh(k x) / (k x)). At H = 4, h_T = h to 2e-6.
  // Patir and Cheng 1978, table 1: C and r of phi along the flow.
  struct Factor {
    double gamma, c, r;
  };
  const std::array<Factor, 7> table{{{1.0 / 9.0, 1.48, 0.42},
                                     {1.0 / 6.0, 1.38, 0.42},
                                     {1.0 / 3.0, 1.18, 0.42},
                                     {1.0, 0.90, 0.56},
                                     {3.0, 0.225, 1.5},
                                     {6.0, 0.520, 1.5},
                                     {9.0, 0.870, 1.5}}};
  const double ratio = 4.0, x = 0.7;
  const auto phi = [&](const Factor& f) {
    return f.gamma <= 1.0 ? 1.0 - f.c * std::exp(-f.r * ratio) : 1.0 + f.c * std::pow(ratio, -f.r);
  };
  const double smooth_force = squeeze(smooth_round(), x, 48, 48);
  for (size_t k = 0; k < table.size(); ++k) {
    PistonLinerOptions options = smooth_round();
    options.roughness = {3e-6, 4e-6, table[k].gamma, true};  // sigma = 5 um, c = 4 sigma
    const double along = phi(table[k]), around = phi(table[table.size() - 1 - k]),
                 root = std::sqrt(around / along) * x,
                 exact = (1.0 - std::tanh(root) / root) / (1.0 - std::tanh(x) / x) / around,
                 found = squeeze(options, x, 48, 48) / smooth_force;
    std::printf("    Peklenik %.3f: force over that of smooth walls %.5f, exact %.5f\n",
                table[k].gamma, found, exact);
    EXPECT_NEAR(found / exact, 1.0, 1e-3);  // the grid's error is nearly the same in both
  }
  PistonLinerOptions nearly = smooth_round();
  nearly.roughness = {1e-9, 1e-9, 1.0, true};
  EXPECT_NEAR(squeeze(nearly, x, 48, 48) / smooth_force, 1.0, 1e-9);  // exp(-0.56 c / sigma) -> 0
}

TEST(WholeSkirt, ElasticBodiesInRigidMotionFeelTheSameForceAcrossSpacesBetweenPatches) {
  // Two strips on the thrust side, two opposite, nothing beside the pin.
  PistonLinerOptions options = whole_scene();
  const auto rigid = make_element(options, false);
  rom::ContactGrid skirt =
      make_patches(8, 3, options.skirt_bottom, options.skirt_top, options.bore_radius);
  const std::vector<int> kept{0, 1, 4, 5};
  Eigen::VectorXd edges(8);
  for (int i = 0; i < 4; ++i) edges.segment<2>(2 * i) = skirt.angle_edges.segment<2>(2 * kept[i]);
  skirt.angle = Eigen::VectorXd(skirt.angle(kept));
  skirt.angle_edges = edges;
  PistonLinerBodies bodies;
  bodies.stroke = crank_stroke;
  bodies.piston = ElasticSurface{skirt, {}};
  std::vector<int> coordinates(22);
  std::iota(coordinates.begin(), coordinates.end(), 0);
  PistonLiner elastic(options, bodies, coordinates);
  const Eigen::MatrixXd motions = radial_motions({skirt, {}});
  Eigen::VectorXd y(6), v(6);
  y << 1e-6, 4e-6, 0.0, 2e-5, -1e-5, 0.0;
  v << 0.0, 0.02, 0.0, 0.3, 0.0, 0.0;
  const std::vector<int> radial{0, 1, 3, 4};
  Eigen::VectorXd y_e(22), v_e(22);
  y_e << motions * y(radial), y(radial), Eigen::VectorXd::Zero(6);
  v_e << motions * v(radial), v(radial), Eigen::VectorXd::Zero(6);
  const Eigen::VectorXd one = force_of(*rigid, y, v), other = force_of(elastic, y_e, v_e);
  Eigen::VectorXd total = other.tail(6);
  total(radial) += motions.transpose() * other.head(12) + other.segment<4>(12);
  EXPECT_GT(one.norm(), 1.0);
  EXPECT_LT((total - one).norm(), 1e-8 * one.norm());

  // One strip moves outward: the gap follows continuously, on pads it would jump midway.
  y_e.setZero();
  y_e.segment(3, 3).setConstant(5e-6);
  y_e.segment<4>(12) = rigid_fit({skirt, {}}) * y_e.head(12);
  force_of(elastic, y_e, Eigen::VectorXd::Zero(22));
  const RowMatrix gap = elastic.snapshot().front().gap;
  double steepest = 0.0, range = 0.0;
  for (int i = 0; i < 24; ++i) {
    steepest = std::max(steepest, std::abs(gap(i, 4) - gap((i + 1) % 24, 4)));
    range = std::max(range, std::abs(gap(i, 4) - gap(0, 4)));
  }
  EXPECT_GT(range, 3e-6);
  EXPECT_LT(steepest, 2.5e-6);  // 45 degrees of a strip are three cells: 5 um over three
}

TEST(WholeSkirt, AMirroredStateHasTheMirroredFilm) {
  const auto run = [](double sign_x, double sign_y) {
    PistonLinerOptions options = whole_scene();
    options.skirt.ovality = 12e-6;
    const auto element = make_element(options, false);
    Eigen::VectorXd y(6), v(6);
    y << sign_x * 2e-6, sign_y * 7e-6, 0.0, sign_y * 4e-5, -sign_x * 1e-5, 0.0;
    v << sign_x * 0.01, sign_y * 0.02, 0.0, 0.0, 0.0, 0.0;
    return force_of(*element, y, v);
  };
  const Eigen::VectorXd one = run(1.0, 1.0), across = run(1.0, -1.0), along = run(-1.0, 1.0);
  const Eigen::VectorXd y_flip = (Eigen::VectorXd(6) << 1, -1, 1, -1, 1, 1).finished(),
                        x_flip = (Eigen::VectorXd(6) << -1, 1, 1, 1, -1, 1).finished();
  EXPECT_GT(std::abs(one[0]), 1e-3 * std::abs(one[1]));
  EXPECT_LT((across - y_flip.cwiseProduct(one)).norm(), 1e-9 * one.norm());
  EXPECT_LT((along - x_flip.cwiseProduct(one)).norm(), 1e-9 * one.norm());
}

}  // namespace
}  // namespace clatter::film
