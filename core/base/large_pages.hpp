#pragma once
// Large arrays in large pages, and memory that is used again: the first touch of 10 GB in pages of
// 4 KiB costs seconds, on a virtual machine tens of seconds.
#include <cstddef>
#include <memory>

namespace clatter {

/// Asks the kernel to back whole 2 MiB pages inside this range by large pages; call it before the
/// first touch. No effect on small ranges and where the kernel has none.
void prefer_large_pages(void* begin, size_t bytes);

/// Gives whole pages inside this range back to the kernel; what stood there is lost.
void give_back_pages(void* begin, size_t bytes);

/// `count` doubles that are not set to zero, in large pages. Throws std::bad_alloc.
std::unique_ptr<double[]> large_array(size_t count);

/// The same in a file without a name under $TMPDIR (/var/tmp), which the kernel writes and reads as
/// memory allows. Throws FileError when there is no room for it.
std::shared_ptr<double[]> spilled_array(size_t count);

/// From now on what is freed stays with the process for its next arrays, instead of going back to
/// the kernel and coming again page by page. Call it in main of a stage that makes and frees large
/// arrays in turn.
void keep_freed_memory();

}  // namespace clatter
