// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-mesh: from a part's description, or a deck of another program, to a proved mesh.
#include "core/base/command_line.hpp"
#include "core/keys/describe.hpp"
#include "mesh/cards_command.hpp"
#include "mesh/export_command.hpp"
#include "mesh/faces_command.hpp"
#include "mesh/mesh_command.hpp"
#include "mesh/part/part_file.hpp"

namespace {

constexpr const char* kEpilog =
    R"(A part is described in TOML (lengths in length_unit, default mm):

  name = "beam"
  kind = "box"                    # or block, piston, rod, cylinder, pan, cad, sheet
  [box]
  size = [200.0, 20.0, 10.0]
  [mesh]
  element_size_mm = 8.0           # the one number that refines everything

clatter-mesh keys prints every key.

A deck of Nastran (.bdf, .nas, .dat, .fem) or Abaqus and CalculiX (.inp) is read directly; --recipe writes its materials, couplings, supports and loads to the fe.toml of the next stage:
  clatter-mesh part.inp --units mm-t-s -o part.mesh.h5 --recipe part.fe.toml
  clatter-mesh part.bdf --units m-kg-s --ignore CQUAD4 -o part.mesh.h5
  clatter-mesh part.bdf --check            (lists all that it holds: read, passed over, refused)
  clatter-mesh part.msh --units mm-t-s -o part.mesh.h5     (Gmsh, MSH 2 or 4: groups are regions,
                                                            surfaces and node sets; .med, .unv and
                                                            .cdb of ANSYS likewise)
Units: m-kg-s, mm-t-s (N, MPa), mm-kg-ms (kN, GPa), mm-kg-s, cm-g-s, in-lbfs2/in-s. In a
description: kind = "deck" with [deck] source, units, ignore.

Any CAD file: kind = "cad" with [cad] source = "part.step", defeature_below = 0.5 to remove faces
narrower than that (fillets, chamfers, tiny holes), join_within = 0.005 to make faces of different
solids one that are nearer than that (clearances, steps of micrometres); surfaces by
cylinder = { radius, point, axis }, plane = { normal, height }, box = { min, max },
outside = { min, max }.

Sheet metal: kind = "sheet" meshes faces of CAD with shells: all faces of a file without solids, the
middle of a solid of constant thickness, or those that [sheet.faces] selects; [edge.NAME] names node
sets on edges. kind = "pan" is an oil pan from its dimensions.

Examples:
  clatter-mesh faces part.step                   (lists its faces; -o part.faces.h5 to draw them)
  clatter-mesh part.step -o part.mesh.h5         (writes part.mesh.toml too: change it, run it)
  clatter-mesh block.mesh.toml -o block.mesh.h5 --write-step block.step
  clatter-mesh piston.mesh.toml -o piston.mesh.h5 --export piston.vtu --export piston.inp
  clatter-mesh export piston.mesh.h5 piston.med piston.unv                (of a finished mesh)

See mesh/README.md for each kind's dimensions and surfaces. Next stage: clatter-assembly.)";

}  // namespace

int main(int argc, char** argv) {
  using namespace clatter;
  CommandLine program("clatter-mesh",
                      "Builds or imports a part's geometry and meshes it with quadratic "
                      "tetrahedra, sheet with shells, or reads the mesh of a deck; proves it and "
                      "names its surfaces.",
                      kEpilog);
  mesh::declare_mesh(program);
  mesh::declare_faces(program);
  mesh::declare_export(program);
  mesh::declare_cards(program);
  keys::add_keys_command(program, {&mesh::part_keys().table()});
  program.moved("--faces", "clatter-mesh faces PART [-o OUTPUT]");
  return program.run(argc, argv);
}
