// SPDX-License-Identifier: GPL-3.0-or-later
// The heap of a program that integrates: every block begins at a multiple of 64 bytes.
//
// Eigen computes the first numbers of a block that is not aligned one by one, with other roundings
// than in packets. So the same sums in blocks elsewhere have other last bits, and a run that is
// resumed, or a second one in a process, another motion. Smaller blocks hold no packet that the
// alignment of malloc, 16 bytes, does not suit.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t kLine = 64, kSmall = 32;

void* block_of(std::size_t size) {
  if (size < kSmall) return std::malloc(std::max<std::size_t>(size, 1));
  const std::size_t lines = (size - 1) / kLine + 1;
  return lines > SIZE_MAX / kLine ? nullptr : std::aligned_alloc(kLine, lines * kLine);
}

}  // namespace

void* operator new(std::size_t size) {
  for (;;) {
    if (void* block = block_of(size)) return block;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
