// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reuse of arrays: the kernel clears every new page, which costs more than the arithmetic.
#include <map>
#include <memory>

namespace clatter::sparse {

/// Uninitialised doubles.
struct Buffer {
  std::unique_ptr<double[]> data;
  size_t room = 0;
};

/// Keeps returned arrays for requests of similar size. Not thread-safe.
class BufferPool {
 public:
  /// At least `count` doubles. Throws std::bad_alloc.
  Buffer take(size_t count);
  void give(Buffer&& buffer);

 private:
  std::multimap<size_t, Buffer> free_;  // by size
};

}  // namespace clatter::sparse
