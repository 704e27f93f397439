// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "mesh/deck/abaqus/loads.hpp"
#include "mesh/deck/abaqus/reading.hpp"
#include "mesh/deck/abaqus/supports.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Processes the cards of the model and its steps.
class Steps {
 public:
  explicit Steps(Reading* reading)
      : reading_(*reading), model_(reading), held_(reading), loads_(reading) {}

  void run() {
    read_model();
    for (const Card& card : reading_.model->uses()[reading_.model->main_use()].scope->cards) {
      reading_.refusals->attempt([&] {
        if (card.keyword().key == "STEP") begin(card);
        if (number_ > 0 && open_) read(card);
        if (card.keyword().key == "ENDSTEP" && open_) end();
      });
    }
  }

 private:
  // Supports outside of steps; if a step replaces them (OP=NEW) they become those of steps.
  void read_model() {
    bool inside = false, replaced = false;
    for_each_card(reading_, {"STEP", "ENDSTEP", "BOUNDARY"}, [&](size_t use, const Card& card) {
      const std::string& key = card.keyword().key;
      if (key != "BOUNDARY") inside = key == "STEP";
      if (key == "BOUNDARY" && inside && card.keyword().choice("OP", "MOD") == "NEW")
        replaced = true;
      if (key == "BOUNDARY" && !inside) held_.read(use, card, 0);
    });
    if (replaced) return;
    model_ = held_;
    reading_.deck->supports = model_.list(nullptr);
  }

  void begin(const Card& card) {
    const Keyword& keyword = card.keyword();
    step_ = Step();
    const std::string* name = keyword.find("NAME");
    ++number_;
    step_.name = name != nullptr && !name->empty() ? *name : fmt::format("step_{}", number_);
    step_.where = reading_.source.where(card.spot());
    perturbation_ = keyword.has("PERTURBATION");
    open_ = !leaves_out(card);
    if (!open_) return;
    if (perturbation_) {
      base_loads_ = std::make_unique<Loads>(loads_);
      loads_ = Loads(&reading_);
    }
    check_linear(card);
  }

  // A step with the stiffness of earlier loads or with large displacements is not supported, nor is
  // one that continues it.
  bool leaves_out(const Card& card) {
    const Keyword& keyword = card.keyword();
    const bool large = keyword.has("NLGEOM") && keyword.choice("NLGEOM", "YES") != "NO";
    const bool loaded = perturbation_ && loaded_ && !reading_.ignore->skips("PERTURBATION", 0);
    const char* why = nullptr;
    if (left_out_) {
      why = "it continues a step that is";
    } else if (reading_.deck->steps.empty()) {
      return false;
    } else if (loaded) {
      why =
          "its stiffness depends on the loads of the steps before it; ignore = "
          "[\"PERTURBATION\"] uses the unloaded stiffness";
    } else if (large && !reading_.ignore->skips("NLGEOM", 0)) {
      why = "its displacements are large (NLGEOM); ignore = [\"NLGEOM\"] takes it as linear";
    }
    if (why == nullptr) return false;
    left_out_ = true;
    reading_.deck->notes.push_back(fmt::format("{}: *STEP is left out: {}", step_.where, why));
    return true;
  }

