// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/large_pages.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/base/error.hpp"
#include "core/base/memory_limit.hpp"

namespace clatter {
namespace {

constexpr double kLargePages = 0.25;  // of the memory limit

}  // namespace

void prefer_large_pages(void* begin, size_t bytes) {
  constexpr uintptr_t kPage = uintptr_t{1} << 21;
  const auto address = reinterpret_cast<uintptr_t>(begin);
  const uintptr_t first = (address + kPage - 1) / kPage * kPage;
  const uintptr_t last = (address + bytes) / kPage * kPage;
  if (last > first) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

void give_back_pages(void* begin, size_t bytes) {
  const auto page = static_cast<uintptr_t>(sysconf(_SC_PAGE_SIZE));
  const auto address = reinterpret_cast<uintptr_t>(begin);
  const uintptr_t first = (address + page - 1) / page * page;
  const uintptr_t last = (address + bytes) / page * page;
  if (last > first) madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
}

std::unique_ptr<double[]> large_array(size_t count) {
  std::unique_ptr<double[]> array(new double[count]);
  prefer_large_pages(array.get(), count * sizeof(double));
  return array;
}

std::shared_ptr<double[]> spilled_array(size_t count) {
  const char* chosen = std::getenv("TMPDIR");
  std::string path = std::string(chosen != nullptr ? chosen : "/var/tmp") + "/clatter-XXXXXX";
  const size_t bytes = count * sizeof(double);
  const auto fail = [&](const char* doing) {
    throw FileError(
        fmt::format("{}: {} {} bytes failed: {}", path, doing, bytes, std::strerror(errno)));
  };
  const int file = mkstemp(path.data());
  if (file < 0) fail("creating a file of");
  unlink(path.c_str());
  const int status = posix_fallocate(file, 0, static_cast<off_t>(bytes));
  if (status != 0) {
    close(file);
    errno = status;
    fail("reserving");
  }
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (memory == MAP_FAILED) fail("mapping");
  return {static_cast<double*>(memory), [bytes](double* array) { munmap(array, bytes); }};
}

void keep_freed_memory() {
#ifndef __SANITIZE_ADDRESS__  // has an allocator of its own, which marks every byte
  mallopt(M_MMAP_MAX, 0);     // otherwise large arrays would be unmapped when freed
  mallopt(M_TRIM_THRESHOLD, -1);
  // The heap grows by this once, without access, so all that is allocated in it has large pages.
  const auto bytes = static_cast<size_t>(kLargePages * memory_limit_gib() * kBytesPerGib);
  void* const heap = std::malloc(bytes);
  if (heap == nullptr) return;
  prefer_large_pages(heap, bytes);
  std::free(heap);
#endif
}

}  // namespace clatter
