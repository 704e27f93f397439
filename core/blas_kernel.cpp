#include "core/blas_kernel.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <mutex>
#include <string>

#include "core/log.hpp"
#include "core/threads.hpp"

namespace clatter {
namespace {

constexpr const char* kChoice = "OPENBLAS_CORETYPE";

template <class Function>
Function* find_symbol(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// Name of the best OpenBLAS 0.3.21 kernel for this CPU; empty when its own choice will be right.
std::string best_kernel() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")) {
    return "SKYLAKEX";
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "HASWELL";
#endif
  return {};
}

/// 2 for kernels with AVX-512, 1 for those with AVX2, 0 for older ones.
int generation(const std::string& kernel) {
  for (const char* wide : {"SkylakeX", "SKYLAKEX", "Cooperlake", "SapphireRapids"})
    if (kernel == wide) return 2;
  for (const char* old :
       {"Prescott", "Core2", "Nehalem", "Penryn", "Dunnington", "Generic", "Sandybridge"})
    if (kernel == old) return 0;
  return 1;
}

/// OpenBLAS must not change its threads while another of ours is inside it.
std::mutex& section_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

void ensure_fast_blas(char** argv) {
  const auto corename = find_symbol<char*()>("openblas_get_corename");
  if (corename == nullptr || std::getenv(kChoice) != nullptr) return;
  const std::string running = corename();
  const std::string better = best_kernel();
  if (better.empty() || generation(running) >= generation(better)) return;
  setenv(kChoice, better.c_str(), 1);
  warn(fmt::format("OpenBLAS chose its kernel {} on this CPU; starting again with {}={}", running,
                   kChoice, better));
  execv("/proc/self/exe", argv);
  // Going on with the slow kernel is right but slow; the line above told so.
}

void set_blas_threads(int count) {
  if (const auto set = find_symbol<void(int)>("openblas_set_num_threads")) set(count);
}

BlasThreads::BlasThreads(int count) : lock_(section_mutex()) { set_blas_threads(count); }
BlasThreads::~BlasThreads() { set_blas_threads(thread_count()); }

}  // namespace clatter
