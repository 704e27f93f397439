// SPDX-License-Identifier: GPL-3.0-or-later
#include "two_parts.hpp"

#include <cmath>
#include <numbers>

#include "block_mesh.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {
namespace {

void add_part(const mesh::Mesh& part, const std::string& name, mesh::Mesh& whole) {
  const auto first = static_cast<int32_t>(whole.nodes.rows());
  whole.nodes.conservativeResize(first + part.nodes.rows(), 3);
  whole.nodes.bottomRows(part.nodes.rows()) = part.nodes;
  const auto region = static_cast<int32_t>(whole.regions.size());
  whole.regions.push_back(name);
  for (mesh::CellBlock block : part.cells) {
    block.region = region;
    block.nodes.array() += first;
    whole.cells.push_back(block);
  }
  for (const auto& [surface, faces] : part.surfaces) {
    mesh::Surface moved = faces;
    for (mesh::FaceBlock& block : moved.faces) block.nodes.array() += first;
    whole.surfaces[name + "_" + surface] = moved;
  }
}

}  // namespace

mesh::Mesh two_parts(const mesh::Mesh& a, const mesh::Mesh& b) {
  mesh::Mesh whole;
  whole.name = "two parts";
  whole.nodes.resize(0, 3);
  add_part(a, "a", whole);
  add_part(b, "b", whole);
  return whole;
}

mesh::Mesh slab(mesh::CellType type, const std::array<int, 3>& n, double shake, double bottom,
                double length) {
  // A smooth sideways motion that vanishes on the four sides: uneven, never folded.
  const auto map = [=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    const double bubble = std::sin(std::numbers::pi * x(0)) * std::sin(std::numbers::pi * x(1));
    return {length * (x(0) + shake / n[0] * bubble * std::cos(3.0 * x(1))),
            x(1) + shake / n[1] * bubble * std::sin(2.0 + 5.0 * x(0)), x(2) + bottom};
  };
  BlockOptions options;
  options.type = type;
  return block_mesh(n, map, options);
}

Eigen::VectorXd free_hz(const fe::FeModel& model, int count) {
  const dense::Eigenpairs eigen =
      dense::symmetric_eigen(full(model.K), full(model.M), dense::EigenParts::kValues);
  return eigen.values.head(count).cwiseAbs().cwiseSqrt() / (2.0 * std::numbers::pi);
}

}  // namespace clatter::assembly::testing
