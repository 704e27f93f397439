// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/periodic_response.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

// Third-party code with narrowing conversions.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wextra"
#include <unsupported/Eigen/FFT>
#pragma GCC diagnostic pop

namespace clatter::dynamics {
namespace {

using Spectrum = std::vector<std::complex<double>>;

/// sin(pi x) / (pi x): what the mean over x periods leaves of an oscillation.
double mean_factor(double x) {
  return x == 0.0 ? 1.0 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x);
}

class Oscillators {
 public:
  Oscillators(const RowMatrix& force, double step)
      : force_(force), n_(static_cast<size_t>(force.rows() - 1)), step_(step) {
    for (RowMatrix* part : {&motion_.eta, &motion_.v, &motion_.a})
      part->setZero(force.rows(), force.cols());
  }

  void solve(Eigen::Index mode, double omega_squared, double damping) {
    std::vector<double> sampled(n_);
    for (size_t i = 0; i < n_; ++i) sampled[i] = force_(static_cast<Eigen::Index>(i), mode);
    sampled[0] = 0.5 * (sampled[0] + force_(static_cast<Eigen::Index>(n_), mode));
    Spectrum force, eta(n_), v(n_), a(n_);
    fft_.fwd(force, sampled);
    if (omega_squared > 0.0) eta[0] = force[0] / omega_squared;
    for (size_t k = 1; 2 * k < n_; ++k) {
      const double w =
          2.0 * std::numbers::pi * static_cast<double>(k) / (step_ * static_cast<double>(n_));
      const double mean = mean_factor(static_cast<double>(k) / static_cast<double>(n_));
      const std::complex<double> i(0.0, 1.0);
      eta[k] = force[k] / mean / (omega_squared - w * w + i * w * damping);
      v[k] = i * w * eta[k];
      a[k] = -w * w * mean * eta[k];
      for (Spectrum* part : {&eta, &v, &a}) (*part)[n_ - k] = std::conj((*part)[k]);
    }
    write(eta, mode, motion_.eta);
    write(v, mode, motion_.v);
    write(a, mode, motion_.a);
  }

  PeriodicMotion motion() { return std::move(motion_); }

 private:
  void write(const Spectrum& spectrum, Eigen::Index mode, RowMatrix& out) {
    std::vector<double> values;
    fft_.inv(values, spectrum);
    for (size_t i = 0; i < n_; ++i) out(static_cast<Eigen::Index>(i), mode) = values[i];
    out(static_cast<Eigen::Index>(n_), mode) = values[0];
  }

  const RowMatrix& force_;
  size_t n_;
  double step_;
  Eigen::FFT<double> fft_;
  PeriodicMotion motion_;
};

}  // namespace

PeriodicMotion periodic_response(const RowMatrix& force, double step,
                                 const Eigen::VectorXd& omega_squared,
                                 const Eigen::VectorXd& damping) {
  Oscillators oscillators(force, step);
  for (Eigen::Index k = 0; k < force.cols(); ++k)
    oscillators.solve(k, omega_squared(k), damping(k));
  return oscillators.motion();
}

}  // namespace clatter::dynamics
