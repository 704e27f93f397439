// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/buffer_pool.hpp"

#include "core/base/large_pages.hpp"

namespace clatter::sparse {
namespace {

constexpr size_t kWorthKeeping = size_t{1} << 14;  // malloc handles smaller ones well

}  // namespace

Buffer BufferPool::take(size_t count) {
  if (count < kWorthKeeping) return {std::unique_ptr<double[]>(new double[count]), count};
  const auto found = free_.lower_bound(count);
  if (found != free_.end() && found->first <= 4 * count) {
    Buffer buffer = std::move(found->second);
    free_.erase(found);
    return buffer;
  }
  // Next requests are often slightly larger; untouched pages cost nothing.
  const size_t room = count + count / 4;
  return {large_array(room), room};
}

void BufferPool::give(Buffer&& buffer) {
  if (buffer.room < kWorthKeeping) return;
  const size_t room = buffer.room;
  free_.emplace(room, std::move(buffer));
}

}  // namespace clatter::sparse
