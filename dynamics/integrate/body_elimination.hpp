// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Elimination of one body after the other from the stage equations.
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "dynamics/integrate/dense_lu.hpp"
#include "dynamics/integrate/elimination_order.hpp"

namespace clatter::dynamics {

/// The equations y = r + S T y: S couples the unknowns of a body, T those of a coupling.
struct StageGraph {
  struct Body {
    int first = 0, size = 0;  // unknowns of a body follow each other
    size_t S = 0;             // where its S begins in `S`
  };
  /// All unknowns of a body, or those of a wide one that the same couplings touch.
  struct Node {
    int first = 0, size = 0;
  };
  struct Coupling {
    std::vector<int> nodes;
    std::vector<int> node, row;  // of each coordinate: its node and where it is there
    bool active = false;         // else its T is zero
    // Of the last evaluation: T, and the coordinates that are its rows; null: all.
    const Eigen::MatrixXd* tangent = nullptr;
    const std::vector<int>* touched = nullptr;
    int rows() const { return static_cast<int>(tangent->rows()); }
    size_t coordinate(int i) const {
      return static_cast<size_t>(touched == nullptr ? i : (*touched)[i]);
    }
  };
  std::vector<Body> bodies;
  std::vector<Node> nodes;  // body by body
  std::vector<Coupling> couplings;
  std::vector<double> S;  // of all bodies

  Eigen::Map<const Eigen::MatrixXd> S_of(const Body& body) const {
    return {S.data() + body.S, body.size, body.size};
  }
};

/// Factors I - S T of a graph body by body. With F = T at first, body c leaves to those with which
/// it is coupled then, N, forces that depend on their displacements alone:
///
///   J_c = I - S_c F_cc,   X = J_c^-1 S_c F_cN,   F_NN <- F_NN + F_Nc X,
///
/// and for a right-hand side r, with forces f that are 0 at first,
///
///   w_c = J_c^-1 (r_c + S_c f_c),   f_N <- f_N + F_Nc w_c,   at last y_c = w_c + X y_N.
///
/// These are static condensations with dynamic stiffnesses F - S_c^-1, S_c being singular or not.
/// The bodies that stay are solved together with a dense factor. F is added up front by front, a
/// front being a body with its N (multifrontal method, Duff and Reid 1983).
class BodyElimination {
 public:
  /// Most unknowns of a body that is eliminated.
  static constexpr int kMostUnknowns = 24;

  /// @param stays per body of the graph, 1: it stays; bodies of several nodes have to.
  BodyElimination(const StageGraph& graph, const std::vector<char>& stays);

  /// Factors; `renewed`: other couplings are active than before. False when a matrix is singular or
  /// not finite, or when cancellation in F shows that a body should not have been eliminated.
  [[nodiscard]] bool factor(const StageGraph& graph, bool renewed);
  /// x <- (I - S T)^-1 x, by unknowns.
  void solve(const StageGraph& graph, double* x) const;

 private:
  /// An eliminated body c.
  struct Front {
    int node = 0, body = 0;
    int first = 0;             // unknown of c
    int size = 0, others = 0;  // n of c, m of N
    int step = 0;              // of the order
    size_t places = 0;         // of N's unknowns, in places_
    size_t factors = 0;        // in factors_: J_c^-1 (n x n), F_Nc (m x n), X^T (m x n)
    size_t update = 0;         // in updates_: what c gives F_NN, m x m
    int child = -1, sibling = -1;
    int coupling = -1;  // the first of those whose first body is c
  };
  /// A body among those that stay.
  struct Last {
    int body = 0, first = 0;  // in the rows of the dense factor
  };

  void find_fronts(const StageGraph& graph);
  void add_up_sizes(const StageGraph& graph);
  bool has_grown(const StageGraph& graph, const StageGraph::Body& body, const double* F,
                 Eigen::Index rows) const;
  void add_coupling(const StageGraph::Coupling& coupling, Eigen::Map<Eigen::MatrixXd> F);
  void add_update(const StageGraph& graph, const Front& child, Eigen::Map<Eigen::MatrixXd> F);
  bool factor_front(const StageGraph& graph, const Front& front);
  template <int kSize>
  bool eliminate(const StageGraph& graph, const Front& front);
  bool factor_end(const StageGraph& graph);
  template <int kSize>
  void solve_down(const StageGraph& graph, const Front& front, double* x) const;
  template <int kSize>
  void solve_up(const Front& front, double* x) const;
  void solve_end(const StageGraph& graph, double* x) const;

  EliminationOrder order_;
  std::vector<Last> end_;
  int end_rows_ = 0;
  std::vector<int> body_;       // of a node
  std::vector<int> end_place_;  // of a node: its first row in the end; -1: it is eliminated

  std::vector<Front> fronts_;
  std::vector<int> next_coupling_;  // of a coupling: the next one of its front
  std::vector<int> places_;         // unknowns
  int end_child_ = -1, end_coupling_ = -1;
  std::vector<int> offset_;  // of a node in the front that is added up
  std::vector<int> map_;     // of a child's or a coupling's rows in it
  std::vector<double> front_, factors_, updates_;
  std::vector<double> size_;  // of an unknown: S_ii times the sum of all |T_ii|
  Eigen::MatrixXd F_end_;
  DenseLu lu_;
  mutable std::vector<double> forces_, part_;  // working memory: no solve takes memory
};

}  // namespace clatter::dynamics
