// SPDX-License-Identifier: GPL-3.0-or-later
// Any text is either a deck or an InputError: no crash, no hang, no runaway memory. A deck that is
// read survives the round trip through the writer.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "core/base/error.hpp"
#include "mesh/deck/contents.hpp"
#include "mesh/deck/nastran/reader.hpp"
#include "mesh/deck/nastran/writer.hpp"
#include "tests/fuzz/whole_deck.hpp"

namespace {

using clatter::mesh::Mesh;

bool same(const Mesh& a, const Mesh& b) {
  if (a.nodes.rows() != b.nodes.rows() || a.cells.size() != b.cells.size()) return false;
  bool equal = a.nodes == b.nodes && a.node_ids == b.node_ids && a.regions == b.regions &&
               a.node_sets == b.node_sets && a.surfaces.size() == b.surfaces.size();
  for (size_t i = 0; i < a.cells.size(); ++i) {
    equal = equal && a.cells[i].type == b.cells[i].type && a.cells[i].region == b.cells[i].region &&
            a.cells[i].ids == b.cells[i].ids && a.cells[i].nodes == b.cells[i].nodes;
  }
  return equal;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  clatter::mesh::deck::Contents contents;
  try {
    auto deck = clatter::mesh::deck::read_nastran_text(
        "fuzz.bdf", text, {{"CQUAD4", "BCSET"}, std::nullopt, &contents});
    const Mesh mesh = deck.mesh;
    std::ostringstream written;
    clatter::mesh::deck::write_nastran(mesh, written);
    try {
      if (!same(mesh, clatter::mesh::deck::read_nastran_text("back.bdf", written.str()).mesh)) {
        std::abort();
      }
    } catch (const clatter::InputError&) {
      std::abort();
    }
    clatter::test::finish(std::move(deck));
  } catch (const clatter::InputError&) {
  }
  contents.passed_line();
  return 0;
}
