// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Film pressure beyond what oil and metal bear.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/law/history.hpp"
#include "dynamics/run/model.hpp"

namespace clatter::dynamics {

/// Film pressure above which neither oil nor skirt behave as modelled [Pa]. Aluminium alloys of
/// pistons yield at about 0.2 GPa and less when hot; a smooth contact first yields at a pressure of
/// 1.1 (mean, sphere) to 1.67 times that (largest, cylinder; Johnson 1985). Long before, constant
/// viscosity is wrong: with 2e-8 1/Pa, usual for mineral oils, it is 400 times higher at 0.3 GPa.
inline constexpr double kLargestFilmPressure = 3e8;

/// Looks for the largest film pressure over the accepted states of a run.
class FilmPressureWatch {
 public:
  /// `scalars`: what model.record() reports of the state at `time` [s].
  void look(const Model& model, const History& scalars, double time);
  /// For each contact one warning with time, position, side force and remedy when its largest
  /// pressure is above kLargestFilmPressure.
  std::vector<std::string> warnings() const;

 private:
  struct Watched {
    std::string name;  // of the cylinder
    const film::PistonLiner* contact;
    size_t pressure, force;  // film_pressure_max, side_force among the scalars
    double largest = kLargestFilmPressure;
    std::string warning = {};
  };
  std::optional<std::vector<Watched>> watched_;  // after the first look
};

}  // namespace clatter::dynamics
