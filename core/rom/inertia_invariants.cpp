// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/inertia_invariants.hpp"

#include <fmt/format.h>

#include <string>

#include "core/base/error.hpp"

namespace clatter::rom {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char* kGroup = "inertia_invariants";

/// The blocks stored in a file: names and indices in `product`. The others are transposes.
struct Block {
  const char* name;
  size_t k, l;
};
constexpr Block kBlocks[] = {{"/product_xx", 0, 0}, {"/product_yy", 1, 1}, {"/product_zz", 2, 2},
                             {"/product_xy", 0, 1}, {"/product_yz", 1, 2}, {"/product_zx", 2, 0}};

Eigen::Matrix3d cross(const Eigen::Vector3d& w) {
  return Eigen::Matrix3d{{0.0, -w.z(), w.y()}, {w.z(), 0.0, -w.x()}, {-w.y(), w.x(), 0.0}};
}

Eigen::Matrix3d turning(const FrameMotion& motion) {
  const Eigen::Matrix3d A = cross(motion.omega);
  return cross(motion.omega_rate) + A * A;
}

/// sum_kl weight_kl product_kl.
MatrixXd sum_of(const std::array<MatrixXd, 9>& product, const Eigen::Matrix3d& weight) {
  MatrixXd sum = MatrixXd::Zero(product[0].rows(), product[0].cols());
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      if (weight(k, l) != 0.0) sum += weight(k, l) * product[3 * k + l];
  return sum;
}

MatrixXd read_sized(const H5File& file, const std::string& name, Eigen::Index rows,
                    Eigen::Index columns) {
  const MatrixXd matrix = file.read_matrix(name);
  if (matrix.rows() != rows || matrix.cols() != columns || !matrix.allFinite())
    throw InputError(fmt::format("{}: {}: found {} x {}{}, expected {} x {} finite values",
                                 file.path().string(), name, matrix.rows(), matrix.cols(),
                                 matrix.allFinite() ? "" : " with a value that is not finite", rows,
                                 columns));
  return matrix;
}

}  // namespace

VectorXd InertiaInvariants::load(const FrameMotion& motion) const {
  const Eigen::Matrix3d B = turning(motion);
  VectorXd sum = VectorXd::Zero(size());
  for (size_t k = 0; k < 3; ++k) {
    sum += motion.acceleration[static_cast<int>(k)] * first[k];
    for (size_t l = 0; l < 3; ++l)
      sum += B(static_cast<int>(k), static_cast<int>(l)) * moment[3 * l + k];
  }
  return -sum;
}

MatrixXd InertiaInvariants::gyroscopic(const Eigen::Vector3d& omega) const {
  return sum_of(product, 2.0 * cross(omega));
}

MatrixXd InertiaInvariants::softening(const FrameMotion& motion) const {
  return sum_of(product, turning(motion));
}

VectorXd InertiaInvariants::force(const FrameMotion& motion, const VectorXd& q,
                                  const VectorXd& v) const {
  return load(motion) - softening(motion) * q - gyroscopic(motion.omega) * v;
}

InertiaInvariants InertiaInvariants::in(const MatrixXd& W) const {
  InertiaInvariants out;
  if (empty()) return out;
  out.place = place;
  for (size_t k = 0; k < 3; ++k) out.first[k] = W.transpose() * first[k];
  for (size_t k = 0; k < 9; ++k) out.moment[k] = W.transpose() * moment[k];
  for (size_t k = 0; k < 9; ++k) out.product[k] = W.transpose() * (product[k] * W);
  return out;
}

void write_inertia_invariants(H5File& file, const InertiaInvariants& invariants) {
  if (invariants.empty()) return;
  const std::string at = kGroup;
  MatrixXd first(3, invariants.size()), moment(9, invariants.size());
  for (size_t k = 0; k < 3; ++k) first.row(static_cast<int>(k)) = invariants.first[k].transpose();
  for (size_t k = 0; k < 9; ++k) moment.row(static_cast<int>(k)) = invariants.moment[k].transpose();
  file.write(at + "/first", first);
  file.write(at + "/moment", moment);
  file.write(at + "/place", MatrixXd(invariants.place));
  for (const Block& block : kBlocks)
    file.write(at + block.name, invariants.product[3 * block.k + block.l]);
}

InertiaInvariants read_inertia_invariants(const H5File& file, const MatrixXd& M_rr) {
  InertiaInvariants out;
  if (!file.has(kGroup)) return out;
  const std::string at = kGroup;
  const Eigen::Index r = M_rr.rows();
  const MatrixXd first = read_sized(file, at + "/first", 3, r);
  const MatrixXd moment = read_sized(file, at + "/moment", 9, r);
  for (size_t k = 0; k < 3; ++k) out.first[k] = first.row(static_cast<int>(k));
  for (size_t k = 0; k < 9; ++k) out.moment[k] = moment.row(static_cast<int>(k));
  out.place = read_sized(file, at + "/place", 3, 3);
  for (const Block& block : kBlocks) {
    const MatrixXd product = read_sized(file, at + block.name, r, r);
    out.product[3 * block.k + block.l] = product;
    out.product[3 * block.l + block.k] = product.transpose();
  }
  const MatrixXd rest = out.product[0] + out.product[4] + out.product[8] - M_rr;
  const double error = rest.cwiseAbs().maxCoeff() / M_rr.cwiseAbs().maxCoeff();
  if (!(error <= 1e-9))
    throw InputError(
        fmt::format("{}: {}: product_xx + product_yy + product_zz differs from M_rr by "
                    "{:.1e} of its largest entry, expected at most 1e-9",
                    file.path().string(), at, error));
  return out;
}

}  // namespace clatter::rom
