// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// In which order coupled unknowns are eliminated.
#include <cstdint>
#include <span>
#include <vector>

namespace clatter::dynamics {

/// Order of the elimination of nodes, groups of unknowns that are eliminated together, from
/// symmetric couplings: in rounds, each of nodes that are not coupled with each other and cost
/// little now (multiple minimum degree, Liu 1985). A chain takes a number of rounds that grows with
/// the logarithm of its links, and the couplings are found in time proportional to them.
/// Takes memory when it is made and, rarely, when a search finds more couplings than all before.
class EliminationOrder {
 public:
  /// A node that is eliminated, and those it is coupled with then.
  struct Step {
    int node = 0;
    int parent = -1;           // step of the one of these that is eliminated first; -1: none is
    int first = 0, count = 0;  // in neighbours()
  };

  /// @param sizes unknowns of each node. @param stays 1: is not eliminated.
  EliminationOrder(std::vector<int> sizes, const std::vector<char>& stays);

  /// No couplings.
  void clear();
  /// Couples all of these nodes with each other.
  void couple(std::span<const int> nodes);
  /// Finds the steps; the couplings are used up.
  void find();

  const std::vector<Step>& steps() const { return steps_; }
  std::span<const int> neighbours(const Step& step) const {
    return {neighbours_.data() + step.first, static_cast<size_t>(step.count)};
  }
  /// The step of a node; -1: it stays.
  int step_of(int node) const { return step_of_[node]; }

 private:
  using Word = std::uint64_t;
  Word* row(int node) { return coupled_.data() + static_cast<size_t>(node) * words_; }
  template <typename Visit>
  void visit(const Word* bits, const Visit& visit) const;
  void find_cost(int node);
  void eliminate(int node);

  std::vector<int> sizes_, all_;  // of all nodes; those that do not stay
  size_t words_;
  std::vector<Word> coupled_;          // a row of bits per node
  std::vector<Word> there_, blocked_;  // nodes that are left; coupled with one of this round
  std::vector<double> cost_;
  std::vector<int> left_, step_of_, neighbours_;
  std::vector<Step> steps_;
};

}  // namespace clatter::dynamics
