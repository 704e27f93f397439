// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/body_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "dynamics/integrate/small_inverse.hpp"

namespace clatter::dynamics {

using Eigen::Dynamic;
using Eigen::Index;
using Eigen::Map;
using Eigen::Matrix;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Growth of F beyond the sum of all |T| that loses half of the digits.
constexpr double kMostGrowth = 1e8;

std::vector<int> sizes_of(const StageGraph& graph) {
  std::vector<int> sizes;
  for (const StageGraph::Node& node : graph.nodes) sizes.push_back(node.size);
  return sizes;
}

/// The body of each node.
std::vector<int> bodies_of(const StageGraph& graph) {
  std::vector<int> bodies;
  int body = 0;
  for (const StageGraph::Node& node : graph.nodes) {
    while (node.first >= graph.bodies[body].first + graph.bodies[body].size) ++body;
    bodies.push_back(body);
  }
  return bodies;
}

std::vector<char> stays_of(const std::vector<int>& bodies, const std::vector<char>& stays) {
  std::vector<char> found;
  for (const int body : bodies) found.push_back(stays[body]);
  return found;
}

/// Calls `visit` with the number of rows as a constant where it is frequent: of a point on a slide,
/// of bodies in a plane and in space.
template <typename Visit>
auto with_size(int size, const Visit& visit) {
  switch (size) {
    case 1:
      return visit(std::integral_constant<int, 1>());
    case 3:
      return visit(std::integral_constant<int, 3>());
    case 6:
      return visit(std::integral_constant<int, 6>());
    default:
      return visit(std::integral_constant<int, Dynamic>());
  }
}

template <typename T>
void grow(std::vector<T>& memory, size_t size) {
  if (memory.size() < size) memory.resize(size);
}

}  // namespace

BodyElimination::BodyElimination(const StageGraph& graph, const std::vector<char>& stays)
    : order_(sizes_of(graph), stays_of(bodies_of(graph), stays)), body_(bodies_of(graph)) {
  std::vector<int> first(graph.bodies.size(), -1);
  int unknowns = 0;
  for (size_t b = 0; b < graph.bodies.size(); ++b) {
    unknowns += graph.bodies[b].size;
    if (stays[b] == 0) continue;
    end_.push_back({static_cast<int>(b), end_rows_});
    first[b] = end_rows_;
    end_rows_ += graph.bodies[b].size;
  }
  for (size_t i = 0; i < graph.nodes.size(); ++i) {
    const auto b = static_cast<size_t>(body_[i]);
    end_place_.push_back(first[b] < 0 ? -1
                                      : first[b] + graph.nodes[i].first - graph.bodies[b].first);
  }
  offset_.resize(graph.nodes.size());
  next_coupling_.resize(graph.couplings.size());
  fronts_.reserve(graph.nodes.size());
  size_.resize(unknowns);
  forces_.resize(unknowns);
  part_.resize(unknowns);
  map_.resize(unknowns);
  F_end_.resize(end_rows_, end_rows_);
}

/// The order of the bodies for the couplings that are active, and the memory of their fronts.
void BodyElimination::find_fronts(const StageGraph& graph) {
  order_.clear();
  for (const StageGraph::Coupling& coupling : graph.couplings)
    if (coupling.active) order_.couple(coupling.nodes);
  order_.find();
  fronts_.clear();
  places_.clear();
  end_child_ = end_coupling_ = -1;
  size_t factors = 0, updates = 0, largest = 0;
  for (const EliminationOrder::Step& step : order_.steps()) {
    Front front;
    front.node = step.node;
    front.body = body_[step.node];
    front.first = graph.nodes[step.node].first;
    front.size = graph.nodes[step.node].size;
    front.step = static_cast<int>(fronts_.size());
    front.places = places_.size();
    for (const int other : order_.neighbours(step)) {
      const StageGraph::Node& node = graph.nodes[other];
      for (int k = 0; k < node.size; ++k) places_.push_back(node.first + k);
    }
    front.others = static_cast<int>(places_.size() - front.places);
    const auto n = static_cast<size_t>(front.size), m = static_cast<size_t>(front.others);
    front.factors = factors;
    front.update = updates;
    factors += n * (n + 2 * m);
    updates += m * m;
    largest = std::max(largest, (n + m) * (n + m));
    fronts_.push_back(front);
  }
  for (Front& front : fronts_) {
    const int parent = order_.steps()[front.step].parent;
    int& first = parent < 0 ? end_child_ : fronts_[parent].child;
    front.sibling = std::exchange(first, front.step);
  }
  for (size_t i = 0; i < graph.couplings.size(); ++i) {
    if (!graph.couplings[i].active) continue;
    int first = -1;
    for (const int node : graph.couplings[i].nodes) {
      const int step = order_.step_of(node);
      if (step >= 0 && (first < 0 || step < first)) first = step;
    }
    int& list = first < 0 ? end_coupling_ : fronts_[first].coupling;
    next_coupling_[i] = std::exchange(list, static_cast<int>(i));
  }
  grow(factors_, factors);
  grow(updates_, updates);
  grow(front_, largest);
}

