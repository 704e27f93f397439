// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The role of each keyword. `clatter-mesh cards` prints these tables.
#include <string>
#include <string_view>
#include <vector>

#include "mesh/deck/abaqus/card.hpp"
#include "mesh/deck/contents.hpp"

namespace clatter::mesh::deck::abaqus {

enum class Role {
  kUnknown,      // refused by name
  kHarmless,     // changes neither K nor M: passed over with its data lines
  kDamping,      // the same, but its alpha and beta are offered to the recipe
  kInteraction,  // the same, but kept: it decides whether a contact is bonded
  kNode,         // tables, read directly
  kElement,
  kSet,        // *NSET, *ELSET
  kGenerate,   // *NGEN, *ELGEN and others: more rows of these tables
  kSystem,     // *SYSTEM: axes of the coordinates that follow
  kParameter,  // *PARAMETER: numbers by name
  kStructure,  // *PART, *ASSEMBLY, *INSTANCE and their ends
  kStepBegin,
  kStepEnd,
  kMaterial,      // *MATERIAL; its properties follow
  kMaterialPart,  // *ELASTIC and others, only after *MATERIAL
  kMaterialIdle,  // *CONDUCTIVITY: the same as kHarmless, only after *MATERIAL
  kCoupling,      // *COUPLING; *KINEMATIC or *DISTRIBUTING follows
  kCouplingPart,
  kModel,      // any other that is kept until the deck is read
  kStep,       // the same, only inside a step
  kProcedure,  // *DYNAMIC: a step that is skipped after a linear one, else refused by name
};

struct KeywordRole {
  std::string_view name;  // in capitals with single blanks, without star: "SOLID SECTION"
  Role role;
  std::string_view meaning;  // what it becomes, or why it is refused or passed over
};

/// What an ignored keyword takes from the model and what of the recipe replaces it, to be appended
/// to the advice; empty for procedures.
std::string advice_of(std::string_view key);

/// Whether a request of output has OUTPUT=2D or 3D, which CalculiX alone reads.
bool is_calculix_output(const Keyword& keyword);

/// The role of a keyword by its folded name without star ("SOLIDSECTION").
Role role_of(std::string_view key);
/// Its row; null for one that is refused because nobody reads it.
const KeywordRole* row_of(std::string_view key);
/// kRead, kPassed or kRefused.
Fate fate_of(Role role);

/// All that are not refused, and those that are for a known reason.
std::vector<Listed> listed_keywords();

}  // namespace clatter::mesh::deck::abaqus
