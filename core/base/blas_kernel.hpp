#pragma once
// OpenBLAS 0.3.21 does not know recent CPUs and then runs its oldest kernel, five times slower.
#include <mutex>
#include <string>

namespace clatter {

/// Compares the kernel that OpenBLAS chose with what the CPU can do; when it fell short, sets
/// OPENBLAS_CORETYPE and starts this program again with the same arguments (at most once, logged).
/// OpenBLAS chooses while it is loaded, so there is no other way. A kernel that the environment
/// names stays, unless `argv` says "--blas NAME", or "--blas auto" for the best one.
/// Call first thing in main of every stage that uses BLAS. No effect without OpenBLAS.
void ensure_fast_blas(char** argv);

/// Says which kernel runs when one was asked for, and otherwise when the environment holds OpenBLAS
/// to an older one than this CPU can run.
/// @param asked value of --blas, empty without it. InputError when another kernel runs.
void report_blas(const std::string& asked);

/// Sets the number of threads inside BLAS; no effect without OpenBLAS.
void set_blas_threads(int count);

/// So many threads in BLAS while it lives (one while our own threads run), thread_count() after it.
/// One lives at a time: a second thread waits.
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
