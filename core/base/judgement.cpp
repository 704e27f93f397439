// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/judgement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter {

Verdict Judgement::of(double value) const {
  if (!judges()) return Verdict::kGood;
  const double sign = refused < good ? -1.0 : 1.0;
  // Written so that NaN is refused.
  if (sign * value <= sign * good) return Verdict::kGood;
  return sign * value <= sign * refused ? Verdict::kWarned : Verdict::kRefused;
}

std::string Judgement::good_text() const {
  return fmt::format("{} {:g}", refused < good ? "from" : "up to", good);
}

std::string Judgement::refused_text() const {
  if (std::isinf(refused)) return "never";
  return fmt::format("{} {:g}", refused < good ? "below" : "above", refused);
}

namespace {

/// "periodicity_block is 0.2, periodicity_rod 0.3, good up to 0.1: why", a text for each judgement
/// by which a number has this verdict.
std::vector<std::string> texts_of(const std::vector<Judged>& numbers, Verdict verdict) {
  struct Group {
    Judgement judgement;
    std::string numbers;
  };
  std::vector<Group> groups;
  for (const Judged& number : numbers) {
    if (number.verdict() != verdict) continue;
    if (groups.empty() || groups.back().judgement.why != number.judgement.why)
      groups.push_back({number.judgement, fmt::format("{} is {:.3g}", number.name, number.value)});
    else
      groups.back().numbers += fmt::format(", {} {:.3g}", number.name, number.value);
  }
  std::vector<std::string> texts;
  for (const auto& [judgement, all] : groups)
    texts.push_back(fmt::format(
        "{}, good {}{}: {}", all, judgement.good_text(),
        verdict == Verdict::kRefused ? fmt::format(", refused {}", judgement.refused_text()) : "",
        judgement.why));
  return texts;
}

}  // namespace

bool any_refused(const std::vector<Judged>& numbers) {
  return std::ranges::any_of(
      numbers, [](const Judged& number) { return number.verdict() == Verdict::kRefused; });
}

void require_trust(const std::string& context, const std::vector<Judged>& numbers) {
  for (const std::string& text : texts_of(numbers, Verdict::kWarned))
    warn(fmt::format("{}: {}", context, text));
  const std::vector<std::string> refused = texts_of(numbers, Verdict::kRefused);
  if (!refused.empty())
    throw NumericsError(fmt::format("{}: {}", context, fmt::join(refused, "; ")));
}

}  // namespace clatter
