// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Memory limit of the process.
#include <limits>
#include <string>
#include <utility>

#include "core/base/error.hpp"

namespace clatter {

inline constexpr double kBytesPerGib = 1024.0 * 1024.0 * 1024.0;

/// Sets the limit of this process [GiB]; 0 means the machine's memory, or `ulimit -v` if less.
void set_memory_limit_gib(double gib);
double memory_limit_gib();

/// Current resident memory of this process [GiB]; 0 where there is no /proc.
double memory_in_use_gib();

/// Memory left below the limit [GiB], at least 0. Where less than `enough` would be left, freed
/// memory kept for reuse (keep_freed_memory) is first returned to the kernel; allocating it again
/// costs time.
double memory_left_gib(double enough = std::numeric_limits<double>::infinity());

/// More memory is needed than is left.
struct MemoryShort : NumericsError {
  using NumericsError::NumericsError;
};

/// Runs `body`; a MemoryShort of it ends with "; <advice>" in addition, unless that is empty.
template <class Body>
auto with_memory_advice(const std::string& advice, Body&& body) {
  try {
    return std::forward<Body>(body)();
  } catch (const MemoryShort& error) {
    if (advice.empty()) throw;
    throw MemoryShort(error.what() + ("; " + advice));
  }
}

/// Throws MemoryShort "<what> needs 1.25 GiB, 340 MiB of 1 GiB are left: <advice>" when `gib` is
/// more than is left.
void require_memory(const std::string& what, double gib, const std::string& advice);

/// An amount of memory as text with three digits: "1.25 GiB", "20.5 MiB", "512 KiB".
std::string memory_text(double gib);

/// GiB of `count` doubles.
double gib_of_doubles(double count);

}  // namespace clatter
