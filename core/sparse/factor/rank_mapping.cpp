// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/rank_mapping.hpp"

#include <algorithm>
#include <queue>

namespace clatter::sparse {
namespace {

constexpr int64_t kRowsOfARank = 100;     // fewest rows of a shared front on a rank
constexpr double kLargestSubtree = 0.25;  // as a fraction of a rank's work

/// First of `count` ranks that share a front; `count` is 1 for one rank's own.
struct Team {
  int first = 0, count = 1;
};

class Mapping {
 public:
  Mapping(const FrontSizes& fronts, int ranks)
      : fronts_(fronts), load_(at(ranks)), stack_(at(ranks), 0.0), team_(fronts.parent.size()) {}

  std::vector<RankLoad> run() {
    const std::vector<char> top = map_subtrees();
    for (int32_t s = 0; s < fronts_.fronts(); ++s) {
      if (top[at(s)] != 0) team_[at(s)] = team_of(s);
      work_on(s);
    }
    return load_;
  }

 private:
  static size_t at(int64_t i) { return static_cast<size_t>(i); }
  int ranks() const { return static_cast<int>(load_.size()); }

  /// Gives each subtree a rank; returns which fronts lie above them.
  std::vector<char> map_subtrees() {
    const auto n = at(fronts_.fronts());
    std::vector<double> work(n);
    children_.resize(n);
    double total = 0.0;
    for (size_t s = 0; s < n; ++s) {
      const int32_t parent = fronts_.parent[s];
      const double own = fronts_.flops(static_cast<int32_t>(s));
      work[s] += own;
      total += own;
      if (parent < 0) continue;
      work[at(parent)] += work[s];
      children_[at(parent)].push_back(static_cast<int32_t>(s));
    }
    const auto lighter = [&](int32_t a, int32_t b) { return work[at(a)] < work[at(b)]; };
    std::priority_queue<int32_t, std::vector<int32_t>, decltype(lighter)> heaviest(lighter);
    for (size_t s = 0; s < n; ++s)
      if (fronts_.parent[s] < 0) heaviest.push(static_cast<int32_t>(s));
    std::vector<char> top(n, 0);
    const double limit = ranks() > 1 ? kLargestSubtree * total / ranks() : total;
    while (!heaviest.empty() && work[at(heaviest.top())] > limit) {
      const int32_t s = heaviest.top();
      heaviest.pop();
      top[at(s)] = 1;
      for (const int32_t child : children_[at(s)]) heaviest.push(child);
    }
    std::vector<double> given(load_.size(), 0.0);
    std::vector<int32_t> pending;
    for (; !heaviest.empty(); heaviest.pop()) {
      const auto least = std::min_element(given.begin(), given.end()) - given.begin();
      given[at(least)] += work[at(heaviest.top())];
      pending.assign(1, heaviest.top());
      while (!pending.empty()) {
        const int32_t s = pending.back();
        pending.pop_back();
        team_[at(s)] = {static_cast<int>(least), 1};
        pending.insert(pending.end(), children_[at(s)].begin(), children_[at(s)].end());
      }
    }
    return top;
  }

  /// As many ranks as the front has rows for; few rows: the rank with the least work.
  Team team_of(int32_t s) const {
    const int64_t most = fronts_.height[at(s)] / kRowsOfARank;
    if (most >= ranks()) return {0, ranks()};
    const int count = static_cast<int>(std::max<int64_t>(1, most));
    Team best;
    double least = 0.0;
    for (int first = 0; first + count <= ranks(); ++first) {
      double sum = 0.0;
      for (int r = first; r < first + count; ++r) sum += load_[at(r)].flops;
      if (first > 0 && sum >= least) continue;
      least = sum;
      best = {first, count};
    }
    return best;
  }

  static bool has(const Team& team, int rank) {
    return rank >= team.first && rank < team.first + team.count;
  }

  /// Assembles, eliminates and stores one front.
  void work_on(int32_t s) {
    const Team team = team_[at(s)];
    const auto height = static_cast<double>(fronts_.height[at(s)]);
    const auto p = static_cast<double>(fronts_.columns[at(s)]), q = height - p;
    const double share = 1.0 / team.count;
    // Half of the pivot block and of the rows below it, to each other rank.
    const double columns = 0.5 * p * (p + q) * (team.count - 1);
    for (int r = team.first; r < team.first + team.count; ++r) {
      RankLoad& load = load_[at(r)];
      load.peak = std::max(load.peak, load.entries + stack_[at(r)] + share * height * height);
      load.flops += share * fronts_.flops(s);
      load.entries += share * static_cast<double>(fronts_.entries(s));
      load.sent += share * columns;
    }
    for (const int32_t child : children_[at(s)]) pass_update(child, team);
    for (int r = team.first; r < team.first + team.count; ++r) stack_[at(r)] += share * q * q;
  }

  /// The update matrix of a child goes from its ranks to those of the parent.
  void pass_update(int32_t child, const Team& parent) {
    const Team& team = team_[at(child)];
    const auto q = static_cast<double>(fronts_.below(child));
    const double share = 1.0 / team.count;
    for (int r = team.first; r < team.first + team.count; ++r) {
      const double kept = has(parent, r) ? 1.0 / parent.count : 0.0;
      load_[at(r)].sent += share * (1.0 - kept) * 0.5 * q * (q + 1.0);
      stack_[at(r)] -= share * q * q;
    }
  }

  const FrontSizes& fronts_;
  std::vector<RankLoad> load_;
  std::vector<double> stack_;
  std::vector<Team> team_;
  std::vector<std::vector<int32_t>> children_;
};

}  // namespace

std::vector<RankLoad> map_to_ranks(const FrontSizes& fronts, int ranks) {
  return Mapping(fronts, ranks).run();
}

}  // namespace clatter::sparse
