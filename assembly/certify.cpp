#include "assembly/certify.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/mass_properties.hpp"
#include "core/error.hpp"
#include "core/log.hpp"

namespace clatter::assembly {
namespace {

constexpr double kMassTolerance = 1e-9;   // ten properties, hard case B5
constexpr double kRigidTolerance = 1e-9;  // rounding leaves 1e-12 at 1e6 DoF
constexpr double kLargeGrowth = 1e6;      // loses six digits in every pivot displacement

/// |K R| over |K| |R|, column by column: the force that a rigid motion should not need.
double rigid_force(const SparseMatrix& K, const Eigen::MatrixXd& rigid) {
  const Eigen::MatrixXd force = multiply_symmetric(K, rigid);
  const double stiffness = Eigen::VectorXd(K.diagonal()).maxCoeff();
  double worst = 0.0;
  for (Eigen::Index c = 0; c < rigid.cols(); ++c)
    worst = std::max(worst, force.col(c).cwiseAbs().maxCoeff() /
                                (stiffness * rigid.col(c).cwiseAbs().maxCoeff()));
  return worst;
}

void require_below(const std::string& name, const char* what, double found, double limit) {
  // Written so that NaN is refused too.
  if (found <= limit) return;
  throw NumericsError(
      fmt::format("{}: {}: found {:.3g}, expected at most {:.1g}", name, what, found, limit));
}

}  // namespace

std::map<std::string, double> certify(const FeModel& model, const Eigen::MatrixXd& nodal_rigid,
                                      const Elimination& elimination, int n_fixed) {
  std::map<std::string, double> numbers;
  numbers["dofs"] = model.size();
  numbers["dofs_fixed"] = n_fixed;
  numbers["dofs_pivot"] = static_cast<double>(elimination.pivots.size());
  numbers["nonzeros_K"] = static_cast<double>(model.K.nonZeros());
  numbers["nonzeros_M"] = static_cast<double>(model.M.nonZeros());
  numbers["largest_T_entry"] = elimination.growth;
  if (elimination.growth > kLargeGrowth)
    warn(
        fmt::format("{}: a pivot displacement is {:.3g} times its neighbours: couplings lie close "
                    "to one another",
                    model.name, elimination.growth));

  const double recovery = (model.T * model.rigid - nodal_rigid).cwiseAbs().maxCoeff() /
                          nodal_rigid.cwiseAbs().maxCoeff();
  numbers["rigid_recovery_error"] = recovery;
  require_below(model.name, "rigid motions recovered by T, relative error", recovery,
                kRigidTolerance);
  if (n_fixed > 0) return numbers;  // a supported model has no rigid motion to compare with

  numbers["rigid_force_residue"] = rigid_force(model.K, model.rigid);
  require_below(model.name, "force of rigid motions, |K R| / |K| |R|",
                numbers["rigid_force_residue"], kRigidTolerance);
  const MassDifference error = compare(properties_of(model.M, model.rigid), model.mass);
  numbers["mass_error"] = error.mass;
  numbers["centre_error"] = error.centre;
  numbers["inertia_error"] = error.inertia;
  require_below(model.name, "mass, R^T M R against the sum over the elements", error.mass,
                kMassTolerance);
  require_below(model.name, "centre of gravity, R^T M R against the sum over the elements",
                error.centre, kMassTolerance);
  require_below(model.name, "inertia, R^T M R against the sum over the elements", error.inertia,
                kMassTolerance);
  return numbers;
}

}  // namespace clatter::assembly