/// What F is compared with to see whether it has grown.
void BodyElimination::add_up_sizes(const StageGraph& graph) {
  std::fill(size_.begin(), size_.end(), 0.0);
  for (const StageGraph::Coupling& coupling : graph.couplings) {
    for (int i = 0; coupling.active && i < coupling.rows(); ++i) {
      const size_t at = coupling.coordinate(i);
      const StageGraph::Node& node = graph.nodes[coupling.node[at]];
      size_[node.first + coupling.row[at]] += std::abs((*coupling.tangent)(i, i));
    }
  }
}

bool BodyElimination::has_grown(const StageGraph& graph, const StageGraph::Body& body,
                                const double* F, Index rows) const {
  const auto S = graph.S_of(body);
  double largest = 0.0, usual = 1.0;
  for (Index i = 0; i < body.size; ++i) {
    const double now = std::abs(F[i * (rows + 1)] * S(i, i));
    if (!(now <= largest)) largest = now;  // a NaN is kept
    usual = std::max(usual, size_[body.first + i] * S(i, i));
  }
  return !(largest <= kMostGrowth * usual);
}

/// Adds T to the front whose nodes are at offset_.
void BodyElimination::add_coupling(const StageGraph::Coupling& coupling, Map<MatrixXd> F) {
  const MatrixXd& T = *coupling.tangent;
  for (int i = 0; i < coupling.rows(); ++i) {
    const size_t at = coupling.coordinate(i);
    map_[i] = offset_[coupling.node[at]] + coupling.row[at];
  }
  for (Index j = 0; j < T.cols(); ++j) {
    double* const column = F.col(map_[j]).data();
    const double* const values = T.col(j).data();
    for (Index i = 0; i < T.rows(); ++i) column[map_[i]] += values[i];
  }
}

/// Adds what a child left to the front whose nodes are at offset_.
void BodyElimination::add_update(const StageGraph& graph, const Front& child, Map<MatrixXd> F) {
  const int m = child.others;
  int* row = map_.data();
  for (const int i : order_.neighbours(order_.steps()[child.step]))
    for (int k = 0; k < graph.nodes[i].size; ++k) *row++ = offset_[i] + k;
  const double* values = updates_.data() + child.update;
  for (int j = 0; j < m; ++j, values += m) {
    double* const column = F.col(map_[j]).data();
    for (int i = 0; i < m; ++i) column[map_[i]] += values[i];
  }
}

/// Adds up F of a front and eliminates its body.
bool BodyElimination::factor_front(const StageGraph& graph, const Front& front) {
  const int rows = front.size + front.others;
  std::fill_n(front_.data(), static_cast<size_t>(rows) * static_cast<size_t>(rows), 0.0);
  offset_[front.node] = 0;
  int at = front.size;
  for (const int i : order_.neighbours(order_.steps()[front.step])) {
    offset_[i] = at;
    at += graph.nodes[i].size;
  }
  const Map<MatrixXd> F(front_.data(), rows, rows);
  for (int i = front.coupling; i >= 0; i = next_coupling_[i]) add_coupling(graph.couplings[i], F);
  for (int i = front.child; i >= 0; i = fronts_[i].sibling) add_update(graph, fronts_[i], F);
  if (has_grown(graph, graph.bodies[front.body], front_.data(), rows)) return false;
  return with_size(front.size, [&](auto size) { return eliminate<size()>(graph, front); });
}

template <int kSize>
bool BodyElimination::eliminate(const StageGraph& graph, const Front& front) {
  const Index n = front.size, m = front.others;
  const Map<MatrixXd> F(front_.data(), n + m, n + m);
  const Map<const Matrix<double, kSize, kSize>> S(graph.S.data() + graph.bodies[front.body].S, n,
                                                  n);
  double* const factors = factors_.data() + front.factors;
  Map<Matrix<double, kSize, kSize>> inverse(factors, n, n);
  Map<Matrix<double, Dynamic, kSize>> F_Nc(factors + n * n, m, n);
  Map<Matrix<double, Dynamic, kSize>> X(factors + n * (n + m), m, n);  // transposed
  Matrix<double, kSize, kSize, 0, kSize == Dynamic ? kMostUnknowns : kSize,
         kSize == Dynamic ? kMostUnknowns : kSize>
      G;
  inverse = -S.lazyProduct(F.template topLeftCorner<kSize, kSize>(n, n));
  inverse.diagonal().array() += 1.0;
  if (!invert_small(inverse)) return false;
  G = inverse.lazyProduct(S);
  F_Nc = F.template bottomLeftCorner<Dynamic, kSize>(m, n);
  const auto F_cN = F.template topRightCorner<kSize, Dynamic>(n, m);
  X = F_cN.transpose().lazyProduct(G.transpose());
  Map<MatrixXd> update(updates_.data() + front.update, m, m);
  update = F.bottomRightCorner(m, m);
  update += F_Nc.lazyProduct(X.transpose());
  return true;
}

