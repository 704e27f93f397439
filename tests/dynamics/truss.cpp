// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/truss.hpp"

#include <Eigen/Geometry>

namespace clatter::dynamics::testing {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

MatrixXd Truss::stiffness_matrix() const {
  MatrixXd K = MatrixXd::Zero(size(), size());
  for (const auto& [a, b] : spring) {
    const Vector3d n = (node[a] - node[b]).normalized();
    const Eigen::Matrix3d k = stiffness * n * n.transpose();
    K.block<3, 3>(3 * a, 3 * a) += k;
    K.block<3, 3>(3 * b, 3 * b) += k;
    K.block<3, 3>(3 * a, 3 * b) -= k;
    K.block<3, 3>(3 * b, 3 * a) -= k;
  }
  return K;
}

rom::InertiaInvariants Truss::invariants() const {
  rom::InertiaInvariants sums;
  sums.first.fill(VectorXd::Zero(size()));
  sums.moment.fill(VectorXd::Zero(size()));
  sums.product.fill(MatrixXd::Zero(size(), size()));
  for (size_t i = 0; i < node.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    sums.place += mass[i] * node[i] * node[i].transpose();
    for (int k = 0; k < 3; ++k) {
      sums.first[k](at + k) = mass[i];
      for (int l = 0; l < 3; ++l) {
        sums.moment[3 * l + k](at + k) = mass[i] * node[i](l);
        sums.product[3 * k + l](at + k, at + l) = mass[i];
      }
    }
  }
  return sums;
}

rom::ReducedModel Truss::model() const {
  rom::ReducedModel model;
  model.name = "truss";
  model.n_boundary = size();
  model.K_rr = stiffness_matrix();
  model.M_rr = MatrixXd::Zero(size(), size());
  model.rigid = MatrixXd::Zero(size(), 6);
  for (size_t i = 0; i < node.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    model.M_rr.block<3, 3>(at, at).diagonal().setConstant(mass[i]);
    model.mass.mass += mass[i];
    for (int k = 0; k < 3; ++k) {
      model.rigid(at + k, k) = 1.0;
      model.rigid.block<3, 1>(at, 3 + k) = Vector3d::Unit(k).cross(node[i]);
    }
  }
  model.inertia = invariants();
  return model;
}

Truss octahedron(double stiffness) {
  Truss one;
  one.stiffness = stiffness;
  for (int k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0}) {
      one.node.push_back((0.2 + 0.02 * k + 0.01 * sign) * sign * Vector3d::Unit(k));
      one.mass.push_back(1.0 + 0.15 * k + 0.1 * sign);
    }
  for (int a = 0; a < 6; ++a)
    for (int b = a + 1; b < 6; ++b)
      if (a / 2 != b / 2) one.spring.push_back({a, b});
  return one;
}

}  // namespace clatter::dynamics::testing
