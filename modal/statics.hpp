// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Static solution of load cases with reactions.
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "core/fe/fe_model.hpp"
#include "core/fe/stress.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::modal {

/// Solution of one load case.
struct StaticCase {
  std::string name;
  std::map<std::string, double> loads;  // factor of each
  Eigen::VectorXd displacement;         // 3 n_nodes [m]: row 3 a + d is node a, direction d
  Eigen::VectorXd rotation;             // 3 of each node of shells [rad]; or empty
  Eigen::VectorXd temperature_rise;     // n_nodes [K]; empty without loads of temperature
  Eigen::VectorXd points;               // 6 n_points: x y z [m], rx ry rz [rad] of each
  Eigen::VectorXd reactions;            // n_s [N, N m]: forces of the supports on the part
  Eigen::MatrixXd support_sums;  // supports x 6: their force [N] and moment about the origin [N m]
  Eigen::VectorXd applied;       // 6: force and moment about the origin of all loads
  double energy = 0.0;           // strain energy [J]
  double backward_error = 0.0;   // relative change of the entries of K and f that makes q exact
  double forward_error = 0.0;    // estimated error of q by rounding, over its largest entry
  double balance = 0.0;  // |applied + reactions| over the sum of force magnitudes; moments over
                         // half the part's diagonal
  double balance_rounding = 0.0;         // part explained by rounding, where it is above 1e-8
  std::vector<fe::RegionStress> stress;  // one per region, two of shells; none without cells
  std::vector<fe::GasketState> gaskets;  // of each gasket with a curve
  int steps = 0;                         // to find what is pressed; 0 without such gaskets
};

struct StaticSolution {
  std::vector<StaticCase> cases;
  sparse::FactorReport factor;
};

/// Solves K q + K_sq^T s = f for the loads and cases named in `wanted`, or for all (beside gaskets
/// with curves for the cases), with
///   u = T q + T_s s,   reactions = K_sq q + K_ss s - f_s,
/// and stresses from u (core/fe/stress.hpp). One factorisation serves all; with gaskets that have
/// curves each case takes some (gasket_statics.hpp). InputError for an unknown name, a model
/// without loads, and a part with free rigid-body motions (they are named); NumericsError when the
/// stiffness is singular otherwise, when the backward error exceeds 1e-12, the balance exceeds 1e-8
/// and the rounding level, or the estimated error of q exceeds 1.
StaticSolution solve_static(const fe::FeModel& model, const std::vector<std::string>& wanted);

/// Stresses at the nodes of one region and case.
struct NodeStress {
  std::string region;
  int32_t node = 0;
  fe::Voigt stress;        // xx yy zz xy yz zx [Pa]
  double von_mises = 0.0;  // [Pa]
};

/// The largest von Mises stress of a case with stresses.
NodeStress largest_stress(const StaticCase& solved);

/// The same as a line of text.
std::string describe_largest_stress(const fe::FeModel& model, const StaticCase& solved);

/// Nodes at locations: a node by its number ("17"), the node nearest to a position in metres
/// ("2,0,0.6"), or a sensor by its name. InputError for any other text and for a model without
/// cells.
std::vector<int32_t> nodes_at(const fe::FeModel& model, const std::vector<std::string>& locations);

/// The stresses at a node: one line per region.
std::vector<std::string> describe_stress(const fe::FeModel& model, const StaticCase& solved,
                                         int32_t node);

/// Writes the cases, nodes, surfaces, points and supports; provenance and timing are left to the
/// caller.
void write_static(H5File& file, const fe::FeModel& model, const StaticSolution& solution);

/// Summary lines for the user.
std::vector<std::string> describe(const fe::FeModel& model, const StaticSolution& solution);

}  // namespace clatter::modal
