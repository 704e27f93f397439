#pragma once
// What each keyword is to the reader.
#include <string_view>

namespace clatter::mesh::deck::abaqus {

enum class Role {
  kUnknown,   // refused by name
  kHarmless,  // output requests, solver controls: skipped with its data lines
  kNode,      // tables, read as they come
  kElement,
  kSet,        // *NSET, *ELSET
  kStructure,  // *PART, *ASSEMBLY, *INSTANCE and their ends
  kStepBegin,
  kStepEnd,
  kMaterial,      // *MATERIAL; what describes one follows
  kMaterialPart,  // *ELASTIC and others, only behind *MATERIAL
  kMaterialIdle,  // *CONDUCTIVITY: has no effect here and stands behind *MATERIAL
  kCoupling,      // *COUPLING; *KINEMATIC or *DISTRIBUTING follows
  kCouplingPart,
  kModel,      // anything else that is kept until the deck is read
  kStep,       // the same, only inside a step
  kProcedure,  // *DYNAMIC: a step that is left out after a linear one, else refused by name
};

/// The role of a keyword by its folded name without star ("SOLIDSECTION").
Role role_of(std::string_view key);

}  // namespace clatter::mesh::deck::abaqus
