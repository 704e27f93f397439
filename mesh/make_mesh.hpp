// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The stage's main call: from a description, CAD or a deck to a proved mesh.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/artefact.hpp"
#include "core/base/child_process.hpp"
#include "core/base/json_line.hpp"
#include "core/mesh/mesh.hpp"
#include "mesh/deck/recipe/recipe.hpp"
#include "mesh/repair/mesh_certificate.hpp"
#include "mesh/repair/quality.hpp"

namespace clatter::mesh {

/// What to mesh, and how.
struct MeshRequest {
  std::filesystem::path input;      // description, CAD or deck
  std::filesystem::path output;     // of the mesh; a CAD file's description lies beside it
  std::filesystem::path step;       // geometry to write as well (.step, .brep); empty: none
  std::string units;                // of a deck
  std::vector<std::string> ignore;  // cards, keywords, groups of a deck to skip
  std::string mass;                 // of a deck's recipe: as in the deck (or empty), ...
  double element_size_mm = 0.0;     // 0: as in the description
  bool accept_poor_cells = false;   // a warning instead of an error
  ChildLimits limits;               // of the child processes that run gmsh
};

/// A mesh and what the other files to write contain.
struct NewMesh {
  Mesh mesh;
  QualityReport quality;
  MeshCertificate certificate;
  Provenance provenance;
  std::optional<deck::Recipe> recipe;  // fe.toml of a deck
  std::string cad;                     // of the geometry, if requested
  std::string description;             // mesh.toml of a CAD file without one
};

/// Meshes a geometry by gmsh, or reads the cells of a deck, proves every cell valid and measures
/// the mesh; warns about an implausible size. `clock` records the steps. InputError for wrong
/// input and poor cells, NumericsError when gmsh fails or a cell stays invalid.
NewMesh make_mesh(const MeshRequest& request, StepClock& clock);

/// Summary lines for the user.
std::vector<std::string> describe(const NewMesh& made);

/// For --json: cells, predicted_cells (null for a deck), dofs, min_dihedral_deg.
JsonMembers json_of(const NewMesh& made);

}  // namespace clatter::mesh
