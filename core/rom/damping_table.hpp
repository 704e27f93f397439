// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Modal damping as a table over frequency.
#include <Eigen/Core>
#include <string>

#include "core/base/h5_file.hpp"

namespace clatter::rom {

/// Damping ratio against undamped frequency: linear between the rows, constant outside.
/// With eigenmodes Phi of (K_rr, M_rr), Phi^T M_rr Phi = I, it represents the damping matrix
///   D = M_rr Phi diag(2 zeta(f_k) omega_k) Phi^T M_rr,   omega_k = 2 pi f_k,
/// which is never formed. Rigid-body modes are not damped.
struct DampingTable {
  Eigen::VectorXd hz;     // rows [Hz], positive, ascending; empty: no modal damping
  Eigen::VectorXd ratio;  // rows, of critical damping, 0 <= zeta < 1

  bool empty() const { return hz.size() == 0; }
  /// zeta of a mode of this frequency [Hz]; 0 when empty.
  double at(double frequency_hz) const;
  /// 2 zeta omega [1/s] of modes with these omega^2 [1/s2]; 0 where omega^2 is not positive.
  Eigen::VectorXd rates(const Eigen::VectorXd& omega_squared) const;
  /// Error in the rows, "found ..., expected ..."; empty when valid.
  std::string fault() const;
};

/// Group `modal_damping`: hz, ratio. Nothing is written when empty.
void write_damping_table(H5File& file, const DampingTable& table);
/// Empty when the file has none; InputError for invalid rows.
DampingTable read_damping_table(const H5File& file);

}  // namespace clatter::rom
