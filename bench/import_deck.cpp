// SPDX-License-Identifier: GPL-3.0-or-later
// import_deck FILE [proved|checked]: reads a deck (.inp Abaqus, else Nastran) and prints nodes,
// cells, seconds, CPU seconds and the megabytes of the mesh itself. proved: with skin and proof, as
// clatter-mesh; checked: as clatter-mesh --check, which has no mesh to count.
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <filesystem>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "mesh/deck/abaqus/reader.hpp"
#include "mesh/deck/check.hpp"
#include "mesh/deck/import.hpp"
#include "mesh/deck/nastran/reader.hpp"

namespace {

clatter::mesh::deck::Deck read(const std::filesystem::path& path, const std::string& how) {
  if (how == "proved")
    return clatter::mesh::deck::read_deck(path, clatter::unit_system_named("m-kg-s", "units"), {});
  if (how == "checked") {
    if (clatter::mesh::deck::check_deck(path, {}).refused > 0)
      throw clatter::InputError("expected a deck that is read");
    return {};
  }
  if (path.extension() == ".inp") return clatter::mesh::deck::read_abaqus(path, {});
  return clatter::mesh::deck::read_nastran(path, {});
}

double megabytes(const clatter::mesh::Mesh& mesh) {
  auto bytes = static_cast<size_t>(mesh.nodes.size()) * sizeof(double) +
               mesh.node_ids.size() * sizeof(int32_t);
  for (const auto& block : mesh.cells) {
    bytes += (static_cast<size_t>(block.nodes.size()) + block.ids.size()) * sizeof(int32_t);
  }
  for (const auto& [name, nodes] : mesh.node_sets) bytes += nodes.size() * sizeof(int32_t);
  return static_cast<double>(bytes) / 1e6;
}

}  // namespace

int main(int argc, char** argv) {
  return clatter::run_guarded("import_deck", [&] {
    if (argc != 2 && argc != 3) throw clatter::InputError("expected one file and how to read it");
    const auto begin = std::chrono::steady_clock::now();
    const auto deck = read(argv[1], argc == 3 ? argv[2] : "");
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    fmt::print("{} {} {:.3f} {:.3f} {:.1f}\n", deck.mesh.nodes.rows(), deck.mesh.cell_count(),
               seconds.count(), static_cast<double>(std::clock()) / CLOCKS_PER_SEC,
               megabytes(deck.mesh));
    return 0;
  });
}
