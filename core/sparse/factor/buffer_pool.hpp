#pragma once
// Arrays that are used again: the kernel clears every fresh page, which costs more than the sums.
#include <map>
#include <memory>

namespace clatter::sparse {

/// Doubles that are not set to zero.
struct Buffer {
  std::unique_ptr<double[]> data;
  size_t room = 0;
};

/// Keeps returned arrays for requests of like size. For one thread.
class BufferPool {
 public:
  /// At least `count` doubles. Throws std::bad_alloc.
  Buffer take(size_t count);
  void give(Buffer&& buffer);

 private:
  std::multimap<size_t, Buffer> free_;  // by room
};

}  // namespace clatter::sparse
