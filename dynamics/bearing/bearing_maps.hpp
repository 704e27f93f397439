// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reaction of the oil film of a plain journal bearing by closed formulas, without units.
#include <cmath>
#include <numbers>

namespace clatter::dynamics {

/// Butenschoen's fit to solutions of Reynolds' equation (Butenschoen 1976) for a width over
/// diameter of 1/6 to 1: Sommerfeld numbers So = F psi^2 / (b d eta w) of wedge and squeeze, and
/// the angle between the wedge's force and the line of centres. `T`: double or Dual.
class ButenschoenMap {
 public:
  /// @param x width over diameter.
  explicit ButenschoenMap(double x)
      : x_(x),
        a1_(1.1642 + x * (-1.9456 + x * (7.1161 + x * (-10.1073 + x * 5.0141)))),
        a2_(-1.000026 + x * (-0.023634 + x * (-0.4215 + x * (-0.038817 - x * 0.090551)))),
        angle_{1.152624 - 0.104565 * x, -2.5905 + 0.798745 * x, 8.73393 - 2.3291 * x,
               -13.3414 + 3.424337 * x, 6.6294 - 1.591732 * x},
        a8_(0.70038 + x * (3.2415 + x * (-12.2486 + x * (18.895 - x * 9.3561)))),
        a9_(-0.999935 + x * (0.0157434 + x * (-0.74224 + x * (0.42278 - x * 0.368928)))) {}

  /// So_D by the relative eccentricity 0 <= e < 1.
  template <class T>
  T wedge(const T& e) const {
    using std::sqrt;
    const double pi = std::numbers::pi;
    const T rest = 1.0 - e * e;
    return x_ * x_ * e * sqrt(pi * pi * rest + 16.0 * e * e) / (2.0 * rest * rest) * a1_ *
           (e - 1.0) / (a2_ + e);
  }
  /// So_V by the eccentricity with the sign of its rate, -1 < e < 1.
  template <class T>
  T squeeze(const T& e) const {
    using std::asin;
    using std::sqrt;
    const T rest = 1.0 - e * e, root = sqrt(rest);
    // pi/2 - acos(e)/2 = pi/4 + asin(e)/2.
    const T film = (0.25 * std::numbers::pi + 0.5 * asin(e)) * (1.0 + 2.0 * e * e) + 1.5 * e * root;
    return 4.0 * x_ * x_ / (rest * rest * root) * film * a8_ * (1.0 - e) / (-a9_ - e);
  }
  /// beta [rad], 0 < e < 1.
  template <class T>
  T angle(const T& e) const {
    using std::atan;
    using std::sqrt;
    const T fit = angle_[0] + e * (angle_[1] + e * (angle_[2] + e * (angle_[3] + e * angle_[4])));
    return atan(std::numbers::pi * sqrt(1.0 - e * e) / (2.0 * e)) * fit;
  }
  /// Damping of the centred journal in all directions: the mean of what squeeze and wedge give as
  /// e -> 0, where So_D = e wedge_slope.
  double centred() const {
    const double slope = x_ * x_ * std::numbers::pi / 2.0 * a1_ / -a2_;
    return 0.5 * (squeeze(0.0) + 2.0 * slope);
  }

 private:
  double x_, a1_, a2_, angle_[5], a8_, a9_;
};

/// Moes' impedance of a cavitating film of finite width (Childs, Moes and van Leeuwen 1977): the
/// force - |n| W by the velocity n = e' - w/2 J e of pure squeeze. W is a fit too: within 8 % of
/// Ocvirk's short bearing.
class MoesMap {
 public:
  /// @param x width over diameter.
  explicit MoesMap(double x) : per_width_(1.0 / (x * x)) {}

  /// Impedance W and its direction, turned by `turn` from that of the velocity.
  template <class T>
  struct Impedance {
    T size, turn;
  };
  /// @param along, across: eccentricity along the velocity, and normal to it (to its left).
  template <class T>
  Impedance<T> impedance(const T& along, const T& across) const {
    using std::asin;
    using std::atan;
    using std::cos;
    using std::sin;
    using std::sqrt;
    // The original measures angles from the eccentricity: the velocity is at alpha with
    // e cos(alpha) = along, e sin(alpha) = -across, and the impedance at gamma = alpha + turn.
    const T eta = -across, root = sqrt(1.0 - eta * eta);
    const T b = (1.0 - along * along - across * across) * per_width_;
    const T lean = atan(3.0 * (1.0 + 3.6 * b) * eta / (4.0 * (1.0 + 2.12 * b) * root));
    const T turn = (1.0 - along / root) * (asin(eta) - lean) - asin(eta);
    // The eccentricity along and across the impedance.
    const T c = cos(turn), s = sin(turn), xi = along * c + across * s, nu = along * s - across * c;
    const T left = 1.0 - xi, q = left * per_width_;
    const T E = 1.0 + 2.12 * q, G = 3.0 * nu * (1.0 + 3.6 * q) / (4.0 * left);
    return {1.0 / (0.15 * sqrt(E * E + G * G) * left * sqrt(left)), turn};
  }

 private:
  double per_width_;
};

}  // namespace clatter::dynamics
