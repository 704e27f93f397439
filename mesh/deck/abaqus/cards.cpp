// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/cards.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace clatter::mesh::deck::abaqus {
namespace {

using Entry = std::pair<std::string_view, Role>;

// Output, printing and solver controls: no effect on the model.
constexpr std::array kHarmless = {
    "CONTACTFILE",
    "CONTACTOUTPUT",
    "CONTACTPRINT",
    "CONTROLS",
    "DESIGNRESPONSE",
    "DESIGNVARIABLES",
    "ELFILE",
    "ELPRINT",
    "ELEMENTOUTPUT",
    "ENERGYFILE",
    "ENERGYOUTPUT",
    "ENERGYPRINT",
    "FACEPRINT",
    "FILEFORMAT",
    "FILEOUTPUT",
    "HEADING",
    "INTEGRATEDOUTPUT",
    "MATRIXOUTPUT",
    "MODALFILE",
    "MODALOUTPUT",
    "MODALPRINT",
    "MONITOR",
    "NODEFILE",
    "NODEOUTPUT",
    "NODEPRINT",
    "NOANALYSIS",
    "OUTPUT",
    "PHYSICALCONSTANTS",
    "PREPRINT",
    "PRINT",
    "RADIATIONFILE",
    "RESTART",
    "SECTIONFILE",
    "SECTIONPRINT",
    "SUBSTRUCTUREMATRIXOUTPUT",
    "TIMEPOINTS",
};

constexpr std::array kRoles = {
    Entry{"NODE", Role::kNode},
    Entry{"ELEMENT", Role::kElement},
    Entry{"NSET", Role::kSet},
    Entry{"ELSET", Role::kSet},
    Entry{"PART", Role::kStructure},
    Entry{"ENDPART", Role::kStructure},
    Entry{"ASSEMBLY", Role::kStructure},
    Entry{"ENDASSEMBLY", Role::kStructure},
    Entry{"INSTANCE", Role::kStructure},
    Entry{"ENDINSTANCE", Role::kStructure},
    Entry{"STEP", Role::kStepBegin},
    Entry{"ENDSTEP", Role::kStepEnd},
    Entry{"MATERIAL", Role::kMaterial},
    Entry{"ELASTIC", Role::kMaterialPart},
    Entry{"DENSITY", Role::kMaterialPart},
    Entry{"EXPANSION", Role::kMaterialPart},
    Entry{"CONDUCTIVITY", Role::kMaterialIdle},
    Entry{"SPECIFICHEAT", Role::kMaterialIdle},
    Entry{"COUPLING", Role::kCoupling},
    Entry{"KINEMATIC", Role::kCouplingPart},
    Entry{"DISTRIBUTING", Role::kCouplingPart},
    Entry{"AMPLITUDE", Role::kModel},
    Entry{"BOUNDARY", Role::kModel},
    Entry{"DISTRIBUTINGCOUPLING", Role::kModel},
    Entry{"EQUATION", Role::kModel},
    Entry{"INITIALCONDITIONS", Role::kModel},
    Entry{"MASS", Role::kModel},
    Entry{"MPC", Role::kModel},
    Entry{"ORIENTATION", Role::kModel},
    Entry{"PRE-TENSIONSECTION", Role::kModel},
    Entry{"RETAINEDNODALDOFS", Role::kModel},
    Entry{"RIGIDBODY", Role::kModel},
    Entry{"ROTARYINERTIA", Role::kModel},
    Entry{"SOLIDSECTION", Role::kModel},
    Entry{"CYCLICSYMMETRYMODEL", Role::kModel},
    Entry{"DASHPOT", Role::kModel},
    Entry{"SPRING", Role::kModel},
    Entry{"SURFACE", Role::kModel},
    Entry{"TIE", Role::kModel},
    Entry{"TRANSFORM", Role::kModel},
    Entry{"CLOAD", Role::kStep},
    Entry{"DLOAD", Role::kStep},
    Entry{"DSLOAD", Role::kStep},
    Entry{"FREQUENCY", Role::kStep},
    Entry{"MATRIXGENERATE", Role::kStep},
    Entry{"SELECTCYCLICSYMMETRYMODES", Role::kStep},
    Entry{"STATIC", Role::kStep},
    Entry{"SUBSTRUCTUREGENERATE", Role::kStep},
    Entry{"TEMPERATURE", Role::kStep},
    Entry{"BUCKLE", Role::kProcedure},
    Entry{"CHANGESOLIDSECTION", Role::kProcedure},
    Entry{"COMPLEXFREQUENCY", Role::kProcedure},
    Entry{"COUPLEDTEMPERATURE-DISPLACEMENT", Role::kProcedure},
    Entry{"DYNAMIC", Role::kProcedure},
    Entry{"GREEN", Role::kProcedure},
    Entry{"HEATTRANSFER", Role::kProcedure},
    Entry{"MODALDYNAMIC", Role::kProcedure},
    Entry{"MODELCHANGE", Role::kProcedure},
    Entry{"SENSITIVITY", Role::kProcedure},
    Entry{"STEADYSTATEDYNAMICS", Role::kProcedure},
    Entry{"UNCOUPLEDTEMPERATURE-DISPLACEMENT", Role::kProcedure},
    Entry{"VISCO", Role::kProcedure},
};

}  // namespace

Role role_of(std::string_view key) {
  for (const auto& [name, role] : kRoles) {
    if (name == key) return role;
  }
  const bool harmless = std::find(kHarmless.begin(), kHarmless.end(), key) != kHarmless.end();
  return harmless ? Role::kHarmless : Role::kUnknown;
}

}  // namespace clatter::mesh::deck::abaqus
