// SPDX-License-Identifier: GPL-3.0-or-later
// Any text is either a symmetric matrix or an InputError: no crash, no hang, no runaway memory.
// The result is a lower triangle of finite values.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/base/error.hpp"
#include "core/base/matrix_text.hpp"

namespace {

/// A file in memory, for a reader that takes a path.
class MemoryFile {
 public:
  MemoryFile(const uint8_t* data, size_t size) : descriptor_(memfd_create("matrix", 0)) {
    if (descriptor_ < 0 || write(descriptor_, data, size) != static_cast<ssize_t>(size)) abort();
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

void check(const clatter::SparseMatrix& lower) {
  if (lower.rows() != lower.cols() || lower.rows() < 1) abort();
  for (int j = 0; j < lower.cols(); ++j)
    for (clatter::SparseMatrix::InnerIterator it(lower, j); it; ++it)
      if (it.row() < j || !std::isfinite(it.value())) abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const MemoryFile file(data, size);
  try {
    check(clatter::read_matrix_text(file.path()));
  } catch (const clatter::InputError&) {
  }
  return 0;
}
