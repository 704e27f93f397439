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
  lines.push_back(fmt::format(
      "{} DoF to eliminate, {} boundary coordinates: L has {:.3g} entries ({}), one factorisation "
      "{:.3g} operations (exact for the order of {}; counted in {}, {})",
      cost.size, cost.boundary, cost.entries, memory_text(8.0 * cost.entries / kBytesPerGib),
      cost.flops, cost.ordering, seconds_text(cost.count_seconds), memory_text(cost.count_gib)));
  lines.push_back(fmt::format(
      "{}: {} at most ({} of them for L and its fronts), up to {:.0f} % of the operations beside "
      "{:.0f} % on average (measured: 0.7 to 1.6 times the memory, 0.9 to 1.4 times the share)",
      ranks_text(cost.ranks()), memory_text(cost.total_gib()), memory_text(cost.factor_gib()),
      100.0 * cost.most_flops() / cost.flops, 100.0 / cost.ranks()));
  if (cost.ranks() > 1)
    lines.push_back(
        fmt::format("messages of one factorisation: {} by all ranks (measured: 0.6 to "
                    "1.1 times)",
                    memory_text(cost.sent_gib())));
  const double columns = static_cast<double>(cost.boundary) / 64.0;
  lines.push_back(fmt::format(
      "{}: one factorisation {}, 64 solves {}, the {} static shapes {}; at {:.3g} Gflop/s of a "
      "core "
      "({}), without the time of messages: expect up to three times as much",
      cost.ranks() == 1 ? "1 core" : fmt::format("{} cores", cost.ranks()),
      seconds_text(cost.factor_seconds()), seconds_text(cost.solve_seconds()), cost.boundary,
      seconds_text(1.5 * columns * cost.solve_seconds()), cost.gflops,
      cost.product_gflops > 0.0 ? fmt::format("a matrix product here: {:.3g}", cost.product_gflops)
                                : "as given"));
  if (cost.ranks() > 1)
    lines.push_back(
        fmt::format("rank 0 orders: {} for the pattern of K", memory_text(cost.count_gib)));
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
          {"count_gib", json_number(cost.count_gib)},
          {"count_seconds", json_number(cost.count_seconds)}};
}

}  // namespace clatter::condense
