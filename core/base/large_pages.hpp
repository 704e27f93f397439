// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Large arrays in large pages, and reuse of freed memory: first access to 10 GB in pages of 4 KiB
// costs seconds, on a virtual machine tens of seconds.
#include <cstddef>
#include <memory>

namespace clatter {

/// Asks the kernel to back the aligned 2 MiB blocks inside this range by large pages; call it
/// before first access. No effect on small ranges and where the kernel has no large pages.
void prefer_large_pages(void* begin, size_t bytes);

/// Returns the complete pages inside this range to the kernel; their content is lost.
void give_back_pages(void* begin, size_t bytes);

/// `count` uninitialised doubles in large pages. Throws std::bad_alloc.
std::unique_ptr<double[]> large_array(size_t count);

/// The same backed by an unlinked file under $TMPDIR (default /var/tmp), paged in and out as memory
/// allows. Throws FileError when the disk is too full.
std::shared_ptr<double[]> spilled_array(size_t count);

/// Keeps freed memory in the process for later arrays instead of returning it to the kernel, and
/// gives the heap large pages. CommandLine::run() calls it, once the memory limit is known.
void keep_freed_memory();

}  // namespace clatter
