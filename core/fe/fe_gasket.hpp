// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Gaskets whose pressure follows a curve, and the state in which a static solution leaves them.
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/base/sparse.hpp"

namespace clatter::fe {

/// Of files of static results.
inline constexpr const char* kStaticSchema = "clatter/static/1";

/// Pressure over closure, linear between points: 0 below the first one, where the gasket is open;
/// beyond the last one with the last slope.
struct GasketCurve {
  std::vector<double> closure;   // ascending [m]
  std::vector<double> pressure;  // not descending, from 0 on [Pa]

  /// The line on which a closure lies: 0 open, k between points k - 1 and k.
  int line(double at) const;
  double slope(int of_line) const;                   // [N/m3]
  double pressure_on(int of_line, double at) const;  // of the line, extended [Pa]
  double pressure_at(double at) const { return pressure_on(line(at), at); }
  double energy(double at) const;  // integral of the pressure [J/m2]
};

/// A gasket with a curve, at the integration points of its slave faces. K of the model has the
/// constant `stiffness` in its place.
struct FeGasket {
  std::string name;
  GasketCurve curve{};
  double stiffness = 0.0;    // normal, in K [N/m3]
  RowMatrix points{};        // m x 3 [m]
  Eigen::VectorXd area{};    // m, of each point [m2]
  SparseMatrix closing{};    // m x n: closure = closing q + closing_s s [m]
  SparseMatrix closing_s{};  // m x n_s
};

/// A gasket in a static solution.
struct GasketState {
  Eigen::VectorXd closure;   // at each point [m]
  Eigen::VectorXd pressure;  // [Pa]
};

/// Groups gaskets/<name>; none without gaskets.
void write_gaskets(H5File& file, const std::vector<FeGasket>& gaskets);
/// InputError for wrong shapes and values. @param n, n_s of the model.
std::vector<FeGasket> read_gaskets(const H5File& file, Eigen::Index n, Eigen::Index n_s);

/// In a file of static results: points and areas, gaskets/<name>/{points,area}.
void write_gasket_points(H5File& file, const std::vector<FeGasket>& gaskets);
/// cases/<case>/gaskets/<name>/{closure,pressure}.
void write_gasket_state(H5File& file, const std::string& of_case, const std::string& gasket,
                        const GasketState& state);

/// The points of a gasket that are pressed in a case of a file of static results.
struct PressedPoints {
  RowMatrix points;          // m x 3 [m]
  Eigen::VectorXd pressure;  // m [Pa]
};
/// @param of_case the only case of the file if empty. InputError for a file, a case or a gasket
/// that does not exist, naming those that do.
PressedPoints read_pressed(const std::filesystem::path& file, std::string of_case,
                           const std::string& gasket);

}  // namespace clatter::fe
