// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/exports/export_groups.hpp"

#include <algorithm>
#include <numeric>

namespace clatter::mesh {
namespace {

bool are_numbers(std::vector<int32_t> ids) {
  std::sort(ids.begin(), ids.end());
  return (ids.empty() || ids.front() > 0) &&
         std::adjacent_find(ids.begin(), ids.end()) == ids.end();
}

}  // namespace

std::vector<ExportFace> export_faces(const Mesh& mesh) {
  std::vector<ExportFace> faces;
  std::map<std::vector<int32_t>, size_t> known;  // by sorted corners
  size_t index = 0;
  for (const auto& [name, surface] : mesh.surfaces) {
    for (const FaceBlock& block : surface.faces) {
      const FaceTraits& face = traits(block.type);
      for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
        const int32_t* begin = block.nodes.data() + f * block.nodes.cols();
        std::vector<int32_t> corners(begin, begin + face.corners);
        std::sort(corners.begin(), corners.end());
        const auto [at, is_new] = known.emplace(std::move(corners), faces.size());
        if (is_new) faces.push_back({block.type, {begin, begin + face.nodes}, {}});
        std::vector<size_t>& surfaces = faces[at->second].surfaces;
        if (surfaces.empty() || surfaces.back() != index) surfaces.push_back(index);
      }
    }
    ++index;
  }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const ExportFace& a, const ExportFace& b) { return a.type < b.type; });
  return faces;
}

std::vector<std::vector<size_t>> sets_of_nodes(const Mesh& mesh) {
  std::vector<std::vector<size_t>> sets(static_cast<size_t>(mesh.nodes.rows()));
  size_t index = 0;
  for (const auto& [name, nodes] : mesh.node_sets) {
    for (const int32_t node : nodes) sets[node].push_back(index);
    ++index;
  }
  return sets;
}

std::vector<int32_t> export_node_numbers(const Mesh& mesh) {
  const auto count = static_cast<size_t>(mesh.nodes.rows());
  if (mesh.node_ids.size() == count && are_numbers(mesh.node_ids)) return mesh.node_ids;
  std::vector<int32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

std::vector<std::vector<int32_t>> export_cell_numbers(const Mesh& mesh) {
  std::vector<std::vector<int32_t>> numbers;
  std::vector<int32_t> all;
  bool complete = true;
  for (const CellBlock& block : mesh.cells) {
    complete = complete && static_cast<Eigen::Index>(block.ids.size()) == block.nodes.rows();
    numbers.push_back(block.ids);
    all.insert(all.end(), block.ids.begin(), block.ids.end());
  }
  if (complete && are_numbers(all)) return numbers;
  int32_t next = 0;
  for (size_t b = 0; b < numbers.size(); ++b) {
    numbers[b].resize(mesh.cells[b].nodes.rows());
    for (int32_t& number : numbers[b]) number = ++next;
  }
  return numbers;
}

}  // namespace clatter::mesh
