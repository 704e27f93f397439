// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/make_mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/plausible.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/mesh/pieces.hpp"
#include "mesh/cad_alone.hpp"
#include "mesh/deck/import.hpp"
#include "mesh/deck/msh/reader.hpp"
#include "mesh/deck/other_formats.hpp"
#include "mesh/deck/recipe/recipe.hpp"
#include "mesh/geometry/bare_cad.hpp"
#include "mesh/geometry/cad_unit.hpp"
#include "mesh/part/part_file.hpp"
#include "mesh/part/part_in_child.hpp"
#include "mesh/repair/certify_mesh.hpp"
#include "mesh/repair/poor_cells.hpp"
#include "mesh/repair/shell_quality.hpp"

namespace clatter::mesh {
namespace {

/// Geometry meshed by gmsh.
NewMesh mesh_geometry(const MeshRequest& a, const Config& config, const PartFile& part,
                      StepClock& clock) {
  const std::string extension = a.step.empty() ? "" : cad_extension(a.step);
  MadePart made = make_part_in_child(
      {&part, a.input.string(), extension, 1e-3 * a.element_size_mm, a.accept_poor_cells},
      a.limits);
  clock.adopt(made.steps);
  NewMesh out{std::move(made.part.mesh),
              std::move(made.part.quality),
              std::move(made.part.certificate),
              {kMeshSchema, config.resolved(), {a.input}},
              {},
              std::move(made.cad),
              {}};
  if (a.element_size_mm > 0.0)
    out.provenance.config += fmt::format("--element-size-mm = {}\n", a.element_size_mm);
  if (part.shape.kind == "cad") out.provenance.inputs.push_back(part.shape.cad.source);
  return out;
}

/// The names of --mass, and of `mass` in [deck].
const std::vector<std::string> kMassForms = {"as in the deck", "consistent", "lumped"};

std::optional<deck::MassForm> mass_form(const std::string& name, const std::string& where) {
  if (name.empty() || name == kMassForms[0]) return std::nullopt;
  if (name == kMassForms[1]) return deck::MassForm::kConsistent;
  if (name == kMassForms[2]) return deck::MassForm::kLumped;
  throw InputError(fmt::format("{}: found \"{}\", expected one of: {}", where, name,
                               fmt::join(kMassForms, ", ")));
}

/// A deck with its own cells.
NewMesh read_mesh_of_deck(const std::filesystem::path& source, const UnitSystem& units,
                          const deck::ReadOptions& options, const std::string& name,
                          const ChildLimits& limits, StepClock& clock) {
  const std::vector<std::string>& ignore = options.ignore;
  deck::Deck found = is_mesh_file(source) ? read_mesh_file(source, units, options, limits)
                                          : deck::read_deck(source, units, options);
  clock.lap("read");
  for (const auto& [card, count] : found.ignored)
    say(fmt::format("{}: ignored {} ({} times)", source.string(), card, count));
  if (!found.passed.empty()) say(fmt::format("{}: {}", source.string(), found.passed));
  found.mesh.name = name;
  NewMesh out;
  out.recipe = deck::recipe_of(found);
  out.mesh = std::move(found.mesh);
  check_structure(out.mesh, source.string());
  out.quality = measure_quality(out.mesh);
  const PoorCells poor = find_poor_cells(out.mesh, out.quality);
  out.certificate = certify_mesh(out.mesh, out.quality);
  note_poor_cells(poor, out.certificate);
  // A mesh of the user is never refused for quality.
  refusal_of_poor_cells(poor, out.mesh, kQualityAims,
                        {units.name.substr(0, units.name.find('-')), units.length}, true);
  const std::string config = fmt::format("source = \"{}\"\nunits = \"{}\"\nignore = [{}]\n",
                                         source.string(), units.name, fmt::join(ignore, ", "));
  out.provenance = {kMeshSchema, config, {}};
  for (const std::string& file : found.files) out.provenance.inputs.emplace_back(file);
  clock.lap("mesh");
  return out;
}

/// A CAD file alone: meshed like the description that is written next to the mesh.
NewMesh mesh_bare_cad(const MeshRequest& a, StepClock& clock) {
  const std::filesystem::path description = description_beside(a.output);
  const double size =
      a.element_size_mm > 0.0 ? a.element_size_mm : default_element_size_mm(a.input, a.limits);
  if (a.element_size_mm == 0.0)
    say(fmt::format(
        "mesh: element size {} mm, from the part's volume (--element-size-mm overrides it)", size));
  const Config config = config_of_cad(a.input, size);
  NewMesh out = mesh_geometry(a, config, part_keys().read(config), clock);
  out.provenance.inputs = {a.input};
  out.description = cad_description(a.input, description, size);
  return out;
}

NewMesh make_any_mesh(const MeshRequest& a, StepClock& clock) {
  if (is_cad(a.input)) return mesh_bare_cad(a, clock);
  if (deck::is_deck(a.input) || is_mesh_file(a.input)) {
    if (a.units.empty())
      throw InputError(
          fmt::format("{}: needs --units: a deck does not say its own", a.input.string()));
    return read_mesh_of_deck(a.input, unit_system_named(a.units, "--units"),
                             {a.ignore, mass_form(a.mass, "--mass")}, a.input.stem().string(),
                             a.limits, clock);
  }
  deck::refuse_other_format(a.input);
  const Config config = Config::load(a.input);
  const PartFile part = part_keys().read(config);
  if (part.shape.kind != "deck") return mesh_geometry(a, config, part, clock);
  NewMesh out = read_mesh_of_deck(part.deck.source, part.deck.units,
                                  {part.deck.ignore, mass_form(part.deck.mass, "deck.mass")},
                                  part.name, a.limits, clock);
  out.provenance.config = config.resolved();
  out.provenance.inputs.push_back(a.input);
  return out;
}

}  // namespace

NewMesh make_mesh(const MeshRequest& request, StepClock& clock) {
  NewMesh made = make_any_mesh(request, clock);
  const RowMatrix& nodes = made.mesh.nodes;
  if (nodes.rows() == 0) return made;
  warn_implausible(
      request.input.string(),
      {length_warning((nodes.colwise().maxCoeff() - nodes.colwise().minCoeff()).maxCoeff())});
  return made;
}

std::vector<std::string> describe(const NewMesh& result) {
  std::vector<std::string> lines;
  const auto& c = result.certificate;
  const Measure& angle = result.quality.min_dihedral_deg;
  lines.push_back(fmt::format("mesh: {:.0f} cells, {:.0f} nodes, {:.0f} degrees of freedom",
                              c.cells, c.nodes, c.dofs));
  if (result.mesh.cell_count() == 0) return lines;
  for (size_t r = 0; r < result.mesh.regions.size(); ++r) {
    const auto region = static_cast<int32_t>(r);
    const double area =
        integrate(result.mesh, shell_surface(result.mesh, region), Eigen::Vector3d::Zero()).area;
    lines.push_back(fmt::format(
        "mesh: region {}: {}", result.mesh.regions[r],
        area > 0.0 ? fmt::format("area of shells {:.6g} m2", area)
                   : fmt::format("volume {:.6g} m3", cell_volume(result.mesh, region))));
  }
  if (const Pieces pieces = pieces_of(result.mesh); pieces.count > 1)
    lines.push_back(fmt::format(
        "mesh: {} pieces share no node; {} nodes of one lie on nodes of another: each piece moves "
        "by itself unless a tie, bolt or coupling joins it",
        pieces.count, pieces.coincident_nodes));
  if (c.volume_against_cad)
    lines.push_back(fmt::format("mesh: volume against CAD {:+.2e}", *c.volume_against_cad));
  if (!result.mesh.shells.empty()) lines.push_back(describe(measure_shells(result.mesh)));
  if (result.mesh.cells.empty()) return lines;
  lines.push_back(fmt::format("mesh: volume against the surface integral {:.1e}",
                              c.volume_against_surface_integral));
  lines.push_back(
      fmt::format("mesh: smallest dihedral angle {:.3g} deg in cell {} at ({:.4f}, {:.4f}, {:.4f}) "
                  "m, scaled Jacobian {:.3f} in cell {}",
                  angle.worst, angle.label, angle.position.x(), angle.position.y(),
                  angle.position.z(), c.min_scaled_jacobian, result.quality.scaled_jacobian.label));
  if (c.invalid_cells_before_repair)
    lines.push_back(fmt::format("mesh: folded cells before repair: {:.0f}, now 0",
                                *c.invalid_cells_before_repair));
  return lines;
}

JsonMembers json_of(const NewMesh& made) {
  const auto& c = made.certificate;
  return {{"cells", json_number(c.cells)},
          {"predicted_cells", c.predicted_cells ? json_number(*c.predicted_cells) : "null"},
          {"dofs", json_number(c.dofs)},
          {"min_dihedral_deg", json_number(c.min_dihedral_deg)}};
}

}  // namespace clatter::mesh
