#include "core/large_pages.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace clatter {

void prefer_large_pages(void* begin, size_t bytes) {
  constexpr uintptr_t kPage = uintptr_t{1} << 21;
  const auto address = reinterpret_cast<uintptr_t>(begin);
  const uintptr_t first = (address + kPage - 1) / kPage * kPage;
  const uintptr_t last = (address + bytes) / kPage * kPage;
  if (last > first) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

std::unique_ptr<double[]> large_array(size_t count) {
  std::unique_ptr<double[]> array(new double[count]);
  prefer_large_pages(array.get(), count * sizeof(double));
  return array;
}

}  // namespace clatter
