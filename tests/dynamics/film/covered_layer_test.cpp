// SPDX-License-Identifier: GPL-3.0-or-later
// Fronts of oil below the skirt: what lies on the liner is not smeared over the grid of the skirt.
#include "dynamics/film/covered_layer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "film_march.hpp"
#include "stroke_march.hpp"

namespace clatter::film {
namespace {

constexpr double kMicro = 1e-6;

// The stroke of the sample at 2000 rpm, top dead centre at 0.
constexpr double kBottom = -0.046, kTop = 0.036, kSpin = 2000.0 * 2.0 * std::numbers::pi / 60.0,
                 kCrank = 0.065, kLambda = 0.065 / 0.21;
double liner_speed(double t) {
  const double a = kSpin * t;
  return kCrank * kSpin * (std::sin(a) + 0.5 * kLambda * std::sin(2.0 * a));
}
double liner_way(double t) {  // up to top dead centre
  const double a = kSpin * t;
  return kCrank * ((1.0 - std::cos(a)) + 0.25 * kLambda * (1.0 - std::cos(2.0 * a)));
}
double crank_time(double degrees) { return degrees / 360.0 * 60.0 / 2000.0; }
double barrel(double z) {
  return z > 0.008 ? 40.0 * kMicro * std::pow((z - 0.008) / 0.028, 2)
                   : 25.0 * kMicro * std::pow((0.008 - z) / 0.054, 2);
}

StrokeConditions skirt(bool remembered, double layer) {
  StrokeConditions conditions;
  conditions.begin = kBottom;
  conditions.end = kTop;
  conditions.layer = layer;
  conditions.speed = liner_speed;
  conditions.remembered = remembered;
  return conditions;
}

/// Layers of 1, 2, 3, 4 m on four cells of 1 m; `wet`: the cell that is not dry, -1: none.
CoveredLayer stairs(const PadFaces& pad, int wet) {
  CoveredLayer layer(pad);
  Eigen::ArrayXd profile(4);
  profile << 1.0, 2.0, 3.0, 4.0;
  layer.start(profile);
  std::vector<double> state;
  layer.save(state);
  for (int k = 0; k < 16; ++k) state[1 + k] = k / 4 == wet ? 0.0 : profile[k / 4] / 4.0;
  for (int j = 0; j < 4; ++j) state[state.size() - 4 + j] = j == wet ? 0.0 : 1.0;
  layer.restore(state.begin(), profile);
  return layer;
}

TEST(CoveredLayer, AFaceCarriesWhatLiesOnItsWay) {
  const PadGrid grid = strip(0.0, 4.0, 4);
  const PadFaces pad(grid, strip_edges(), false);
  CoveredLayer layer = stairs(pad, -1);
  const FilmStage stage;
  const FilmCells gap = smooth(Eigen::ArrayXd::Constant(4, 20.0));
  const KnownFlows& up = layer.slide(-0.5, gap, stage);  // the liner moves up by half a cell
  ASSERT_EQ(pad.faces().size(), 3u);
  for (int f = 0; f < 3; ++f) {
    EXPECT_TRUE(up.at[f]);
    EXPECT_NEAR(up.volume[f], 0.5 * (f + 1), 1e-14) << f;
  }
  EXPECT_FALSE(up.at[pad.rim_flow(0)]);  // the edges are flooded: the gap decides what comes in
  EXPECT_TRUE(up.at[pad.rim_flow(1)]);
  EXPECT_NEAR(up.volume[pad.rim_flow(1)], 2.0, 1e-14);
  const KnownFlows& down = layer.slide(0.75, gap, stage);
  for (int f = 0; f < 3; ++f) EXPECT_NEAR(down.volume[f], -0.75 * (f + 2), 1e-14) << f;
  EXPECT_TRUE(down.at[pad.rim_flow(0)]);
  EXPECT_NEAR(down.volume[pad.rim_flow(0)], 0.75, 1e-14);
  EXPECT_FALSE(down.at[pad.rim_flow(1)]);
}

TEST(CoveredLayer, OverAnEdgeComesWhatTheGapTakes) {
  const PadGrid grid = strip(0.0, 4.0, 4);
  const Edge open = Edge::supply(0.0, 1.0, 5.0);
  const PadFaces pad(grid, strip_edges(open, open), false);
  CoveredLayer layer = stairs(pad, -1);
  const FilmStage stage;
  const auto flows = [&](double gap) {
    return layer.slide(-1.25, smooth(Eigen::ArrayXd::Constant(4, gap)), stage);
  };
  const KnownFlows wide = flows(10.0), narrow = flows(9.9);
  EXPECT_NEAR(wide.volume[pad.rim_flow(0)], -1.25 * 5.0, 1e-14);
  EXPECT_NEAR(wide.volume[0], 1.0 + 0.25 * 5.0, 1e-14);
  EXPECT_NEAR(wide.volume[1], 2.0 + 0.25 * 1.0, 1e-14);
  EXPECT_FALSE(narrow.at[pad.rim_flow(0)]);
  EXPECT_FALSE(narrow.at[0]);
  EXPECT_TRUE(narrow.at[1]);
}

TEST(CoveredLayer, BesideACellThatIsNotDryTheFilmsOwnLawHolds) {
  const PadGrid grid = strip(0.0, 4.0, 4);
  const PadFaces pad(grid, strip_edges(), false);
  CoveredLayer layer = stairs(pad, 1);
  const FilmStage stage;
  const FilmCells gap = smooth(Eigen::ArrayXd::Constant(4, 20.0));
  const KnownFlows& flows = layer.slide(-0.5, gap, stage);
  EXPECT_FALSE(flows.at[0]);
  EXPECT_FALSE(flows.at[1]);
  EXPECT_TRUE(flows.at[2]);
  EXPECT_NEAR(flows.volume[2], 1.5, 1e-14);
  // By more than a cell: fronts move as far, and no face is beyond their reach.
  const KnownFlows& far = layer.slide(-1.5, gap, stage);
  for (int f = 0; f < 3; ++f) EXPECT_FALSE(far.at[f]) << f;
}

/// L1 error of a ridge of 15 mm x 4 um after a stroke of 8 mm and back in so many steps, of the
/// ridge, and the part of the oil that is missing.
std::pair<double, double> ridge_error(int cells, bool remembered, bool on_liner, int steps,
                                      const dynamics::Tableau& method) {
  const double layer = (on_liner ? 5.0 : 20.0) * kMicro;  // of the liner: up to half of the gap
  StrokeConditions conditions = skirt(remembered, layer);
  const double period = 0.03, reach = 8e-3, pi = std::numbers::pi;
  conditions.speed = [=](double t) {
    return reach * pi / period * std::sin(2.0 * pi * t / period);
  };
  StrokeMarch march(cells, conditions);
  const auto ridge = [](double z) { return z > -0.006 && z < 0.009 ? 4.0 * kMicro : 0.0; };
  march.start(
      0.0, [&](double z) { return layer + (on_liner ? ridge(z) : 0.0); },
      [&](double z) { return on_liner ? 0.0 : ridge(z); });
  const Eigen::ArrayXd first = march.content(), h = march.at_cells([&](double z) {
    return 40.0 * kMicro + (on_liner ? barrel(z) : 0.0);
  });
  const double oil = march.oil();
  for (int k = 0; k < steps; ++k) march.step(method, period / steps, [&](double) { return h; });
  return {(march.content() - first).abs().sum() * (kTop - kBottom) / cells / (4.0 * kMicro * 15e-3),
          std::abs(march.oil() / oil - 1.0)};
}

// Up to five cells of travel a step.
TEST(CoveredLayer, ARidgeThatRestsOnAWallStaysThere) {
  for (const bool on_liner : {true, false})
    for (const int cells : {16, 32, 64, 128}) {
      const double by_cells =
          ridge_error(cells, false, on_liner, 4 * cells, dynamics::sdirk2()).first;
      double worst = 0.0, lost = 0.0;
      for (const int steps : {8, 20, 100, 1000})
        for (const dynamics::Tableau* method : {&dynamics::sdirk2(), &dynamics::tr_bdf2()}) {
          const auto [error, missing] = ridge_error(cells, true, on_liner, steps, *method);
          worst = std::max(worst, error);
          lost = std::max(lost, missing);
        }
      std::printf("    ridge on the %s, %3d cells: error %.0e, by cells %.3f\n",
                  on_liner ? "liner" : "skirt", cells, worst, by_cells);
      EXPECT_LT(worst, 1e-10);
      EXPECT_LT(lost, 1e-12);
      EXPECT_TRUE(!on_liner || by_cells > 0.05);
    }
}

// Full from z_f to the outlet with the flux of the layer, t V.
TEST(CoveredLayer, AStarvedSliderIsThatOfTheFilmAlone) {
  const double t = 5.5 * kMicro, speed = 5.0, length = 0.06;
  for (const int cells : {16, 32, 64}) {
    double loads[2];
    for (const bool remembered : {false, true}) {
      StrokeConditions conditions;
      conditions.layer = t;
      conditions.bulk_modulus = 2e9;
      conditions.speed = [=](double) { return speed; };
      conditions.remembered = remembered;
      StrokeMarch march(cells, conditions);
      const Eigen::ArrayXd h =
          march.at_cells([=](double z) { return (40.0 - 32.0 * z / length) * kMicro; });
      march.start(
          0.0, [=](double) { return t; }, [](double) { return 0.0; });
      const double dt = 0.5 * length / cells / speed;
      const int steps = static_cast<int>(std::lround(2.0 / speed / dt));
      for (int k = 0; k < steps; ++k)
        loads[remembered] = march.step(dynamics::sdirk2(), dt, [&](double) { return h; });
    }
    std::printf("    starved slider, %2d cells: load %+.2f %%, by cells alone %+.2f %%\n", cells,
                100.0 * (loads[1] / 40560.0 - 1.0), 100.0 * (loads[0] / 40560.0 - 1.0));
    EXPECT_NEAR(loads[1], loads[0], 2e-3 * 40560.0);
  }
}

/// Carries the wedge of oil that the liner of the sample has under its skirt to top dead centre.
void carry_wedge(StrokeMarch& march, const Eigen::ArrayXd& h, double offset = 0.0) {
  const double begin = crank_time(-40.0), at = liner_way(begin) + offset;
  march.start(
      begin,
      [=](double z) {
        const double x = z - at + 0.005;
        return 5.0 * kMicro + (x > 0.0 && x < 0.015 ? 11.0 * kMicro * x / 0.015 : 0.0);
      },
      [](double) { return 0.0; });
  for (int k = 0; k < 160; ++k)
    march.step(dynamics::sdirk2(), -begin / 160, [&](double) { return h; });
}

constexpr double kWidth = 0.08, kMass = 1.0, kForce = 1000.0;

/// Largest deceleration of a body of 1 kg that 1 kN pushes over 50 um onto the wedge [m/s2].
double slap(int cells, bool remembered, double offset) {
  Eigen::ArrayXd shape(cells);
  for (int c = 0; c < cells; ++c)
    shape[c] = 50.0 * kMicro + barrel(kBottom + (kTop - kBottom) * (c + 0.5) / cells);
  StrokeMarch march(cells, skirt(remembered, 5.0 * kMicro));
  carry_wedge(march, shape, offset * (kTop - kBottom) / cells);
  double peak = 0.0;
  while (march.time() < 5e-4) {
    march.step_body(dynamics::sdirk2(), 2e-6, shape, kMass / kWidth, kForce / kWidth);
    peak = std::max(peak, -march.acceleration);
  }
  return peak;
}

TEST(CoveredLayer, TheSlapOntoAWedgeOfOilConverges) {
  for (const bool remembered : {false, true})
    for (const int cells : {16, 32, 64, 128}) {
      double sum = 0.0, least = INFINITY, most = 0.0;
      for (int k = 0; k < 5; ++k) {
        const double peak = slap(cells, remembered, 0.2 * k) / 23300.0 - 1.0;
        sum += 0.2 * peak;
        least = std::min(least, peak);
        most = std::max(most, peak);
      }
      std::printf("    slap, %-10s %3d cells: %+.1f %% (%+.1f to %+.1f)\n",
                  remembered ? "remembered" : "by cells", cells, 100.0 * sum, 100.0 * least,
                  100.0 * most);
      if (remembered && cells == 64) {
        EXPECT_LT(std::abs(sum), 0.05);
      }
    }
}

/// Gap at which a prescribed approach at 0.1 m/s carries 500 N [um], and impulse [Ns].
std::pair<double, double> approach(int cells, bool remembered) {
  Eigen::ArrayXd relief(cells);
  for (int c = 0; c < cells; ++c)
    relief[c] = barrel(kBottom + (kTop - kBottom) * (c + 0.5) / cells);
  StrokeMarch march(cells, skirt(remembered, 5.0 * kMicro));
  carry_wedge(march, 50.0 * kMicro + relief);
  const int steps = 400;
  const double dt = 42.0 * kMicro / 0.1 / steps;
  double before = 0.0, at = 0.0, impulse = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double now = kWidth * march.step(dynamics::sdirk2(), dt, [&](double t) {
      return Eigen::ArrayXd(50.0 * kMicro - 0.1 * t + relief);
    });
    if (at == 0.0 && now > 500.0)
      at = 50.0 - 1e6 * 0.1 * (march.time() - dt * (now - 500.0) / (now - before));
    impulse += dt * now;
    before = now;
  }
  return {at, impulse};
}

TEST(CoveredLayer, TheGapAtWhichARidgeCarriesConverges) {
  for (const bool remembered : {false, true})
    for (const int cells : {16, 32, 64, 128, 256}) {
      const auto [gap, impulse] = approach(cells, remembered);
      std::printf("    approach, %-10s %3d cells: 500 N at %.2f um, %.3f Ns\n",
                  remembered ? "remembered" : "by cells", cells, gap, impulse);
      if (remembered && cells >= 32) {
        EXPECT_NEAR(gap, 14.47, 35.0 / cells);
      }
    }
}

/// Full film under a loaded skirt, rupture, transport through top dead centre and its reversal.
struct Life {
  double crest, gap, impulse, lost;
};
Life life(int cells, bool remembered, double scale) {
  const auto low = [](double t) {
    const double a = t / crank_time(1.0);
    if (a < -40.0) return 4.7 * kMicro;
    const double x = (a + 40.0) / 15.0;
    return a < -25.0 ? (4.7 + 29.3 * x * x * (3.0 - 2.0 * x)) * kMicro
                     : 34.0 * kMicro - 0.1 * std::max(t, 0.0);
  };
  StrokeMarch march(cells, skirt(remembered, 6.0 * kMicro));
  const Eigen::ArrayXd relief = march.at_cells(barrel);
  march.start(
      crank_time(-60.0), [](double z) { return std::min(6.0 * kMicro, 4.7 * kMicro + barrel(z)); },
      [](double) { return 0.0; });
  const double oil = march.oil(), dt = 10e-6 / scale;
  Life result{0.0, 0.0, 0.0, 0.0};
  double before = 0.0;
  while (march.time() < 26.0 * kMicro / 0.1) {
    const double step = march.time() < -0.5 * dt ? dt : 0.1 * dt;
    const double now = kWidth * march.step(dynamics::sdirk2(), step, [&](double t) {
      return Eigen::ArrayXd(low(t) + relief);
    });
    if (result.crest == 0.0 && march.time() > -1e-9)
      result.crest = 1e6 * march.content().maxCoeff();
    if (march.time() > 0.0) result.impulse += step * now;
    if (result.gap == 0.0 && now > 500.0 && march.time() > 0.0)
      result.gap = 34.0 - 0.1e6 * (march.time() - step * (now - 500.0) / (now - before));
    before = now;
  }
  result.lost = std::abs(march.oil() / oil - 1.0);
  return result;
}

TEST(CoveredLayer, TheLifeOfARidgeConvergesAtSmallAndLargeSteps) {
  for (const bool remembered : {false, true})
    for (const int cells : {16, 32, 64, 128}) {
      const Life one = life(cells, remembered, 1.0);
      std::printf("    life, %-10s %3d cells: crest %.1f um, 500 N at %.2f um, %.3f Ns, oil %.0e\n",
                  remembered ? "remembered" : "by cells", cells, one.crest, one.gap, one.impulse,
                  one.lost);
      EXPECT_LT(one.lost, 1e-12);
      if (remembered && cells == 64) {
        EXPECT_NEAR(one.crest, 17.1, 0.9);
      }
    }
  for (const double scale : {1.0, 0.5, 0.25, 0.125}) {
    const Life one = life(256, true, scale);
    std::printf("    life, 256 cells, Courant %.1f: crest %.1f um, 500 N at %.2f um, %.3f Ns\n",
                0.3 / scale, one.crest, one.gap, one.impulse);
    EXPECT_NEAR(one.crest, 17.1, 1.0);
  }
}

TEST(CoveredLayer, TheTangentIsExact) {
  const int cells = 48;
  Eigen::ArrayXd shape(cells);
  for (int c = 0; c < cells; ++c)
    shape[c] = 14.0 * kMicro + barrel(kBottom + (kTop - kBottom) * (c + 0.5) / cells);
  StrokeMarch march(cells, skirt(true, 5.0 * kMicro));
  carry_wedge(march, 50.0 * kMicro + shape);
  for (int k = 0; k < 40; ++k)
    march.step(dynamics::sdirk2(), 1e-5,
               [&](double t) { return Eigen::ArrayXd(shape + 20.0 * kMicro - 0.05 * t); });
  const double kappa = 2e-6, d = 1e-11, t = march.time() + kappa;
  const auto at = [&](double change) {
    return march.stage(1, kappa, {}, shape - 0.3 * kMicro + change, t);
  };
  const double high = at(d), low = at(-d);
  EXPECT_GT(at(0.0), 0.0);
  EXPECT_NEAR(march.load_by_gap(), (high - low) / (2.0 * d), 1e-5 * std::abs(high - low) / d);
}

}  // namespace
}  // namespace clatter::film
