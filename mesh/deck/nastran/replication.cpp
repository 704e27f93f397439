// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/replication.hpp"

#include <fmt/format.h>

#include "mesh/deck/field_text.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

constexpr int32_t kMostRepetitions = 1'000'000;

// "*(1.5)" or "*1.5"; "=(3)" or "=3": what is after the first character.
std::string_view argument(std::string_view text) {
  text = trimmed(text.substr(1));
  if (text.starts_with('(') && text.ends_with(')')) text = text.substr(1, text.size() - 2);
  return trimmed(text);
}

// The field plus the step; empty when one of them is no number.
std::string stepped(std::string_view field, std::string_view step) {
  const auto whole = to_integer(field), whole_step = to_integer(step);
  if (whole && whole_step) return std::to_string(int64_t{*whole} + *whole_step);
  const auto real = to_number(field), real_step = to_number(step);
  return real && real_step ? fmt::format("{:#}", *real + *real_step) : std::string();
}

}  // namespace

std::vector<std::string> Replication::expand(const LineFields& line, std::string& trouble) {
  int32_t times = 1;
  if (line.head == "=") {
    steps_.assign(line.data.begin(), line.data.end());
  } else if (const auto count = to_integer(argument(line.head));
             count && *count > 0 && *count <= kMostRepetitions && !steps_.empty()) {
    times = *count;
  } else {
    trouble = fmt::format("found {}, expected = or, after a line of =, the number of repetitions",
                          shown(line.head));
    return {};
  }
  std::vector<std::string> lines;
  for (int32_t k = 0; k < times && trouble.empty(); ++k) {
    lines.push_back(next_line(trouble));
    previous_ = lines.back();
  }
  return lines;
}

std::string Replication::next_line(std::string& trouble) const {
  LineFields before;
  trouble = split_line(previous_, before);
  if (trouble.empty() && (previous_.empty() || before.continuation || before.large))
    trouble = "found a repetition, expected a card in small or free fields before it";
  std::string out(before.head);
  bool all_same = false;
  for (size_t i = 0; i < before.data.size() && trouble.empty(); ++i) {
    const std::string_view step = i < steps_.size() ? std::string_view(steps_[i]) : "";
    all_same = all_same || step == "==";
    std::string field(step);
    if (all_same || step == "=") {
      field = before.data[i];
    } else if (step.starts_with('*')) {
      field = stepped(before.data[i], argument(step));
      if (field.empty())
        trouble = fmt::format("found step {} at field {}, expected a number at both", shown(step),
                              shown(before.data[i]));
    }
    out += "," + field;
  }
  return out;
}

}  // namespace clatter::mesh::deck::nastran
