// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case R6: the element's tangent against central differences, in every regime.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "film_march.hpp"
#include "piston_scene.hpp"
#include "tests/observed.hpp"

namespace clatter::film {
namespace {

struct Regime {
  const char* name;
  double clearance, fill, depth;  // depth: how far the pin is pushed to the thrust side [m]
  ContactEffects effects;
  bool flow_factors;
  AsperityOptions::Law law;
  double approach = 20e-3;  // [m/s] towards the thrust side
  double layer = INFINITY;  // oil on the liner [m]
  double viscosity = 0.01;  // [Pa s]; little, where asperities are to carry a share
  LinerEnds ends{};         // of the liner; the pad is from 0.223 to 0.293 m
  Cavity cavity = Cavity::kLayer;
  bool oil_laws = false;  // all laws of the viscosity, factors of friction, oil on the liner
  SkirtSpan span = SkirtSpan::kPads;
  std::vector<Recess> recesses{};
};
void PrintTo(const Regime& regime, std::ostream* out) { *out << regime.name; }

std::vector<bool> split_of(const PistonLiner& element) {
  std::vector<bool> split;
  for (const PadSnapshot& pad : element.snapshot())
    for (Eigen::Index c = 0; c < pad.fill.size(); ++c) split.push_back(pad.fill.data()[c] < 1.0);
  return split;
}

// Central differences with Richardson extrapolation; the start content is fixed, so each difference
// is of one stage.
double tangent_error(PistonLiner& element, const Eigen::VectorXd& y, double approach,
                     double& cavitated_share, double& contact_share) {
  const int n = element.size();
  // Settle the content at rest, then probe a stage that closes the gap a little further.
  const dynamics::Stage first{2.0e-3, 1e-12, 0, {}};
  dynamics::Response response;
  element.begin_step(first.time);
  element.evaluate(first, y, Eigen::VectorXd::Zero(n), true, response);
  element.finish_stage(first);
  element.accept_step(first.time);
  element.begin_step(first.time);
  const dynamics::Stage stage{2.0e-3 + 2e-6, 2e-6, 1, {2e-6}};
  Eigen::VectorXd probe = y;
  // Closing towards the thrust side, and a different little step of every coordinate.
  probe += stage.kappa * approach * (y.array() / y.cwiseAbs().maxCoeff()).matrix();
  for (int k = 0; k < n; ++k) probe[k] += 0.1 * stage.kappa * approach * std::sin(3.0 * k + 1.0);
  // Velocities follow from the displacements, as in the integrator's stage.
  const auto rate = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
    return (at - y) / stage.kappa;
  };
  element.evaluate(stage, probe, rate(probe), true, response);
  const Eigen::MatrixXd tangent = full_tangent(response);
  double fill = 0.0, count = 0.0, contact = 0.0, total = 0.0;
  for (const PadSnapshot& pad : element.snapshot()) {
    if (pad.fill.size() > 0) {
      fill += (pad.fill.array() < 1.0).cast<double>().sum();
      total += pad.pressure.sum();
    }
    if (pad.contact_pressure.size() > 0) contact += pad.contact_pressure.sum();
    count += static_cast<double>(pad.gap.size());
  }
  cavitated_share = fill / count;
  contact_share = contact > 0.0 ? contact / (contact + total) : 0.0;
  const std::vector<bool> split = split_of(element);
  bool same_split = true;
  double worst = 0.0;
  dynamics::Response low, high;
  for (int k = 0; k < n; ++k) {
    auto central = [&](double d) {
      Eigen::VectorXd y_low = probe, y_high = probe;
      y_low[k] -= d;
      y_high[k] += d;
      element.evaluate(stage, y_high, rate(y_high), false, high);
      same_split = same_split && split_of(element) == split;
      element.evaluate(stage, y_low, rate(y_low), false, low);
      same_split = same_split && split_of(element) == split;
      return Eigen::VectorXd((high.force - low.force) / (2.0 * d));
    };
    // Differences across a switch of a cell are meaningless: reduce the step until the split does
    // not change.
    // A column of little stiffness, as that of the height, needs a longer step than the gap's, and
    // so does the pin of an elastic piston: it turns the skirt by the lever of its axial
    // displacement only, millimetres on a slope of the liner of 1e-5.
    // A patch that barely reaches a pad is compared with the largest column: differences have no
    // digits of its own.
    const double largest = tangent.cwiseAbs().maxCoeff(),
                 own = tangent.col(k).cwiseAbs().maxCoeff();
    const bool patch = n > 6 && k < kPin;
    const bool soft = !patch && own < 1e-5 * largest;
    const bool pin = n > 6 && k >= n - 4 && k < n - 1;
    double d = pin ? 4e-6 : soft ? 4e-8 : 4e-10;
    Eigen::VectorXd difference;
    do {
      same_split = true;
      difference = (4.0 * central(0.5 * d) - central(d)) / 3.0;
      d *= 0.25;
    } while (!same_split && d > 1e-13);
    EXPECT_TRUE(same_split) << "column " << k;
    if (own == 0.0) {  // a patch beside no pad, the pin along which nothing acts
      // Differences are rounding of the forces over the step.
      EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-11 * largest) << "column " << k;
      continue;
    }
    worst = std::max(worst, (difference - tangent.col(k)).cwiseAbs().maxCoeff() /
                                (patch ? std::max(own, 1e-3 * largest) : own));
  }
  return worst;
}

