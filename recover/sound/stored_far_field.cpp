// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/stored_far_field.hpp"

#include <cmath>

#include "core/sound/complex_lu.hpp"
#include "core/sound/far_harmonics.hpp"
#include "core/sound/spherical_harmonics.hpp"

namespace clatter::recover {
namespace {

Eigen::MatrixXcd coordinate_fields(const Eigen::MatrixXcd& far, const RowMatrix& flow) {
  return sound::rows_product(far.transpose(), flow.cast<sound::Complex>());
}

}  // namespace

Eigen::MatrixXcd stored_far_field(const Eigen::MatrixXcd& of_flow, const RowMatrix& flow) {
  constexpr double kDropped = 1e-6;
  const Eigen::MatrixXd squares = coordinate_fields(of_flow, flow).cwiseAbs2();
  const Eigen::RowVectorXd most = kDropped * squares.colwise().sum();
  auto degree = static_cast<int>(std::lround(std::sqrt(static_cast<double>(squares.rows())))) - 1;
  Eigen::RowVectorXd dropped = Eigen::RowVectorXd::Zero(squares.cols());
  for (; degree > 0; --degree) {
    const Eigen::Index below = sound::harmonic_count(degree - 1);
    dropped += squares.middleRows(below, 2 * degree + 1).colwise().sum();
    if ((dropped.array() > most.array()).any()) break;
  }
  // In two steps: as one expression g++ 12 leaves the last row of each column as it was.
  const Eigen::MatrixXcf single =
      of_flow.topRows(sound::harmonic_count(degree)).cast<std::complex<float>>();
  return single.cast<sound::Complex>();
}

Eigen::MatrixXd far_field_resistance(const sound::Space& space, const Eigen::MatrixXcd& far,
                                     const RowMatrix& flow) {
  const Eigen::MatrixXcd F = coordinate_fields(far, flow);
  const Eigen::MatrixXd real = F.real(), imag = F.imag();
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(F.cols(), F.cols());
  R.selfadjointView<Eigen::Lower>().rankUpdate(real.transpose());
  R.selfadjointView<Eigen::Lower>().rankUpdate(imag.transpose());
  R *= sound::power_of_far_field(space);
  return R.selfadjointView<Eigen::Lower>();
}

}  // namespace clatter::recover
