// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace clatter::mesh::deck::nastran {
namespace {

constexpr const char* kRetained = "boundary DoFs of a condensation";
constexpr const char* kSystem = "coordinate system";
constexpr const char* kBeam = "bar, beam or truss between two grids";
constexpr const char* kBeamSection = "section and material of bars";
constexpr const char* kCell = "cells, with any mid-side nodes or none";
constexpr const char* kSkin = "shell; where it is a face of a solid, a surface";
constexpr const char* kLayers =
    "section of shells with its layers; of faces of solids left out with a line";

// Why cards are passed over.
constexpr const char* kDampers = "dampers";
constexpr const char* kDynamic = "of loads and damping over frequency or time";
constexpr const char* kNonlinear = "of a nonlinear analysis";
constexpr const char* kTemperature = "dependence of constants on temperature";
constexpr const char* kOptimisation = "of an optimisation";
constexpr const char* kOutput = "of output and plots";
constexpr const char* kFluid = "of a fluid";
constexpr const char* kContactPart = "of contact, whose pairs are refused";
constexpr const char* kUnused = "properties of cells that are not read";
constexpr const char* kSuper = "of the reduction in Nastran";

// Why cards are refused, and the remedy.
constexpr const char* kBars =
    "no curved bars; ignore = [\"{0}\"] drops their stiffness and mass: CBAR along chords replace "
    "them";
constexpr const char* kShearPanels =
    "no shear panels; ignore = [\"{0}\"] drops their stiffness and mass: a CQUAD4 with a thin "
    "PSHELL "
    "and its stringers as CBAR replace them";
constexpr const char* kBarLoads =
    "loads along bars are not read; ignore = [\"{0}\"] drops them: FORCE and MOMENT on their grids "
    "replace them";
constexpr const char* kContact =
    "contact that opens is not linear; ignore = [\"{0}\"] leaves both sides free of each other: a "
    "[[tie]] of the fe.toml joins them";
constexpr const char* kWelds =
    "ignore = [\"{0}\"] drops these joints: a [[tie]] or [[spring]] of the fe.toml replaces them";
constexpr const char* kOthers =
    "parts of other files are not assembled here; ignore = [\"{0}\"] leaves them out: a scene "
    "joins parts";
constexpr const char* kGenel =
    "ignore = [\"{0}\"] drops its stiffness: a [[matrix]] of the fe.toml replaces it";
constexpr const char* kSpline =
    "ignore = [\"{0}\"] drops it: [[equation]] of the fe.toml replaces it";
constexpr const char* kPlate =
    "ignore = [\"{0}\"] drops it: a [[coupling]] of type rigid in the fe.toml replaces it";
constexpr const char* kContactSet =
    "contact that opens is not linear; ignore = [\"{0}\"] leaves both sides free of each other: "
    "where the deck means glue, a BGSET of the same regions joins them, else a [[tie]] of the "
    "fe.toml";

constexpr Role reads(std::string_view name, void (*read)(const Card&, RawDeck&), size_t most,
                     const char* meaning) {
  return {name, Fate::kRead, read, most, 0, 0, meaning};
}
constexpr Role passes(std::string_view name, const char* why) {
  return {name, Fate::kPassed, nullptr, 0, 0, 0, why};
}
constexpr Role refuses(std::string_view name, const char* why, size_t first_grid, size_t grids) {
  return {name, Fate::kRefused, nullptr, 0, first_grid, grids, why};
}

// Sorted by name.
constexpr std::array kRoles = {
    reads("ACCEL", read_accel, 0, "acceleration, the same everywhere or varying along an axis"),
    reads("ACCEL1", read_accel1, 0, "acceleration of some grids"),
    passes("ACMODL", kFluid),
    reads("ASET", read_aset, 8, kRetained),
    reads("ASET1", read_aset1, 0, kRetained),
    reads("BAROR", read_baror, 8, "defaults of CBAR"),
    refuses("BCBODY", kContact, 0, 0),
    refuses("BCBODY1", kContact, 0, 0),
    passes("BCGRID", kContactPart),
    refuses("BCONECT", kContact, 0, 0),
    refuses("BCONP", kContact, 0, 0),
    passes("BCONPRG", kContactPart),
    passes("BCONPRP", kContactPart),
    passes("BCPARA", kContactPart),
    passes("BCPROP", kContactPart),
    passes("BCRPARA", kContactPart),
    refuses("BCTABL1", kContact, 0, 0),
    refuses("BCTABLE", kContact, 0, 0),
    passes("BCTADD", kContactPart),
    passes("BCTPARA", kContactPart),
    passes("BCTPARM", kContactPart),
    refuses("BCTSET", kContactSet, 0, 0),
    reads("BEAMOR", read_baror, 8, "defaults of CBEAM"),
    passes("BFRIC", kContactPart),
    reads("BGSET", read_bgset, 0, "ties"),
    passes("BLSEG", kContactPart),
    passes("BOUTPUT", kOutput),
    reads("BSET", read_aset, 8, kRetained),
    reads("BSET1", read_aset1, 0, kRetained),
    passes("BSURF", kContactPart),
    reads("BSURFS", read_bsurfs, 0, "surface of a tie"),
    passes("BWIDTH", kContactPart),
    Role{"CBAR", Fate::kRead, read_cbar, 16, 2, 2, kBeam},
    Role{"CBEAM", Fate::kRead, read_cbar, 24, 2, 2, kBeam},
    refuses("CBEAM3", kBars, 2, 3),
    refuses("CBEND", kBars, 2, 2),
    reads("CBUSH", read_cbush, 16, "springs along three axes and about them"),
    passes("CDAMP1", kDampers),
    passes("CDAMP2", kDampers),
    passes("CDAMP3", kDampers),
    passes("CDAMP4", kDampers),
    passes("CDAMP5", kDampers),
    reads("CELAS1", read_celas1, 8, "spring"),
    reads("CELAS2", read_celas2, 8, "spring"),
    reads("CELAS3", read_celas3, 8, "spring"),
    reads("CELAS4", read_celas4, 8, "spring"),
    reads("CFAST", read_cfast, 16, "springs between patches of two sheets"),
    reads("CGAP", read_cgap, 8, "springs of the state in which the gap begins"),
    reads("CHEXA", read_cell, 24, kCell),
    reads("CMASS1", read_celas1, 8, "mass between DoFs"),
    reads("CMASS2", read_celas2, 8, "mass between DoFs"),
    reads("CMASS3", read_celas3, 8, "mass between DoFs"),
    reads("CMASS4", read_celas4, 8, "mass between DoFs"),
    passes("CMSMETHD", kSuper),
    reads("CONM1", read_conm1, 24, "mass matrix of a grid"),
    reads("CONM2", read_conm2, 16, "mass with inertia and offset"),
    Role{"CONROD", Fate::kRead, read_conrod, 8, 1, 2, kBeam},
    reads("CORD1C", read_cord1, 8, kSystem),
    reads("CORD1R", read_cord1, 8, kSystem),
    reads("CORD1S", read_cord1, 8, kSystem),
    reads("CORD2C", read_cord2, 16, kSystem),
    reads("CORD2R", read_cord2, 16, kSystem),
    reads("CORD2S", read_cord2, 16, kSystem),
    reads("CPENTA", read_cell, 24, kCell),
    reads("CPYRA", read_cell, 16, kCell),
    reads("CPYRAM", read_cell, 16, kCell),
    reads("CQUAD4", read_skin, 16, kSkin),
    reads("CQUAD8", read_skin, 24, kSkin),
    reads("CQUADR", read_skin, 16, kSkin),
    Role{"CROD", Fate::kRead, read_crod, 8, 2, 2, kBeam},
    refuses("CSEAM", kWelds, 0, 0),
    reads("CSET", read_aset, 8, kRetained),
    reads("CSET1", read_aset1, 0, kRetained),
    refuses("CSHEAR", kShearPanels, 2, 4),
    refuses("CSUPER", kOthers, 0, 0),
    reads("CTETRA", read_cell, 16, kCell),
    reads("CTRIA3", read_skin, 16, kSkin),
    reads("CTRIA6", read_skin, 16, kSkin),
    reads("CTRIAR", read_skin, 16, kSkin),
    Role{"CTUBE", Fate::kRead, read_crod, 8, 2, 2, kBeam},
    passes("CVISC", kDampers),
    reads("CWELD", read_cweld, 24, "springs between patches of two sheets"),
    passes("DAREA", kDynamic),
    passes("DCONADD", kOptimisation),
    passes("DCONSTR", kOptimisation),
    passes("DDVAL", kOptimisation),
    passes("DELAY", kDynamic),
    passes("DEQATN", kOptimisation),
    passes("DESVAR", kOptimisation),
    passes("DLINK", kOptimisation),
    passes("DLOAD", kDynamic),
    reads("DMIG", read_dmig, 0, "matrix that K2GG or M2GG chooses"),
    passes("DOPTPRM", kOptimisation),
    passes("DPHASE", kDynamic),
    passes("DRESP1", kOptimisation),
    passes("DRESP2", kOptimisation),
    passes("DRESP3", kOptimisation),
    passes("DSCREEN", kOptimisation),
    passes("DSHAPE", kOptimisation),
    passes("DTABLE", kOptimisation),
    passes("DTI", kOutput),
    passes("DTPG", kOptimisation),
    passes("DTPL", kOptimisation),
    passes("DVCREL1", kOptimisation),
    passes("DVCREL2", kOptimisation),
    passes("DVGRID", kOptimisation),
    passes("DVMREL1", kOptimisation),
    passes("DVMREL2", kOptimisation),
    passes("DVPREL1", kOptimisation),
    passes("DVPREL2", kOptimisation),
    passes("DVSHAP", kOptimisation),
    passes("ECHOOFF", kOutput),
    passes("ECHOON", kOutput),
    passes("EIGB", kDynamic),
    passes("EIGC", kDynamic),
    passes("EIGP", kDynamic),
    reads("EIGR", read_eigr, 16, "number of modes of a step"),
    reads("EIGRL", read_eigrl, 0, "number of modes of a step"),
    passes("EXTRN", kSuper),
    passes("FLSPOUT", kFluid),
    reads("FORCE", read_force, 8, "force"),
    reads("FORCE1", read_force1, 8, "force"),
    reads("FORCE2", read_force2, 8, "force"),
    passes("FREQ", kDynamic),
    passes("FREQ1", kDynamic),
    passes("FREQ2", kDynamic),
    passes("FREQ3", kDynamic),
    passes("FREQ4", kDynamic),
    passes("FREQ5", kDynamic),
    refuses("GENEL", kGenel, 0, 0),
    reads("GRAV", read_grav, 8, "acceleration"),
    reads("GRDSET", read_grdset, 8, "systems and supports that a GRID leaves blank"),
    reads("GRID", read_grid, 8, "node, or point where a coupling, mass or spring names it"),
    reads("LOAD", read_load, 0, "sum of load sets"),
    passes("LSEQ", kDynamic),
    reads("MAT1", read_mat1, 16,
          "isotropic material; GE is its loss factor; stress limits are not read"),
    reads("MAT10", read_other_material, 0, "of a fluid, whose cells are refused"),
    reads("MAT2", read_mat2, 24, "anisotropic material of shells"),
    reads("MAT3", read_other_material, 0, "named where a solid or shell has it"),
    passes("MAT4", kUnused),
    passes("MAT5", kUnused),
    reads("MAT8", read_mat8, 24, "orthotropic material of shells; strengths are not read"),
    reads("MAT9", read_mat9, 32, "anisotropic material"),
    reads("MATHE", read_other_material, 0, "named where a solid or shell has it"),
    reads("MATHP", read_other_material, 0, "named where a solid or shell has it"),
    passes("MATS1", kNonlinear),
    passes("MATT1", kTemperature),
    passes("MATT2", kUnused),
    passes("MATT8", kUnused),
    passes("MATT9", kTemperature),
    passes("MDLPRM", kNonlinear),
    reads("MOMENT", read_force, 8, "moment"),
    reads("MOMENT1", read_force1, 8, "moment"),
    reads("MOMENT2", read_force2, 8, "moment"),
    passes("MONPNT1", kOutput),
    passes("MONPNT2", kOutput),
    passes("MONPNT3", kOutput),
    reads("MPC", read_mpc, 0, "equation"),
    reads("MPCADD", read_mpcadd, 0, "sum of sets of equations"),
    passes("NLADAPT", kNonlinear),
    passes("NLPARM", kNonlinear),
    passes("NLPCI", kNonlinear),
    passes("NLSTEP", kNonlinear),
    passes("OMIT", kSuper),
    passes("OMIT1", kSuper),
    passes("PANEL", kOutput),
    Role{"PARAM", Fate::kRead, nullptr, 8, 0, 0,
         "WTMASS, COUPMASS, CK2, CM2, INREL, G; ALPHA1 and ALPHA2 are offered as damping; others "
         "are passed over"},
    reads("PBAR", read_pbar, 24, kBeamSection),
    reads("PBARL", read_pbarl, 0, kBeamSection),
    passes("PBCOMP", kUnused),
    reads("PBEAM", read_pbeam, 0, kBeamSection),
    reads("PBEAML", read_pbeaml, 0, kBeamSection),
    passes("PBEND", kUnused),
    reads("PBUSH", read_pbush, 0, "stiffness and loss factors of bushes"),
    passes("PBUSHT", kDynamic),
    reads("PCOMP", read_pshell, 0, kLayers),
    reads("PCOMPG", read_pshell, 0, kLayers),
    reads("PCOMPS", read_other_property, 0, "named where a solid or shell has it"),
    passes("PDAMP", kDampers),
    passes("PDAMP5", kDampers),
    passes("PDAMPT", kDampers),
    reads("PELAS", read_pelas, 8, "stiffness and loss factor of springs"),
    passes("PELAST", kDynamic),
    reads("PFAST", read_pfast, 16, "diameter, stiffness and mass of CFAST"),
    reads("PGAP", read_pgap, 0, "stiffness of gaps"),
    reads("PLOAD", read_pload, 8, "pressure on a face of solids or shells"),
    refuses("PLOAD1", kBarLoads, 0, 0),
    reads("PLOAD2", read_pload2, 0, "pressure on shells, or two-dimensional cells on solids"),
    reads("PLOAD4", read_pload4, 16, "pressure on a face, normal or along a vector"),
    passes("PLOTEL", kOutput),
    passes("PLOTEL3", kOutput),
    passes("PLOTEL4", kOutput),
    reads("PLPLANE", read_other_property, 8, "named where a solid or shell has it"),
    reads("PLSOLID", read_other_property, 8, "named where a solid or shell has it"),
    reads("PMASS", read_pmass, 8, "mass of CMASS1 and CMASS3"),
    reads("PROD", read_prod, 8, kBeamSection),
    passes("PSHEAR", kUnused),
    reads("PSHELL", read_pshell, 16,
          "section of shells with its materials; of faces of solids left out with a line"),
    reads("PSOLID", read_psolid, 8, "region with its material"),
    reads("PTUBE", read_ptube, 8, kBeamSection),
    passes("PVISC", kDampers),
    reads("PWELD", read_pweld, 16, "diameter and material of CWELD"),
    passes("QSET", kSuper),
    passes("QSET1", kSuper),
    passes("RANDPS", kDynamic),
    passes("RANDT1", kDynamic),
    reads("RBAR", read_rbar, 16, "rigid coupling, or equations"),
    reads("RBAR1", read_rbar1, 8, "rigid coupling, or equations"),
    reads("RBE1", read_rbe1, 0, "rigid coupling, or equations"),
    reads("RBE2", read_rbe2, 0, "rigid coupling; in some directions of a CD system: equations"),
    reads("RBE3", read_rbe3, 0, "distributing coupling"),
    reads("RFORCE", read_rforce, 24, "rotation"),
    reads("RJOINT", read_rbar1, 8, "rigid coupling, or equations"),
    passes("RLOAD1", kDynamic),
    passes("RLOAD2", kDynamic),
    reads("RROD", read_rrod, 8, "equation"),
    refuses("RSPLINE", kSpline, 0, 0),
    refuses("RTRPLT", kPlate, 0, 0),
    refuses("SEBULK", kOthers, 0, 0),
    refuses("SECONCT", kOthers, 0, 0),
    refuses("SESET", kOthers, 0, 0),
    reads("SET1", read_set1, 0, "node set"),
    passes("SET2", kOutput),
    passes("SET3", kOutput),
    reads("SPC", read_spc, 8, "supports, prescribed displacements"),
    reads("SPC1", read_spc1, 0, "supports"),
    reads("SPCADD", read_spcadd, 0, "sum of sets of supports"),
    reads("SPCD", read_spcd, 8, "prescribed displacements of a load set"),
    reads("SPOINT", read_spoint, 0, "scalar point"),
    passes("SUPORT", kSuper),
    passes("SUPORT1", kSuper),
    passes("TABDMP1", kDynamic),
    passes("TABLED1", kDynamic),
    passes("TABLED2", kDynamic),
    passes("TABLED3", kDynamic),
    passes("TABLED4", kDynamic),
    passes("TABLEM1", kTemperature),
    passes("TABLEM2", kTemperature),
    passes("TABLEM3", kTemperature),
    passes("TABLEM4", kTemperature),
    passes("TABLES1", kNonlinear),
    passes("TABLEST", kTemperature),
    passes("TABRND1", kDynamic),
    passes("TABRNDG", kDynamic),
    reads("TEMP", read_temp, 8, "temperatures of nodes"),
    reads("TEMPD", read_tempd, 8, "temperature of all other nodes"),
    refuses("TF", kGenel, 0, 0),
    passes("TIC", kDynamic),
    passes("TLOAD1", kDynamic),
    passes("TLOAD2", kDynamic),
    passes("TOPVAR", kOptimisation),
    passes("TSTEP", kDynamic),
    passes("TSTEPNL", kDynamic),
    passes("USET", kSuper),
    passes("USET1", kSuper),
    passes("VIEW", kOutput),
    passes("VIEW3D", kOutput),
};

static_assert(std::is_sorted(kRoles.begin(), kRoles.end(),
                             [](const Role& a, const Role& b) { return a.name < b.name; }));

}  // namespace

const Role* role_of(std::string_view name) {
  const auto at =
      std::lower_bound(kRoles.begin(), kRoles.end(), name,
                       [](const Role& role, std::string_view n) { return role.name < n; });
  return at != kRoles.end() && at->name == name ? &*at : nullptr;
}

std::vector<Listed> listed_cards() {
  std::vector<Listed> rows;
  for (const Role& role : kRoles) {
    const std::string remark =
        role.fate == Fate::kRefused ? advice_of(role) : std::string(role.meaning);
    rows.push_back({std::string(role.name), role.fate, remark});
  }
  return rows;
}

std::string advice_of(const Role& role) {
  return fmt::format(fmt::runtime(role.meaning), role.name);
}

}  // namespace clatter::mesh::deck::nastran
