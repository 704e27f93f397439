// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/skin/radiated_power.hpp"

#include <algorithm>
#include <map>
#include <mutex>

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
    for (int32_t face : panels[p].faces) members[static_cast<size_t>(face)].push_back(p);
  std::map<std::vector<size_t>, std::vector<int32_t>> by_membership;
  for (size_t face = 0; face < members.size(); ++face)
    if (!members[face].empty()) by_membership[members[face]].push_back(static_cast<int32_t>(face));
  std::vector<Patch> patches;
  for (auto& [owners, faces] : by_membership) patches.push_back({owners, std::move(faces)});
  return patches;
}

/// Lower triangle of the form of faces[begin .. end).
void add_form(const rom::Skin& skin, const std::vector<int32_t>& faces, int64_t begin, int64_t end,
              Eigen::MatrixXd& lower) {
  constexpr int64_t kFacesAtOnce = 128;
  for (int64_t first = begin; first < end; first += kFacesAtOnce) {
    const NormalSamples samples = normal_samples(skin.nodes, skin.triangles, faces, first,
                                                 std::min(first + kFacesAtOnce, end));
    RowMatrix rows = samples.sample * skin.T;
    rows = samples.weight.cwiseSqrt().asDiagonal() * rows;
    lower.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
  }
}

Eigen::MatrixXd patch_form(const rom::Skin& skin, const std::vector<int32_t>& faces) {
  const Eigen::Index r = skin.T.cols();
  std::map<int64_t, Eigen::MatrixXd> pieces;  // summed in order: same threads, same result
  std::mutex lock;
  parallel_pieces(static_cast<int64_t>(faces.size()), [&](int64_t begin, int64_t end) {
    Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(r, r);
    add_form(skin, faces, begin, end, lower);
    const std::lock_guard guard(lock);
    pieces.emplace(begin, std::move(lower));
  });
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(r, r);
  for (const auto& [begin, lower] : pieces) sum += lower;
  return sum.selfadjointView<Eigen::Lower>();
}

}  // namespace

std::vector<PanelForm> normal_velocity_forms(const rom::Skin& skin, const SkinGeometry& geometry,
                                             const std::vector<Panel>& panels) {
  const Eigen::Index r = skin.T.cols();
  std::vector<PanelForm> forms;
  for (const Panel& panel : panels)
    forms.push_back({panel.name, panel.area, Eigen::MatrixXd::Zero(r, r)});
  const std::vector<Patch> patches = split_into_patches(panels, geometry.face_area.size());
  Progress progress("normal velocity forms", static_cast<double>(geometry.face_area.size()),
                    "faces");
  double done = 0.0;
  for (const Patch& patch : patches) {
    const Eigen::MatrixXd W = patch_form(skin, patch.faces);
    for (size_t owner : patch.panels) forms[owner].W += W;
    progress.update(done += static_cast<double>(patch.faces.size()));
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
