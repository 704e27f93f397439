// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/interior_modes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "condense/basis/shape_basis.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/named.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

sparse::EigenOptions eigen_options(const ModeRequest& request) {
  sparse::EigenOptions options;
  options.count = request.count;
  options.fmax_hz = request.fmax_hz;
  options.prove_count = request.prove_count;
  static_cast<sparse::EigenChoice&>(options) = request;
  return options;
}

void take_report(const sparse::ModeSet& modes, const ModeRequest& request, InteriorModes& out) {
  out.proof = modes.proof;
  out.residuals = modes.residuals;
  out.cutoff_hz = request.fmax_hz > 0.0 || modes.size() == 0
                      ? request.fmax_hz
                      : sparse::hz_of_value(modes.values.tail(1)[0]);
  if (modes.errors.size() == 0) return;
  out.frequency_error = modes.errors.maxCoeff();
  out.cutoff_hz = std::min(out.cutoff_hz, sparse::hz_of_value(modes.next_value));
}

InteriorModes fixed_interface_modes(const PartitionedModel& part, const sparse::Factor& factor_ii,
                                    const ModeRequest& request) {
  const bool guyan = request.count == 0 && request.fmax_hz == 0.0;
  sparse::EigenOptions options = eigen_options(request);
  options.sigma = 0.0;  // K_ii itself is definite and already factorised
  if (guyan) options.count = 1;
  sparse::ModeSet modes = sparse::solve_modes(part.interior(), options, &factor_ii);
  InteriorModes out;
  take_report(modes, request, out);
  out.accurate_to_hz = 0.5 * out.cutoff_hz;
  if (guyan) {
    out.vectors.resize(part.K.ib.rows(), 0);
    out.residuals.resize(0);
    return out;
  }
  out.hz = modes.values.unaryExpr(&sparse::hz_of_value);
  out.vectors.swap(modes.vectors);
  return out;
}

InteriorModes own_modes(const PartitionedModel& part, const sparse::Factor& factor_ii,
                        const ModeRequest& request) {
  const MatrixXd motions = part.rows_of_whole(part.free.q);
  sparse::EigenOptions options = eigen_options(request);
  options.rigid = motions;
  if (request.count > 0) options.count += static_cast<int>(motions.cols());
  const sparse::ModeSet modes = sparse::solve_modes(part.whole(), options);
  InteriorModes out;
  take_report(modes, request, out);
  out.accurate_to_hz = out.cutoff_hz;
  out.own_modes = std::max(0, modes.size() - static_cast<int>(motions.cols()));
  MatrixXd shapes(part.whole().rows(), motions.cols() + out.own_modes);
  shapes.leftCols(motions.cols()) = motions;
  shapes.rightCols(out.own_modes) = modes.vectors.rightCols(out.own_modes);
  const MatrixXd inertia = *part.whole().mass({}) * shapes;
  const MatrixXd force = inertia(part.interior_of_whole, Eigen::all);
  ShapeBasis basis =
      shape_basis(factor_ii.solve(force), MatrixXd(force.rows(), 0), part.interior());
  if (!basis.dependent.empty())
    warn(fmt::format("{} of {} rigid and own modes depend on the static shapes and were dropped",
                     basis.dependent.size(), force.cols()));
  out.dropped = static_cast<int>(basis.dependent.size());
  out.hz = basis.values.unaryExpr(&sparse::hz_of_value);
  out.vectors.swap(basis.vectors);
  return out;
}

/// f_i of the named loads, n_i x loads.
MatrixXd interior_loads(const PartitionedModel& part, const std::vector<std::string>& names) {
  const fe::FeModel& model = part.full;
  const std::vector<int32_t>& interior = part.dofs.interior;
  MatrixXd forces(static_cast<Index>(interior.size()), static_cast<Index>(names.size()));
  for (Index j = 0; j < forces.cols(); ++j) {
    const std::string& name = names[j];
    const Eigen::VectorXd& load =
        find_named(model.loads, model.name + ": load_shapes", "load", name);
    if (model.prescribed.contains(name))
      throw InputError(
          fmt::format("{}: load_shapes: found \"{}\", which prescribes the displacement "
                      "of a support, expected forces",
                      model.name, name));
    forces.col(j) = load(interior);
  }
  return forces;
}

void append_load_shapes(const MatrixXd& forces, const PartitionedModel& part,
                        const sparse::Factor& factor_ii, const std::vector<std::string>& names,
                        InteriorModes& out) {
  const ShapeBasis basis = shape_basis(factor_ii.solve(forces), out.vectors, part.interior());
  std::vector<std::string> dropped;
  for (const int j : basis.dependent) dropped.push_back(names[j]);
  if (!dropped.empty())
    warn(fmt::format("load shapes that depend on other vectors were dropped: {}",
                     fmt::join(dropped, ", ")));
  const Index k = out.vectors.cols(), m = basis.vectors.cols();
  out.vectors.conservativeResize(Eigen::NoChange, k + m);
  out.vectors.rightCols(m) = basis.vectors;
  out.hz.conservativeResize(k + m);
  out.hz.tail(m) = basis.values.unaryExpr(&sparse::hz_of_value);
  out.load_shapes = static_cast<int>(m);
  out.dropped += static_cast<int>(dropped.size());
}

}  // namespace

InteriorModes interior_modes(const PartitionedModel& part, const sparse::Factor& factor_ii,
                             const ModeRequest& request, StepClock& clock) {
  const MatrixXd forces = interior_loads(part, request.load_shapes);
  InteriorModes out = request.own_modes ? own_modes(part, factor_ii, request)
                                        : fixed_interface_modes(part, factor_ii, request);
  if (request.accurate_to_hz > 0.0) out.accurate_to_hz = request.accurate_to_hz;
  clock.lap(fmt::format("{} {} modes", request.own_modes ? out.own_modes : out.vectors.cols(),
                        request.own_modes ? "own" : "fixed-interface"));
  if (forces.cols() == 0) return out;
  append_load_shapes(forces, part, factor_ii, request.load_shapes, out);
  clock.lap(fmt::format("{} load shapes", out.load_shapes));
  return out;
}

}  // namespace clatter::condense
