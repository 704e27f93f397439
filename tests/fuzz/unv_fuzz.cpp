// SPDX-License-Identifier: GPL-3.0-or-later
// Any text is either such a file or an InputError: no crash, no hang, no runaway memory.
#include <cstddef>
#include <cstdint>

#include "core/base/error.hpp"
#include "mesh/deck/msh/unv_reader.hpp"
#include "tests/fuzz/whole_deck.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  auto file = clatter::test::stream_of(data, size);
  try {
    clatter::test::finish(clatter::mesh::read_unv(file, "fuzz.unv", {}));
  } catch (const clatter::InputError&) {
  }
  return 0;
}
