// SPDX-License-Identifier: GPL-3.0-or-later
// Covered fractions of a pad whose liner has ends.
#include "dynamics/film/cover.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "film_march.hpp"
#include "tests/refusal.hpp"

namespace clatter::film {
namespace {

const PadGrid kPad = strip(-0.04, 0.03, 14);  // rows of 5 mm
const LinerEnds kEnds{0.1, 0.25};

Cover cover_at(double height) {
  Cover cover;
  CoverMap(kEnds, kPad).at(height, cover);
  return cover;
}

TEST(Cover, SumOfTheRowsIsTheCoveredLength) {
  for (double height = 0.0; height < 0.35; height += 0.0007) {
    const double low = std::max(height - 0.04, kEnds.bottom),
                 high = std::min(height + 0.03, kEnds.top);
    // Within half a row of an end of the skirt the end of the liner is smoothed.
    bool near = false;
    for (double skirt : {height - 0.04, height + 0.03})
      for (double end : {kEnds.bottom, kEnds.top}) near = near || std::abs(skirt - end) < 2.5e-3;
    const double covered = 0.005 * cover_at(height).share.sum();
    EXPECT_NEAR(covered, std::max(high - low, 0.0), near ? 0.5e-3 : 1e-15) << height;
  }
}

TEST(Cover, RowsInsideAreCompleteAndRowsOutsideAreNot) {
  const Cover inside = cover_at(0.15);
  EXPECT_TRUE((inside.share == 1.0).all());
  EXPECT_TRUE((inside.edge == 1.0).all());
  EXPECT_TRUE((inside.share_slope == 0.0).all());
  const Cover above = cover_at(0.3);
  EXPECT_TRUE((above.share == 0.0).all());
  EXPECT_TRUE((above.edge == 0.0).all());
}

TEST(Cover, DerivativesAreThoseOfTheFractionsAndContinuous) {
  const double d = 1e-6;
  double largest = 0.0;
  Cover last = cover_at(0.07);
  for (double height = 0.07; height < 0.15; height += 1e-4) {
    const Cover here = cover_at(height), low = cover_at(height - d), high = cover_at(height + d);
    EXPECT_LT(((high.share - low.share) / (2.0 * d) - here.share_slope).abs().maxCoeff(), 1e-2);
    // Of 300 and 6e4; the next derivatives, 2.4e5 and 1e8, jump.
    EXPECT_LT(((high.edge - low.edge) / (2.0 * d) - here.edge_slope).abs().maxCoeff(), 0.3);
    EXPECT_LT(
        ((high.share_slope - low.share_slope) / (2.0 * d) - here.share_curve).abs().maxCoeff(),
        100.0);
    // Of the slope's 200 per metre, its curvature of at most 1.5 / (5 mm)^2 takes 6 in a step.
    largest = std::max(largest, (here.share_slope - last.share_slope).abs().maxCoeff());
    last = here;
  }
  EXPECT_LT(largest, 6.1);
}

TEST(Cover, ALinerShorterThanTwoRowsIsRefused) {
  test::expect_parts(test::refusal_of([] {
                       CoverMap(LinerEnds{0.1, 0.109}, kPad);
                     }),
                     {"found ends at 0.1 and 0.109 m", "at least two rows of cells, 0.01 m"});
}

TEST(Cover, TheFilmsDerivativeByTheSpeedIsADifferenceQuotient) {
  const Cover cover = cover_at(0.121);
  const Eigen::ArrayXd gap =
      along(kPad, [](double z) { return 15e-6 + 8e-6 * std::sin(90.0 * z); });
  const Eigen::ArrayXd content =
      gap * along(kPad, [](double z) { return 0.9 + 0.15 * std::sin(130.0 * z); });
  const Edge open = Edge::supply(2e4, 0.7, 5e-6);
  for (const Cavity cavity : {Cavity::kLayer, Cavity::kStriated})
    for (const double speed : {-3.0, 3.0}) {
      const auto solved = [&](double at) {
        Reynolds film(kPad, {Edge::wall(), Edge::wall(), open, open, open}, true);
        FilmStage stage{1e-4, 0.01, 0.0, at, false, 2e8};
        stage.cavity = cavity;
        stage.cover = &cover;
        film.solve(smooth(gap), content * cover.of_cells(1), stage);
        return film;
      };
      constexpr double kStep = 1e-6;
      Reynolds at = solved(speed);
      const Reynolds more = solved(speed + kStep), less = solved(speed - kStep);
      const auto value = [](const Reynolds& film, int c) {
        return film.is_full(c) ? film.pressure()[c] : film.fill()[c];
      };
      Eigen::ArrayXd derivative;
      at.speed_sensitivity(derivative);
      int full = 0, empty = 0;
      for (int c = 0; c < kPad.size(); ++c) {
        if (cover.share[c] == 0.0) continue;
        ++(at.is_full(c) ? full : empty);
        const double scale = at.is_full(c) ? derivative.abs().maxCoeff() : 1.0;
        EXPECT_NEAR(derivative[c], (value(more, c) - value(less, c)) / (2.0 * kStep), 1e-6 * scale);
      }
      EXPECT_GT(std::min(full, empty), 0);
    }
}

}  // namespace
}  // namespace clatter::film
