// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/interface/interface_modes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "condense/interface/film_work.hpp"
#include "core/base/error.hpp"
#include "core/dense/least_squares.hpp"
#include "core/dense/solve.hpp"
#include "core/dense/svd.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The boundary coordinates that stay and those that become modes, ascending.
struct Split {
  std::vector<int> stay, become;
};

Split split_boundary(const rom::ReducedModel& model, const std::vector<std::string>& sets) {
  std::vector<char> named(static_cast<size_t>(model.n_boundary), 0);
  for (const std::string& name : sets)
    for (const int32_t dof : model.set(name).dofs) named[dof] = 1;
  Split split;
  for (int dof = 0; dof < model.n_boundary; ++dof)
    (named[dof] != 0 ? split.become : split.stay).push_back(dof);
  return split;
}

/// Rejects coordinates that leave a free rigid motion; rigid_R is their part of these motions.
void check_holds(const rom::ReducedModel& model, const MatrixXd& rigid_R, double length) {
  if (rigid_R.cols() == 0 || rigid_R.rows() == 0) return;
  MatrixXd scaled = rigid_R;  // columns of unit size; zero for a motion that moves no coordinate
  for (Index j = 0; j < scaled.cols(); ++j)
    scaled.col(j) /= std::max(scaled.col(j).norm(), 1e-9 * std::max(1.0, length));
  const VectorXd singular = dense::singular_values(scaled);
  const auto rank = (singular.array() > 1e-6 * singular[0]).count();
  if (rank == rigid_R.cols()) return;
  throw InputError(
      fmt::format("{}: interface.sets: found {} coordinates that stay and hold {} of {} rigid "
                  "motions, expected sets that leave enough to hold the body, or all sets",
                  model.name, rigid_R.rows(), rank, rigid_R.cols()));
}

/// Areas of the patches of the coordinates `become`; InputError when one is no patch.
VectorXd areas_of(const rom::ReducedModel& model, const InterfaceOptions& options,
                  const std::vector<int>& become) {
  VectorXd by_coordinate = VectorXd::Zero(model.n_boundary);
  for (const std::string& name : options.sets) {
    if (!model.grids.contains(name))
      throw InputError(
          fmt::format("{}: interface.weight: weight = \"area\" needs contact grids, \"{}\" is "
                      "another set",
                      model.name, name));
    const VectorXd areas = patch_areas(model.grid(name));
    const std::vector<int32_t>& dofs = model.set(name).dofs;
    for (size_t k = 0; k < dofs.size(); ++k) by_coordinate[dofs[k]] = areas[static_cast<Index>(k)];
  }
  return by_coordinate(become);
}

struct Shapes {
  MatrixXd Phi;  // |S| x p, unit mass in M_SS
  double next_hz = 0.0;
};

/// Elastic modes of (K_SS, N), after the `rigid` motions of all of the boundary.
Shapes interface_shapes(const MatrixXd& K_SS, const MatrixXd& M_SS, const MatrixXd& N,
                        const MatrixXd& rigid, const InterfaceOptions& options) {
  const double sigma = rigid.cols() > 0 ? sparse::dense_shift(K_SS, N) : 0.0;
  const sparse::EigenResult all = sparse::solve_dense(K_SS, N, sigma);
  if (!all.ok()) throw NumericsError("interface modes: " + all.message);
  const Index elastic = all.values.size() - rigid.cols();
  const VectorXd values = all.values.tail(elastic);
  Index count = std::min<Index>(options.modes, elastic);
  if (options.fmax_hz > 0.0)
    count = (values.array() < sparse::value_of_hz(options.fmax_hz)).count();
  Shapes out;
  out.Phi.resize(K_SS.rows(), rigid.cols() + count);
  out.Phi.leftCols(rigid.cols()) = rigid;
  out.Phi.rightCols(count) = all.vectors.middleCols(rigid.cols(), count);
  for (Index j = 0; j < out.Phi.cols(); ++j)
    out.Phi.col(j) /= std::sqrt(out.Phi.col(j).dot(M_SS * out.Phi.col(j)));
  if (!options.by_area && count < elastic) out.next_hz = sparse::hz_of_value(values[count]);
  return out;
}

