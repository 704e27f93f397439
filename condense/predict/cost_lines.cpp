// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/predict/cost_lines.hpp"

#include <fmt/format.h>

#include "core/base/memory_limit.hpp"

namespace clatter::condense {
namespace {

/// "12.3 s", "4.5 min", "6.7 h".
std::string seconds_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.2g} min", seconds / 60.0);
  return fmt::format("{:.2g} h", seconds / 3600.0);
}

/// "1 rank" or "each of 8 ranks".
std::string ranks_text(int ranks) {
  return ranks == 1 ? "1 rank" : fmt::format("each of {} ranks", ranks);
}

}  // namespace

std::vector<std::string> describe(const PredictedCost& cost) {
  std::vector<std::string> lines;
  const auto say = [&](const char* text, const auto&... parts) {
    lines.push_back(fmt::format(fmt::runtime(text), parts...));
  };
  say("{} DoF to eliminate, {} boundary coordinates: L has {:.3g} entries ({}), one factorisation "
      "{:.3g} operations (exact in the order of {}; counted in {}, {})",
      cost.size, cost.boundary, cost.entries, memory_text(8.0 * cost.entries / kBytesPerGib),
      cost.flops, cost.ordering, seconds_text(cost.count_seconds), memory_text(cost.count_gib));
  say("memory of {}: {} at most, {} of them for L with its fronts (MUMPS: 0.7 to 1.6 times that)",
      ranks_text(cost.ranks()), memory_text(cost.total_gib()), memory_text(cost.factor_gib()));
  if (cost.ranks() > 1) {
    say("rank 0 orders and analyses for all: {} at most", memory_text(cost.analysis_gib()));
    say("largest share of the operations: {:.3g} %, {:.3g} % on average (MUMPS: 1.0 to 1.4 times "
        "the largest); messages of one factorisation: {} (0.6 to 1.5 times)",
        100.0 * cost.most_flops() / cost.flops, 100.0 / cost.ranks(), memory_text(cost.sent_gib()));
  }
  const std::string rate = cost.product_gflops > 0.0
                               ? fmt::format("a matrix product here: {:.3g}", cost.product_gflops)
                               : "as given";
  say("seconds at {:.3g} Gflop/s of a core ({}): one factorisation {}, 64 solves {}, the static "
      "shapes {}; messages come on top: expect one to three times as much",
      cost.gflops, rate, seconds_text(cost.factor_seconds()), seconds_text(cost.solve_seconds()),
      seconds_text(1.5 / 64.0 * static_cast<double>(cost.boundary) * cost.solve_seconds()));
  return lines;
}

JsonMembers json_of(const PredictedCost& cost) {
  const auto of_ranks = [&](double sparse::RankLoad::*value, double factor) {
    std::string text = "[";
    for (const sparse::RankLoad& one : cost.load)
      text += (text.size() > 1 ? ", " : "") + json_number(factor * (one.*value));
    return text + "]";
  };
  constexpr double kGib = 8.0 / kBytesPerGib;
  return {{"dofs", json_number(static_cast<double>(cost.size))},
          {"boundary", json_number(static_cast<double>(cost.boundary))},
          {"ordering", json_text(cost.ordering)},
          {"factor_entries", json_number(cost.entries)},
          {"factor_flops", json_number(cost.flops)},
          {"largest_front", json_number(static_cast<double>(cost.largest_front))},
          {"ranks", json_number(cost.ranks())},
          {"rank_flops", of_ranks(&sparse::RankLoad::flops, 1.0)},
          {"rank_entries", of_ranks(&sparse::RankLoad::entries, 1.0)},
          {"rank_sent_gib", of_ranks(&sparse::RankLoad::sent, kGib)},
          {"factor_gib", json_number(cost.factor_gib())},
          {"matrices_gib", json_number(cost.matrices_gib())},
          {"model_gib", json_number(cost.model_gib())},
          {"core_gflops", json_number(cost.gflops)},
          {"factor_seconds", json_number(cost.factor_seconds())},
          {"solve_seconds", json_number(cost.solve_seconds())},
          {"analysis_gib", json_number(cost.analysis_gib())},
          {"analysis_gib", json_number(cost.analysis_gib())},
          {"count_gib", json_number(cost.count_gib)},
          {"count_seconds", json_number(cost.count_seconds)}};
}

}  // namespace clatter::condense
