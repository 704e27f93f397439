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

inline constexpr const char* kStaticSchema = "clatter/static/1";

/// The answer to one load case.
struct StaticCase {
  std::string name;
  std::map<std::string, double> loads;  // factor of each
  Eigen::VectorXd displacement;         // 3 n_nodes [m]: row 3 a + d is node a, direction d
  Eigen::VectorXd points;               // 6 n_points: x y z [m], rx ry rz [rad] of each
  Eigen::VectorXd reactions;            // n_s [N, N m]: what the supports do to the part
  Eigen::MatrixXd support_sums;   // supports x 6: their force [N] and moment about the origin [N m]
  Eigen::VectorXd applied;        // 6: force and moment about the origin of all loads
  double energy = 0.0;            // strain energy [J]
  double backward_error = 0.0;    // relative change of the entries of K and f for which q is exact
  double forward_error = 0.0;     // estimated, of q over its largest entry, by rounding of entries
  double balance = 0.0;           // |applied + reactions| over the forces that cancel; moments over
                                  // half the part's diagonal
  double balance_rounding = 0.0;  // what rounding explains of it, where it is above 1e-8
  std::vector<fe::RegionStress> stress;  // a region each; none when the model has no cells
};

struct StaticSolution {
  std::vector<StaticCase> cases;
  sparse::FactorReport factor;
};

/// Solves K q + K_sq^T s = f for the loads and cases named in `wanted`, or for all, with
///   u = T q + T_s s,   reactions = K_sq q + K_ss s - f_s,
/// and stresses from u (core/fe/stress.hpp). One factorisation serves all. InputError for an
/// unknown name, a model without loads, and a part whose supports leave rigid motions free (they
/// are named); NumericsError when the stiffness is singular otherwise, when the backward error
/// exceeds 1e-12, the balance 1e-8 and what rounding explains, or the estimated error of q all of
/// it.
StaticSolution solve_static(const fe::FeModel& model, const std::vector<std::string>& wanted);

/// Stresses at the nodes of one region and case.
struct NodeStress {
  std::string region;
  int32_t node = 0;
  fe::Voigt stress;        // xx yy zz xy yz zx [Pa]
  double von_mises = 0.0;  // [Pa]
};

/// The largest von Mises stress of a case that has stresses.
NodeStress largest_stress(const fe::FeModel& model, const StaticCase& solved);

/// Says it in a line.
std::string describe_largest_stress(const fe::FeModel& model, const StaticCase& solved);

/// Nodes at places: a node by its number ("17"), the node nearest to a place in metres
/// ("2,0,0.6"), or a sensor by its name. InputError for a place that is none of these and for a
/// model without cells.
std::vector<int32_t> nodes_at(const fe::FeModel& model, const std::vector<std::string>& places);

/// The stresses at a node: a line for each region there.
std::vector<std::string> describe_stress(const fe::FeModel& model, const StaticCase& solved,
                                         int32_t node);

/// Writes the cases, nodes, surfaces, points and supports; provenance and timing are the caller's.
void write_static(H5File& file, const fe::FeModel& model, const StaticSolution& solution);

/// A few lines for the user.
std::vector<std::string> describe(const fe::FeModel& model, const StaticSolution& solution);

}  // namespace clatter::modal
