// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/exports/export_groups.hpp"

#include <algorithm>
#include <numeric>

#include "mesh/deck/shell_numbers.hpp"

namespace clatter::mesh {
namespace {

bool are_numbers(std::vector<int32_t> ids) {
  std::sort(ids.begin(), ids.end());
  return (ids.empty() || ids.front() > 0) &&
         std::adjacent_find(ids.begin(), ids.end()) == ids.end();
}

class FaceCollector {
 public:
  explicit FaceCollector(const Mesh& mesh) : mesh_(mesh) {}

  std::vector<ExportFace> run() {
    add_shells();
    size_t index = 0;
    for (const auto& [name, surface] : mesh_.surfaces) {
      for (const FaceBlock& block : surface.faces)
        for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
          ExportFace& face = faces_[at(block.type, block.nodes.data() + f * block.nodes.cols())];
          if (face.surfaces.empty() || face.surfaces.back() != index)
            face.surfaces.push_back(index);
        }
      ++index;
    }
    std::stable_sort(faces_.begin(), faces_.end(),
                     [](const ExportFace& a, const ExportFace& b) { return a.type < b.type; });
    return std::move(faces_);
  }

 private:
  void add_shells() {
    const auto numbers = deck::shell_numbers(mesh_, export_cell_numbers(mesh_));
    for (size_t b = 0; b < mesh_.shells.size(); ++b) {
      const ShellBlock& block = mesh_.shells[b];
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
        const int32_t* nodes = block.nodes.data() + c * block.nodes.cols();
        known_.emplace(key_of(block.type, nodes), faces_.size());
        faces_.push_back({block.type,
                          {nodes, nodes + block.nodes.cols()},
                          {},
                          block.region,
                          numbers[b][static_cast<size_t>(c)]});
      }
    }
  }

  static std::vector<int32_t> key_of(FaceType type, const int32_t* nodes) {
    std::vector<int32_t> corners(nodes, nodes + traits(type).corners);
    std::sort(corners.begin(), corners.end());
    return corners;
  }

  // Index of the face, which is added where there is none.
  size_t at(FaceType type, const int32_t* nodes) {
    const auto [at, is_new] = known_.emplace(key_of(type, nodes), faces_.size());
    if (is_new) faces_.push_back({type, {nodes, nodes + traits(type).nodes}, {}});
    return at->second;
  }

  const Mesh& mesh_;
  std::vector<ExportFace> faces_;
  std::map<std::vector<int32_t>, size_t> known_;  // by sorted corners
};

}  // namespace

std::vector<ExportFace> export_faces(const Mesh& mesh) { return FaceCollector(mesh).run(); }

std::vector<std::string> export_region_names(const Mesh& mesh) {
  std::vector<std::string> names = mesh.regions;
  for (const ShellBlock& block : mesh.shells) {
    const std::string& name = mesh.regions[block.region];
    if (mesh.surfaces.contains(name)) names[block.region] = name + "_shells";
  }
  return names;
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

int32_t largest_cell_number(const std::vector<std::vector<int32_t>>& solids,
                            const std::vector<ExportFace>& faces) {
  int32_t largest = 0;
  for (const std::vector<int32_t>& numbers : solids)
    for (const int32_t number : numbers) largest = std::max(largest, number);
  for (const ExportFace& face : faces) largest = std::max(largest, face.number);
  return largest;
}

}  // namespace clatter::mesh
