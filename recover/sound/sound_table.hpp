// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sound of a part over frequency, in its reduced coordinates: what makes the sound of a run a
// matrix product.
//
//   P = 1/2 v^H R(f) v,   p_m = H_m(f) v,   v: complex reduced velocity, peak
//   F_lm = G_lm(f) q,     R = share Re( Q^H G^H G Q ),   q = Q v: flow of the acoustic skin's nodes
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/sound/space.hpp"
#include "recover/acoustic/flow_map.hpp"
#include "recover/sound/sound_options.hpp"

namespace clatter::recover {

/// What was measured of the boundary elements at one frequency [dB].
struct SampleChecks {
  double condition = 0.0, far_field_error = 0.0;
  // Of the power of a point source: from the far field, from the pressures on the surface.
  std::optional<double> monopole_error{}, surface_power_error{};
};

/// The sound at one frequency.
struct SoundSample {
  double frequency_hz = 0.0;
  Eigen::MatrixXd R;   // r x r, symmetric, positive semidefinite [N s/m for translations]
  Eigen::MatrixXcd H;  // n_m x r [Pa s/m for translations]
  /// G: (degree + 1)^2 x n_v [Pa s/m2], the far field in spherical harmonics (sound::FarHarmonics).
  Eigen::MatrixXcd far{};
  /// n_v x r, at the nodes of the acoustic skin, of which H is made; as written. Only while a file
  /// is made.
  Eigen::MatrixXcf pressure{};
  SampleChecks checks{};
};

/// Samples at ascending frequencies, and how to interpolate between them.
struct SoundTable {
  sound::Fluid fluid{};
  std::optional<sound::Plane> ground{};
  MeasurementSurface surface{};  // its microphones are the first of:
  std::vector<Microphone> microphones{};
  Eigen::VectorXd distance{};  // n_m [m], of the microphones from the middle of the acoustic skin
  FlowMap flow{};              // from the faces of the body to the nodes of the acoustic skin
  std::vector<SoundSample> samples{};

  sound::Space space() const { return {fluid, ground}; }
  double from_hz() const { return samples.front().frequency_hz; }
  double to_hz() const { return samples.back().frequency_hz; }
  int size() const { return static_cast<int>(samples.front().R.rows()); }
};

/// Whether a frequency is not above the table.
bool covers(const SoundTable& table, double frequency_hz);

/// Weights of the samples around a frequency: sum_i weight_i value(first + i).
struct Stencil {
  size_t first = 0;
  Eigen::VectorXd weight{};
};

/// The polynomial through the three samples on either side (Lagrange), fewer at the ends. Below the
/// first sample that sample alone.
/// @param frequency_hz ascending
Stencil stencil(const std::vector<double>& frequency_hz, double at_hz);

/// The stencil of a frequency, weights times (f / f_i)^2: what resistance_at() multiplies R with.
/// @throws InputError above the table
Stencil power_stencil(const SoundTable& table, double frequency_hz);

/// R, interpolated as R / f^2. @throws InputError above the table
Eigen::MatrixXd resistance_at(const SoundTable& table, double frequency_hz);

/// H, interpolated as H exp(i k distance) / f. @throws InputError above the table
Eigen::MatrixXcd microphones_at(const SoundTable& table, double frequency_hz);

/// Differences of an interpolated and a computed sample [dB].
struct SampleErrors {
  double resistance = 0.0;  // largest of the diagonal
  double microphone = 0.0;  // largest 20 lg(1 + |difference| / |row|)
};
SampleErrors interpolation_errors(const SoundTable& table, const SoundSample& computed);

}  // namespace clatter::recover
