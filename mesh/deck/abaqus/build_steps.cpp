// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "mesh/deck/abaqus/loads.hpp"
#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/abaqus/supports.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Processes the cards of the model and its steps.
class Steps {
 public:
  explicit Steps(Model& model)
      : model_(model), base_supports_(model), held_(model), loads_(model) {}

  void run() {
    read_model();
    for (const Card& card : model_.numbering.uses()[model_.numbering.main_use()].scope->cards) {
      model_.refusals.attempt([&] {
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
    for_each_card(model_, {"STEP", "ENDSTEP", "BOUNDARY"}, [&](size_t use, const Card& card) {
      const std::string& key = card.keyword().key;
      if (key != "BOUNDARY") inside = key == "STEP";
      if (key == "BOUNDARY" && inside && card.keyword().choice("OP", "MOD") == "NEW")
        replaced = true;
      if (key == "BOUNDARY" && !inside) held_.read(use, card, 0);
    });
    if (replaced) return;
    base_supports_ = held_;
    model_.deck.supports = base_supports_.list(nullptr);
  }

  void begin(const Card& card) {
    const Keyword& keyword = card.keyword();
    step_ = Step();
    const std::string* name = keyword.find("NAME");
    ++number_;
    step_.name = name != nullptr && !name->empty() ? *name : fmt::format("step_{}", number_);
    step_.where = model_.source.where(card.origin());
    perturbation_ = keyword.has("PERTURBATION");
    open_ = !leaves_out(card);
    if (!open_) return;
    if (perturbation_) {
      base_loads_ = std::make_unique<Loads>(loads_);
      loads_ = Loads(model_);
    }
    check_linear(card);
  }

  // A step with the stiffness of earlier loads or with large displacements is not supported, nor is
  // one that continues it.
  bool leaves_out(const Card& card) {
    const Keyword& keyword = card.keyword();
    const bool large = keyword.has("NLGEOM") && keyword.choice("NLGEOM", "YES") != "NO";
    const bool loaded = perturbation_ && loaded_ && !model_.ignore.lists("PERTURBATION");
    const char* why = nullptr;
    if (left_out_) {
      why = "it continues a step that is";
    } else if (model_.deck.steps.empty()) {
      return false;
    } else if (loaded) {
      why =
          "its stiffness depends on the loads of the steps before it; ignore = "
          "[\"PERTURBATION\"] uses the unloaded stiffness";
    } else if (large && !model_.ignore.lists("NLGEOM")) {
      why = "its displacements are large (NLGEOM); ignore = [\"NLGEOM\"] takes it as linear";
    }
    if (why == nullptr) return false;
    left_out_ = true;
    model_.deck.notes.push_back(fmt::format("{}: *STEP is left out: {}", step_.where, why));
    return true;
  }

  void check_linear(const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"NAME", "INC", "NLGEOM", "PERTURBATION", "AMPLITUDE", "UNSYMM", "EXTRAPOLATION",
                   "CONVERTSDI", "SOLVER"},
                  model_.source, model_.ignore);
    if (keyword.has("NLGEOM") && keyword.choice("NLGEOM", "NO") != "NO" &&
        !model_.ignore.skips("NLGEOM")) {
      model_.source.fail(card.origin(),
                         "*STEP with NLGEOM is not supported: the analysis is "
                         "linear; ignore = [\"NLGEOM\"] takes it as linear");
    }
    if (perturbation_ && loaded_) model_.ignore.skips("PERTURBATION");
  }

  void read(const Card& card) {
    const std::string& key = card.keyword().key;
    const size_t use = model_.numbering.main_use();
    if (key == "BOUNDARY") held_.read(use, card, number_);
    if (key == "CLOAD") loads_.read_forces(use, card, number_);
    if (key == "DLOAD") loads_.read_element_loads(use, card, number_);
    if (key == "DSLOAD") loads_.read_pressures(use, card, number_);
    if (key == "TEMPERATURE") loads_.read_temperatures(use, card, number_);
    if (key == "RETAINEDNODALDOFS") read_retained(use, card);
    if (key == "STATIC") {
      card.keyword().allow({"SOLVER", "DIRECT", "TIMERESET", "TOTALTIMEATSTART", "STABILIZE",
                            "ALLSDTOL", "CONTINUE", "FACTOR"},
                           model_.source, model_.ignore);
      step_.kind = Step::Kind::kStatic;
      if (!perturbation_) set_times(card);
    }
    if (key == "FREQUENCY") read_frequency(card);
  }

  // Its increment, its period (1).
  void set_times(const Card& card) {
    const Fields fields =
        card.size() > 0 ? card.line(0, model_.source) : Fields("", model_.source, card.origin());
    model_.step_time = fields.number_or(1, "period of the step", 1.0);
    model_.total_time = time_before_ + *model_.step_time;
  }

  void read_frequency(const Card& card) {
    card.keyword().allow(
        {"SOLVER", "STORAGE", "GLOBAL", "EIGENSOLVER", "NORMALIZATION", "SIM", "ACOUSTICCOUPLING",
         "DAMPINGPROJECTION", "NUMBERINTERVAL", "PROPERTYEVALUATION", "RESIDUALMODES", "NSET"},
        model_.source, model_.ignore);
    step_.kind = Step::Kind::kFrequency;
    if (card.size() == 0) return;
    const Fields fields = card.line(0, model_.source);
    if (!fields.blank(0)) {
      step_.modes = fields.integer(0, "number of modes", 1, std::numeric_limits<int32_t>::max());
    }
    if (fields.blank(1) && fields.blank(2)) return;
    model_.deck.notes.push_back(fmt::format(
        "{}: *FREQUENCY asks for modes from {} to {} (per unit of time): give the limit to "
        "clatter-modal",
        model_.source.where(fields.origin()), fields.blank(1) ? "0" : fields.text(1),
        fields.blank(2) ? "any frequency" : fields.text(2)));
  }

  void read_retained(size_t use, const Card& card) {
    card.keyword().allow({"SORTED"}, model_.source, model_.ignore);
    for (size_t i = 0; i < card.size(); ++i) {
      const Fields fields = card.line(i, model_.source);
      fields.at_most(3, "nodes, first and last DoF");
      const DofMask mask = dof_range(fields, 1);
      std::map<std::pair<std::string, DofMask>, std::vector<NodeIndex>> groups;
      for (const int32_t row : model_.sets.nodes_at(fields, 0, use)) {
        const auto [node_index, dofs] = held_dofs(model_, row, mask);
        if (node_index != NodeMap::kNone && dofs != 0) {
          groups[{model_.node_map.displacement_system(row), dofs}].push_back(node_index);
        }
      }
      for (auto& [key, node_indices] : groups) {
        Support retained;
        retained.where = model_.source.where(fields.origin());
        retained.node_indices = std::move(node_indices);
        retained.dofs = key.second;
        retained.system = key.first;
        model_.deck.retained.push_back(std::move(retained));
      }
    }
  }

  // Loads do not change frequencies: a frequency step keeps only its supports.
  void end() {
    step_.supports = held_.list(&base_supports_);
    if (step_.kind != Step::Kind::kFrequency) loads_.list(step_, number_);
    const bool moved = std::any_of(step_.supports.begin(), step_.supports.end(),
                                   [](const Support& support) { return support.value != 0.0; });
    const bool general = step_.kind == Step::Kind::kStatic && !perturbation_;
    loaded_ = loaded_ || (general && (moved || !loads_.empty()));
    if (perturbation_) loads_ = *base_loads_;
    time_before_ = model_.total_time.value_or(time_before_);
    model_.step_time = model_.total_time = std::nullopt;
    open_ = false;
    check_memory();
    model_.deck.steps.push_back(std::move(step_));
  }

  // Steps repeat what they inherit.
  void check_memory() {
    constexpr int64_t kMostEntries = int64_t{1} << 25;  // two gigabytes
    entries_ += static_cast<int64_t>(step_.forces.size());
    for (const Support& support : step_.supports) {
      entries_ += static_cast<int64_t>(support.node_indices.size());
    }
    if (!step_.temperature.empty()) entries_ += model_.numbering.nodes() / 8;
    if (entries_ > kMostEntries) {
      throw InputError(
          fmt::format("{}: steps have more than {} loads and supports, including "
                      "inherited ones",
                      step_.where, kMostEntries));
    }
  }

  Model& model_;
  int64_t entries_ = 0;
  Supports base_supports_, held_;
  Loads loads_;
  std::unique_ptr<Loads> base_loads_;
  Step step_;
  StepNumber number_ = 0;
  double time_before_ = 0.0;
  bool open_ = false, perturbation_ = false, loaded_ = false, left_out_ = false;
};

}  // namespace

