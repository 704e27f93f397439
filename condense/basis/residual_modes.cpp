// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/residual_modes.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/fe/part_errors.hpp"
#include "core/sparse/dense_product.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows i of A (u_i; u_b).
MatrixXd interior_rows(const sparse::SymmetricOperator& A_ii, const SparseMatrix& A_ib,
                       const MatrixXd& u_i, const MatrixXd& u_b) {
  MatrixXd out = A_ii * u_i;
  out += A_ib * u_b;
  return out;
}

/// Elastic Ritz pairs below a limit.
struct Ritz {
  VectorXd values;
  MatrixXd vectors;  // r x p, unit modal mass
};

/// @param motions n_b x m: the first rows of the free rigid motions, whose others are zero.
Ritz elastic_modes(const MatrixXd& K_rr, const MatrixXd& M_rr, const MatrixXd& motions,
                   double limit) {
  MatrixXd rigid = MatrixXd::Zero(K_rr.rows(), motions.cols());
  rigid.topRows(motions.rows()) = motions;
  const sparse::EigenResult all = sparse::solve_dense(K_rr, M_rr, rigid, std::nullopt);
  if (!all.ok()) throw NumericsError("reduced model: " + all.message);
  const Index kept = (all.values.array() < limit).count();
  return {all.values.head(kept), all.vectors.leftCols(kept)};
}

/// The passes; X holds the added vectors, with the boundary held.
class Correction {
 public:
  Correction(Reduction& reduction, const sparse::Factor& factor, const PartitionedModel& part,
             const MatrixXd& motions)
      : reduction_(reduction),
        factor_(factor),
        part_(part),
        K_(part.K),
        M_(part.M),
        motions_(motions),
        team_(part.team()),
        K_ii_(part.interior().stiffness({})),
        M_ii_(part.interior().mass({})) {
    X_.resize(K_.ib.rows(), 0);
    border();
  }

  /// Estimates the errors, keeps the corrections for `improve`.
  VectorXd estimate(double limit);
  void improve(const std::vector<Index>& chosen);
  void append(ResidualReport& report);
  Index modes() const { return ritz_.values.size(); }
  /// What the last estimate says of the modes and of reduced parts.
  void report_modes(ResidualReport& report) const;

 private:
  /// K_rr and M_rr with the rows and columns of X added.
  void border();
  MatrixXd bordered(const MatrixXd& A_rr, const PartitionedMatrix& A,
                    const sparse::SymmetricOperator& A_ii) const;

  Reduction& reduction_;
  const sparse::Factor& factor_;
  const PartitionedModel& part_;
  const PartitionedMatrix& K_;
  const PartitionedMatrix& M_;
  const MatrixXd& motions_;
  const sparse::RowTeam& team_;
  std::shared_ptr<const sparse::SymmetricOperator> K_ii_, M_ii_;
  MatrixXd X_;              // n_i x m
  MatrixXd K_rr_, M_rr_;    // bordered
  VectorXd pseudo_values_;  // of X
  Ritz ritz_;
  MatrixXd delta_;     // n_i x p
  MatrixXd of_parts_;  // p x parts
};

void Correction::report_modes(ResidualReport& report) const {
  report.modes = static_cast<int>(modes());
  report.modes_hz = ritz_.values.unaryExpr(&sparse::hz_of_value);
  report.of_parts = of_parts_;
}

MatrixXd Correction::bordered(const MatrixXd& A_rr, const PartitionedMatrix& A,
                              const sparse::SymmetricOperator& A_ii) const {
  const Index r = A_rr.rows(), m = X_.cols();
  MatrixXd out(r + m, r + m);
  out.topLeftCorner(r, r) = A_rr;
  if (m == 0) return out;
  const MatrixXd image = A_ii * X_;
  const MatrixXd image_b = team_.sum(A.ib.transpose() * X_);
  out.topRightCorner(r, m) = reduction_.basis.project(image, image_b);
  out.bottomLeftCorner(m, r) = out.topRightCorner(r, m).transpose();
  const MatrixXd corner = team_.sum(sparse::transposed_product(X_, image));
  out.bottomRightCorner(m, m) = 0.5 * (corner + corner.transpose());
  return out;
}

void Correction::border() {
  K_rr_ = bordered(reduction_.K_rr, K_, *K_ii_);
  M_rr_ = bordered(reduction_.M_rr, M_, *M_ii_);
}

