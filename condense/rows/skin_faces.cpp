// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/rows/skin_faces.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "core/base/named.hpp"
#include "core/mesh/boundary.hpp"

namespace clatter::condense {
namespace {

using mesh::FaceType;

class Builder {
 public:
  explicit Builder(int64_t n_nodes) : n_nodes_(static_cast<int32_t>(n_nodes)) {}

  void add(FaceType type, std::span<const int32_t> f) {
    const auto [entry, fresh] = triangles_of_.try_emplace(mesh::face_key(type, f));
    if (!fresh) return;
    const int32_t first = triangle_count();
    split(type, f);
    entry->second = {first, triangle_count()};
  }

  /// Triangles of a face [first, second), empty when it was not added.
  std::pair<int32_t, int32_t> triangles_of(FaceType type, std::span<const int32_t> f) const {
    const auto entry = triangles_of_.find(mesh::face_key(type, f));
    return entry == triangles_of_.end() ? std::pair{0, 0} : entry->second;
  }

  SkinFaces finish() {
    SkinFaces out;
    out.triangles = Eigen::Map<const IndexMatrix>(
        corners_.data(), static_cast<Eigen::Index>(corners_.size()) / 6, 6);
    std::vector<int32_t> used = corners_;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (int32_t& id : out.triangles.reshaped())
      id = static_cast<int32_t>(std::lower_bound(used.begin(), used.end(), id) - used.begin());
    for (const int32_t id : used)
      out.points.push_back(id < n_nodes_ ? SkinPoint{{id, 1.0}} : made_[id - n_nodes_]);
    return out;
  }

 private:
  int32_t triangle_count() const { return static_cast<int32_t>(corners_.size() / 6); }

  void split(FaceType type, std::span<const int32_t> f) {
    switch (type) {
      case FaceType::kTri6:
        return add_triangle({f[0], f[1], f[2], f[3], f[4], f[5]});
      case FaceType::kTri3:
        return add_triangle(
            {f[0], f[1], f[2], middle(f[0], f[1]), middle(f[1], f[2]), middle(f[2], f[0])});
      case FaceType::kQuad4: {
        const int32_t c = new_point({{f[0], .25}, {f[1], .25}, {f[2], .25}, {f[3], .25}});
        add_triangle({f[0], f[1], f[2], middle(f[0], f[1]), middle(f[1], f[2]), c});
        return add_triangle({f[0], f[2], f[3], c, middle(f[2], f[3]), middle(f[3], f[0])});
      }
      case FaceType::kQuad8: {
        const int32_t c = new_point({{f[0], -.25},
                                     {f[1], -.25},
                                     {f[2], -.25},
                                     {f[3], -.25},
                                     {f[4], .5},
                                     {f[5], .5},
                                     {f[6], .5},
                                     {f[7], .5}});
        add_triangle({f[0], f[1], f[2], f[4], f[5], c});
        return add_triangle({f[0], f[2], f[3], c, f[6], f[7]});
      }
    }
  }

  void add_triangle(const std::array<int32_t, 6>& nodes) {
    corners_.insert(corners_.end(), nodes.begin(), nodes.end());
  }
  int32_t new_point(SkinPoint point) {
    made_.push_back(std::move(point));
    return n_nodes_ + static_cast<int32_t>(made_.size()) - 1;
  }
  int32_t middle(int32_t a, int32_t b) {
    const auto [entry, fresh] = midpoints_.try_emplace(std::minmax(a, b), -1);
    if (fresh) entry->second = new_point({{a, 0.5}, {b, 0.5}});
    return entry->second;
  }

  int32_t n_nodes_;
  std::map<mesh::FaceKey, std::pair<int32_t, int32_t>> triangles_of_;
  std::map<std::pair<int32_t, int32_t>, int32_t> midpoints_;
  std::vector<SkinPoint> made_;
  std::vector<int32_t> corners_;
};

/// body(type, nodes) for each face of some blocks.
template <class Blocks, class Body>
void for_each_face(const Blocks& blocks, Body&& body) {
  for (const auto& block : blocks)
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f)
      body(block.type, std::span<const int32_t>(block.nodes.data() + f * block.nodes.cols(),
                                                static_cast<size_t>(block.nodes.cols())));
}

}  // namespace

SkinFaces skin_faces(const fe::FeModel& model, const std::vector<std::string>& surfaces) {
  Builder builder(model.nodes.rows());
  for (const std::string& name : surfaces)
    for_each_face(find_named(model.surfaces, model.name + ": skin", "surface", name).faces,
                  [&](FaceType type, std::span<const int32_t> f) { builder.add(type, f); });
  SkinFaces out = builder.finish();
  const auto triangles_on = [&](const auto& blocks) {
    std::vector<int32_t> rows;
    for_each_face(blocks, [&](FaceType type, std::span<const int32_t> f) {
      const auto [first, end] = builder.triangles_of(type, f);
      for (int32_t row = first; row < end; ++row) rows.push_back(row);
    });
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
  };
  for (const auto& [name, surface] : model.surfaces)
    if (std::vector<int32_t> rows = triangles_on(surface.faces); !rows.empty())
      out.of_surface[name] = std::move(rows);
  out.sheet = triangles_on(model.cells.shells);
  const std::vector<mesh::FaceBlock> of_parts{{FaceType::kTri6, model.parts.sheet}};
  for (const int32_t row : triangles_on(of_parts)) out.sheet.push_back(row);
  std::sort(out.sheet.begin(), out.sheet.end());
  return out;
}

}  // namespace clatter::condense
