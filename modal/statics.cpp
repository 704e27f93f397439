// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/statics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "core/base/error.hpp"
#include "core/fe/free_motions.hpp"
#include "core/fe/shell_stress.hpp"
#include "modal/certificates.hpp"
#include "modal/gasket_statics.hpp"
#include "modal/refined_solve.hpp"
#include "modal/static_factor.hpp"

namespace clatter::modal {
namespace {

// By the judgements of the certificate: backward errors of each row, of which refinement leaves
// 1e-16 or so, sums of forces, of which rounding leaves 1e-12 or so, and displacements without a
// correct digit.
const double kBackward = judgement_of<StaticCertificate>("backward_error_max").refused;
const double kBalance = judgement_of<StaticCertificate>("balance_max").good;
const double kForward = judgement_of<StaticCertificate>("forward_error_max").refused;
constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();
constexpr double kHeldMotion = 1e-10;  // of the magnitudes in a row of K R; rounding is 1e-13

using Factors = std::map<std::string, double>;

/// The loads of a requested name: those of a case, or a single load.
Factors factors_of(const fe::FeModel& model, const std::string& name) {
  if (const auto found = model.cases.find(name); found != model.cases.end()) return found->second;
  if (model.loads.contains(name)) return {{name, 1.0}};
  std::vector<std::string> present;
  for (const auto& entry : model.cases) present.push_back(entry.first);
  for (const auto& entry : model.loads) present.push_back(entry.first);
  throw InputError(fmt::format("{}: case: found \"{}\", expected one of: {}", model.name, name,
                               fmt::join(present, ", ")));
}

std::vector<std::string> all_names(const fe::FeModel& model) {
  std::vector<std::string> names;
  // Single loads need not press a gasket that opens.
  if (model.gaskets.empty() || model.cases.empty())
    for (const auto& entry : model.loads) names.push_back(entry.first);
  for (const auto& entry : model.cases) names.push_back(entry.first);
  if (names.empty())
    throw InputError(fmt::format("{}: found no load, expected a [[load]]", model.name));
  return names;
}

/// Temperature rise of all loads of a case [K] (n_nodes); empty when none has one.
Eigen::VectorXd temperature_rise(const fe::FeModel& model, const Factors& loads) {
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

RightSides right_sides(const fe::FeModel& model, const std::vector<std::string>& names) {
  const auto m = static_cast<Eigen::Index>(names.size());
  const Eigen::Index n_s = model.supports.size();
  RightSides sides{Eigen::MatrixXd::Zero(model.size(), m), Eigen::MatrixXd::Zero(n_s, m),
                   Eigen::MatrixXd::Zero(n_s, m)};
  for (Eigen::Index c = 0; c < m; ++c)
    for (const auto& [load, factor] : factors_of(model, names[c])) {
      sides.f.col(c) += factor * model.loads.at(load);
      const auto held = model.support_loads.find(load);
      if (held != model.support_loads.end()) sides.f_s.col(c) += factor * held->second;
      const auto moved = model.prescribed.find(load);
      if (moved != model.prescribed.end()) sides.s.col(c) += factor * moved->second;
    }
  return sides;
}

void refuse_free_body(const fe::FeModel& model) {
  const fe::FreeMotions free = fe::free_motions(model);
  if (free.count() == 0) return;
  std::vector<std::string> names;
  for (Eigen::Index c = 0; c < free.count(); ++c) {
    std::string name = fe::motion_name(free.unit.col(c), fe::characteristic_length(model));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  throw InputError(
      fmt::format("{}: found {} unsupported rigid-body motions (such as {}){}, expected a "
                  "[[support]] for each",
                  model.name, free.count(), fmt::join(names, ", "),
                  free.bodies > 1 ? fmt::format(" in {} unconnected bodies", free.bodies) : ""));
}

/// 1 for rigid-body motions without force if supports are removed, 0 for those that an equation or
/// a ground spring holds: their forces are not reactions. Row by row, as in free_motions(): a soft
/// spring on a stiff part holds it.
Eigen::VectorXd balanced_motions(const fe::FeModel& model) {
  const fe::FeSupports& supports = model.supports;
  Eigen::MatrixXd force = multiply_symmetric(model.K, model.rigid);
  Eigen::MatrixXd size = magnitude_product(model.K, model.rigid);
  if (supports.size() > 0) {
    const SparseMatrix on_q = supports.K_sq.transpose();
    force += on_q * supports.rigid;
    size += on_q.cwiseAbs() * supports.rigid.cwiseAbs();
    // A spring between the ground and a supported DoF appears only in the rows of s.
    Eigen::MatrixXd on_s = supports.K_sq * model.rigid;
    on_s += multiply_symmetric(supports.K_ss, supports.rigid);
    Eigen::MatrixXd size_s = supports.K_sq.cwiseAbs() * model.rigid.cwiseAbs();
    size_s += magnitude_product(supports.K_ss, supports.rigid);
    force.conservativeResize(force.rows() + on_s.rows(), Eigen::NoChange);
    force.bottomRows(on_s.rows()) = on_s;
    size.conservativeResize(force.rows(), Eigen::NoChange);
    size.bottomRows(on_s.rows()) = size_s;
  }
  Eigen::VectorXd kept(6);
  for (Eigen::Index d = 0; d < 6; ++d)
    kept(d) = (force.col(d).cwiseAbs().array() <= kHeldMotion * size.col(d).array()).all();
  return kept;
}

double ratio(double part, double whole) { return whole > 0.0 ? part / whole : part; }

/// Rounding error of the sum of the nodal forces, in the units of the balance: bending of thin
/// parts is a small difference of large forces.
double rounding_of(const fe::FeModel& model, const Eigen::VectorXd& q, const Eigen::VectorXd& s) {
  Eigen::VectorXd sum =
      model.rigid.cwiseAbs().transpose() * Eigen::VectorXd(magnitude_product(model.K, q));
  const fe::FeSupports& supports = model.supports;
  if (supports.size() > 0) {
    const Eigen::VectorXd forces = supports.K_sq.cwiseAbs() * q.cwiseAbs() +
                                   Eigen::VectorXd(magnitude_product(supports.K_ss, s));
    sum += supports.rigid.cwiseAbs().transpose() * forces;
  }
  sum.tail(3) /= fe::characteristic_length(model);
  return kRounding * sum.norm();
}

/// What gaskets with curves add to the forces and the energy by K.
struct Beyond {
  Eigen::VectorXd on_s;  // n_s [N]; empty: nothing
  double energy = 0.0;   // [J]
};

StaticCase recover(const fe::FeModel& model, const Eigen::VectorXd& q, const Eigen::VectorXd& f,
                   const Eigen::VectorXd& f_s, const Eigen::VectorXd& s,
                   const Eigen::VectorXd& balanced, const Beyond& beyond = {}) {
  StaticCase out;
  double size = f.lpNorm<1>();  // sum of force magnitudes
  const fe::FeSupports& supports = model.supports;
  const Eigen::VectorXd elastic = multiply_symmetric(model.K, q);
  out.displacement = model.T * q;
  if (!model.points.names.empty()) out.points = model.points.T * q;
  if (!model.rotations.nodes.empty()) out.rotation = model.rotations.T * q;
  out.applied = model.rigid.transpose() * f;
  out.energy = 0.5 * q.dot(elastic) + beyond.energy;
  out.reactions = Eigen::VectorXd::Zero(supports.size());
  out.support_sums = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(supports.names.size()), 6);
  if (supports.size() > 0) {
    const Eigen::VectorXd on_q = supports.K_sq.transpose() * s;
    const Eigen::VectorXd on_s = multiply_symmetric(supports.K_ss, s);
    out.displacement += supports.T * s;
    if (out.points.size() > 0) out.points += model.points.T_s * s;
    if (out.rotation.size() > 0) out.rotation += model.rotations.T_s * s;
    out.applied += supports.rigid.transpose() * f_s;
    out.energy += q.dot(on_q) + 0.5 * s.dot(on_s);
    const Eigen::VectorXd by_q = supports.K_sq * q;
    out.reactions = by_q + on_s - f_s;
    if (beyond.on_s.size() > 0) out.reactions += beyond.on_s;
    size += by_q.lpNorm<1>() + on_s.lpNorm<1>() + f_s.lpNorm<1>();
    for (Eigen::Index k = 0; k < supports.size(); ++k)
      out.support_sums.row(supports.support[k]) += out.reactions(k) * supports.rigid.row(k);
  }
  Eigen::VectorXd sum = out.applied + out.support_sums.colwise().sum().transpose();
  sum = sum.cwiseProduct(balanced);
  sum.tail(3) /= fe::characteristic_length(model);
  out.balance = ratio(sum.norm(), size);
  if (out.balance > kBalance) out.balance_rounding = ratio(rounding_of(model, q, s), size);
  return out;
}

std::vector<fe::RegionStress> stresses_of(const fe::FeModel& model, const StaticCase& solved) {
  std::vector<fe::RegionStress> all =
      fe::nodal_stress(model.nodes, model.cells, solved.displacement, solved.temperature_rise);
  std::ranges::move(
      fe::shell_stress(model.nodes, model.cells, solved.displacement, model.rotations.nodes,
                       solved.rotation, solved.temperature_rise),
      std::back_inserter(all));
  return all;
}

void refuse_inexact(const fe::FeModel& model, const StaticCase& found) {
  // Written so that NaN is also refused.
  if (!(found.backward_error <= kBackward))
    throw NumericsError(fmt::format("{}: {}: found backward error {:.3g}, expected at most {:.0e}",
                                    model.name, found.name, found.backward_error, kBackward));
  if (!(found.balance <= std::max(kBalance, found.balance_rounding)))
    throw NumericsError(
        fmt::format("{}: {}: found balance of forces {:.3g}, expected at most {:.0e}", model.name,
                    found.name, found.balance, kBalance));
  if (!(found.forward_error <= kForward))
    throw NumericsError(
        fmt::format("{}: {}: found an estimated displacement error of {:.2g} from rounding of the "
                    "entries of K, expected at most {:g}: use thicker walls, smaller jumps of "
                    "stiffness, or stiffer supports",
                    model.name, found.name, found.forward_error, kForward));
}

/// Completes a case that is solved.
StaticCase finished(const fe::FeModel& model, StaticCase found, const std::string& name,
                    double backward, double forward) {
  found.name = name;
  found.loads = factors_of(model, name);
  found.backward_error = backward;
  found.forward_error = forward;
  refuse_inexact(model, found);
  found.temperature_rise = temperature_rise(model, found.loads);
  found.stress = stresses_of(model, found);
  return found;
}

/// Supports hold every DoF: displacements are the prescribed ones, and the reactions are K_ss s -
/// f_s.
StaticSolution solve_held(const fe::FeModel& model, const std::vector<std::string>& names,
                          const RightSides& sides) {
  if (!model.gaskets.empty())
    throw InputError(fmt::format(
        "{}: found supports that hold every DoF beside the gasket {} with a curve, expected a free "
        "side of it",
        model.name, model.gaskets[0].name));
  const Eigen::VectorXd balanced = balanced_motions(model);
  StaticSolution solution;
  for (size_t c = 0; c < names.size(); ++c) {
    const auto col = static_cast<Eigen::Index>(c);
    solution.cases.push_back(finished(model,
                                      recover(model, Eigen::VectorXd(0), Eigen::VectorXd(0),
                                              sides.f_s.col(col), sides.s.col(col), balanced),
                                      names[c], 0.0, 0.0));
  }
  return solution;
}

/// Each case on its own: what is pressed depends on it.
StaticSolution solve_with_curves(const fe::FeModel& model, const std::vector<std::string>& names,
                                 const RightSides& sides, const Eigen::MatrixXd& driven) {
  const Eigen::VectorXd balanced = balanced_motions(model);
  StaticSolution solution;
  for (size_t c = 0; c < names.size(); ++c) {
    const auto col = static_cast<Eigen::Index>(c);
    const Eigen::VectorXd f = driven.col(col), s = sides.s.col(col);
    PressedSolution pressed = solve_pressed(model, f, s, model.name + ": " + names[c]);
    solution.factor = pressed.factor;
    StaticCase found =
        finished(model,
                 recover(model, pressed.solved.x.col(0), sides.f.col(col), sides.f_s.col(col), s,
                         balanced, {pressed.on_s, pressed.energy}),
                 names[c], pressed.solved.backward[0], pressed.solved.forward[0]);
    found.gaskets = std::move(pressed.gaskets);
    found.steps = pressed.steps;
    solution.cases.push_back(std::move(found));
  }
  return solution;
}

std::string describe_gasket(const fe::FeGasket& gasket, const fe::GasketState& state) {
  const GasketSums sums = sums_of(gasket, state);
  std::string text = fmt::format(
      "  {}: pressed on {:.1f} % of {:.4g} m2, force {:.6g} N, highest pressure {:.4g} MPa",
      gasket.name, 100.0 * sums.pressed / sums.area, sums.area, sums.force, 1e-6 * sums.highest);
  if (sums.opening > 0.0) text += fmt::format(", opens by up to {:.3g} um", 1e6 * sums.opening);
  return text;
}

}  // namespace

StaticSolution solve_static(const fe::FeModel& model, const std::vector<std::string>& wanted) {
  const std::vector<std::string> names = wanted.empty() ? all_names(model) : wanted;
  const RightSides sides = right_sides(model, names);
  if (model.size() == 0) return solve_held(model, names, sides);
  refuse_free_body(model);
  Eigen::MatrixXd driven = sides.f;
  if (model.supports.size() > 0) driven -= model.supports.K_sq.transpose() * sides.s;
  if (!model.gaskets.empty()) return solve_with_curves(model, names, sides, driven);
  const sparse::SupernodalFactor factor = explained_factor(model, model.K);
  const RefinedSolution solved = solve_refined(factor, model.K, driven);

  StaticSolution solution;
  solution.factor = factor.report();
  const Eigen::VectorXd balanced = balanced_motions(model);
  for (size_t c = 0; c < names.size(); ++c) {
    const auto col = static_cast<Eigen::Index>(c);
    solution.cases.push_back(finished(model,
                                      recover(model, solved.x.col(col), sides.f.col(col),
                                              sides.f_s.col(col), sides.s.col(col), balanced),
                                      names[c], solved.backward[col], solved.forward[col]));
  }
  return solution;
}

std::vector<std::string> describe(const fe::FeModel& model, const StaticSolution& solution) {
  std::vector<std::string> lines;
  for (const StaticCase& one : solution.cases) {
    Eigen::Vector3d largest = Eigen::Vector3d::Zero();
    double most = -1.0;
    const auto look = [&](const Eigen::Vector3d& u, const Eigen::Vector3d& at) {
      if (u.norm() <= most) return;
      most = u.norm();
      largest = at;
    };
    for (Eigen::Index a = 0; a < model.nodes.rows(); ++a)
      look(one.displacement.segment<3>(3 * a), model.nodes.row(a));
    for (Eigen::Index p = 0; p < one.points.size() / 6; ++p)
      look(one.points.segment<3>(6 * p), model.points.position.row(p));
    lines.push_back(fmt::format(
        "{}: largest displacement {:.6g} m at ({:.4f}, {:.4f}, {:.4f}) m, energy "
        "{:.6g} J, backward error {:.1e}, error by rounding about {:.1e}, balance {:.1e}{}",
        one.name, most, largest.x(), largest.y(), largest.z(), one.energy, one.backward_error,
        one.forward_error, one.balance,
        one.steps > 0 ? fmt::format(", gaskets found in {} steps", one.steps) : ""));
    if (!one.stress.empty()) lines.push_back(describe_largest_stress(model, one));
    for (size_t g = 0; g < one.gaskets.size(); ++g)
      lines.push_back(describe_gasket(model.gaskets[g], one.gaskets[g]));
    for (Eigen::Index s = 0; s < one.support_sums.rows(); ++s)
      lines.push_back(
          fmt::format("  {}: force ({:.6g}, {:.6g}, {:.6g}) N, moment about the origin "
                      "({:.6g}, {:.6g}, {:.6g}) N m",
                      model.supports.names[s], one.support_sums(s, 0), one.support_sums(s, 1),
                      one.support_sums(s, 2), one.support_sums(s, 3), one.support_sums(s, 4),
                      one.support_sums(s, 5)));
  }
  return lines;
}

}  // namespace clatter::modal
