// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/bearing/bearing_film.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "dynamics/bearing/dual.hpp"
#include "dynamics/element/element.hpp"

namespace clatter::dynamics {
namespace {

using Number = Dual<5>;

/// Eccentricity and its rate [1/s], spin [rad/s].
struct Orbit {
  Number x, y, vx, vy, spin;
};

struct Pull {
  Number x, y;
};

/// A film about a centred journal: the same in all directions.
Pull centred_pull(const Orbit& at, double damping) {
  return {-damping * (at.vx + 0.5 * at.spin * at.y), -damping * (at.vy - 0.5 * at.spin * at.x)};
}

/// x / sqrt(x^2 + s^2), a smooth sign.
Number smooth_sign(const Number& x) {
  return x / sqrt(x * x + BearingFilm::kSmoothing * BearingFilm::kSmoothing);
}

Pull butenschoen_pull(const Orbit& at, const ButenschoenMap& map) {
  const Number square = at.x * at.x + at.y * at.y;
  // The blend and its first two derivatives vanish with e.
  const double t = std::sqrt(square.value) / BearingFilm::kCentred;
  if (t < 1e-4) return centred_pull(at, map.centred());
  const Number e = sqrt(square), nx = at.x / e, ny = at.y / e;
  const Number rate = nx * at.vx + ny * at.vy, around = nx * at.vy - ny * at.vx;
  const Number speed = at.spin - 2.0 * around / e;
  const Number wedge = map.wedge(e) * speed, beta = map.angle(e);
  const Number radial =
      -wedge * smooth_sign(speed) * cos(beta) - map.squeeze(e * smooth_sign(rate)) * rate;
  const Number tangential = wedge * sin(beta);
  const Pull full{radial * nx - tangential * ny, radial * ny + tangential * nx};
  if (t >= 1.0) return full;
  const Number s = e / BearingFilm::kCentred;
  const Number share = s * s * s * (10.0 + s * (6.0 * s - 15.0));
  const Pull low = centred_pull(at, map.centred());
  return {low.x + share * (full.x - low.x), low.y + share * (full.y - low.y)};
}

Pull moes_pull(const Orbit& at, const MoesMap& map) {
  const Number nx = at.vx + 0.5 * at.spin * at.y, ny = at.vy - 0.5 * at.spin * at.x;
  // At rest there is no direction: the eccentricity along and across the velocity vanishes with it.
  const Number size = sqrt(nx * nx + ny * ny + BearingFilm::kSmoothing * BearingFilm::kSmoothing);
  const Number ux = nx / size, uy = ny / size;
  const auto W = map.impedance(ux * at.x + uy * at.y, ux * at.y - uy * at.x);
  const Number c = cos(W.turn), s = sin(W.turn);
  return {-W.size * (c * nx - s * ny), -W.size * (s * nx + c * ny)};
}

}  // namespace

BearingFilm::BearingFilm(const BearingSize& size, BearingModel model)
    : size_(size),
      model_(model),
      butenschoen_(size.width / size.diameter),
      moes_(size.width / size.diameter) {}

FilmForce BearingFilm::force(const JournalMotion& motion) const {
  const double c = size_.radial_clearance();
  const double found = eccentricity(motion);
  if (!(found < kLargest))
    throw StepRefused("the journal touches the bearing",
                      fmt::format("relative eccentricity {:.6g}", found));
  const auto variable = [](double value, int k) { return Number::variable(value, k); };
  const Orbit at{variable(motion.offset.x() / c, 0), variable(motion.offset.y() / c, 1),
                 variable(motion.velocity.x() / c, 2), variable(motion.velocity.y() / c, 3),
                 variable(motion.spin, 4)};
  const Pull pull =
      model_ == BearingModel::kMoes ? moes_pull(at, moes_) : butenschoen_pull(at, butenschoen_);
  const double scale =
      size_.width * size_.diameter * size_.viscosity / (size_.clearance * size_.clearance);
  const Number shear = 0.5 * std::numbers::pi * size_.clearance * size_.diameter * at.spin /
                       sqrt(1.0 - at.x * at.x - at.y * at.y);
  const Number moment = -shear - 0.5 * c * (at.x * pull.y - at.y * pull.x);
  FilmForce film;
  const Number* rows[] = {&pull.x, &pull.y, &moment};
  for (int k = 0; k < 3; ++k) {
    film.value(k) = scale * rows[k]->value;
    film.by_motion.row(k) = scale * rows[k]->by.transpose();
  }
  film.by_motion.leftCols<4>() /= c;
  return film;
}

}  // namespace clatter::dynamics
