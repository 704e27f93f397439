// SPDX-License-Identifier: GPL-3.0-or-later
// CONM1, and the DMIG that K2GG and M2GG choose.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;

constexpr int64_t kMostRows = 4096;  // of a dense matrix of 128 MB

// m I and nothing else: a plain mass.
bool is_plain(const MatrixXd& M) {
  MatrixXd rest = M;
  rest.topLeftCorner<3, 3>() -= M(0, 0) * Matrix3d::Identity();
  return rest.isZero(0.0);
}

void add_mass_matrix(Model& model, const RawMassMatrix& raw) {
  MatrixXd M(6, 6);
  size_t next = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) M(i, j) = M(j, i) = raw.lower[next++];
  M *= model.raw.control.mass_factor;
  const NodeIndex node_index = model.require(raw.grid, raw.origin);
  const Matrix3d axes =
      model.systems.directions(raw.system, model.node_map.position(node_index), raw.origin);
  MatrixXd turn = MatrixXd::Zero(6, 6);
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = axes;
  const std::string where = model.source.where(raw.origin);
  if (is_plain(M)) {
    if (M(0, 0) != 0.0) model.deck.masses.push_back({where, node_index, M(0, 0)});
    return;
  }
  const bool turns = model.node_map.turns(node_index);
  if (!turns && !M.bottomRows<3>().isZero(0.0))
    model.source.fail(raw.origin,
                      fmt::format("CONM1: found an inertia or offset on node {} of solids, which "
                                  "has no rotations, expected masses alone",
                                  raw.grid));
  NodalMatrix matrix{fmt::format("conm1_{}", model.deck.matrices.size() + 1), where, true, {}, {}};
  const Eigen::Index n = turns ? 6 : 3;
  for (int d = 0; d < n; ++d) matrix.terms.push_back({node_index, d, 1.0});
  matrix.values = (turn * M * turn.transpose()).topLeftCorner(n, n);
  model.deck.matrices.push_back(std::move(matrix));
}

/// A DMIG on the basic directions of its grids.
class Direct {
 public:
  Direct(Model& model, const std::string& name, const RawDirect& raw)
      : model_(model), name_(name), raw_(raw) {}

  NodalMatrix build(double factor, bool is_mass) {
    check();
    NodalMatrix matrix{name_, model_.source.where(raw_.origin), is_mass, {}, {}};
    for (const RawDirect::Entry& entry : raw_.entries)
      for (int end = 0; end < 2; ++end) row_of(entry, end, matrix.terms);
    if (static_cast<int64_t>(matrix.terms.size()) > kMostRows)
      fail(fmt::format("found {} rows, expected at most {}", matrix.terms.size(), kMostRows));
    const auto n = static_cast<Eigen::Index>(matrix.terms.size());
    matrix.values = MatrixXd::Zero(n, n);
    for (const RawDirect::Entry& entry : raw_.entries) add(entry, factor, matrix);
    if (n > 0) require_symmetric(matrix);  // a header alone is a matrix of zeros
    return matrix;
  }

 private:
  void check() const {
    if (raw_.form == 0) fail("found no header (NAME 0 IFO ...), expected one");
    if (raw_.form == RawDirect::kComplex) fail("found complex numbers, expected real ones");
    if (raw_.form != RawDirect::kSymmetric && raw_.form != 1)
      fail(fmt::format("found IFO {}, expected 6 (symmetric) or 1 (square)", raw_.form));
  }

  /// First of the rows of the end's grid: three for displacements or rotations along other axes,
  /// else one.
  size_t row_of(const RawDirect::Entry& entry, int end, std::vector<Equation::Term>& terms) {
    const int32_t grid = entry.grid[end];
    const NodeIndex node_index = model_.require(grid, raw_.origin);
    const int direction = model_.direction_at(grid, entry.direction[end], raw_.origin);
    if (direction >= 3 && !model_.node_map.turns(node_index))
      fail(fmt::format("found a rotation of node {} of solids, which has none", grid));
    const bool turned = model_.node_map.displacement_system(node_index) != 0;
    const int first = turned ? direction / 3 * 3 : direction;
    const auto [at, fresh] = rows_.try_emplace({node_index, first, turned}, terms.size());
    for (int k = 0; fresh && k < (turned ? 3 : 1); ++k)
      terms.push_back({node_index, first + k, 1.0});
    return at->second;
  }

