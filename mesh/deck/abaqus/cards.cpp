// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace clatter::mesh::deck::abaqus {
namespace {

using Entry = std::pair<std::string_view, Role>;

// Output, solver controls, damping of modes, contact's refinements: they change neither K nor M.
constexpr std::array kHarmless = {
    "BASEMOTION",
    "CHANGEFRICTION",
    "CONTACTCONTROLS",
    "CONTACTDAMPING",
    "CONTACTFILE",
    "CONTACTINITIALIZATIONASSIGNMENT",
    "CONTACTINITIALIZATIONDATA",
    "CONTACTOUTPUT",
    "CONTACTPRINT",
    "CONTACTSTABILIZATION",
    "CONTROLS",
    "DESIGNRESPONSE",
    "DESIGNVARIABLES",
    "DIAGNOSTICS",
    "ELEMENTMATRIXOUTPUT",
    "ELEMENTOUTPUT",
    "ELFILE",
    "ELPRINT",
    "ENERGYFILE",
    "ENERGYOUTPUT",
    "ENERGYPRINT",
    "FACEPRINT",
    "FILEFORMAT",
    "FILEOUTPUT",
    "FILTER",
    "GAPCONDUCTANCE",
    "GAPHEATGENERATION",
    "GLOBALDAMPING",
    "HEADING",
    "HOURGLASSSTIFFNESS",
    "INCREMENTATIONOUTPUT",
    "INTEGRATEDOUTPUT",
    "MATRIXOUTPUT",
    "MODALDAMPING",
    "MODALFILE",
    "MODALOUTPUT",
    "MODALPRINT",
    "MONITOR",
    "NOANALYSIS",
    "NODEFILE",
    "NODEOUTPUT",
    "NODEPRINT",
    "OUTPUT",
    "PHYSICALCONSTANTS",
    "PREPRINT",
    "PRINT",
    "RADIATIONFILE",
    "RESTART",
    "SECTIONCONTROLS",
    "SECTIONFILE",
    "SECTIONPRINT",
    "SELECTEIGENMODES",
    "SOLVERCONTROLS",
    "SUBSTRUCTUREMATRIXOUTPUT",
    "SURFACEPROPERTYASSIGNMENT",
    "TIMEPOINTS",
    "TRANSVERSESHEARSTIFFNESS",
    "USEROUTPUTVARIABLES",
};

constexpr std::array kRoles = {
    Entry{"NODE", Role::kNode},
    Entry{"ELEMENT", Role::kElement},
    Entry{"NSET", Role::kSet},
    Entry{"ELSET", Role::kSet},
    Entry{"NGEN", Role::kGenerate},
    Entry{"NFILL", Role::kGenerate},
    Entry{"NCOPY", Role::kGenerate},
    Entry{"ELGEN", Role::kGenerate},
    Entry{"ELCOPY", Role::kGenerate},
    Entry{"SYSTEM", Role::kSystem},
    Entry{"PARAMETER", Role::kParameter},
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
    Entry{"DAMPING", Role::kMaterialPart},
    Entry{"ANNEALTEMPERATURE", Role::kMaterialIdle},
    Entry{"CONDUCTIVITY", Role::kMaterialIdle},
    Entry{"CREEP", Role::kMaterialIdle},
    Entry{"CYCLICHARDENING", Role::kMaterialIdle},
    Entry{"DAMAGEEVOLUTION", Role::kMaterialIdle},
    Entry{"DAMAGEINITIATION", Role::kMaterialIdle},
    Entry{"DAMAGESTABILIZATION", Role::kMaterialIdle},
    Entry{"DEPVAR", Role::kMaterialIdle},
    Entry{"FAILSTRAIN", Role::kMaterialIdle},
    Entry{"FAILSTRESS", Role::kMaterialIdle},
    Entry{"LATENTHEAT", Role::kMaterialIdle},
    Entry{"PLASTIC", Role::kMaterialIdle},
    Entry{"POTENTIAL", Role::kMaterialIdle},
    Entry{"RATEDEPENDENT", Role::kMaterialIdle},
    Entry{"SPECIFICHEAT", Role::kMaterialIdle},
    Entry{"TENSILEFAILURE", Role::kMaterialIdle},
    Entry{"COUPLING", Role::kCoupling},
    Entry{"KINEMATIC", Role::kCouplingPart},
    Entry{"DISTRIBUTING", Role::kCouplingPart},
    Entry{"SURFACEINTERACTION", Role::kInteraction},
    Entry{"SURFACEBEHAVIOR", Role::kInteraction},
    Entry{"COHESIVEBEHAVIOR", Role::kInteraction},
    Entry{"FRICTION", Role::kInteraction},
    Entry{"CONTACT", Role::kModel},
    Entry{"CONTACTEXCLUSIONS", Role::kModel},
    Entry{"CONTACTINCLUSIONS", Role::kModel},
    Entry{"CONTACTPAIR", Role::kModel},
    Entry{"CONTACTPROPERTYASSIGNMENT", Role::kModel},
    Entry{"BEAMGENERALSECTION", Role::kModel},
    Entry{"BEAMSECTION", Role::kModel},
    Entry{"MEMBRANESECTION", Role::kModel},
    Entry{"SHELLGENERALSECTION", Role::kModel},
    Entry{"SHELLSECTION", Role::kModel},
    Entry{"SURFACESECTION", Role::kModel},
    Entry{"KINEMATICCOUPLING", Role::kModel},
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

std::string advice_of(std::string_view key) {
  if (role_of(key) == Role::kProcedure) return "";
  constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kLosses = {
      {{"CONNECTOR", "its connections: [[spring]] and [[equation]]"},
       {"FASTENER", "its connections: [[spring]] and [[coupling]]"},
       {"GAP", "the stiffness of its gaps: [[spring]]"},
       {"JOINT", "its stiffness: [[spring]]"},
       {"GASKET", "its stiffness: [[spring]] or [[tie]]"},
       {"NONSTRUCTURALMASS", "its mass: [[point_mass]]"},
       {"EMBEDDEDELEMENT", "its connection: [[coupling]] or [[tie]]"},
       {"SHELLTOSOLIDCOUPLING", "its connection: [[coupling]] or [[tie]]"},
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

Role role_of(std::string_view key) {
  for (const auto& [name, role] : kRoles) {
    if (name == key) return role;
  }
  const bool harmless = std::find(kHarmless.begin(), kHarmless.end(), key) != kHarmless.end();
  return harmless ? Role::kHarmless : Role::kUnknown;
}

}  // namespace clatter::mesh::deck::abaqus
