// Any text is either a deck or an InputError: no crash, no hang, no runaway memory.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/error.hpp"
#include "mesh/deck/nastran_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    clatter::mesh::deck::read_nastran_text("fuzz.bdf", text, {{"CQUAD4", "BCSET"}});
  } catch (const clatter::InputError&) {
  }
  return 0;
}
