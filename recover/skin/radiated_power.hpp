// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mean square normal velocity and equivalent radiated power (ERP) without expansion to the skin:
//
//   integral of v_n^2 dS = v_r^T W v_r,   W = sum over faces of integral (n^T T)^T (n^T T) dS
//
// W [m2], r x r, is computed once per panel; each line or instant then costs r^2.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"
#include "core/rom/skin_rows.hpp"
#include "recover/skin/panels.hpp"

namespace clatter::recover {

/// The surrounding fluid, and the radiation efficiency.
struct Air {
  double density = 1.204;      // [kg/m3], air at 20 degrees C and 101325 Pa
  double sound_speed = 343.2;  // [m/s]
  double loss_factor = 1.0;    // 1: every face radiates like a piston in an infinite baffle
};

/// A panel's quadratic form.
struct PanelForm {
  std::string name;
  double area = 0.0;  // [m2]
  Eigen::MatrixXd W;  // r x r, symmetric, both triangles filled [m2]
};

/// Computes the forms of all panels; a face in several panels is processed once. The rows of T are
/// read by groups of neighbouring faces; the faces of a group are distributed to the threads, each
/// with its own sum.
/// @param skin nodes and triangles; its T is not used
/// @param T rows of the skin, 3 n_s x r
std::vector<PanelForm> normal_velocity_forms(const rom::Skin& skin, const rom::SkinRows& T,
                                             const SkinGeometry& geometry,
                                             const std::vector<Panel>& panels);

/// v^H W v for each row of `v` (m x r): integral of |v_n|^2 dS [m4/s2].
Eigen::VectorXd normal_velocity_integral(const Eigen::MatrixXd& W, const Eigen::MatrixXcd& v);
/// The same for real rows, instants in time.
Eigen::VectorXd normal_velocity_integral(const Eigen::MatrixXd& W, const RowMatrix& v);

/// ERP = loss * rho c * S * <v_n^2> [W]; <v_n^2> is the mean square over time and surface [m2/s2].
inline double equivalent_radiated_power(const Air& air, double area, double mean_square) {
  return air.loss_factor * air.density * air.sound_speed * area * mean_square;
}

}  // namespace clatter::recover
