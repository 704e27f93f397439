// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/elimination_order.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace clatter::dynamics {

namespace {

constexpr int kBits = 64;
/// Nodes of a round cost at most this multiple of the cheapest: those within a chain as well as
/// those at its ends.
constexpr double kAlike = 2.5;

}  // namespace

EliminationOrder::EliminationOrder(std::vector<int> sizes, const std::vector<char>& stays)
    : sizes_(std::move(sizes)), words_((sizes_.size() + kBits - 1) / kBits) {
  for (size_t i = 0; i < sizes_.size(); ++i)
    if (stays[i] == 0) all_.push_back(static_cast<int>(i));
  coupled_.resize(sizes_.size() * words_);
  there_.resize(words_);
  blocked_.resize(words_);
  cost_.resize(sizes_.size());
  step_of_.resize(sizes_.size());
  left_.reserve(all_.size());
  steps_.reserve(all_.size());
}

void EliminationOrder::clear() { std::fill(coupled_.begin(), coupled_.end(), Word{0}); }

void EliminationOrder::couple(std::span<const int> nodes) {
  for (const int a : nodes) {
    Word* const bits = row(a);
    for (const int b : nodes) bits[b / kBits] |= Word{1} << (b % kBits);
  }
}

template <typename Visit>
void EliminationOrder::visit(const Word* bits, const Visit& visit) const {
  for (size_t w = 0; w < words_; ++w)
    for (Word word = bits[w] & there_[w]; word != 0; word &= word - 1)
      visit(static_cast<int>(w) * kBits + std::countr_zero(word));
}

/// About the number of multiplications.
void EliminationOrder::find_cost(int node) {
  int others = 0;
  visit(row(node), [&](int i) { others += sizes_[i]; });
  const int own = sizes_[node], all = own + others;
  cost_[node] = static_cast<double>(own) * all * all;
}

void EliminationOrder::eliminate(int node) {
  there_[node / kBits] &= ~(Word{1} << (node % kBits));
  Step step{node, -1, static_cast<int>(neighbours_.size()), 0};
  const Word* const own = row(node);
  visit(own, [&](int i) {
    neighbours_.push_back(i);
    ++step.count;
    Word* const other = row(i);
    for (size_t w = 0; w < words_; ++w) other[w] |= own[w];
    other[i / kBits] &= ~(Word{1} << (i % kBits));
  });
  for (size_t w = 0; w < words_; ++w) blocked_[w] |= own[w];
  step_of_[node] = static_cast<int>(steps_.size());
  steps_.push_back(step);
}

void EliminationOrder::find() {
  steps_.clear();
  neighbours_.clear();
  std::fill(there_.begin(), there_.end(), ~Word{0});
  std::fill(step_of_.begin(), step_of_.end(), -1);
  left_ = all_;
  for (size_t i = 0; i < sizes_.size(); ++i)
    row(static_cast<int>(i))[i / kBits] &= ~(Word{1} << (i % kBits));
  for (const int node : left_) find_cost(node);
  const auto is_in = [](const std::vector<Word>& set, int node) {
    return (set[node / kBits] >> (node % kBits) & 1) != 0;
  };
  while (!left_.empty()) {
    double least = std::numeric_limits<double>::infinity();
    for (const int node : left_) least = std::min(least, cost_[node]);
    std::fill(blocked_.begin(), blocked_.end(), Word{0});
    for (const int node : left_)
      if (cost_[node] <= kAlike * least && !is_in(blocked_, node)) eliminate(node);
    std::erase_if(left_, [&](int node) { return !is_in(there_, node); });
    for (const int node : left_)
      if (is_in(blocked_, node)) find_cost(node);
  }
  for (Step& step : steps_) {
    for (const int i : neighbours(step)) {
      const int at = step_of(i);
      if (at >= 0 && (step.parent < 0 || at < step.parent)) step.parent = at;
    }
  }
}

}  // namespace clatter::dynamics
