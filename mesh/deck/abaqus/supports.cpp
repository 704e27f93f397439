// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>

namespace clatter::mesh::deck::abaqus {
namespace {

// Degrees of freedom by name, as Abaqus defines them.
constexpr std::array<std::pair<std::string_view, DofMask>, 8> kNamed = {{
    {"XSYMM", 0b110001},
    {"YSYMM", 0b101010},
    {"ZSYMM", 0b011100},
    {"XASYMM", 0b001110},
    {"YASYMM", 0b010101},
    {"ZASYMM", 0b100011},
    {"PINNED", 0b000111},
    {"ENCASTRE", 0b111111},
}};

struct TimeValue {
  double time = 0.0, value = 0.0;
};

// Pairs of time and value, times ascending.
std::vector<TimeValue> table_of(const Card& amplitude, const Source& source) {
  const Keyword& keyword = amplitude.keyword();
  if (keyword.choice("VALUE", "RELATIVE") != "RELATIVE") {
    source.fail(keyword.origin, "*AMPLITUDE: expected VALUE=RELATIVE, a factor of the loads");
  }
  std::vector<TimeValue> table;
  for (size_t i = 0; i < amplitude.size(); ++i) {
    const Fields fields = amplitude.line(i, source);
    for (size_t k = 0; k + 1 < fields.size(); k += 2) {
      table.push_back({fields.number(k, "time"), fields.number(k + 1, "amplitude")});
      if (table.size() > 1 && !(table.back().time >= table[table.size() - 2].time))
        fields.fail(fmt::format("*AMPLITUDE: found time {} after {}, expected ascending times",
                                table.back().time, table[table.size() - 2].time));
    }
  }
  return table;
}

// Straight or smooth between the times of the table, constant outside.
double value_at(const std::vector<TimeValue>& table, double time, bool smooth) {
  const auto after = std::upper_bound(table.begin(), table.end(), time,
                                      [](double t, const TimeValue& one) { return t < one.time; });
  if (after == table.end()) return table.back().value;
  if (after == table.begin()) return table.front().value;
  const TimeValue& a = *(after - 1);
  double s = (time - a.time) / (after->time - a.time);
  if (smooth) s = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  return a.value + s * (after->value - a.value);
}

}  // namespace

double amplitude_factor(const Model& model, const Card& card) {
  const std::string* name = card.keyword().find("AMPLITUDE");
  if (name == nullptr) return 1.0;
  const auto known = model.amplitudes.find(folded(*name));
  if (known == model.amplitudes.end()) {
    model.source.fail(card.origin(), fmt::format("found no amplitude {}", shown(*name)));
  }
  const Keyword& amplitude = known->second->keyword();
  const std::string definition = amplitude.choice("DEFINITION", "TABULAR");
  const bool smooth = definition == "SMOOTHSTEP";
  const std::vector<TimeValue> table = smooth || definition == "TABULAR"
                                           ? table_of(*known->second, model.source)
                                           : std::vector<TimeValue>();
  if (std::all_of(table.begin(), table.end(),
                  [&](const TimeValue& one) { return one.value == table.front().value; }) &&
      !table.empty())
    return table.front().value;
  const bool total = amplitude.choice("TIME", "STEPTIME") == "TOTALTIME";
  const auto time = total ? model.total_time : model.step_time;
  if (table.empty() || !time) {
    model.source.fail(card.origin(),
                      fmt::format("amplitude {} changes with time, expected a table that a general "
                                  "*STATIC step takes at its end; ignore = [\"AMPLITUDE\"] uses "
                                  "the values without it",
                                  *name));
  }
  return value_at(table, *time, smooth);
}

std::pair<NodeIndex, DofMask> held_dofs(const Model& model, int32_t row, DofMask mask) {
  const NodeIndex rotated = model.node_map.rotation_of(row);
  if (rotated != NodeMap::kNone) {
    return {rotated, static_cast<DofMask>((mask & kTranslations) << 3)};
  }
  const NodeIndex node_index = model.node_map.find(row);
  if (node_index == NodeMap::kNone || model.node_map.turns(node_index)) return {node_index, mask};
  return {node_index, static_cast<DofMask>(mask & kTranslations)};
}

void Supports::read(size_t use, const Card& card, StepNumber step) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"OP", "AMPLITUDE", "TYPE"}, model_->source, model_->ignore);
  if (keyword.choice("TYPE", "DISPLACEMENT") != "DISPLACEMENT") {
    model_->source.fail(card.origin(), "*BOUNDARY: expected TYPE=DISPLACEMENT");
  }
  if (keyword.choice("OP", "MOD") == "NEW") {
    std::erase_if(held_, [&](const auto& entry) { return entry.second.step != step; });
  }
  const double factor = model_->ignore.lists("AMPLITUDE") ? 1.0 : amplitude_factor(*model_, card);
  cards_.push_back(model_->source.where(card.origin()));
  for (size_t i = 0; i < card.size(); ++i) {
    model_->refusals.attempt([&] { read_line(use, card.line(i, model_->source), factor, step); });
  }
}

