#include "modal/statics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "modal/free_motions.hpp"

namespace clatter::modal {
namespace {

constexpr double kTolerance = 1e-8;   // of residual and balance; rounding leaves 1e-12 or so
constexpr double kHeldMotion = 1e-8;  // |K R| / |K| |R| of a rigid motion that an equation holds

using Factors = std::map<std::string, double>;

/// The loads of a wanted name: a case's, or the one load by itself.
Factors factors_of(const assembly::FeModel& model, const std::string& name) {
  if (const auto found = model.cases.find(name); found != model.cases.end()) return found->second;
  if (model.loads.contains(name)) return {{name, 1.0}};
  std::vector<std::string> present;
  for (const auto& entry : model.cases) present.push_back(entry.first);
  for (const auto& entry : model.loads) present.push_back(entry.first);
  throw InputError(fmt::format("{}: case: found \"{}\", expected one of: {}", model.name, name,
                               fmt::join(present, ", ")));
}

std::vector<std::string> all_names(const assembly::FeModel& model) {
  std::vector<std::string> names;
  for (const auto& entry : model.loads) names.push_back(entry.first);
  for (const auto& entry : model.cases) names.push_back(entry.first);
  if (names.empty())
    throw InputError(fmt::format("{}: found no load, expected a [[load]]", model.name));
  return names;
}

/// Of all loads of a case [K] (n_nodes); empty when none has a temperature.
Eigen::VectorXd temperature_rise(const assembly::FeModel& model, const Factors& loads) {
  Eigen::VectorXd sum;
  for (const auto& [load, factor] : loads) {
    const auto found = model.temperature_rise.find(load);
    if (found == model.temperature_rise.end()) continue;
    if (sum.size() == 0) sum = Eigen::VectorXd::Zero(model.nodes.rows());
    sum += factor * found->second;
  }
  return sum;
}

/// Columns: f (n), f_s (n_s) and s (n_s) of each case.
struct RightSides {
  Eigen::MatrixXd f, f_s, s;
};

RightSides right_sides(const assembly::FeModel& model, const std::vector<std::string>& names) {
  const auto m = static_cast<Eigen::Index>(names.size());
  const Eigen::Index n_s = model.supports.size();
  RightSides sides{Eigen::MatrixXd::Zero(model.size(), m), Eigen::MatrixXd::Zero(n_s, m),
                   Eigen::MatrixXd::Zero(n_s, m)};
  for (Eigen::Index c = 0; c < m; ++c)
    for (const auto& [load, factor] : factors_of(model, names[static_cast<size_t>(c)])) {
      sides.f.col(c) += factor * model.loads.at(load);
      const auto held = model.support_loads.find(load);
      if (held != model.support_loads.end()) sides.f_s.col(c) += factor * held->second;
      const auto moved = model.prescribed.find(load);
      if (moved != model.prescribed.end()) sides.s.col(c) += factor * moved->second;
    }
  return sides;
}

void refuse_free_body(const assembly::FeModel& model) {
  const Eigen::MatrixXd motions = free_motions(model);
  if (motions.cols() == 0) return;
  std::vector<std::string> names;
  for (Eigen::Index c = 0; c < motions.cols(); ++c) {
    std::string name = motion_name(motions.col(c), characteristic_length(model));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  throw InputError(
      fmt::format("{}: found {} rigid motions that nothing holds (such as {}), expected a "
                  "[[support]] that does",
                  model.name, motions.cols(), fmt::join(names, ", ")));
}

/// 1 for the rigid motions that are free of force without supports, 0 for those that an equation
/// holds: its forces are no reactions.
Eigen::VectorXd balanced_motions(const assembly::FeModel& model) {
  Eigen::MatrixXd force = multiply_symmetric(model.K, model.rigid);
  if (model.supports.size() > 0) force += model.supports.K_sq.transpose() * model.supports.rigid;
  const double stiffness = Eigen::VectorXd(model.K.diagonal()).maxCoeff();
  Eigen::VectorXd kept(6);
  for (Eigen::Index d = 0; d < 6; ++d) {
    const double motion = model.rigid.col(d).cwiseAbs().maxCoeff();
    kept(d) = force.col(d).cwiseAbs().maxCoeff() <= kHeldMotion * stiffness * motion ? 1.0 : 0.0;
  }
  return kept;
}

double ratio(double part, double whole) { return whole > 0.0 ? part / whole : part; }

StaticCase recover(const assembly::FeModel& model, const Eigen::VectorXd& q,
                   const Eigen::VectorXd& f, const Eigen::VectorXd& f_s, const Eigen::VectorXd& s,
                   const Eigen::VectorXd& balanced) {
  StaticCase out;
  double size = f.lpNorm<1>();  // of forces that cancel
  const assembly::FeSupports& supports = model.supports;
  const Eigen::VectorXd elastic = multiply_symmetric(model.K, q);
  Eigen::VectorXd driven = f;
  out.displacement = model.T * q;
  if (!model.points.names.empty()) out.points = model.points.T * q;
  out.applied = model.rigid.transpose() * f;
  out.energy = 0.5 * q.dot(elastic);
  out.reactions = Eigen::VectorXd::Zero(supports.size());
  out.support_sums = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(supports.names.size()), 6);
  if (supports.size() > 0) {
    const Eigen::VectorXd on_q = supports.K_sq.transpose() * s;
    const Eigen::VectorXd on_s = multiply_symmetric(supports.K_ss, s);
    driven -= on_q;
    out.displacement += supports.T * s;
    if (out.points.size() > 0) out.points += model.points.T_s * s;
    out.applied += supports.rigid.transpose() * f_s;
    out.energy += q.dot(on_q) + 0.5 * s.dot(on_s);
    const Eigen::VectorXd by_q = supports.K_sq * q;
    out.reactions = by_q + on_s - f_s;
    size += by_q.lpNorm<1>() + on_s.lpNorm<1>() + f_s.lpNorm<1>();
    for (Eigen::Index k = 0; k < supports.size(); ++k)
      out.support_sums.row(supports.support[static_cast<size_t>(k)]) +=
          out.reactions(k) * supports.rigid.row(k);
  }
  out.residual = ratio((elastic - driven).norm(), driven.norm());
  Eigen::VectorXd sum = out.applied + out.support_sums.colwise().sum().transpose();
  sum = sum.cwiseProduct(balanced);
  sum.tail(3) /= characteristic_length(model);
  out.balance = ratio(sum.norm(), size);
  return out;
}

/// Nothing is unknown where supports hold every DoF: displacements are those prescribed, and the
/// reactions are K_ss s - f_s.
StaticSolution solve_held(const assembly::FeModel& model, const std::vector<std::string>& names,
                          const RightSides& sides) {
  constexpr double kHeldBalance = 1e-8;  // rounding leaves 1e-12 or so
  const assembly::FeSupports& supports = model.supports;
  const Eigen::MatrixXd force = multiply_symmetric(supports.K_ss, supports.rigid);
  const double stiffness = Eigen::VectorXd(supports.K_ss.diagonal()).maxCoeff();
  Eigen::VectorXd balanced(6);
  for (Eigen::Index d = 0; d < 6; ++d)
    balanced(d) = force.col(d).cwiseAbs().maxCoeff() <=
                          kHeldMotion * stiffness * supports.rigid.col(d).cwiseAbs().maxCoeff()
                      ? 1.0
                      : 0.0;
  StaticSolution solution;
  for (size_t c = 0; c < names.size(); ++c) {
    const auto col = static_cast<Eigen::Index>(c);
    StaticCase found = recover(model, Eigen::VectorXd(0), Eigen::VectorXd(0), sides.f_s.col(col),
                               sides.s.col(col), balanced);
    found.name = names[c];
    found.loads = factors_of(model, names[c]);
    if (!(found.balance <= kHeldBalance))
      throw NumericsError(
          fmt::format("{}: {}: found balance of forces {:.3g}, expected at most {:.0e}", model.name,
                      found.name, found.balance, kHeldBalance));
    found.stress = assembly::nodal_stress(model.nodes, model.cells, found.displacement,
                                          temperature_rise(model, found.loads));
    solution.cases.push_back(std::move(found));
  }
  return solution;
}

}  // namespace

StaticSolution solve_static(const assembly::FeModel& model,
                            const std::vector<std::string>& wanted) {
  const std::vector<std::string> names = wanted.empty() ? all_names(model) : wanted;
  const RightSides sides = right_sides(model, names);
  if (model.size() == 0) return solve_held(model, names, sides);
  refuse_free_body(model);
  const SupernodalFactor factor(model.K);
  Eigen::MatrixXd driven = sides.f;
  if (model.supports.size() > 0) driven -= model.supports.K_sq.transpose() * sides.s;
  Eigen::MatrixXd q = factor.solve(driven);
  // One refinement: reactions are small differences of large forces.
  q += factor.solve(driven - multiply_symmetric(model.K, q));

  StaticSolution solution;
  solution.factor = factor.report();
  const Eigen::VectorXd balanced = balanced_motions(model);
  for (size_t c = 0; c < names.size(); ++c) {
    const auto col = static_cast<Eigen::Index>(c);
    StaticCase found = recover(model, q.col(col), sides.f.col(col), sides.f_s.col(col),
                               sides.s.col(col), balanced);
    found.name = names[c];
    found.loads = factors_of(model, names[c]);
    // Written so that NaN is refused too.
    if (!(found.residual <= kTolerance && found.balance <= kTolerance))
      throw NumericsError(fmt::format(
          "{}: {}: found residual {:.3g} and balance of forces {:.3g}, expected at most {:.0e}",
          model.name, found.name, found.residual, found.balance, kTolerance));
    found.stress = assembly::nodal_stress(model.nodes, model.cells, found.displacement,
                                          temperature_rise(model, found.loads));
    solution.cases.push_back(std::move(found));
  }
  return solution;
}

std::vector<std::string> describe(const assembly::FeModel& model, const StaticSolution& solution) {
  std::vector<std::string> lines;
  for (const StaticCase& one : solution.cases) {
    Eigen::Index largest = 0;
    double most = 0.0;
    for (Eigen::Index a = 0; a < model.nodes.rows(); ++a) {
      const double length = one.displacement.segment<3>(3 * a).norm();
      if (length <= most) continue;
      most = length;
      largest = a;
    }
    lines.push_back(
        fmt::format("{}: largest displacement {:.6g} m at ({:.4f}, {:.4f}, {:.4f}) m, energy "
                    "{:.6g} J, residual "
                    "{:.1e}, balance {:.1e}",
                    one.name, most, model.nodes(largest, 0), model.nodes(largest, 1),
                    model.nodes(largest, 2), one.energy, one.residual, one.balance));
    if (!one.stress.empty()) lines.push_back(describe_largest_stress(model, one));
    for (Eigen::Index s = 0; s < one.support_sums.rows(); ++s)
      lines.push_back(
          fmt::format("  {}: force ({:.6g}, {:.6g}, {:.6g}) N, moment about the origin "
                      "({:.6g}, {:.6g}, {:.6g}) N m",
                      model.supports.names[static_cast<size_t>(s)], one.support_sums(s, 0),
                      one.support_sums(s, 1), one.support_sums(s, 2), one.support_sums(s, 3),
                      one.support_sums(s, 4), one.support_sums(s, 5)));
  }
  return lines;
}

}  // namespace clatter::modal