  /// The components of the end's direction on its rows.
  Eigen::VectorXd along(const RawDirect::Entry& entry, int end) {
    const NodeIndex node_index = model_.require(entry.grid[end], raw_.origin);
    const int32_t system = model_.node_map.displacement_system(node_index);
    if (system == 0) return Eigen::VectorXd::Ones(1);
    const int direction = entry.direction[end];
    return model_.systems.directions(system, model_.node_map.position(node_index), raw_.origin)
        .col(direction % 3);
  }

  void add(const RawDirect::Entry& entry, double factor, NodalMatrix& matrix) {
    const auto column = static_cast<Eigen::Index>(row_of(entry, 0, matrix.terms));
    const auto row = static_cast<Eigen::Index>(row_of(entry, 1, matrix.terms));
    const Eigen::VectorXd a = along(entry, 0), b = along(entry, 1);
    const MatrixXd part = factor * entry.value * b * a.transpose();
    matrix.values.block(row, column, b.size(), a.size()) += part;
    const bool diagonal =
        entry.grid[0] == entry.grid[1] && entry.direction[0] == entry.direction[1];
    if (raw_.form == RawDirect::kSymmetric && !diagonal)
      matrix.values.block(column, row, a.size(), b.size()) += part.transpose();
  }

  void require_symmetric(NodalMatrix& matrix) const {
    const MatrixXd twice = matrix.values + matrix.values.transpose();
    const double skew = (matrix.values - matrix.values.transpose()).cwiseAbs().maxCoeff();
    if (!(skew <= 1e-6 * twice.cwiseAbs().maxCoeff()))
      fail("found a matrix that is not symmetric, expected a symmetric one");
    matrix.values = 0.5 * twice;
  }

  [[noreturn]] void fail(const std::string& message) const {
    model_.source.fail(raw_.origin, fmt::format("DMIG {}: {}", name_, message));
  }

  Model& model_;
  const std::string& name_;
  const RawDirect& raw_;
  std::map<std::tuple<NodeIndex, int, bool>, size_t> rows_;
};

void add_direct(Model& model, const std::string& name, double factor, bool is_mass) {
  const auto found = model.raw.direct.find(name);
  if (found == model.raw.direct.end())
    throw InputError(fmt::format("{}: {}2GG = {}: found no DMIG of this name",
                                 model.source.files().front(), is_mass ? "M" : "K", name));
  NodalMatrix matrix = Direct(model, name, found->second).build(factor, is_mass);
  if (!matrix.terms.empty()) model.deck.matrices.push_back(std::move(matrix));
  found->second.form = RawDirect::kUsed;
}

}  // namespace

void build_matrices(Model& model) {
  Refusals& refusals = model.refusals;
  for (const RawMassMatrix& raw : model.raw.mass_matrices)
    refusals.attempt([&] { add_mass_matrix(model, raw); });
  const Control& control = model.raw.control;
  for (const auto& [name, factor] : control.direct_stiffness)
    refusals.attempt([&, &one = name, by = factor] {
      add_direct(model, one, by * control.direct_stiffness_factor, false);
    });
  for (const auto& [name, factor] : control.direct_mass)
    refusals.attempt([&, &one = name, by = factor] {
      add_direct(model, one, by * control.direct_mass_factor, true);  // WTMASS does not count
    });
  for (const auto& [name, direct] : model.raw.direct)
    if (direct.form != RawDirect::kUsed)
      refusals.contents().pass("matrix", "DMIG " + name, model.source, direct.origin,
                               "not chosen by the case control");
}

}  // namespace clatter::mesh::deck::nastran
