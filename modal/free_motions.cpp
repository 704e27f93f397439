#include "modal/free_motions.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace clatter::modal {

double characteristic_length(const assembly::FeModel& model) {
  const Eigen::RowVector3d span =
      model.nodes.colwise().maxCoeff() - model.nodes.colwise().minCoeff();
  return std::max(0.5 * span.norm(), 1e-12);
}

std::string motion_name(const Eigen::VectorXd& motion, double length) {
  const Eigen::Vector3d shift = motion.head(3), turn = motion.tail(3);
  const bool turns = turn.norm() * length > 1e-3 * shift.norm();
  Eigen::Index axis = 0;
  (turns ? turn : shift).cwiseAbs().maxCoeff(&axis);
  return fmt::format("{} {}", turns ? "rotation about" : "displacement along", "xyz"[axis]);
}

Eigen::MatrixXd free_motions(const assembly::FeModel& model) {
  // An M-orthonormal basis of the motions first: a row of points has no rotation about itself.
  const Eigen::MatrixXd mass = model.rigid.transpose() * multiply_symmetric(model.M, model.rigid);
  const Eigen::VectorXd scale =
      mass.diagonal().unaryExpr([](double m) { return m > 0.0 ? 1.0 / std::sqrt(m) : 0.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(scale.asDiagonal() * mass *
                                                            scale.asDiagonal());
  const Eigen::Index moving = (gram.eigenvalues().array() > 1e-12).count();
  const Eigen::MatrixXd unit =
      scale.asDiagonal() * gram.eigenvectors().rightCols(moving) *
      gram.eigenvalues().tail(moving).cwiseSqrt().cwiseInverse().asDiagonal();

  const Eigen::MatrixXd motion = model.rigid * unit;
  const Eigen::MatrixXd energy = motion.transpose() * multiply_symmetric(model.K, motion);
  // Rounding leaves about 1e-15 of the energy that the DoFs would have each by itself.
  const Eigen::VectorXd alone = motion.cwiseAbs2().transpose() * model.K.diagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eig(0.5 * (energy + energy.transpose()));
  const Eigen::Index count = (eig.eigenvalues().array() < 1e-10 * alone.maxCoeff()).count();
  return unit * eig.eigenvectors().leftCols(count);
}

}  // namespace clatter::modal
