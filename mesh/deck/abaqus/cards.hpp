// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The role of each keyword.
#include <string_view>

namespace clatter::mesh::deck::abaqus {

enum class Role {
  kUnknown,   // refused by name
  kHarmless,  // output requests, solver controls: skipped with its data lines
  kNode,      // tables, read directly
  kElement,
  kSet,        // *NSET, *ELSET
  kStructure,  // *PART, *ASSEMBLY, *INSTANCE and their ends
  kStepBegin,
  kStepEnd,
  kMaterial,      // *MATERIAL; its properties follow
  kMaterialPart,  // *ELASTIC and others, only after *MATERIAL
  kMaterialIdle,  // *CONDUCTIVITY: has no effect here, only after *MATERIAL
  kCoupling,      // *COUPLING; *KINEMATIC or *DISTRIBUTING follows
  kCouplingPart,
  kModel,      // any other that is kept until the deck is read
  kStep,       // the same, only inside a step
  kProcedure,  // *DYNAMIC: a step that is skipped after a linear one, else refused by name
};

/// The role of a keyword by its folded name without star ("SOLIDSECTION").
Role role_of(std::string_view key);

}  // namespace clatter::mesh::deck::abaqus