void Supports::read_line(size_t use, const Fields& fields, double factor, StepNumber step) {
  const std::vector<int32_t> rows = model_->sets.nodes_at(fields, 0, use);
  const std::string word = folded(fields.text(1));
  DofMask mask = 0;
  double value = 0.0;
  for (const auto& [name, bits] : kNamed) {
    if (name == word) mask = bits;
  }
  if (mask != 0) {
    fields.at_most(2, "nodes and the name of a support");
  } else {
    fields.at_most(4, "nodes, first and last DoF, value");
    mask = dof_range(fields, 1);
    value = factor * fields.number_or(3, "value", 0.0);
  }
  for (const int32_t row : rows) hold(row, mask, value, step, fields.origin());
}

void Supports::hold(int32_t row, DofMask mask, double value, StepNumber step, Origin origin) {
  const auto [node_index, dofs] = held_dofs(*model_, row, mask);
  if (node_index == NodeMap::kNone) return;
  for (int k = 0; k < 6; ++k) {
    if ((dofs >> k & 1) == 0) continue;
    const Held held{value, &model_->node_map.displacement_system(row), step,
                    static_cast<int32_t>(cards_.size()) - 1};
    const auto [at, is_new] = held_.emplace(std::pair(node_index, k), held);
    if (is_new) continue;
    if (at->second.step == step && at->second.value != value) {
      model_->source.fail(
          origin, fmt::format("node {} is fixed at {} and at {} in direction {}",
                              model_->numbering.node_ids()[row], at->second.value, value, k + 1));
    }
    // A repeated value keeps its first line.
    if (at->second.value != value || at->second.step != step) at->second = held;
  }
}

std::vector<Support> Supports::list(const Supports* other) const {
  // By card, value and axes; in each the mask by node index.
  std::map<std::tuple<int32_t, double, std::string>, std::map<NodeIndex, DofMask>> groups;
  for (const auto& [dof, held] : held_) {
    if (other != nullptr) {
      const auto at = other->held_.find(dof);
      if (at != other->held_.end() && at->second.value == held.value) continue;
    }
    DofMask& mask = groups[{held.card, held.value, *held.system}][dof.first];
    mask = static_cast<DofMask>(mask | 1 << dof.second);
  }
  std::vector<Support> supports;
  for (const auto& [key, node_indices] : groups) {
    std::map<DofMask, std::vector<NodeIndex>> by_mask;
    for (const auto& [node_index, mask] : node_indices) by_mask[mask].push_back(node_index);
    for (auto& [mask, members] : by_mask) {
      Support support;
      support.where = cards_[std::get<0>(key)];
      support.node_indices = std::move(members);
      support.dofs = mask;
      support.value = std::get<1>(key);
      support.system = std::get<2>(key);
      supports.push_back(std::move(support));
    }
  }
  return supports;
}

}  // namespace clatter::mesh::deck::abaqus
