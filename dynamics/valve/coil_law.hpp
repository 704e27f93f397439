// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A coil spring as masses between springs whose coils may touch.
#include <vector>

namespace clatter::dynamics {

/// Round wire wound to a cylinder.
struct SpringWire {
  double wire = 3.4e-3;           // its diameter d [m]
  double diameter = 21.5e-3;      // of the coils D, mean [m]
  double turns = 6.0;             // that are active, n
  double shear_modulus = 79.3e9;  // G [Pa]
  double density = 7850.0;        // rho [kg/m3]

  double stiffness() const;  // G d^4 / (8 D^3 n) [N/m]
  double mass() const;       // pi^2 d^2 D n rho / 4 [kg]
};

/// A spring as n masses in its length.
struct CoilSpringSpec {
  double stiffness = SpringWire{}.stiffness();  // [N/m]
  double mass = SpringWire{}.mass();            // [kg]
  int masses = 8;                               // n
  double force = 150.0;                         // at the installed length [N]
  double to_solid = 8.7e-3;                     // from there until all coils touch [m]
  double damping = 0.01;                        // of the first surge mode, over critical
  double clash_stiffness = 1e8;                 // of coils that touch [N/m]
  double clash_damping = 0.1;                   // of two masses that meet, over critical

  /// First surge frequency of the continuous spring with both ends held, sqrt(k/m)/2 [Hz].
  double surge() const;
};

/// Force in a part of the spring, a push counts positive, and its derivatives.
struct CoilForce {
  double force = 0.0, by_length = 0.0, by_rate = 0.0;  // [N], [N/m], [N s/m]
  double stored = 0.0, lost = 0.0;                     // [J], [W]
};

/// The length of the spring between two neighbouring masses, or between an end and the mass next to
/// it. With the change e of its length from the installed one,
///
///   p = F_0 - k e - c e' + <k_c d + c_c S(d/d_0) d'>,     d = -e - gap > 0 where coils touch
///
/// A contact never pulls, and what is at an end only pushes. S is a smooth step over d_0, so that
/// the force is continuous where coils meet.
class CoilLaw {
 public:
  static constexpr double kDampedDepth = 1e-7;  // d_0 [m]
  /// @param share of the spring's length. @param is_end next to an end of the spring.
  CoilLaw(const CoilSpringSpec& spec, double share, bool is_end);
  /// @param change e [m]. @param rate e' [m/s].
  CoilForce at(double change, double rate) const;
  double gap() const { return gap_; }              // at the installed length [m]
  double stiffness() const { return stiffness_; }  // k [N/m]

 private:
  bool is_end_;
  double force_, stiffness_, damping_, gap_, clash_stiffness_, clash_damping_;
};

/// The n + 1 parts of a spring of n masses m/n: half of a mass's length at each end, 1/n between
/// masses. Held at both ends its first frequency is (2n/pi) sin(pi/2n) of the continuous spring's,
/// its static stiffness k, and its mass m is all between the ends.
std::vector<CoilLaw> coil_laws(const CoilSpringSpec& spec);

}  // namespace clatter::dynamics
