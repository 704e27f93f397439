// SPDX-License-Identifier: GPL-3.0-or-later
// Squeeze films with known answers.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "film_march.hpp"

namespace clatter::film {
namespace {

// Closing at speed V: the content before is what a gap wider by kappa V held.
void squeeze(Reynolds& film, double gap, double speed, double viscosity) {
  const double kappa = 1e-6;
  const Eigen::ArrayXd h = Eigen::ArrayXd::Constant(film.grid().size(), gap);
  film.solve(smooth(h), h + kappa * speed, {kappa, viscosity, 0.0, 0.0, false});
}

TEST(StripSqueeze, LoadConvergesAtSecondOrder) {
  // W' = mu V L^3 / h^3 = 1e4 N/m for mu = .01, L = 10 mm, h = 10 um, V = 1 mm/s.
  double last = 0.0;
  for (int cells : {8, 16, 32, 64}) {
    Reynolds film(strip(0.0, 10e-3, cells), strip_edges(), true);
    squeeze(film, 10e-6, 1e-3, 0.01);
    const double error = load(film) / 1e4 - 1.0;
    std::printf("strip squeeze n=%2d error %+.2e order %.2f\n", cells, error, order(last, error));
    if (last != 0.0) {
      EXPECT_NEAR(order(last, error), 2.0, 0.05);
    }
    EXPECT_NEAR(error, 2.0 / (cells * cells), 1e-9);  // all of it from the half cells at the ends
    last = error;
  }
}

TEST(StripSqueeze, PressureIsTheParabola) {
  const int cells = 40;
  const double length = 10e-3, h = 10e-6;
  Reynolds film(strip(0.0, length, cells), strip_edges(), true);
  squeeze(film, h, 1e-3, 0.01);
  for (int j = 0; j < cells; ++j) {
    const double x = film.grid().axial(j);
    const double exact = 6.0 * 0.01 * 1e-3 / (h * h * h) * x * (length - x);
    // Constant source: the scheme is exact but for the half cell at the ends, 3 mu V dx^2 / (2
    // h^3).
    EXPECT_NEAR(film.pressure()[j], exact,
                1.01 * 1.5 * 1e-5 / (h * h * h) * std::pow(length / cells, 2));
  }
}

TEST(SquarePlateSqueeze, FactorIsTheSeriesValue) {
  // W = .421731 mu V L^4 / h^3 (Fourier series).
  double last = 0.0;
  for (int cells : {8, 16, 32, 64}) {
    Reynolds film(PadGrid::uniform(0.0, 1.0, cells, 0.0, 1.0, cells, 1.0), {}, true);
    squeeze(film, 1e-3, 1e-3, 1.0);
    const double factor = load(film) * 1e-9 / 1e-3;
    const double error = factor / 0.421731 - 1.0;
    std::printf("square plate n=%2d factor %.6f error %+.2e order %.2f\n", cells, factor, error,
                order(last, error));
    if (last != 0.0) {
      EXPECT_NEAR(order(last, error), 2.0, 0.1);
    }
    last = error;
  }
  EXPECT_LT(std::abs(last), 1e-3);
}

TEST(StripSqueeze, SinksFromTwentyToFiveMicrometresInKnownTime) {
  // W' = mu (-dh/dt) L^3 / h^3 gives t = mu L^3 / (2 W') (1/h^2 - 1/h0^2) = 18.75 ms.
  const double target = 18.75e-3;
  double last = 0.0;
  for (int steps : {50, 100, 200}) {
    const int cells = 100;
    Reynolds film(strip(0.0, 10e-3, cells), strip_edges(), true);
    // Massless plate: at each implicit Euler step find the gap that carries the load.
    double h = 20e-6, time = 0.0;
    const double dt = target / steps;
    auto force = [&](double from, double to) {
      film.solve(smooth(Eigen::ArrayXd::Constant(cells, to)), Eigen::ArrayXd::Constant(cells, from),
                 {dt, 0.01, 0.0, 0.0, false});
      return load(film);
    };
    double reached = 0.0;
    while (reached == 0.0) {
      double low = 0.3 * h, high = h;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (force(h, middle) > 1e4 ? low : high) = middle;
      }
      // 1/h^2 grows linearly in time: interpolate the passage of 5 um in it.
      const double before = 1.0 / (h * h), after = 1.0 / (high * high), goal = 1.0 / 25e-12;
      if (after >= goal) reached = time + dt * (goal - before) / (after - before);
      h = high;
      time += dt;
    }
    const double error = reached / target - 1.0;
    std::printf("sinking strip steps=%3d time %.5f ms error %+.2e order %.2f\n", steps,
                reached * 1e3, error, order(last, error));
    if (last != 0.0) {
      EXPECT_NEAR(order(last, error), 1.0, 0.35);  // implicit Euler
    }
    last = error;
  }
  EXPECT_LT(std::abs(last), 2e-2);
}

}  // namespace
}  // namespace clatter::film
