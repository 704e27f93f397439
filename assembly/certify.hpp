#pragma once
// Proves an assembled model before it is written.
#include <Eigen/Core>
#include <map>
#include <string>

#include "assembly/elimination.hpp"
#include "assembly/fe_model.hpp"

namespace clatter::assembly {

/// Checks M, K, T and `rigid` of `model` against each other and against the integrals over the
/// elements (model.mass); returns the numbers. `nodal_rigid` (3 n_nodes x 6) are unit rigid
/// motions with supported displacements at zero. NumericsError when mass, centre or inertia are
/// off by more than 1e-9 (hard case B5), or when rigid motions are not free of force or not
/// recovered to 1e-9.
std::map<std::string, double> certify(const FeModel& model, const Eigen::MatrixXd& nodal_rigid,
                                      const Elimination& elimination, int n_fixed);

}  // namespace clatter::assembly
