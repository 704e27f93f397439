// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// *BOUNDARY: fixed DoFs and their values, step by step.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {

/// Number of a step; the model itself is step 0.
using StepNumber = int32_t;

/// Factor of a card's AMPLITUDE at the end of the step (Model::step_time); 1 without one.
/// InputError for one that changes with time outside of general static steps.
double amplitude_factor(const Model& model, const Card& card);

/// The DoFs of a node in `mask` (1 to 6 of the deck): its node index, and the mask there. kNone for
/// a node without stiffness; a mask of 0 for rotations of a node that has none.
std::pair<NodeIndex, DofMask> held_dofs(const Model& model, int32_t row, DofMask mask);

class Supports {
 public:
  explicit Supports(Model& model) : model_(&model) {}

  /// One *BOUNDARY. OP=NEW releases supports of other steps. InputError for a DoF with two values
  /// in one step.
  void read(size_t use, const Card& card, StepNumber step);
  /// Supports that `other` does not have in the same way (null: all).
  std::vector<Support> list(const Supports* other) const;

 private:
  struct Held {
    double value = 0.0;
    const std::string* system = nullptr;
    StepNumber step = 0;
    int32_t card = 0;  // index into cards_
  };

  void read_line(size_t use, const Fields& fields, double factor, StepNumber step);
  void hold(int32_t row, DofMask mask, double value, StepNumber step, Origin origin);

  Model* model_;
  std::map<std::pair<NodeIndex, int>, Held> held_;
  std::vector<std::string> cards_;  // their positions in the deck
};

}  // namespace clatter::mesh::deck::abaqus
