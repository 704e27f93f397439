// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ring/ring_law.hpp"

#include <cmath>

namespace clatter::dynamics {
namespace {

constexpr double kFilm = 2.4474842;   // h_0 W' / (mu U R)
constexpr double kShear = 3.2914322;  // f / sqrt(S) of the full film
constexpr double kApart = 4.0;        // lambda from which no asperities touch
constexpr double kPower = 6.804;

}  // namespace

RingFriction ring_friction(const RingSpec& ring, double duty) {
  const double by_duty = kFilm * ring.face_radius / ring.roughness;  // of lambda
  const double rest = 1.0 - by_duty * duty / kApart;
  const double steep = rest > 0.0 ? std::pow(rest, kPower - 1.0) : 0.0;
  const double share = steep * rest, share_slope = -kPower / kApart * by_duty * steep;
  const double root = std::sqrt(duty), film = kShear * root;
  const double film_slope = duty > 0.0 ? 0.5 * kShear / root : 0.0;
  return {share * ring.boundary + (1.0 - share) * film,
          share_slope * (ring.boundary - film) + (1.0 - share) * film_slope};
}

RingShear ring_shear(const RingSpec& ring, double viscosity, double load, double speed,
                     double reversal) {
  const double r = std::hypot(speed, reversal), sign = speed / r;
  const double by_speed = viscosity / load;
  const RingFriction f = ring_friction(ring, by_speed * r);
  const double across = reversal / r;
  return {-load * f.value * sign,
          -load * (f.slope * by_speed * sign * sign + f.value * across * across / r)};
}

}  // namespace clatter::dynamics