  void check_linear(const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"NAME", "INC", "NLGEOM", "PERTURBATION", "AMPLITUDE", "UNSYMM"}, reading_.source,
                  reading_.ignore);
    if (keyword.has("NLGEOM") && keyword.choice("NLGEOM", "NO") != "NO" &&
        !reading_.ignore->skips("NLGEOM")) {
      reading_.source.fail(card.spot(),
                           "*STEP with NLGEOM is not supported: the analysis is "
                           "linear; ignore = [\"NLGEOM\"] takes it as linear");
    }
    if (perturbation_ && loaded_) reading_.ignore->skips("PERTURBATION");
  }

  void read(const Card& card) {
    const std::string& key = card.keyword().key;
    const size_t use = reading_.model->main_use();
    if (key == "BOUNDARY") held_.read(use, card, number_);
    if (key == "CLOAD") loads_.read_forces(use, card, number_);
    if (key == "DLOAD") loads_.read_element_loads(use, card, number_);
    if (key == "DSLOAD") loads_.read_pressures(use, card, number_);
    if (key == "TEMPERATURE") loads_.read_temperatures(use, card, number_);
    if (key == "RETAINEDNODALDOFS") read_retained(use, card);
    if (key == "STATIC") {
      card.keyword().allow({"SOLVER", "DIRECT"}, reading_.source, reading_.ignore);
      step_.kind = Step::Kind::kStatic;
    }
    if (key == "FREQUENCY") read_frequency(card);
  }

  void read_frequency(const Card& card) {
    card.keyword().allow({"SOLVER", "STORAGE", "GLOBAL", "EIGENSOLVER", "NORMALIZATION"},
                         reading_.source, reading_.ignore);
    step_.kind = Step::Kind::kFrequency;
    if (card.size() == 0) return;
    const Fields fields = card.line(0, reading_.source);
    if (!fields.empty(0)) {
      step_.modes = fields.integer(0, "number of modes", 1, std::numeric_limits<int32_t>::max());
    }
  }

  void read_retained(size_t use, const Card& card) {
    card.keyword().allow({"SORTED"}, reading_.source, reading_.ignore);
    for (size_t i = 0; i < card.size(); ++i) {
      const Fields fields = card.line(i, reading_.source);
      fields.at_most(3, "nodes, first and last DoF");
      const DofMask mask = dof_range(fields, 1);
      std::map<std::pair<std::string, DofMask>, std::vector<NodeIndex>> groups;
      for (const int32_t row : reading_.sets->nodes_at(fields, 0, use)) {
        const auto [node_index, dofs] = held_dofs(reading_, row, mask);
        if (node_index != NodeMap::kNone && dofs != 0) {
          groups[{reading_.node_map->system(row), dofs}].push_back(node_index);
        }
      }
      for (auto& [key, node_indices] : groups) {
        Support retained;
        retained.where = reading_.source.where(fields.spot());
        retained.node_indices = std::move(node_indices);
        retained.dofs = key.second;
        retained.system = key.first;
        reading_.deck->retained.push_back(std::move(retained));
      }
    }
  }

  // Loads do not change frequencies: a frequency step keeps only its supports.
  void end() {
    step_.supports = held_.list(&model_);
    if (step_.kind != Step::Kind::kFrequency) loads_.list(&step_, number_);
    const bool moved = std::any_of(step_.supports.begin(), step_.supports.end(),
                                   [](const Support& support) { return support.value != 0.0; });
    const bool general = step_.kind == Step::Kind::kStatic && !perturbation_;
    loaded_ = loaded_ || (general && (moved || !loads_.empty()));
    if (perturbation_) loads_ = *base_loads_;
    open_ = false;
    check_memory();
    reading_.deck->steps.push_back(std::move(step_));
  }

  // Steps repeat what they inherit.
  void check_memory() {
    constexpr int64_t kMostEntries = int64_t{1} << 25;  // two gigabytes
    entries_ += static_cast<int64_t>(step_.forces.size());
    for (const Support& support : step_.supports) {
      entries_ += static_cast<int64_t>(support.node_indices.size());
    }
    if (!step_.temperature.empty()) entries_ += reading_.model->nodes() / 8;
    if (entries_ > kMostEntries) {
      throw InputError(
          fmt::format("{}: steps have more than {} loads and supports, including "
                      "inherited ones",
                      step_.where, kMostEntries));
    }
  }

  Reading& reading_;
  int64_t entries_ = 0;
  Supports model_, held_;
  Loads loads_;
  std::unique_ptr<Loads> base_loads_;
  Step step_;
  StepNumber number_ = 0;
  bool open_ = false, perturbation_ = false, loaded_ = false, left_out_ = false;
};

}  // namespace

void read_initial_conditions(Reading* reading) {
  for_each_card(*reading, {"INITIALCONDITIONS"}, [&](size_t use, const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"TYPE"}, reading->source, reading->ignore);
    if (keyword.choice("TYPE", "") != "TEMPERATURE") {
      reading->source.fail(card.spot(),
                           "*INITIAL CONDITIONS: expected TYPE=TEMPERATURE; ignore = "
                           "[\"*INITIAL CONDITIONS\"] skips all of them");
    }
    reading->initial.resize(static_cast<size_t>(reading->model->nodes()), 0.0);
    for (size_t i = 0; i < card.size(); ++i) {
      const Fields fields = card.line(i, reading->source);
      fields.at_most(2, "nodes, temperature");
      const double value = fields.number(1, "temperature");
      for (const int32_t row : reading->sets->nodes_at(fields, 0, use)) {
        reading->initial[static_cast<size_t>(row)] = value;
      }
    }
  });
  // Nodes without elements do not count for a uniform temperature.
  std::vector<double> known;
  for (size_t row = 0; row < reading->initial.size(); ++row) {
    if (reading->node_map->mesh_node(static_cast<int32_t>(row)) != NodeMap::kNone) {
      known.push_back(reading->initial[row]);
    }
  }
  if (known.empty()) return;
  if (std::any_of(known.begin(), known.end(), [&](double t) { return t != known.front(); })) return;
  for (auto& [name, material] : reading->deck->materials) {
    material.reference_temperature = known.front();
  }
  std::fill(reading->initial.begin(), reading->initial.end(), known.front());
}

void read_steps(Reading* reading) {
  for_each_card(*reading, {"AMPLITUDE"}, [&](size_t, const Card& card) {
    reading->amplitudes[card.keyword().choice("NAME", "")] = &card;
  });
  Steps(reading).run();
}

}  // namespace clatter::mesh::deck::abaqus
