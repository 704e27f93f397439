// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// OpenBLAS 0.3.21 does not recognise recent CPUs and falls back to its oldest kernel, five times
// slower. Where a limit of address space leaves no room for the buffers of OpenBLAS's threads, a
// program that links this restarts itself with one of them before main, or ends with exit code 3.
#include <mutex>
#include <string>

namespace clatter {

/// Compares the kernel that OpenBLAS chose with what the CPU supports; if a better one exists, sets
/// OPENBLAS_CORETYPE and restarts this program with the same arguments (at most once, silently; a
/// restart that fails is warned of): OpenBLAS selects its kernel while it is loaded. A kernel set
/// in the environment is kept, unless `argv` contains "--blas NAME", or "--blas auto" for the best
/// one. Call first in main of every stage that uses BLAS. No effect without OpenBLAS.
void ensure_fast_blas(char** argv);

/// Logs the running kernel when --blas was given, and otherwise when the environment forces a
/// kernel older than this CPU supports.
/// @param requested value of --blas, empty without it. InputError when another kernel runs.
void report_blas(const std::string& requested);

/// Sets the number of threads inside BLAS; no effect without OpenBLAS.
void set_blas_threads(int count);

/// Takes the buffer of OpenBLAS while there is room, where the address space is limited; the
/// program then has one thread of its own as well. NumericsError when there is no room.
void reserve_blas_memory();

/// Sets the number of BLAS threads while it lives (one while our own threads run); afterwards it is
/// thread_count(). Only one exists at a time: a second thread waits.
class BlasThreads {
 public:
  explicit BlasThreads(int count);
  ~BlasThreads();
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
};

}  // namespace clatter