void build_initial_temperature(Model& model) {
  for_each_card(model, {"INITIALCONDITIONS"}, [&](size_t use, const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"TYPE"}, model.source, model.ignore);
    const std::string type = keyword.choice("TYPE", "");
    if (type == "VELOCITY" || type == "FIELD") {
      model.refusals.contents().pass("keyword", keyword.name + ", TYPE=" + type, model.source,
                                     card.origin(), "of a state that linear statics do not have");
      return;
    }
    if (type != "TEMPERATURE") {
      model.source.fail(card.origin(),
                        "*INITIAL CONDITIONS: expected TYPE=TEMPERATURE; ignore = "
                        "[\"*INITIAL CONDITIONS\"] skips all of them");
    }
    model.initial.resize(model.numbering.nodes(), 0.0);
    for (size_t i = 0; i < card.size(); ++i) {
      const Fields fields = card.line(i, model.source);
      fields.at_most(2, "nodes, temperature");
      const double value = fields.number(1, "temperature");
      for (const int32_t row : model.sets.nodes_at(fields, 0, use)) {
        model.initial[row] = value;
      }
    }
  });
  // Nodes without elements do not count for a uniform temperature.
  std::vector<double> known;
  for (size_t row = 0; row < model.initial.size(); ++row) {
    if (model.node_map.mesh_node(static_cast<int32_t>(row)) != NodeMap::kNone) {
      known.push_back(model.initial[row]);
    }
  }
  if (known.empty()) return;
  if (std::any_of(known.begin(), known.end(), [&](double t) { return t != known.front(); })) return;
  for (auto& [name, material] : model.deck.materials) {
    material.reference_temperature = known.front();
  }
  std::fill(model.initial.begin(), model.initial.end(), known.front());
}

void build_steps(Model& model) {
  for_each_card(model, {"AMPLITUDE"}, [&](size_t, const Card& card) {
    model.amplitudes[card.keyword().choice("NAME", "")] = &card;
  });
  Steps(model).run();
}

}  // namespace clatter::mesh::deck::abaqus
