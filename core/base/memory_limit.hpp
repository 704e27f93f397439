#pragma once
// How much memory the process may take.
#include <limits>
#include <string>

namespace clatter {

/// Sets the limit of this process [GiB]; 0 means the machine's memory.
void set_memory_limit_gib(double gib);
double memory_limit_gib();

/// Resident memory of this process now [GiB]; 0 where there is no /proc.
double memory_in_use_gib();

/// What is left below the limit [GiB], at least 0. Memory that was freed but kept for later arrays
/// (keep_freed_memory) goes back to the kernel first where less than `enough` would be left: it
/// costs time to have it again.
double memory_left_gib(double enough = std::numeric_limits<double>::infinity());

/// Throws NumericsError "<what> needs 1.25 GiB, 340 MiB of 1 GiB are left: <advice>" when `gib` is
/// more than what is left.
void require_memory(const std::string& what, double gib, const std::string& advice);

/// An amount of memory for people, three digits: "1.25 GiB", "20.5 MiB", "512 KiB".
std::string memory_text(double gib);

/// GiB of so many doubles.
double gib_of_doubles(double count);

}  // namespace clatter
