// SPDX-License-Identifier: GPL-3.0-or-later
// Subcases: their loads, temperatures, supports.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "mesh/deck/nastran/loads.hpp"
#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

// TEMPERATURE(INITIAL) is the reference temperature of every material.
void set_initial_temperature(Model& model) {
  const int32_t set = model.raw.control.initial_temperature;
  if (set == 0) return;
  const auto at = model.raw.temperatures.find(set);
  const Origin origin = at == model.raw.temperatures.end() ? 0 : at->second.origin;
  if (at == model.raw.temperatures.end() || !at->second.has_default || !at->second.values.empty()) {
    model.source.fail(origin, fmt::format("TEMPERATURE(INITIAL) = {}: expected one TEMPD and no "
                                          "TEMP in this set: the same everywhere",
                                          set));
  }
  for (auto& [name, material] : model.deck.materials) {
    material.reference_temperature = at->second.default_value;
  }
}

class Steps {
 public:
  explicit Steps(Model& model) : model_(model), raw_(model.raw), loads_(model) {}

  void run() {
    Refusals& refusals = model_.refusals;
    refusals.attempt([&] { loads_.build_surfaces(); });
    if (raw_.control.has_cases) {
      for (const Subcase& subcase : raw_.control.subcases) {
        refusals.attempt([&] { add_subcase(subcase); });
      }
      return;
    }
    for (const int32_t load : loads_.top_loads()) {
      refusals.attempt([&] { add_load_step(load); });
    }
  }

 private:
  void add_load_step(int32_t load) {
    Step step;
    step.name = fmt::format("load_{}", load);
    step.where = model_.source.where(loads_.origin_of(load));
    loads_.list(step, load, loads_.origin_of(load));
    check_moved(step);
    model_.deck.steps.push_back(std::move(step));
  }

  void add_subcase(const Subcase& subcase) {
    const Choice& choice = subcase.choice;
    Step step;
    step.name = fmt::format("subcase_{}", subcase.id);
    step.where = model_.source.where(subcase.origin);
    const int32_t solution = choice.analysis != 0 ? choice.analysis : raw_.control.solution;
    if (solution == 101) step.kind = Step::Kind::kStatic;
    if (solution == 103) step.kind = Step::Kind::kFrequency;
    if (choice.method != 0) {
      const auto count = raw_.eigen_counts.find(choice.method);
      const bool needed = solution == 0 || solution == 103;
      if (count == raw_.eigen_counts.end() && needed) {
        model_.source.fail(subcase.origin,
                           fmt::format("METHOD = {}: found no EIGRL or EIGR", choice.method));
      }
      if (count != raw_.eigen_counts.end()) step.modes = count->second;
    }
    if (choice.load != 0) loads_.list(step, choice.load, subcase.origin);
    if (choice.temperature != 0) loads_.list_temperature(step, choice.temperature, subcase.origin);
    if (choice.spc != 0 && !same_supports()) {
      step.supports = supports_of(model_, choice.spc, subcase.origin);
    }
    check_moved(step);
    model_.deck.steps.push_back(std::move(step));
  }

  // Each displacement of SPCD must be one that a support holds, at no value of its own.
  void check_moved(const Step& step) const {
    if (step.moved.empty()) return;
    std::map<NodeIndex, DofMask> held, given;
    const std::vector<Support>* const all[] = {&model_.deck.supports, &step.supports};
    for (const auto* supports : all)
      for (const Support& support : *supports)
        for (const NodeIndex index : support.node_indices) {
          held[index] = static_cast<DofMask>(held[index] | support.dofs);
          if (support.value != 0.0)
            given[index] = static_cast<DofMask>(given[index] | support.dofs);
        }
    for (const Support& moved : step.moved)
      for (const NodeIndex index : moved.node_indices) {
        const int32_t grid = raw_.grids.ids[model_.node_map.row_of(index)];
        if ((moved.dofs & ~held[index]) != 0)
          throw InputError(fmt::format(
              "{}: SPCD: grid {}: found a component that the supports of {} do not hold, expected "
              "it in their SPC",
              moved.where, grid, step.name));
        if ((moved.dofs & given[index]) != 0)
          throw InputError(fmt::format(
              "{}: SPCD: grid {}: SPCD and D of SPC exclude each other: leave D of SPC blank",
              moved.where, grid));
      }
  }

  bool same_supports() const {
    const auto& all = raw_.control.subcases;
    return std::all_of(all.begin(), all.end(), [&](const Subcase& subcase) {
      return subcase.choice.spc == all.front().choice.spc;
    });
  }

  Model& model_;
  const RawDeck& raw_;
  Loads loads_;
};

}  // namespace

void build_initial_temperature(Model& model) {
  model.refusals.attempt([&] { set_initial_temperature(model); });
}

void build_steps(Model& model) { Steps(model).run(); }

}  // namespace clatter::mesh::deck::nastran