class Tangent : public ::testing::TestWithParam<Regime> {};

TEST_P(Tangent, HardR6_AnalyticTangentAgreesWithCentralDifferences) {
  const Regime& regime = GetParam();
  // The pin offset adds levers of the axial forces.
  for (const auto& [elastic, offset] : {std::pair{false, 0.0}, {true, 0.0}, {true, 2e-3}}) {
    PistonLinerOptions options;
    options.span = regime.span;
    options.recesses = regime.recesses;
    options.cells_around = 8;
    options.cells_along = 9;
    options.clearance = regime.clearance;
    options.initial_fill = regime.fill;
    options.effects = regime.effects;
    options.oil_thickness = regime.layer;
    options.viscosity = regime.viscosity;
    options.ends = regime.ends;
    options.cavity = regime.cavity;
    options.skirt.barrel_top = 15e-6;
    options.skirt.barrel_bottom = 10e-6;
    options.skirt.ovality = 8e-6;
    options.roughness = {0.4e-6, 0.3e-6, 1.0, regime.flow_factors};
    options.asperity.law = regime.law;
    if (regime.oil_laws) {
      options.roughness.stress_factors = regime.flow_factors;
      options.oil.vogel = {regime.viscosity / std::exp(5.0), 1000.0, 180.0};
      options.oil.height = {0.2, 0.3};
      options.oil.temperature = {380.0, 390.0};
      options.oil.pressure_coefficient = 2e-8;
      options.oil.cross = {1e6, 0.4, 0.8};
      if (std::isfinite(regime.layer)) {
        options.liner_layer.emplace();
        options.liner_layer->bottom = 0.05;
        options.liner_layer->top = 0.35;
      }
    }
    const auto element = make_element(options, elastic, offset);
    Eigen::VectorXd y = pushed(*element, elastic, regime.depth, 2e-5);
    double cavitated = 0.0, contact = 0.0;
    const double error = tangent_error(*element, y, regime.approach, cavitated, contact);
    std::printf("R6 %-22s %-7s error %.1e  cavitated %.0f %%  asperity share %.0f %%\n",
                regime.name, elastic ? "elastic" : "rigid", error, 100.0 * cavitated,
                100.0 * contact);
    test::expect_at_most("error of the tangent", error, 1e-6);  // required
  }
}

constexpr ContactEffects kAll{true, true, true, true};
constexpr ContactEffects kFilm{true, true, false, true};
constexpr LinerEnds kCut{0.24, 0.285};

Regime with_oil_laws(Regime regime) {
  regime.oil_laws = true;
  return regime;
}

/// A groove of the skirt under pressure, one of the liner, and a window beside the pin.
Regime with_recesses(Regime regime) {
  Recess supplied{.bottom = -0.02, .top = -0.005, .angle_begin = -1.0, .angle_span = 2.0},
      port{.on_liner = true, .bottom = 0.27, .top = 0.283},
      cut{.kind = Recess::Kind::kWindow, .bottom = -0.04, .top = 0.0, .angle_begin = 0.3};
  supplied.pressure = 3e4;  // little force, of which differences take rounding
  cut.angle_span = 0.35;
  regime.recesses = {supplied, port, cut};
  return regime;
}

Regime whole(Regime regime) {
  regime.span = SkirtSpan::kWhole;
  return regime;
}

