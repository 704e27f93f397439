// SPDX-License-Identifier: GPL-3.0-or-later
// Any text is either a deck or an InputError: no crash, no hang, no runaway memory.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/error.hpp"
#include "mesh/deck/abaqus/reader.hpp"
#include "mesh/deck/contents.hpp"
#include "tests/fuzz/whole_deck.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  clatter::mesh::deck::Contents contents;
  const clatter::mesh::deck::ReadOptions options{
      {"NLGEOM", "S3", "*SHELL SECTION", "MOMENT"}, std::nullopt, &contents};
  try {
    clatter::test::finish(clatter::mesh::deck::read_abaqus_text("fuzz.inp", text, options));
  } catch (const clatter::InputError&) {
  }
  contents.passed_line();
  return 0;
}
