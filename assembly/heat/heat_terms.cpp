// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/heat/heat_terms.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "core/base/error.hpp"
#include "core/fe/heat.hpp"
#include "core/mesh/boundary.hpp"

namespace clatter::assembly {
namespace {

std::string name_of(const Selection& selection) {
  return selection.surface.empty() ? selection.node_set : selection.surface;
}

/// Faces of the skin by their corners.
std::set<mesh::FaceKey> faces_of_skin(const mesh::Mesh& mesh) {
  std::set<mesh::FaceKey> keys;
  for (const mesh::FaceBlock& block : mesh.surface("skin").faces)
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f)
      keys.insert(mesh::face_key(
          block.type, {block.nodes.row(f).data(), static_cast<size_t>(block.nodes.cols())}));
  return keys;
}

/// A face between two regions has no fluid: a film there would draw heat from inside the part.
void require_outside(const mesh::Mesh& mesh, const std::set<mesh::FaceKey>& skin,
                     const std::string& surface, const std::string& where) {
  for (const mesh::FaceBlock& block : mesh.surface(surface).faces)
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      const mesh::FaceKey key = mesh::face_key(
          block.type, {block.nodes.row(f).data(), static_cast<size_t>(block.nodes.cols())});
      if (skin.contains(key)) continue;
      const Eigen::RowVector3d at = mesh.nodes.row(block.nodes(f, 0));
      throw InputError(
          fmt::format("{}: found a face of {} inside the part, at ({:.6g}, {:.6g}, {:.6g}) m, "
                      "expected faces of its boundary",
                      where, surface, at(0), at(1), at(2)));
    }
}

}  // namespace

double HeatTerms::into_part(const Eigen::VectorXd& temperature) const {
  if (H.nonZeros() == 0) return q.sum();
  return (q - Eigen::VectorXd(multiply_symmetric(H, temperature))).sum();
}

std::vector<HeatTerms> heat_terms(const PartData& part, const HeatSpec& spec) {
  const mesh::Mesh& mesh = part.mesh;
  const SparseMatrix none(mesh.nodes.rows(), mesh.nodes.rows());
  std::vector<HeatTerms> terms;
  std::set<mesh::FaceKey> skin;
  if (!spec.films.empty() || !spec.fluxes.empty()) skin = faces_of_skin(mesh);
  for (const HeatSpec::Film& film : spec.films) {
    require_outside(mesh, skin, film.surface, spec.where);
    fe::SurfaceHeat heat =
        fe::film_heat(mesh.nodes, mesh.surface(film.surface), on_surface(film.coefficient),
                      on_surface(film.temperature));
    terms.push_back({"film " + film.surface, std::move(heat.H), std::move(heat.q)});
  }
  for (const HeatSpec::Flux& flux : spec.fluxes) {
    require_outside(mesh, skin, flux.surface, spec.where);
    terms.push_back({"flux " + flux.surface, none,
                     fe::flux_heat(mesh.nodes, mesh.surface(flux.surface), on_surface(flux.flux))});
  }
  for (const HeatSpec::Source& source : spec.sources)
    terms.push_back(
        {fmt::format("source {}", fmt::join(source.regions, " ")), none,
         fe::volume_heat(mesh, source.power) +
             fe::sheet_heat(mesh, part.recipe.materials, part.recipe.sections, source.power)});
  return terms;
}

FixedNodes fixed_nodes(const PartData& part, const HeatSpec& spec) {
  FixedNodes out;
  for (size_t k = 0; k < spec.fixed.size(); ++k) {
    const HeatSpec::Fixed& one = spec.fixed[k];
    out.boundaries.push_back("fixed " + name_of(one.selection));
    const std::vector<int32_t> nodes =
        one.selection.surface.empty() ? part.mesh.node_set(one.selection.node_set)
                                      : mesh::nodes_of(part.mesh.surface(one.selection.surface));
    for (const int32_t node : nodes) {
      const auto [at, added] = out.kelvin.emplace(node, one.temperature);
      if (!added && at->second != one.temperature)
        throw InputError(fmt::format(
            "{}: found a node of {} that {} fixes at another temperature, expected one temperature",
            one.selection.where, name_of(one.selection), out.boundaries[out.which.at(node)]));
      out.which.emplace(node, k);
    }
  }
  return out;
}

SparseMatrix contact_conduction(const PartData& part, const TieSpec& tie, const Projection& found,
                                double conductance) {
  const mesh::Mesh& mesh = part.mesh;
  const Eigen::Index n = mesh.nodes.rows();
  std::vector<Eigen::Triplet<double, int32_t>> jumps;
  for (const ProjectedNode& row : found.tied) {
    jumps.emplace_back(row.node, row.node, 1.0);
    for (const auto& [node, value] : row.on) jumps.emplace_back(row.node, node, -value);
  }
  SparseMatrix J(n, n);
  J.setFromTriplets(jumps.begin(), jumps.end());
  const SparseMatrix weights =
      fe::film_heat(
          mesh.nodes, mesh.surface(tie.slave), [&](const auto&) { return conductance; },
          [](const auto&) { return 0.0; })
          .H.selfadjointView<Eigen::Lower>();
  const SparseMatrix K = J.transpose() * weights * J;
  return K.triangularView<Eigen::Lower>();
}

}  // namespace clatter::assembly