INSTANTIATE_TEST_SUITE_P(
    Regimes, Tangent,
    ::testing::Values(Regime{"full film",
                             30e-6,
                             1.0,
                             15e-6,
                             {true, true, false, true},
                             false,
                             AsperityOptions::Law::kFit},
                      Regime{"cavitated",
                             30e-6,
                             0.999,
                             24e-6,
                             {true, true, false, true},
                             false,
                             AsperityOptions::Law::kFit},
                      Regime{"plain Reynolds",
                             30e-6,
                             1.0,
                             15e-6,
                             {true, false, false, false},
                             false,
                             AsperityOptions::Law::kFit},
                      Regime{"dry contact",
                             5e-6,
                             1.0,
                             5.2e-6,
                             {false, false, true, true},
                             false,
                             AsperityOptions::Law::kFit},
                      Regime{"dry contact exact",
                             5e-6,
                             1.0,
                             5.2e-6,
                             {false, false, true, true},
                             false,
                             AsperityOptions::Law::kExact},
                      Regime{"mixed", 5e-6, 1.0, 6.2e-6, kAll, false, AsperityOptions::Law::kFit,
                             1e-5, INFINITY, 1e-6},
                      Regime{"mixed, thin oil layer", 5e-6, 1.0, 5e-6, kAll, false,
                             AsperityOptions::Law::kFit, 20e-3, 1e-6},
                      Regime{"mixed, flow factors", 5e-6, 1.0, 6.2e-6, kAll, true,
                             AsperityOptions::Law::kExact, 1e-5, INFINITY, 1e-6},
                      Regime{"mixed, streamers",
                             5e-6,
                             1.0,
                             5e-6,
                             kAll,
                             false,
                             AsperityOptions::Law::kFit,
                             20e-3,
                             1e-6,
                             0.01,
                             {},
                             Cavity::kStriated},
                      Regime{"full film over an end",
                             30e-6,
                             1.0,
                             15e-6,
                             {true, true, false, true},
                             false,
                             AsperityOptions::Law::kFit,
                             20e-3,
                             INFINITY,
                             0.01,
                             kCut},
                      Regime{"dry contact over an end",
                             5e-6,
                             1.0,
                             5.2e-6,
                             {false, false, true, true},
                             false,
                             AsperityOptions::Law::kFit,
                             20e-3,
                             INFINITY,
                             0.01,
                             kCut},
                      Regime{"mixed over an end", 5e-6, 1.0, 6.2e-6, kAll, false,
                             AsperityOptions::Law::kFit, 1e-5, INFINITY, 1e-6, kCut},
                      Regime{"mixed over an end, flow factors", 5e-6, 1.0, 6.2e-6, kAll, true,
                             AsperityOptions::Law::kFit, 1e-5, INFINITY, 1e-6, kCut},
                      Regime{"thin layer over an end", 5e-6, 1.0, 5e-6, kAll, false,
                             AsperityOptions::Law::kFit, 20e-3, 1e-6, 0.01, kCut},
                      with_oil_laws({"full film, laws of the oil", 30e-6, 1.0, 15e-6, kFilm, true,
                                     AsperityOptions::Law::kFit, 20e-3, INFINITY, 0.05}),
                      with_oil_laws({"mixed, laws of the oil", 5e-6, 1.0, 6.2e-6, kAll, true,
                                     AsperityOptions::Law::kExact, 1e-5, INFINITY, 1e-6, kCut}),
                      with_oil_laws({"thin layer that is remembered", 5e-6, 1.0, 5e-6, kAll, false,
                                     AsperityOptions::Law::kFit, 20e-3, 1e-6}),
                      whole({"full film around the skirt", 30e-6, 1.0, 15e-6, kFilm, false,
                             AsperityOptions::Law::kFit}),
                      with_recesses(whole({"full film with recesses", 30e-6, 1.0, 15e-6, kFilm,
                                           false, AsperityOptions::Law::kFit})),
                      with_recesses({"cavitated with recesses", 30e-6, 0.999, 24e-6, kFilm, false,
                                     AsperityOptions::Law::kFit}),
                      with_recesses({"mixed with recesses over an end", 5e-6, 1.0, 6.2e-6, kAll,
                                     true, AsperityOptions::Law::kFit, 1e-5, INFINITY, 1e-6, kCut}),
                      with_recesses({"thin layer with recesses",
                                     5e-6,
                                     1.0,
                                     5e-6,
                                     kAll,
                                     false,
                                     AsperityOptions::Law::kFit,
                                     20e-3,
                                     1e-6,
                                     0.01,
                                     {},
                                     Cavity::kLayer,
                                     true}),
                      whole({"mixed around the skirt", 5e-6, 1.0, 6.2e-6, kAll, true,
                             AsperityOptions::Law::kFit, 1e-5, INFINITY, 1e-6, kCut}),
                      Regime{"streamers over an end", 5e-6, 1.0, 5e-6, kAll, false,
                             AsperityOptions::Law::kFit, 20e-3, 1e-6, 0.01, kCut,
                             Cavity::kStriated}),
    [](const auto& info) {
      std::string name = info.param.name;
      std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
      return name;
    });

}  // namespace
}  // namespace clatter::film
