// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/shell_quality.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "core/mesh/shell_shape.hpp"

namespace clatter::mesh {

ShellQuality measure_shells(const Mesh& mesh) {
  ShellQuality out;
  out.jacobian.value = std::numeric_limits<double>::infinity();
  int32_t number = 0;
  for (const ShellBlock& block : mesh.shells) {
    const auto n = static_cast<size_t>(traits(block.type).corners);
    (n == 3 ? out.triangles : out.quadrilaterals) += block.nodes.rows();
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      ++number;
      std::array<Eigen::Vector3d, 4> x;
      for (size_t i = 0; i < n; ++i)
        x[i] = mesh.nodes.row(block.nodes(c, static_cast<Eigen::Index>(i)));
      const ShellShape shape = shape_of_shell(std::span(x).first(n));
      const auto take = [&](WorstShell& worst, double value, bool worse) {
        if (!worse) return;
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        for (size_t i = 0; i < n; ++i) centre += x[i] / static_cast<double>(n);
        worst = {value, block.ids.empty() ? number : block.ids[static_cast<size_t>(c)], centre};
      };
      take(out.warp, shape.warp, shape.warp > out.warp.value);
      take(out.aspect, shape.aspect, shape.aspect > out.aspect.value);
      take(out.jacobian, shape.jacobian, shape.jacobian < out.jacobian.value);
    }
  }
  return out;
}

std::string describe(const ShellQuality& quality) {
  const auto worst = [](const WorstShell& shell) {
    return fmt::format("{:.3g} in shell {} at ({:.4f}, {:.4f}, {:.4f}) m", shell.value, shell.label,
                       shell.position.x(), shell.position.y(), shell.position.z());
  };
  return fmt::format(
      "mesh: shells: {} quadrilaterals, {} triangles; largest warp {}, smallest scaled Jacobian "
      "{}, "
      "largest aspect ratio {:.3g}",
      quality.quadrilaterals, quality.triangles, worst(quality.warp), worst(quality.jacobian),
      quality.aspect.value);
}

void note_shells(const ShellQuality& quality, MeshCertificate& certificate) {
  certificate.shell_triangles = static_cast<double>(quality.triangles);
  certificate.largest_shell_warp = quality.warp.value;
  certificate.min_shell_jacobian = quality.jacobian.value;
  certificate.largest_shell_aspect = quality.aspect.value;
}

}  // namespace clatter::mesh
