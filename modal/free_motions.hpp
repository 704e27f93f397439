#pragma once
// The rigid motions that a model's supports leave free.
#include <Eigen/Core>
#include <string>

#include "assembly/fe_model.hpp"

namespace clatter::modal {

/// The rigid motions that cost no energy in K, as combinations of the six unit motions: 6 x m, with
/// m = 6 for a free body and 0 for one on its own supports.
Eigen::MatrixXd free_motions(const assembly::FeModel& model);

/// Half the diagonal of the part's box [m]: distances of rotations are measured at this size.
double characteristic_length(const assembly::FeModel& model);

/// "rotation about z" or "displacement along x": what a motion (6) mostly is. Rotations about a far
/// point look like displacements, so any turn at all is called a rotation.
std::string motion_name(const Eigen::VectorXd& motion, double length);

}  // namespace clatter::modal
