// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/model/certify.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/load/mass_properties.hpp"
#include "core/base/error.hpp"
#include "core/dense/svd.hpp"

namespace clatter::assembly {
namespace {

double largest(const Eigen::MatrixXd& values) {
  return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0;
}

/// |K R| over |K| |R|, column by column: the spurious force of a rigid motion, on the coordinates
/// or, when supports hold all of them, on the supports.
double rigid_force(const fe::FeModel& model, const Eigen::MatrixXd& motions) {
  const fe::FeSupports& supports = model.supports;
  const Eigen::MatrixXd rigid = model.rigid * motions;
  const Eigen::MatrixXd held = supports.rigid * motions;
  const bool all_held = model.size() == 0;
  Eigen::MatrixXd force = multiply_symmetric(all_held ? supports.K_ss : model.K,  //
                                             all_held ? held : rigid);
  if (!all_held && supports.size() > 0) force += supports.K_sq.transpose() * held;
  const double stiffness =
      largest(Eigen::VectorXd(all_held ? supports.K_ss.diagonal() : model.K.diagonal()));
  double worst = 0.0;
  for (Eigen::Index c = 0; c < rigid.cols(); ++c) {
    const double motion = std::max(largest(rigid.col(c)), largest(held.col(c)));
    worst = std::max(worst, largest(force.col(c)) / (stiffness * motion));
  }
  return worst;
}

/// Rigid motions (columns) that no equation constrains.
Eigen::MatrixXd free_motions(const Eigen::MatrixXd& grounded) {
  if (grounded.rows() == 0) return Eigen::MatrixXd::Identity(6, 6);
  return dense::null_space(grounded);
}

/// Those without rotation, of motions that nothing constrains.
Eigen::MatrixXd translations(const Eigen::MatrixXd& motions) {
  return motions * dense::null_space(motions.bottomRows<3>());
}

/// By the judgement of a field. Of an assembled model even what is warned of in others is refused.
void require_good(const std::string& name, const char* what, double found, const char* field) {
  const double limit = judgement_of<FeCertificate>(field).good;
  // Written so that NaN fails too.
  if (found <= limit) return;
  throw NumericsError(
      fmt::format("{}: {}: found {:.3g}, expected at most {:.1g}", name, what, found, limit));
}

}  // namespace

FeCertificate certify(const fe::FeModel& model, const Constrained& constrained,
                      const Recipe& recipe) {
  const Elimination& elimination = constrained.elimination;
  FeCertificate numbers;
  numbers.dofs = model.size();
  numbers.dofs_fixed = elimination.supports();
  numbers.dofs_pivot = static_cast<double>(elimination.pivots.size());
  numbers.nonzeros_K = static_cast<double>(model.K.nonZeros());
  numbers.nonzeros_M = static_cast<double>(model.M.nonZeros());
  numbers.nonzeros_T = static_cast<double>(model.T.nonZeros());
  numbers.largest_T_entry = elimination.growth;
  for (const auto& [heat, field] : model.heat) numbers.heat_balance[heat] = field.balance;

  const Eigen::MatrixXd motions = free_motions(constrained.grounded);
  numbers.rigid_motions_held_by_equations = static_cast<double>(6 - motions.cols());
  if (motions.cols() == 0 || model.nodes.rows() == 0) return numbers;
  Eigen::MatrixXd nodal(model.T.rows(), 6);
  for (Eigen::Index a = 0; a < model.nodes.rows(); ++a)
    nodal.middleRows<3>(3 * a) = rigid_motion(model.nodes.row(a).transpose());
  nodal *= motions;
  Eigen::MatrixXd recovered = model.T * (model.rigid * motions);
  if (model.supports.size() > 0) recovered += model.supports.T * (model.supports.rigid * motions);
  const double recovery = (recovered - nodal).cwiseAbs().maxCoeff() / nodal.cwiseAbs().maxCoeff();
  numbers.rigid_recovery_error = recovery;
  require_good(model.name, "rigid motions recovered by T, relative error", recovery,
               "rigid_recovery_error");
  // Loads that keep their directions turn a stressed part.
  const bool turned = recipe.prestress && elimination.supports() > 0;
  numbers.rigid_force_residue = rigid_force(model, turned ? translations(motions) : motions);
  require_good(model.name,
               recipe.prestress ? "force of rigid motions, |K R| / |K| |R|, with the loads of "
                                  "[prestress], which keep their directions (hold the part by "
                                  "[[support]])"
                                : "force of rigid motions, |K R| / |K| |R|",
               *numbers.rigid_force_residue, "rigid_force_residue");
  // A supported model's M lacks the mass of the held DoFs; a mass matrix need not be that of a
  // body.
  const bool bodies = std::ranges::none_of(recipe.matrices, &MatrixSpec::is_mass);
  if (elimination.supports() > 0 || motions.cols() < 6 || !bodies) return numbers;
  const MassDifference error = compare(properties_of(model.M, model.rigid), model.mass);
  numbers.mass_error = error.mass;
  require_good(model.name, "mass, R^T M R against the sum over the elements", error.mass,
               "mass_error");
  numbers.centre_error = error.centre;
  numbers.inertia_error = error.inertia;
  if (recipe.mass == fe::MassForm::kHrz) return numbers;
  require_good(model.name, "centre of gravity, R^T M R against the sum over the elements",
               error.centre, "mass_error");
  require_good(model.name, "inertia, R^T M R against the sum over the elements", error.inertia,
               "mass_error");
  return numbers;
}

}  // namespace clatter::assembly
