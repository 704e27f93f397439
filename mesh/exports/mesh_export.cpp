// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/exports/mesh_export.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/whole_file.hpp"
#include "core/mesh/vtu_writer.hpp"
#include "mesh/deck/abaqus/writer.hpp"
#include "mesh/deck/nastran/writer.hpp"
#include "mesh/exports/med_writer.hpp"
#include "mesh/exports/msh_writer.hpp"
#include "mesh/exports/unv_writer.hpp"

namespace clatter::mesh {
namespace {

/// These formats have complete cells; only clatter uses the set.
void warn_of_hanging_mid_side_nodes(const Mesh& mesh, const std::filesystem::path& path) {
  const auto set = mesh.node_sets.find(kHangingMidSideNodes);
  if (set == mesh.node_sets.end()) return;
  warn(
      fmt::format("{}: the {} mid-side nodes of the set \"{}\" move freely in other programs: tie "
                  "each to the mean of its edge's ends there",
                  path.string(), set->second.size(), kHangingMidSideNodes));
}

}  // namespace

void export_mesh(const Mesh& mesh, const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".vtu") return write_whole_file(path, vtu_text(mesh));
  if (extension == ".msh" || extension == ".inp" || extension == ".med" || extension == ".unv")
    warn_of_hanging_mid_side_nodes(mesh, path);
  if (extension == ".msh") return write_whole_file(path, msh_text(mesh));
  if (extension == ".med") return write_med(mesh, path);
  if (extension == ".unv") return write_whole_file(path, unv_text(mesh));
  if (extension == ".inp") return deck::write_abaqus(mesh, path);
  if (extension == ".bdf" || extension == ".nas" || extension == ".dat")
    return deck::write_nastran(mesh, path);
  throw InputError(fmt::format(
      "{}: found extension '{}', expected .vtu, .msh, .med, .unv, .inp, .bdf, .nas or .dat",
      path.string(), extension));
}

}  // namespace clatter::mesh
