// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/skin/radiated_power.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "core/base/progress.hpp"
#include "core/base/threads.hpp"

namespace clatter::recover {
namespace {

/// Faces that belong to the same panels; their part of W is added to all of these.
struct Patch {
  std::vector<size_t> panels;
  std::vector<int32_t> faces;
};

std::vector<Patch> split_into_patches(const std::vector<Panel>& panels, int64_t n_faces) {
  std::vector<std::vector<size_t>> members(static_cast<size_t>(n_faces));
  for (size_t p = 0; p < panels.size(); ++p)
    for (int32_t face : panels[p].faces) members[face].push_back(p);
  std::map<std::vector<size_t>, std::vector<int32_t>> by_membership;
  for (size_t face = 0; face < members.size(); ++face)
    if (!members[face].empty()) by_membership[members[face]].push_back(static_cast<int32_t>(face));
  std::vector<Patch> patches;
  for (auto& [owners, faces] : by_membership) patches.push_back({owners, std::move(faces)});
  return patches;
}

/// Position along a Z-order curve (Morton 1966), 10 bits an axis: near in it, near in space.
uint32_t z_order(const Eigen::RowVector3d& at, const Eigen::RowVector3d& low, double size) {
  uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<uint32_t>(1023.0 * (at[axis] - low[axis]) / size);
    for (int bit = 0; bit < 10; ++bit) code |= ((cell >> bit) & 1u) << (3 * bit + axis);
  }
  return code;
}

/// Sorts faces so that neighbours in the list are neighbours on the skin and share nodes.
void sort_by_neighbourhood(const SkinGeometry& geometry, std::vector<int32_t>& faces) {
  const Eigen::RowVector3d low = geometry.face_centre.colwise().minCoeff();
  const double size = (geometry.face_centre.colwise().maxCoeff() - low).maxCoeff();
  if (!(size > 0.0)) return;
  const auto key = [&](int32_t face) {
    return std::pair{z_order(geometry.face_centre.row(face), low, size), face};
  };
  std::sort(faces.begin(), faces.end(), [&](int32_t a, int32_t b) { return key(a) < key(b); });
}

/// Faces with their nodes numbered among themselves, and these nodes' rows of T.
struct FaceGroup {
  RowMatrix nodes;        // n x 3 [m]
  IndexMatrix triangles;  // f x 6, rows of `nodes`
  RowMatrix T;            // 3 n x r
};

FaceGroup read_group(const rom::Skin& skin, const rom::SkinRows& T,
                     std::span<const int32_t> faces) {
  FaceGroup group;
  group.triangles = skin.triangles(std::vector<int32_t>(faces.begin(), faces.end()), Eigen::all);
  std::vector<int32_t> used(group.triangles.data(),
                            group.triangles.data() + group.triangles.size());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (int32_t& id : group.triangles.reshaped())
    id = static_cast<int32_t>(std::lower_bound(used.begin(), used.end(), id) - used.begin());
  group.nodes = skin.nodes(used, Eigen::all);
  group.T = T.of_nodes(used);
  return group;
}

/// Adds the lower triangle of the form of faces [begin, end) of a group.
void add_form(const FaceGroup& group, int64_t begin, int64_t end, Eigen::MatrixXd& lower) {
  constexpr int64_t kFacesAtOnce = 128;
  std::vector<int32_t> faces(static_cast<size_t>(group.triangles.rows()));
  std::iota(faces.begin(), faces.end(), 0);
  for (int64_t first = begin; first < end; first += kFacesAtOnce) {
    const NormalSamples samples = normal_samples(group.nodes, group.triangles, faces, first,
                                                 std::min(first + kFacesAtOnce, end));
    RowMatrix rows = samples.sample * group.T;
    rows = samples.weight.cwiseSqrt().asDiagonal() * rows;
    lower.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
  }
}

/// Faces whose rows of T take about 200 MB; on a quadratic skin a face has two nodes of its own.
int64_t faces_of_a_group(Eigen::Index r) {
  return std::max<int64_t>((int64_t{25} << 20) / (6 * std::max<int64_t>(r, 1)), 128);
}

Eigen::MatrixXd patch_form(const rom::Skin& skin, const rom::SkinRows& T,
                           const std::vector<int32_t>& faces, Progress& progress, double& done) {
  const Eigen::Index r = T.cols();
  const auto n_faces = static_cast<int64_t>(faces.size());
  const int64_t step = faces_of_a_group(r), threads = thread_count();
  // One sum per thread, added in order: same threads, same result.
  std::vector<Eigen::MatrixXd> lower(static_cast<size_t>(threads));
  for (int64_t first = 0; first < n_faces; first += step) {
    const int64_t count = std::min(step, n_faces - first);
    const FaceGroup group = read_group(
        skin, T, std::span(faces).subspan(static_cast<size_t>(first), static_cast<size_t>(count)));
    parallel_pieces(threads, [&](int64_t begin, int64_t end) {
      for (int64_t t = begin; t < end; ++t) {
        Eigen::MatrixXd& sum = lower[t];
        if (sum.size() == 0) sum = Eigen::MatrixXd::Zero(r, r);
        add_form(group, count * t / threads, count * (t + 1) / threads, sum);
      }
    });
    progress.update(done += static_cast<double>(count));
  }
  for (size_t t = 1; t < lower.size(); ++t) lower[0] += lower[t];
  return lower[0].selfadjointView<Eigen::Lower>();
}

}  // namespace

std::vector<PanelForm> normal_velocity_forms(const rom::Skin& skin, const rom::SkinRows& T,
                                             const SkinGeometry& geometry,
                                             const std::vector<Panel>& panels) {
  const Eigen::Index r = T.cols();
  std::vector<PanelForm> forms;
  for (const Panel& panel : panels)
    forms.push_back({panel.name, panel.area, Eigen::MatrixXd::Zero(r, r)});
  std::vector<Patch> patches = split_into_patches(panels, geometry.face_area.size());
  Progress progress("normal velocity forms", static_cast<double>(geometry.face_area.size()),
                    "faces");
  double done = 0.0;
  for (Patch& patch : patches) {
    sort_by_neighbourhood(geometry, patch.faces);
    const Eigen::MatrixXd W = patch_form(skin, T, patch.faces, progress, done);
    for (size_t owner : patch.panels) forms[owner].W += W;
  }
  return forms;
}

Eigen::VectorXd normal_velocity_integral(const Eigen::MatrixXd& W, const RowMatrix& v) {
  Eigen::VectorXd result(v.rows());
  parallel_pieces(v.rows(), [&](int64_t begin, int64_t end) {
    const auto rows = v.middleRows(begin, end - begin);
    result.segment(begin, end - begin) = (rows * W).cwiseProduct(rows).rowwise().sum();
  });
  // W is semidefinite: negative values are rounding and set to zero.
  return result.cwiseMax(0.0);
}

Eigen::VectorXd normal_velocity_integral(const Eigen::MatrixXd& W, const Eigen::MatrixXcd& v) {
  const RowMatrix real = v.real(), imag = v.imag();
  return normal_velocity_integral(W, real) + normal_velocity_integral(W, imag);
}

}  // namespace clatter::recover