VectorXd Correction::estimate(double limit) {
  ritz_ = elastic_modes(K_rr_, M_rr_, motions_, limit);
  const ReducedBasis& basis = reduction_.basis;
  const Index r = basis.size(), p = modes();
  MatrixXd u_i = basis.interior(ritz_.vectors.topRows(r));
  sparse::add_product(1.0, X_, ritz_.vectors.bottomRows(X_.cols()), u_i);
  const MatrixXd u_b = ritz_.vectors.topRows(basis.boundary());
  const MatrixXd force = interior_rows(*M_ii_, M_.ib, u_i, u_b) * ritz_.values.asDiagonal() -
                         interior_rows(*K_ii_, K_.ib, u_i, u_b);
  delta_ = factor_.solve(force);
  if (part_.interior().local() != nullptr && !part_.full.parts.list.empty()) {
    MatrixXd u(part_.full.size(), p);
    u(part_.dofs.interior, Eigen::all) = u_i;
    u(part_.dofs.boundary, Eigen::all) = u_b;
    of_parts_ = fe::part_errors(part_.full.parts, ritz_.values, u);
  }
  VectorXd error(p);
  for (Index j = 0; j < p; ++j) error[j] = force.col(j).dot(delta_.col(j));
  team_.sum(error.data(), p);
  for (Index j = 0; j < p; ++j) error[j] = 0.5 * error[j] / ritz_.values[j];
  return error;
}

void Correction::improve(const std::vector<Index>& chosen) {
  MatrixXd vectors = delta_(Eigen::all, chosen);
  if (X_.cols() > 0) {
    const MatrixXd parts = ritz_.vectors.bottomRows(X_.cols())(Eigen::all, chosen);
    sparse::add_product(1.0, X_, parts, vectors);
  }
  // K-orthonormal first, since norms differ by many powers of ten; then M-orthonormal with K
  // diagonal, as fixed-interface modes are.
  MatrixXd gram = team_.sum(sparse::transposed_product(vectors, *K_ii_ * vectors));
  const VectorXd unit = gram.diagonal().cwiseSqrt().cwiseInverse();
  const dense::Eigenpairs eig =
      dense::symmetric_eigen(unit.asDiagonal() * gram * unit.asDiagonal());
  const Index rank = (eig.values.array() > 1e-10).count();
  const MatrixXd to_unit = unit.asDiagonal() * eig.vectors.rightCols(rank) *
                           eig.values.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
  MatrixXd basis = MatrixXd::Zero(vectors.rows(), rank);
  sparse::add_product(1.0, vectors, to_unit, basis);
  const dense::Eigenpairs nu =
      dense::symmetric_eigen(team_.sum(sparse::transposed_product(basis, *M_ii_ * basis)));
  const MatrixXd to_modes =
      (nu.vectors * nu.values.cwiseSqrt().cwiseInverse().asDiagonal()).rowwise().reverse();
  X_ = MatrixXd::Zero(vectors.rows(), rank);
  sparse::add_product(1.0, basis, to_modes, X_);
  pseudo_values_ = nu.values.cwiseInverse().reverse();
  border();
}

void Correction::append(ResidualReport& report) {
  const Index m = X_.cols();
  if (m == 0) return;
  report.hz = pseudo_values_.unaryExpr(&sparse::hz_of_value);
  ReducedBasis& basis = reduction_.basis;
  const Index k = basis.shapes.cols();
  basis.shapes.conservativeResize(Eigen::NoChange, k + m);
  basis.shapes.rightCols(m) = X_;
  reduction_.K_rr = K_rr_;
  reduction_.M_rr = M_rr_;
}

}  // namespace

ResidualReport add_residual_modes(Reduction& reduction, const sparse::Factor& factor_ii,
                                  const PartitionedModel& part, const MatrixXd& motions,
                                  double limit_hz, double target) {
  constexpr int kPasses = 4;
  Correction correction(reduction, factor_ii, part, motions);
  ResidualReport report;
  report.estimated = true;
  std::vector<char> corrected;  // by index in the ascending list, which passes hardly reorder
  for (int pass = 0; pass <= kPasses; ++pass) {
    const VectorXd error = correction.estimate(sparse::value_of_hz(limit_hz));
    correction.report_modes(report);
    report.error_estimate = error.size() > 0 ? error.maxCoeff() : 0.0;
    if (pass == 0) report.error_before = report.error_estimate;
    if (target <= 0.0 || report.error_estimate <= target || pass == kPasses) break;
    corrected.resize(error.size(), 0);
    std::vector<Index> chosen;
    for (Index j = 0; j < error.size(); ++j) {
      char& once = corrected[j];
      if (error[j] > 0.01 * target) once = 1;
      if (once != 0) chosen.push_back(j);
    }
    correction.improve(chosen);
  }
  correction.append(report);
  return report;
}

}  // namespace clatter::condense