bool BodyElimination::factor_end(const StageGraph& graph) {
  if (end_rows_ == 0) return true;
  F_end_.setZero();
  const Map<MatrixXd> F(F_end_.data(), end_rows_, end_rows_);
  for (size_t i = 0; i < offset_.size(); ++i) offset_[i] = end_place_[i];
  for (int i = end_coupling_; i >= 0; i = next_coupling_[i]) add_coupling(graph.couplings[i], F);
  for (int i = end_child_; i >= 0; i = fronts_[i].sibling) add_update(graph, fronts_[i], F);
  auto J = lu_.matrix(end_rows_);
  for (const Last& last : end_) {
    const StageGraph::Body& body = graph.bodies[last.body];
    if (has_grown(graph, body, &F_end_(last.first, last.first), end_rows_)) return false;
    J.middleRows(last.first, body.size).noalias() =
        -graph.S_of(body) * F_end_.middleRows(last.first, body.size);
  }
  J.diagonal().array() += 1.0;
  return lu_.factor();
}

bool BodyElimination::factor(const StageGraph& graph, bool renewed) {
  if (renewed) find_fronts(graph);
  add_up_sizes(graph);
  for (const Front& front : fronts_)
    if (!factor_front(graph, front)) return false;
  return factor_end(graph);
}

template <int kSize>
void BodyElimination::solve_down(const StageGraph& graph, const Front& front, double* x) const {
  const Index n = front.size, m = front.others;
  const StageGraph::Body& body = graph.bodies[front.body];
  using Vector = Matrix<double, kSize, 1, 0, kSize == Dynamic ? kMostUnknowns : kSize, 1>;
  const Map<const Matrix<double, kSize, kSize>> S(graph.S.data() + body.S, n, n),
      inverse(factors_.data() + front.factors, n, n);
  const Map<const Matrix<double, Dynamic, kSize>> F_Nc(factors_.data() + front.factors + n * n, m,
                                                       n);
  Map<Matrix<double, kSize, 1>> w(x + body.first, n);
  const Map<const Matrix<double, kSize, 1>> f(forces_.data() + body.first, n);
  const Vector right = w + S.lazyProduct(f);
  w = inverse.lazyProduct(right);
  Map<VectorXd> forces(part_.data(), m);
  forces = F_Nc.lazyProduct(w);
  const int* const places = places_.data() + front.places;
  for (Index i = 0; i < m; ++i) forces_[places[i]] += forces(i);
}

template <int kSize>
void BodyElimination::solve_up(const Front& front, double* x) const {
  const Index n = front.size, m = front.others;
  const Map<const Matrix<double, Dynamic, kSize>> X(factors_.data() + front.factors + n * (n + m),
                                                    m, n);
  const int* const places = places_.data() + front.places;
  Map<VectorXd> y(part_.data(), m);
  for (Index i = 0; i < m; ++i) y(i) = x[places[i]];
  double* const own = x + front.first;
  for (Index k = 0; k < n; ++k) own[k] += X.col(k).dot(y);
}

void BodyElimination::solve_end(const StageGraph& graph, double* x) const {
  if (end_rows_ == 0) return;
  for (const Last& last : end_) {
    const StageGraph::Body& body = graph.bodies[last.body];
    Map<VectorXd> right(part_.data() + last.first, body.size);
    right = Map<const VectorXd>(x + body.first, body.size);
    right.noalias() +=
        graph.S_of(body) * Map<const VectorXd>(forces_.data() + body.first, body.size);
  }
  lu_.solve(part_.data());
  for (const Last& last : end_) {
    const StageGraph::Body& body = graph.bodies[last.body];
    std::copy_n(part_.data() + last.first, body.size, x + body.first);
  }
}

void BodyElimination::solve(const StageGraph& graph, double* x) const {
  std::fill(forces_.begin(), forces_.end(), 0.0);
  for (const Front& front : fronts_)
    with_size(front.size, [&](auto size) { solve_down<size()>(graph, front, x); });
  solve_end(graph, x);
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front)
    with_size(front->size, [&](auto size) { solve_up<size()>(*front, x); });
}

}  // namespace clatter::dynamics
