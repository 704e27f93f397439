// SPDX-License-Identifier: GPL-3.0-or-later
// RBAR and RBE1 with independent DoFs at several grids, RROD.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <bit>

#include "mesh/deck/nastran/dependent_rows.hpp"
#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::Vector3d;

constexpr double kSingular = 1e-10;

/// One direction of one independent grid.
struct Independent {
  std::vector<Equation::Term> terms;
  RowVectorXd motion;  // its displacement in terms of the six motions of the body
};

class Link {
 public:
  Link(Model& model, const RawLink& raw) : model_(model), raw_(raw) {
    for (const RawLink::End& end : raw.independent) model.require(end.grid, raw.origin);
    at_ = model.node_map.position(model.require(raw.independent[0].grid, raw.origin));
    for (const auto* ends : {&raw.independent, &raw.dependent})
      for (const RawLink::End& end : *ends)
        if (end.dofs != 0) size_ = std::max(size_, (position(end.grid) - at_).norm());
    if (!(size_ > 0.0)) size_ = 1.0;
  }

  // u_d = m_d q with the motion q of the body from u_i = R q of the independent directions.
  void build() {
    gather();
    const MatrixXd inverse = motion_from_independent();
    for (const RawLink::End& end : raw_.dependent) {
      const NodeIndex node_index = model_.require(end.grid, raw_.origin);
      for (DependentRow& row : dependent_rows(model_, node_index, end.dofs, raw_.origin)) {
        const RowVectorXd share = motion(row.base, row.direction, position(end.grid)) * inverse;
        for (size_t i = 0; i < independent_.size(); ++i)
          for (const Equation::Term& term : independent_[i].terms)
            if (std::abs(share(static_cast<Eigen::Index>(i))) > kSingular)
              add_term(row.equation.terms, term.node_index, term.direction,
                       -share(static_cast<Eigen::Index>(i)) * term.coefficient);
        model_.deck.equations.push_back(std::move(row.equation));
      }
    }
  }

  // a . (u_B - u_A) = 0 along the rod.
  void build_rod() {
    const RawLink::End &a = raw_.dependent[0], &b = raw_.dependent[1];
    const RawLink::End& dependent = a.dofs != 0 ? a : b;
    const NodeIndex at_a = model_.require(a.grid, raw_.origin),
                    at_b = model_.require(b.grid, raw_.origin);
    const Vector3d along = (position(b.grid) - position(a.grid)).normalized();
    if (!along.allFinite()) fail("found both grids at one point, expected a length");
    const NodeIndex first = a.dofs != 0 ? at_a : at_b, second = a.dofs != 0 ? at_b : at_a;
    const int32_t system = model_.node_map.displacement_system(first);
    const Vector3d own = model_.systems.directions(system, position(dependent.grid), raw_.origin)
                             .col(std::countr_zero(dependent.dofs));
    if (!(std::abs(own.dot(along)) > kSingular))
      fail("found a dependent component across the rod, expected one along it");
    Equation equation{model_.source.where(raw_.origin), {}};
    Eigen::Index largest = 0;
    along.cwiseAbs().maxCoeff(&largest);
    add_term(equation.terms, first, static_cast<int>(largest), along[largest]);
    for (int k = 0; k < 3; ++k)
      if (k != largest) add_term(equation.terms, first, k, along[k]);
    for (int k = 0; k < 3; ++k) add_term(equation.terms, second, k, -along[k]);
    model_.deck.equations.push_back(std::move(equation));
  }

 private:
  Vector3d position(int32_t grid) {
    return model_.node_map.position(model_.require(grid, raw_.origin));
  }

  /// t . (u + theta x (x - x_0)), or t . theta; lengths in units of the element's size.
  RowVectorXd motion(int base, const Vector3d& t, const Vector3d& x) const {
    RowVectorXd row = RowVectorXd::Zero(6);
    if (base == 0) {
      row.head<3>() = t.transpose();
      row.tail<3>() = ((x - at_).cross(t) / size_).transpose();
    } else {
      row.tail<3>() = (t / size_).transpose();
    }
    return row;
  }

  void gather() {
    for (const RawLink::End& end : raw_.independent) {
      const NodeIndex node_index = model_.require(end.grid, raw_.origin);
      const int32_t system = model_.node_map.displacement_system(node_index);
      const auto axes = model_.systems.directions(system, position(end.grid), raw_.origin);
      for (int d = 0; d < 6; ++d)
        if (end.dofs >> d & 1)
          independent_.push_back({terms_along(model_, node_index, d, 1.0, raw_.origin),
                                  motion(d < 3 ? 0 : 3, axes.col(d % 3), position(end.grid))});
    }
  }

  /// q = R^-1 u. Of fewer than six DoFs, all of one grid, the other motions are none: so does
  /// Nastran.
  MatrixXd motion_from_independent() {
    const auto n = static_cast<Eigen::Index>(independent_.size());
    MatrixXd R(n, 6);
    for (Eigen::Index i = 0; i < n; ++i) R.row(i) = independent_[i].motion;
    const bool one_grid = std::count_if(raw_.independent.begin(), raw_.independent.end(),
                                        [](const RawLink::End& end) { return end.dofs != 0; }) == 1;
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr;
    qr.setThreshold(kSingular);
    qr.compute(R);
    if (n > 6 || qr.rank() < n || (n < 6 && !one_grid))
      fail(
          fmt::format("found {} independent components, of which {} hold it, expected six that "
                      "hold a rigid body",
                      n, qr.rank()));
    if (n < 6)
      model_.deck.notes.push_back(
          fmt::format("{}: {}: {} independent components: the other motions are taken as none",
                      model_.source.where(raw_.origin), raw_.name, n));
    return qr.pseudoInverse();
  }

  [[noreturn]] void fail(const std::string& message) const {
    model_.source.fail(raw_.origin, fmt::format("{}: {}", raw_.name, message));
  }

  Model& model_;
  const RawLink& raw_;
  Vector3d at_;
  double size_ = 0.0;
  std::vector<Independent> independent_;
};

void add_link(Model& model, const RawLink& raw) {
  Link link(model, raw);
  if (raw.along_only) return link.build_rod();
  link.build();
}

}  // namespace

void build_links(Model& model) {
  for (const RawLink& raw : model.raw.links) {
    model.refusals.attempt([&] { add_link(model, raw); });
  }
}

}  // namespace clatter::mesh::deck::nastran
