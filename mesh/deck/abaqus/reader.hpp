// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reads an Abaqus or CalculiX input deck.
#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// Supported, in the deck's own units:
///
///   mesh        *NODE, *ELEMENT of C3D4 C3D5 C3D6 C3D8 C3D8I C3D8R C3D10 C3D15 C3D20 C3D20R,
///               *NSET, *ELSET, *SURFACE, *PART, *INSTANCE, *INCLUDE
///   material    *ELASTIC, *DENSITY, *EXPANSION, *SOLID SECTION, *ORIENTATION
///   constraints *TIE, *COUPLING, *DISTRIBUTING COUPLING, *RIGID BODY, *EQUATION, *MPC of PIN, TIE,
///               BEAM and LINEAR, *MASS, *ROTARY INERTIA
///   steps       *STATIC, *FREQUENCY with *BOUNDARY, *TRANSFORM, *CLOAD, *DLOAD, *DSLOAD,
///   *TEMPERATURE
///
/// Names are kept as first written and compared without case and blanks. Output requests are
/// skipped; any other keyword, parameter or element type is an InputError "deck.inp:12: ..." unless
/// the user ignores it by name. Interpretation of the deck:
///
/// - A region is an element set with a section and has its name; a deck without any section has the
///   sets of *ELEMENT as regions, without material. Other element sets are not stored in the mesh.
/// - Nodes without elements are skipped unless a constraint, a mass or an equation needs them: then
///   they are points. A support of a skipped node has no effect and is skipped too.
/// - A deck of instances: a scope's numbers are kept if they are above those of the scopes before,
///   else a multiple of a power of ten is added (node 17 of the second instance: 1017). A name of a
///   part becomes "instance.name" if there are several instances or the assembly has that name as
///   well.
/// - C3D8 and C3D20 are kFull, C3D6, C3D15, C3D8R and C3D20R kReduced, C3D8I kIncompatible.
/// - Strains of a temperature start at that of *INITIAL CONDITIONS; ZERO of *EXPANSION has no
///   effect on constant coefficients.
/// - A reference node that belongs to an element becomes a point as well, which moves that node; a
///   ROT NODE's translations are the rotations of its reference point.
/// - *DISTRIBUTING COUPLING with its node at the weighted centre of the others means the same in
///   all programs. Elsewhere the moment of a force is balanced, as in Abaqus, with a note; ignore =
///   ["MOMENT"] reads it as CalculiX does: a weighted mean, the moment is lost.
/// - Elements of two dimensions that are a face of a solid are surfaces with the names of their
///   sets, lines on the nodes of solids are node sets; without a section the others are left out
///   with a note, with one they are refused.
/// - Without any section a *ELSET of complete *ELEMENT sets (a physical group of Gmsh) is a region.
/// - C3D10M, C3D8H, C3D8S, C3D8T and the like are read as the type without these letters, with a
/// note
///   each.
/// - Bonded *CONTACT PAIR and general contact are ties; other contact is refused.
/// - *DISTRIBUTING COUPLING, *KINEMATIC COUPLING, *RIGID BODY with TIE NSET or PIN NSET.
/// - Keywords between *INSTANCE and *END INSTANCE belong to that instance alone.
/// - <name> of *PARAMETER is replaced in all later lines.
/// - An element line with too many nodes is refused; ignore = ["EXTRA NODES"] takes the first ones,
///   as CalculiX does.
/// - Elements of the assembly name nodes of instances as "instance.number".
/// - An amplitude is a factor at the end of a general static step; elsewhere it must be constant.
/// - A force per volume (BX, BY, BZ) is an acceleration of the model, which has one density.
/// - A *TIE or *COUPLING surface of TYPE=NODE means the outer faces whose nodes are all in it.
/// - Equations between nodes with *TRANSFORM are transformed to the basic axes.
/// - *STEP, PERTURBATION after a loaded *STATIC step is skipped with all that follow and a note
///   (its stiffness depends on the loads), and so is a step with NLGEOM after others; ignore =
///   ["PERTURBATION"] takes the unloaded stiffness, ignore = ["NLGEOM"] a step as linear, ignore =
///   ["AMPLITUDE"] loads without their amplitude. NLGEOM in the first step is refused.
/// - SPRINGA, SPRING1 and SPRING2 become springs; dashpots are skipped with a note.
/// - *MPC, MEANROT: DoF 1 of its last node becomes the rotation rx of a point.
/// - *CYCLIC SYMMETRY MODEL: the sector is expanded to the full ring (cyclic.hpp).
/// - Steps inherit loads and supports from the step before (OP=MOD); within one step loads on the
///   same node or face add up. A *STEP, PERTURBATION has only its own loads.
///
/// InputError for errors in the deck, FileError when it cannot be read.
Deck read_abaqus(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same from text in memory, without includes; `name` is for messages.
Deck read_abaqus_text(const std::string& name, std::string_view text,
                      const ReadOptions& options = {});

}  // namespace clatter::mesh::deck
