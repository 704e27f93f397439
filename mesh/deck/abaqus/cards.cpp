// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr const char* kNotLinear = "left out after linear steps, else refused";
constexpr const char* kOutput = "output";
constexpr const char* kNonlinear = "of a nonlinear analysis";
constexpr const char* kContact = "contact, beyond whether it is bonded";
constexpr const char* kDamping = "damping";
constexpr const char* kOffered = "damping; alpha and beta are offered to the recipe";
constexpr const char* kHeat = "of heat transfer";
constexpr const char* kShells = "of shells";
constexpr const char* kThin =
    "of shells and beams, which are surfaces where they are faces of solids";

constexpr std::array kRoles = {
    KeywordRole{"NODE", Role::kNode, "nodes"},
    KeywordRole{"ELEMENT", Role::kElement, "cells and elements of one or two nodes (types below)"},
    KeywordRole{"NSET", Role::kSet, "node set"},
    KeywordRole{"ELSET", Role::kSet, "element set"},
    KeywordRole{"NGEN", Role::kGenerate, "nodes on a line"},
    KeywordRole{"NFILL", Role::kGenerate, "nodes between two sets"},
    KeywordRole{"NCOPY", Role::kGenerate, "copies of nodes"},
    KeywordRole{"NMAP", Role::kGenerate,
                "nodes of rectangular, skew, cylindrical or spherical coordinates"},
    KeywordRole{"ELGEN", Role::kGenerate, "rows of elements"},
    KeywordRole{"ELCOPY", Role::kGenerate, "copies of elements"},
    KeywordRole{"SYSTEM", Role::kSystem, "coordinate system of the nodes that follow"},
    KeywordRole{"PARAMETER", Role::kParameter, "numbers by name"},
    KeywordRole{"PART", Role::kStructure, "mesh of instances"},
    KeywordRole{"END PART", Role::kStructure, "end of a part"},
    KeywordRole{"ASSEMBLY", Role::kStructure, "all instances"},
    KeywordRole{"END ASSEMBLY", Role::kStructure, "end of the assembly"},
    KeywordRole{"INSTANCE", Role::kStructure, "a part, moved and turned"},
    KeywordRole{"END INSTANCE", Role::kStructure, "end of an instance"},
    KeywordRole{"STEP", Role::kStepBegin, "step"},
    KeywordRole{"END STEP", Role::kStepEnd, "end of a step"},
    KeywordRole{"MATERIAL", Role::kMaterial, "material"},
    KeywordRole{"ELASTIC", Role::kMaterialPart,
                "isotropic, engineering constants, orthotropic, anisotropic, lamina of shells"},
    KeywordRole{"DENSITY", Role::kMaterialPart, "density"},
    KeywordRole{"EXPANSION", Role::kMaterialPart, "thermal expansion"},
    KeywordRole{"DAMPING", Role::kMaterialPart, "alpha and beta, offered to the recipe"},
    KeywordRole{"ANNEAL TEMPERATURE", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"CONDUCTIVITY", Role::kMaterialIdle, kHeat},
    KeywordRole{"CREEP", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"CYCLIC HARDENING", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"DAMAGE EVOLUTION", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"DAMAGE INITIATION", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"DAMAGE STABILIZATION", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"DEPVAR", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"FAIL STRAIN", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"FAIL STRESS", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"LATENT HEAT", Role::kMaterialIdle, kHeat},
    KeywordRole{"PLASTIC", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"POTENTIAL", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"RATE DEPENDENT", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"SPECIFIC HEAT", Role::kMaterialIdle, kHeat},
    KeywordRole{"TENSILE FAILURE", Role::kMaterialIdle, kNonlinear},
    KeywordRole{"COUPLING", Role::kCoupling, "coupling of a surface or set to a reference node"},
    KeywordRole{"KINEMATIC", Role::kCouplingPart, "rigid coupling"},
    KeywordRole{"DISTRIBUTING", Role::kCouplingPart, "distributing coupling"},
    KeywordRole{"SURFACE INTERACTION", Role::kInteraction, kContact},
    KeywordRole{"SURFACE BEHAVIOR", Role::kInteraction, kContact},
    KeywordRole{"COHESIVE BEHAVIOR", Role::kInteraction, kContact},
    KeywordRole{"FRICTION", Role::kInteraction, kContact},
    KeywordRole{"CONTACT", Role::kModel, "ties of bonded surfaces"},
    KeywordRole{"CONTACT EXCLUSIONS", Role::kModel, "surfaces of a bonded contact"},
    KeywordRole{"CONTACT INCLUSIONS", Role::kModel, "surfaces of a bonded contact"},
    KeywordRole{"CONTACT PAIR", Role::kModel, "a tie where it is bonded"},
    KeywordRole{"CONTACT PROPERTY ASSIGNMENT", Role::kModel, "decides whether a contact is bonded"},
    KeywordRole{"BEAM GENERAL SECTION", Role::kModel, "section and material of B31 and B32"},
    KeywordRole{"BEAM SECTION", Role::kModel, "section and material of B31 and B32"},
    KeywordRole{"MEMBRANE SECTION", Role::kModel, kThin},
    KeywordRole{"SHELL GENERAL SECTION", Role::kModel, kThin},
    KeywordRole{"SHELL SECTION", Role::kModel, "section and material of shells"},
    KeywordRole{"SHELL TO SOLID COUPLING", Role::kModel, "tie of the edge of a sheet"},
    KeywordRole{"NODAL THICKNESS", Role::kModel, "thickness of shells at their nodes"},
    KeywordRole{"SURFACE SECTION", Role::kModel, kThin},
    KeywordRole{"KINEMATIC COUPLING", Role::kModel, "rigid coupling"},
    KeywordRole{"AMPLITUDE", Role::kModel, "taken at the end of a static step"},
    KeywordRole{"BOUNDARY", Role::kModel, "supports, prescribed displacements"},
    KeywordRole{"CONNECTOR BEHAVIOR", Role::kModel, "stiffness of connectors"},
    KeywordRole{"CONNECTOR ELASTICITY", Role::kModel,
                "linear stiffness, of components or coupled; rigid components"},
    KeywordRole{"CONNECTOR SECTION", Role::kModel,
                "rigid components become couplings and equations, elastic ones springs"},
    KeywordRole{"DISTRIBUTING COUPLING", Role::kModel, "distributing coupling"},
    KeywordRole{"EQUATION", Role::kModel, "equation"},
    KeywordRole{"INITIAL CONDITIONS", Role::kModel, "reference temperature"},
    KeywordRole{"MASS", Role::kModel, "mass"},
    KeywordRole{
        "MPC", Role::kModel,
        "PIN, TIE, BEAM, LINEAR, PLANE, STRAIGHT, MEANROT to first order in the displacements"},
    KeywordRole{"NONSTRUCTURAL MASS", Role::kModel, "a larger density of solids"},
    KeywordRole{"ORIENTATION", Role::kModel, "coordinate system of materials"},
    KeywordRole{"PRE-TENSION SECTION", Role::kModel, "bolt, cut through its shank of solids"},
    KeywordRole{"RETAINED NODAL DOFS", Role::kModel, "boundary DoFs of a condensation"},
    KeywordRole{"RIGID BODY", Role::kModel, "rigid coupling"},
    KeywordRole{"ROTARY INERTIA", Role::kModel, "inertia of a mass"},
    KeywordRole{"SOLID SECTION", Role::kModel, "region with its material"},
    KeywordRole{"CYCLIC SYMMETRY MODEL", Role::kModel,
                "the sector is expanded to the complete ring"},
    KeywordRole{"DASHPOT", Role::kModel,
                "left out with a warning: no effect on statics and undamped frequencies"},
    KeywordRole{"SPRING", Role::kModel, "SPRINGA, SPRING1, SPRING2; ORIENTATION"},
    KeywordRole{"SURFACE", Role::kModel, "surface"},
    KeywordRole{"TIE", Role::kModel, "tie"},
    KeywordRole{"TRANSFORM", Role::kModel, "coordinate system of nodes"},
    KeywordRole{"CLOAD", Role::kStep, "force, moment"},
    KeywordRole{"DLOAD", Role::kStep, "P1 to P6, P of shells, GRAV, CENTRIF, BX, BY, BZ"},
    KeywordRole{"DSLOAD", Role::kStep, "P: pressure on a surface"},
    KeywordRole{"FREQUENCY", Role::kStep, "number of modes of a step"},
    KeywordRole{"MATRIX GENERATE", Role::kStep, "a step without loads"},
    KeywordRole{"SELECT CYCLIC SYMMETRY MODES", Role::kStep,
                "reported: the ring has all nodal diameters"},
    KeywordRole{"STATIC", Role::kStep, "static step"},
    KeywordRole{"SUBSTRUCTURE GENERATE", Role::kStep, "a step without loads"},
    KeywordRole{"TEMPERATURE", Role::kStep, "temperatures of nodes"},
    KeywordRole{"BUCKLE", Role::kProcedure, kNotLinear},
    KeywordRole{"CHANGE SOLID SECTION", Role::kProcedure, kNotLinear},
    KeywordRole{"COMPLEX FREQUENCY", Role::kProcedure, kNotLinear},
    KeywordRole{"COUPLED TEMPERATURE-DISPLACEMENT", Role::kProcedure, kNotLinear},
    KeywordRole{"DYNAMIC", Role::kProcedure, kNotLinear},
    KeywordRole{"GREEN", Role::kProcedure, kNotLinear},
    KeywordRole{"HEAT TRANSFER", Role::kProcedure, kNotLinear},
    KeywordRole{"MODAL DYNAMIC", Role::kProcedure, kNotLinear},
    KeywordRole{"MODEL CHANGE", Role::kProcedure, kNotLinear},
    KeywordRole{"SENSITIVITY", Role::kProcedure, kNotLinear},
    KeywordRole{"STEADY STATE DYNAMICS", Role::kProcedure, kNotLinear},
    KeywordRole{"UNCOUPLED TEMPERATURE-DISPLACEMENT", Role::kProcedure, kNotLinear},
    KeywordRole{"VISCO", Role::kProcedure, kNotLinear},
    KeywordRole{"BASE MOTION", Role::kHarmless, "of a dynamic step"},
    KeywordRole{"CHANGE FRICTION", Role::kHarmless, kNonlinear},
    KeywordRole{"CONNECTOR DAMPING", Role::kHarmless, kDamping},
    KeywordRole{"CONTACT CONTROLS", Role::kHarmless, kNonlinear},
    KeywordRole{"CONTACT DAMPING", Role::kHarmless, kDamping},
    KeywordRole{"CONTACT FILE", Role::kHarmless, kOutput},
    KeywordRole{"CONTACT INITIALIZATION ASSIGNMENT", Role::kHarmless, kNonlinear},
    KeywordRole{"CONTACT INITIALIZATION DATA", Role::kHarmless, kNonlinear},
    KeywordRole{"CONTACT OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"CONTACT PRINT", Role::kHarmless, kOutput},
    KeywordRole{"CONTACT STABILIZATION", Role::kHarmless, kNonlinear},
    KeywordRole{"CONTROLS", Role::kHarmless, "control of the solver"},
    KeywordRole{"DAMPING CONTROLS", Role::kHarmless, kDamping},
    KeywordRole{"DESIGN RESPONSE", Role::kHarmless, "of a sensitivity"},
    KeywordRole{"DESIGN VARIABLES", Role::kHarmless, "of a sensitivity"},
    KeywordRole{"DIAGNOSTICS", Role::kHarmless, kOutput},
    KeywordRole{"ELEMENT MATRIX OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"ELEMENT OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"EL FILE", Role::kHarmless, kOutput},
    KeywordRole{"EL PRINT", Role::kHarmless, kOutput},
    KeywordRole{"END", Role::kHarmless, "end of the deck"},
    KeywordRole{"ENERGY FILE", Role::kHarmless, kOutput},
    KeywordRole{"ENERGY OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"ENERGY PRINT", Role::kHarmless, kOutput},
    KeywordRole{"FACE PRINT", Role::kHarmless, kOutput},
    KeywordRole{"FILE FORMAT", Role::kHarmless, kOutput},
    KeywordRole{"FILE OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"FILTER", Role::kHarmless, kOutput},
    KeywordRole{"FLEXIBLE BODY", Role::kHarmless, kOutput},
    KeywordRole{"GAP CONDUCTANCE", Role::kHarmless, kHeat},
    KeywordRole{"GAP HEAT GENERATION", Role::kHarmless, kHeat},
    KeywordRole{"GLOBAL DAMPING", Role::kDamping, kOffered},
    KeywordRole{"HEADING", Role::kHarmless, "title"},
    KeywordRole{"HOURGLASS STIFFNESS", Role::kHarmless, "of reduced integration in Abaqus"},
    KeywordRole{"INCREMENTATION OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"INTEGRATED OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"MATRIX OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"MODAL DAMPING", Role::kDamping, kOffered},
    KeywordRole{"MODAL FILE", Role::kHarmless, kOutput},
    KeywordRole{"MODAL OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"MODAL PRINT", Role::kHarmless, kOutput},
    KeywordRole{"MONITOR", Role::kHarmless, kOutput},
    KeywordRole{"NO ANALYSIS", Role::kHarmless, "control of the run"},
    KeywordRole{"NODE FILE", Role::kHarmless, kOutput},
    KeywordRole{"NODE OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"NODE PRINT", Role::kHarmless, kOutput},
    KeywordRole{"OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"PHYSICAL CONSTANTS", Role::kHarmless, kHeat},
    KeywordRole{"PREPRINT", Role::kHarmless, kOutput},
    KeywordRole{"PRINT", Role::kHarmless, kOutput},
    KeywordRole{"RADIATION FILE", Role::kHarmless, kOutput},
    KeywordRole{"RESTART", Role::kHarmless, "files of a restart"},
    KeywordRole{"SECTION CONTROLS", Role::kHarmless, "of reduced integration in Abaqus"},
    KeywordRole{"SECTION FILE", Role::kHarmless, kOutput},
    KeywordRole{"SECTION PRINT", Role::kHarmless, kOutput},
    KeywordRole{"SELECT EIGENMODES", Role::kHarmless, "of modal steps"},
    KeywordRole{"SOLVER CONTROLS", Role::kHarmless, "control of the solver"},
    KeywordRole{"SUBSTRUCTURE DAMPING", Role::kHarmless, kDamping},
    KeywordRole{"SUBSTRUCTURE DAMPING CONTROLS", Role::kHarmless, kDamping},
    KeywordRole{"SUBSTRUCTURE MATRIX OUTPUT", Role::kHarmless, kOutput},
    KeywordRole{"SURFACE PROPERTY ASSIGNMENT", Role::kHarmless, kShells},
    KeywordRole{"TIME POINTS", Role::kHarmless, "of output"},
    KeywordRole{"USER OUTPUT VARIABLES", Role::kHarmless, kOutput},
};

// `key` has no blanks.
bool is(std::string_view key, std::string_view name) {
  for (const char c : name) {
    if (c == ' ') continue;
    if (key.empty() || key.front() != c) return false;
    key.remove_prefix(1);
  }
  return key.empty();
}

}  // namespace

std::string advice_of(std::string_view key) {
  if (role_of(key) == Role::kProcedure) return "";
  if (key == "IMPERFECTION") return ": nodes then stay where they were before it";
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kLosses = {
      {{"CONNECTOR", "its connections: [[spring]] and [[equation]]"},
       {"FASTENER", "its connections: [[spring]] and [[coupling]]"},
       {"GAP", "the stiffness of its gaps: [[spring]]"},
       {"JOINT", "its stiffness: [[spring]]"},
       {"GASKET", "its stiffness: [[spring]] or [[tie]]"},
       {"EMBEDDEDELEMENT", "its connection: [[coupling]] or [[tie]]"},
       {"MATRIX", "its stiffness and mass: [[spring]] and [[point_mass]]"},
       {"SUBSTRUCTURE", "its stiffness and mass: [[spring]] and [[point_mass]]"},
       {"USERELEMENT", "its stiffness and mass: [[spring]] and [[point_mass]]"},
       {"INERTIARELIEF", "its balance of loads: [[support]] of six DoFs"}}};
  for (const auto& [name, loss] : kLosses) {
    if (key.starts_with(name)) return fmt::format(" and {} of the recipe replace it", loss);
  }
  return ", and what it adds to stiffness, mass, supports or couplings: [[spring]], "
         "[[point_mass]], "
         "[[support]], [[coupling]] of the recipe replace it";
}

const KeywordRole* row_of(std::string_view key) {
  const auto at = std::find_if(kRoles.begin(), kRoles.end(),
                               [&](const KeywordRole& row) { return is(key, row.name); });
  return at == kRoles.end() ? nullptr : &*at;
}

bool is_calculix_output(const Keyword& keyword) {
  const std::string output = folded(keyword.choice("OUTPUT", ""));
  return output == "2D" || output == "3D";
}

Role role_of(std::string_view key) {
  const KeywordRole* row = row_of(key);
  return row == nullptr ? Role::kUnknown : row->role;
}

Fate fate_of(Role role) {
  switch (role) {
    case Role::kUnknown:
    case Role::kProcedure:
      return Fate::kRefused;
    case Role::kHarmless:
    case Role::kDamping:
    case Role::kInteraction:
    case Role::kMaterialIdle:
      return Fate::kPassed;
    default:
      return Fate::kRead;
  }
}

std::vector<Listed> listed_keywords() {
  std::vector<Listed> rows;
  for (const KeywordRole& row : kRoles)
    rows.push_back({"*" + std::string(row.name), fate_of(row.role), std::string(row.meaning)});
  return rows;
}

}  // namespace clatter::mesh::deck::abaqus
