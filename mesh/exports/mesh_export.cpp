// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/exports/mesh_export.hpp"

#include <fmt/format.h>

#include <map>

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

/// Only Nastran's cells have a thickness and an offset of their own.
void warn_of_sections(const Mesh& mesh, const std::filesystem::path& path) {
  int64_t count = 0;
  for (const ShellBlock& block : mesh.shells)
    if (block.thickness.size() > 0 || block.offset.size() > 0) count += block.nodes.rows();
  if (count == 0) return;
  warn(
      fmt::format("{}: {} shells have a thickness or an offset of their own, which only .bdf, .nas "
                  "and .dat contain: give them sections in the other program",
                  path.string(), count));
}

void warn_of_directions(const Mesh& mesh, const std::filesystem::path& path) {
  int64_t count = 0;
  for (const ShellBlock& block : mesh.shells) count += block.axis.rows();
  if (count > 0)
    warn(
        fmt::format("{}: direction 1 of the material of {} shells is not written: give it to their "
                    "sections in the other program",
                    path.string(), count));
}

template <std::string (*kText)(const Mesh&)>
void write_text(const Mesh& mesh, const std::filesystem::path& path) {
  write_whole_file(path, kText(mesh));
}

using Writer = void (*)(const Mesh&, const std::filesystem::path&);

Writer writer_of(const std::filesystem::path& path) {
  static const std::map<std::string, Writer> writers = {
      {".vtu", write_text<vtu_text>}, {".msh", write_text<msh_text>}, {".med", write_med},
      {".unv", write_text<unv_text>}, {".inp", deck::write_abaqus},   {".bdf", deck::write_nastran},
      {".nas", deck::write_nastran},  {".dat", deck::write_nastran}};
  const auto writer = writers.find(path.extension().string());
  if (writer != writers.end()) return writer->second;
  throw InputError(fmt::format(
      "{}: found extension '{}', expected .vtu, .msh, .med, .unv, .inp, .bdf, .nas or .dat",
      path.string(), path.extension().string()));
}

}  // namespace

void check_export(const std::filesystem::path& path) { writer_of(path); }

void export_mesh(const Mesh& mesh, const std::filesystem::path& path) {
  const Writer write = writer_of(path);
  if (path.extension() != ".vtu") {
    warn_of_hanging_mid_side_nodes(mesh, path);
    if (write != static_cast<Writer>(deck::write_nastran)) warn_of_sections(mesh, path);
    warn_of_directions(mesh, path);
  }
  write(mesh, path);
}

}  // namespace clatter::mesh