/// W of q = W (q_R, z, modal coordinates).
MatrixXd transformation(const rom::ReducedModel& model, const Split& split, const MatrixXd& Psi_SR,
                        const MatrixXd& Phi_S) {
  const auto n_R = static_cast<Index>(split.stay.size());
  const Index n_k = model.size() - model.n_boundary, p = Phi_S.cols();
  MatrixXd W = MatrixXd::Zero(model.size(), n_R + p + n_k);
  for (Index k = 0; k < n_R; ++k) W(split.stay[k], k) = 1.0;
  for (size_t k = 0; k < split.become.size(); ++k) {
    W.row(split.become[k]).head(n_R) = Psi_SR.row(static_cast<Index>(k));
    W.row(split.become[k]).segment(n_R, p) = Phi_S.row(static_cast<Index>(k));
  }
  W.bottomRightCorner(n_k, n_k).setIdentity();
  return W;
}

MatrixXd projected(const MatrixXd& A, const MatrixXd& W) {
  const MatrixXd out = W.transpose() * (A * W);
  return 0.5 * (out + out.transpose());
}

/// Renumbers the DoFs of sets: coordinates that stay, after all coordinates the rows of `become`,
/// and then the rows that were already combined among the coordinates `before`.
void renumber(rom::ReducedModel& model, const Split& split, int before, int size) {
  std::vector<int32_t> renumbered(static_cast<size_t>(model.n_boundary));
  for (size_t k = 0; k < split.stay.size(); ++k)
    renumbered[split.stay[k]] = static_cast<int32_t>(k);
  for (size_t k = 0; k < split.become.size(); ++k)
    renumbered[split.become[k]] = size + static_cast<int32_t>(k);
  const auto shift = size + static_cast<int32_t>(split.become.size()) - before;
  for (auto& [name, set] : model.sets)
    for (int32_t& dof : set.dofs) dof = dof < before ? renumbered[dof] : dof + shift;
}

/// Rigid motions (r x m) in the coordinates after W: q_R as it is, z the nearest in the mass of S.
MatrixXd carried(const rom::ReducedModel& model, const Split& split, const MatrixXd& W,
                 const MatrixXd& motions) {
  const auto n_R = static_cast<Index>(split.stay.size());
  const Index p = W.cols() - n_R - (model.size() - model.n_boundary);
  const MatrixXd W_S = W(split.become, Eigen::all);
  const MatrixXd Phi_S = W_S.middleCols(n_R, p);
  const MatrixXd M_Phi = MatrixXd(model.M_rr(split.become, split.become)) * Phi_S;
  const MatrixXd motions_R = motions(split.stay, Eigen::all);
  const MatrixXd rest = motions(split.become, Eigen::all) - W_S.leftCols(n_R) * motions_R;
  MatrixXd out = MatrixXd::Zero(W.cols(), motions.cols());
  out.topRows(n_R) = motions_R;
  out.middleRows(n_R, p) =
      dense::solve_symmetric(Phi_S.transpose() * M_Phi, M_Phi.transpose() * rest);
  return out;
}

/// The model in the coordinates after W.
rom::ReducedModel transformed(const rom::ReducedModel& model, const Split& split,
                              const MatrixXd& W) {
  rom::ReducedModel out = model;
  const auto n_R = static_cast<Index>(split.stay.size());
  out.M_rr = projected(model.M_rr, W);
  out.K_rr = projected(model.K_rr, W);
  if (model.loss.rows() > 0) out.loss = projected(model.loss, W);
  for (auto& [name, load] : out.loads) load = W.transpose() * model.loads.at(name);
  out.inertia = model.inertia.in(W);
  if (model.inertia_force.rows() > 0) out.inertia_force = W.transpose() * model.inertia_force;
  if (model.skin.T.rows() > 0) out.skin.T = model.skin.T * W;
  const Index n_S = static_cast<Index>(split.become.size());
  out.combined.resize(n_S + model.combined.rows(), W.cols());
  out.combined.topRows(n_S) = W(split.become, Eigen::all);
  if (model.combined.rows() > 0)
    out.combined.bottomRows(model.combined.rows()) = model.combined * W;
  out.rigid = carried(model, split, W, model.rigid);
  renumber(out, split, model.size(), static_cast<int>(W.cols()));
  out.n_boundary = static_cast<int>(n_R);
  return out;
}

/// Largest relative frequency error of elastic modes below the limit.
/// @param before, after with the free motions of each.
double frequency_error(const rom::ReducedModel& before, const MatrixXd& motions_before,
                       const rom::ReducedModel& after, const MatrixXd& motions_after,
                       double limit_hz) {
  const auto values = [](const rom::ReducedModel& model, const MatrixXd& motions) {
    const sparse::EigenResult all =
        sparse::solve_dense(model.K_rr, model.M_rr, motions, std::nullopt);
    if (!all.ok()) throw NumericsError("reduced interface: " + all.message);
    return all.values;
  };
  const VectorXd exact = values(before, motions_before), found = values(after, motions_after);
  double error = 0.0;
  for (Index j = 0; j < exact.size() && exact[j] < sparse::value_of_hz(limit_hz); ++j)
    error = std::max(error, j < found.size() ? std::sqrt(found[j] / exact[j]) - 1.0 : 1.0);
  return error;
}

