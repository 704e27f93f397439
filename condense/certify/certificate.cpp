// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/certify/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"
#include "core/dense/solve.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/rom/rigid_mass.hpp"
#include "core/sparse/eigen/dense_solver.hpp"

namespace clatter::condense {
namespace {

/// Above which a number of the certificate is refused (hard cases B4 and B5).
double limit_of(const char* name) { return judgement_of<rom::ReducedCertificate>(name).refused; }

/// R^T M R of the full model for rigid motions about `point`.
Eigen::MatrixXd rigid_mass(const PartitionedModel& part, const Eigen::Vector3d& point) {
  const Eigen::MatrixXd rigid = rom::rigid_about(part.rows_of_whole(part.full.rigid), point);
  return part.team().sum(rigid.transpose() * part.whole().mass_times(rigid));
}

double scaled_condition(const Eigen::MatrixXd& M_rr) {
  const Eigen::VectorXd scale = M_rr.diagonal().cwiseSqrt().cwiseInverse();
  const dense::Eigenpairs eig = dense::symmetric_eigen(
      scale.asDiagonal() * M_rr * scale.asDiagonal(), dense::EigenParts::kValues);
  return eig.ok ? eig.values.maxCoeff() / eig.values.minCoeff()
                : std::numeric_limits<double>::infinity();
}

/// "joint[3].rz", or "a mode", with the way out.
std::string without_mass(const rom::ReducedModel& reduced, Eigen::Index coordinate) {
  for (const auto& [name, set] : reduced.sets)
    for (size_t k = 0; k < set.dofs.size(); ++k)
      if (set.dofs[k] == coordinate)
        return set.labels[k] + " moves no mass" +
               (set.is_rotation[k] != 0
                    ? ": of the nodes of a flat sheet leave out the rotation about its normal "
                      "([[nodes.term]] with directions)"
                    : "");
  return "a mode moves no mass";
}

/// The coordinate that has the largest part in the motion of least mass.
[[noreturn]] void refuse_mass(const rom::ReducedModel& reduced) {
  const Eigen::VectorXd scale =
      reduced.M_rr.diagonal().cwiseAbs().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const dense::Eigenpairs eigen =
      dense::symmetric_eigen(scale.asDiagonal() * reduced.M_rr * scale.asDiagonal());
  Eigen::Index least = 0;
  reduced.M_rr.diagonal().minCoeff(&least);
  if (reduced.M_rr(least, least) > 0.0 && eigen.ok)
    eigen.vectors.col(0).cwiseAbs().maxCoeff(&least);
  throw NumericsError("reduced model: M_rr is not positive definite, " +
                      without_mass(reduced, least));
}

/// Rigid count, first elastic and highest frequency of (K_rr, M_rr).
void certify_spectrum(rom::ReducedModel& reduced, const Eigen::MatrixXd& motions) {
  constexpr double kRounding = 1e-15;  // of the highest value: rounding of doubles
  rom::ReducedCertificate& out = reduced.certificate;
  const sparse::EigenResult low =
      sparse::solve_dense(reduced.K_rr, reduced.M_rr, motions, std::nullopt);
  if (!low.ok()) throw NumericsError("reduced model: " + low.message);
  const dense::Eigenpairs all =
      dense::symmetric_eigen(reduced.K_rr, reduced.M_rr, dense::EigenParts::kValues);
  if (!all.ok) refuse_mass(reduced);
  const double highest = all.values.maxCoeff();
  const Eigen::Index zeros = (low.values.array() <= kRounding * highest).count();
  out.rigid_modes = static_cast<double>(motions.cols() + zeros);
  out.first_elastic_hz = zeros < low.values.size() ? sparse::hz_of_value(low.values[zeros]) : 0.0;
  out.max_frequency_hz = sparse::hz_of_value(highest);
}

void certify_modes(rom::ReducedModel& reduced, const CraigBampton& source) {
  rom::ReducedCertificate& out = reduced.certificate;
  const Eigen::Index n_k = reduced.fixed_interface_hz.size();
  const Eigen::MatrixXd unit =
      reduced.M_rr.bottomRightCorner(n_k, n_k) - Eigen::MatrixXd::Identity(n_k, n_k);
  out.residual_modes = static_cast<double>(source.residual.hz.size());
  out.modal_mass_error = n_k > 0 ? unit.cwiseAbs().maxCoeff() : 0.0;
  const InteriorModes& interior = source.interior;
  const Eigen::VectorXd& residuals = interior.residuals;
  out.eigen_residual_max = residuals.size() > 0 ? residuals.maxCoeff() : 0.0;
  if (interior.frequency_error >= 0.0) out.eigen_frequency_error = interior.frequency_error;
  out.load_shapes = interior.load_shapes;
  out.own_modes = interior.own_modes;
  if (source.residual.estimated) {
    out.frequency_error_estimate = source.residual.error_estimate;
    out.frequency_error_modes = source.residual.modes;
    // Own modes are exact: the estimate would be meaningless for a body joined to others.
    if (interior.own_modes == 0) out.frequency_error_joined = source.residual.error_before;
  }
  const Eigen::Index modes = n_k - source.residual.hz.size() - interior.load_shapes;
  out.fixed_interface_modes = reduced.method == "craig-chang" ? 0.0 : static_cast<double>(modes);
  out.count_proved = interior.proof.proved ? 1.0 : 0.0;
  out.count_below = static_cast<double>(interior.proof.below);
  out.count_limit_hz = sparse::hz_of_value(interior.proof.limit);
  out.cutoff_hz = interior.cutoff_hz;
  out.accurate_to_hz = interior.accurate_to_hz;
}

double difference(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  return (found - expected).norm() / expected.norm();
}

/// Largest relative deviation from the values that follow from the rigid motions r and M_rr: sum_k
/// product_kk = M_rr; for a body whose six motions are free first_k = M_rr r_k, moment_lk -
/// moment_kl = M_rr r_(3+j), and place against the mass properties.
double inertia_error(const rom::ReducedModel& reduced, bool free_body) {
  const rom::InertiaInvariants& found = reduced.inertia;
  double error = difference(found.product[0] + found.product[4] + found.product[8], reduced.M_rr);
  if (!free_body) return error;
  const Eigen::MatrixXd momentum = reduced.M_rr * reduced.rigid;
  for (size_t k = 0; k < 3; ++k) {
    const size_t l = (k + 1) % 3, j = (k + 2) % 3;  // a rotation about j moves k towards l
    error = std::max(error, difference(found.first[k], momentum.col(static_cast<Eigen::Index>(k))));
    error = std::max(error, difference(found.moment[3 * k + l] - found.moment[3 * l + k],
                                       momentum.col(static_cast<Eigen::Index>(3 + j))));
  }
  // Of the mass matrix: a lumped one has more inertia than the cells.
  const Eigen::Matrix3d about_origin =
      reduced.rigid.rightCols(3).transpose() * momentum.rightCols(3);
  const Eigen::Matrix3d place =
      0.5 * about_origin.trace() * Eigen::Matrix3d::Identity() - about_origin;
  return std::max(error, difference(found.place, place));
}

}  // namespace

MassError compare_mass(const rom::MassProperties& found, const rom::MassProperties& expected) {
  MassError error;
  const double moment = expected.inertia.norm();
  const double gyration = std::sqrt(moment / expected.mass);
  error.mass = std::abs(found.mass - expected.mass) / expected.mass;
  error.centre = (found.centre - expected.centre).norm() / gyration;
  error.inertia = (found.inertia - expected.inertia).norm() / moment;
  return error;
}

double clear_rigid_stiffness(rom::ReducedModel& reduced, const Eigen::MatrixXd& r) {
  if (r.cols() == 0) return 0.0;
  if (r.cols() == reduced.K_rr.rows()) {  // a rigid body: all of K_rr is rounding (hard case F1)
    reduced.K_rr.setZero();
    return 0.0;
  }
  const Eigen::MatrixXd unit = r.colwise().normalized();  // metres and radians have equal weight
  const double residue = (reduced.K_rr * unit).colwise().norm().maxCoeff() / reduced.K_rr.norm();
  const Eigen::MatrixXd Mr = reduced.M_rr * unit;
  const Eigen::MatrixXd to_rigid = dense::solve_symmetric(unit.transpose() * Mr, Mr.transpose());
  const Eigen::MatrixXd right = reduced.K_rr - (reduced.K_rr * unit) * to_rigid;
  const Eigen::MatrixXd both = right - to_rigid.transpose() * (unit.transpose() * right);
  reduced.K_rr = 0.5 * (both + both.transpose());
  return residue;
}

void certify(rom::ReducedModel& reduced, const PartitionedModel& part, const CraigBampton& source,
             const Eigen::MatrixXd& motions, bool spectrum) {
  rom::ReducedCertificate& out = reduced.certificate;
  const Eigen::Vector3d centre =
      rom::properties_of(rigid_mass(part, Eigen::Vector3d::Zero())).centre;
  const Eigen::MatrixXd rigid = rom::rigid_about(reduced.rigid, centre);
  const rom::MassProperties found =
      rom::properties_of(rigid.transpose() * reduced.M_rr * rigid, centre);
  const rom::MassProperties full = rom::properties_of(rigid_mass(part, centre), centre);
  out.rigid_stiffness_residue = clear_rigid_stiffness(reduced, motions);
  out.rigid_shape_error = source.rigid_error;
  const bool free_body = part.free.all_free();  // a held body cannot move rigidly
  if (free_body) {
    out.mass_error = compare_mass(found, full).largest();
    out.mass_error_elements = compare_mass(found, part.full.mass).largest();
  }
  out.certified = spectrum && part.full.parts.certified() ? 1.0 : 0.0;
  out.dropped_vectors = source.dropped + source.interior.dropped;
  out.K_ii_rcond = source.factor.rcond;
  out.K_ii_probe_residual = source.factor.probe_residual;
  if (!reduced.inertia.empty()) out.inertia_invariants_error = inertia_error(reduced, free_body);
  if (spectrum) {
    out.condition_M_rr = scaled_condition(reduced.M_rr);
    certify_spectrum(reduced, motions);
  }
  certify_modes(reduced, source);
  if (const double limit = limit_of("mass_error"); free_body && !(*out.mass_error <= limit)) {
    throw NumericsError(
        fmt::format("reduced model: mass properties differ by {:.1e} from the full "
                    "model's, expected at most {:.0e}",
                    *out.mass_error, limit));
  }
  if (const double limit = limit_of("inertia_invariants_error");
      !reduced.inertia.empty() && !(*out.inertia_invariants_error <= limit)) {
    throw NumericsError(fmt::format(
        "reduced model: inertia invariants differ by {:.1e} from those of M_rr and the rigid "
        "motions, expected at most {:.0e}",
        *out.inertia_invariants_error, limit));
  }
  const double stiffness = limit_of("rigid_stiffness_residue");
  if (!(*out.rigid_stiffness_residue <= stiffness) ||
      (spectrum && out.rigid_modes != static_cast<double>(motions.cols()))) {
    throw NumericsError(fmt::format(
        "reduced model: {} rigid modes with stiffness residue {:.1e}, expected {} and at most "
        "{:.0e}",
        spectrum ? fmt::format("{}", *out.rigid_modes) : "uncounted", *out.rigid_stiffness_residue,
        motions.cols(), stiffness));
  }
}

}  // namespace clatter::condense