double film_work_error(const rom::ReducedModel& before, const MatrixXd& motions_before,
                       const rom::ReducedModel& after, const MatrixXd& motions_after,
                       const InterfaceOptions& options) {
  double error = 0.0;
  for (const auto& [name, grid] : before.grids) {
    if (std::find(options.sets.begin(), options.sets.end(), name) == options.sets.end()) continue;
    const VectorXd exact =
        static_work(before.K_rr, before.M_rr, motions_before, film_forces(before, name));
    const VectorXd found =
        static_work(after.K_rr, after.M_rr, motions_after, film_forces(after, name));
    for (Index k = 0; k < exact.size(); ++k)
      if (exact[k] > 1e-9 * exact.maxCoeff())
        error = std::max(error, std::abs(found[k] / exact[k] - 1.0));
  }
  return error;
}

}  // namespace

const keys::Keys<InterfaceOptions>& interface_keys() {
  static const keys::Keys<InterfaceOptions> keys(
      "interface", "a second reduction: modes instead of coordinates of the boundary",
      [](auto& key, InterfaceOptions& options) {
        key.texts("sets", options.sets,
                  "names of sets of the boundary whose coordinates go; all without it");
        key.integer("modes", options.modes, Range::between(1.0, 1e6), "elastic modes, this many");
        key.number("fmax_hz", options.fmax_hz, Range::positive(), "or all below this frequency")
            .needs("weight", "mass", "modes by area have no frequency");
        key.choice("weight", options.by_area, {{"mass", false}, {"area", true}},
                   "by which the modes are orthogonal: mass, or the areas of the patches");
        key.one_of({"modes", "fmax_hz"});
      });
  return keys;
}

void choose_sets(const Config& table, const std::vector<std::string>& boundary,
                 InterfaceOptions& options) {
  if (!table.has("sets")) options.sets = boundary;
  if (options.sets.empty()) table.fail("sets", "found no set, expected one or more names");
  for (const std::string& name : options.sets)
    if (std::find(boundary.begin(), boundary.end(), name) == boundary.end())
      table.fail("sets", fmt::format("found \"{}\", expected sets of the boundary: {}", name,
                                     fmt::join(boundary, ", ")));
}

ReducedInterface reduce_interface(const rom::ReducedModel& model, const InterfaceOptions& options,
                                  const MatrixXd& motions, double length, double limit_hz) {
  const Split split = split_boundary(model, options.sets);
  const MatrixXd rigid_R = motions(split.stay, Eigen::all);
  const MatrixXd rigid_S = motions(split.become, Eigen::all);
  check_holds(model, rigid_R, length);
  const MatrixXd K_SS = model.K_rr(split.become, split.become);
  const MatrixXd M_SS = model.M_rr(split.become, split.become);
  const MatrixXd N =
      options.by_area ? MatrixXd(areas_of(model, options, split.become).asDiagonal()) : M_SS;
  const bool all_of_it = split.stay.empty();
  const Shapes shapes =
      interface_shapes(K_SS, M_SS, N, all_of_it ? rigid_S : MatrixXd(K_SS.rows(), 0), options);
  MatrixXd Psi_SR(K_SS.rows(), static_cast<Index>(split.stay.size()));
  if (!all_of_it) {
    Psi_SR = -dense::solve_symmetric(K_SS, model.K_rr(split.become, split.stay));
    // The smallest change with which the shapes represent the rigid motions exactly.
    if (rigid_R.cols() > 0) Psi_SR += (rigid_S - Psi_SR * rigid_R) * dense::pseudo_inverse(rigid_R);
  }
  const MatrixXd W = transformation(model, split, Psi_SR, shapes.Phi);
  rom::ReducedModel reduced = transformed(model, split, W);
  MatrixXd after = carried(model, split, W, motions);
  InterfaceReport report;
  report.coordinates = static_cast<int>(split.become.size());
  report.modes = static_cast<int>(shapes.Phi.cols());
  report.cutoff_hz = shapes.next_hz;
  report.frequency_error = frequency_error(model, motions, reduced, after, limit_hz);
  report.pressure_work_error = film_work_error(model, motions, reduced, after, options);
  if (report.cutoff_hz > 0.0) reduced.valid_to_hz = std::min(reduced.valid_to_hz, report.cutoff_hz);
  return {std::move(reduced), std::move(after), report};
}

}  // namespace clatter::condense
