// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/blas_kernel.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <strings.h>
#include <unistd.h>

#include <cstdlib>
#include <mutex>
#include <string>
#include <string_view>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/threads.hpp"

namespace clatter {
namespace {

constexpr const char* kChoice = "OPENBLAS_CORETYPE";

template <class Function>
Function* find_symbol(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// Name of the best OpenBLAS 0.3.21 kernel for this CPU; empty when OpenBLAS's own choice is right.
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

bool same_name(const std::string& a, const std::string& b) {
  return strcasecmp(a.c_str(), b.c_str()) == 0;
}

/// Value of --blas; empty without it.
std::string requested_kernel(char** argv) {
  constexpr std::string_view kOption = "--blas";
  for (char** word = argv; *word != nullptr; ++word) {
    const std::string_view text = *word;
    if (text == kOption && word[1] != nullptr) return word[1];
    if (text.starts_with("--blas=")) return std::string(text.substr(kOption.size() + 1));
  }
  return {};
}

/// 2 for kernels with AVX-512, 1 for those with AVX2, 0 for older ones.
int generation(const std::string& kernel) {
  for (const char* wide : {"SkylakeX", "Cooperlake", "SapphireRapids"})
    if (same_name(kernel, wide)) return 2;
  for (const char* old :
       {"Prescott", "Core2", "Nehalem", "Penryn", "Dunnington", "Generic", "Sandybridge"})
    if (same_name(kernel, old)) return 0;
  return 1;
}

/// OpenBLAS must not change its thread count while another thread of ours uses it.
std::mutex& section_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

void ensure_fast_blas(char** argv) {
  const auto corename = find_symbol<char*()>("openblas_get_corename");
  if (corename == nullptr) return;
  const std::string requested = requested_kernel(argv), running = corename();
  const char* set = std::getenv(kChoice);
  if (requested.empty() && set != nullptr) return;
  const bool automatic = requested.empty() || requested == "auto";
  const std::string wanted = automatic ? best_kernel() : requested;
  if (wanted.empty() || same_name(running, wanted)) return;
  if (automatic && generation(running) >= generation(wanted)) return;
  if (set != nullptr && same_name(set, wanted)) return;  // it was started with that already
  setenv(kChoice, wanted.c_str(), 1);
  execv("/proc/self/exe", argv);
  if (requested.empty())
    warn(fmt::format("OpenBLAS chose its kernel {} on this CPU, a slow one: set {}={}", running,
                     kChoice, wanted));
}

void report_blas(const std::string& requested) {
  const auto corename = find_symbol<char*()>("openblas_get_corename");
  if (corename == nullptr) {
    if (!requested.empty()) say("--blas has no effect: this BLAS is not OpenBLAS");
    return;
  }
  const std::string running = corename(), best = best_kernel();
  if (!requested.empty() && requested != "auto" && !same_name(running, requested))
    throw InputError(
        fmt::format("--blas: found {}, but OpenBLAS runs {} on this CPU, expected auto or an "
                    "OpenBLAS kernel for this CPU such as Haswell, SkylakeX or Zen",
                    requested, running));
  if (!requested.empty()) {
    say(fmt::format("OpenBLAS runs its kernel {}", running));
  } else if (std::getenv(kChoice) != nullptr && generation(running) < generation(best)) {
    say(fmt::format("{} forces OpenBLAS to kernel {}, but this CPU supports {}: use --blas auto",
                    kChoice, running, best));
  }
}

void set_blas_threads(int count) {
  if (const auto set = find_symbol<void(int)>("openblas_set_num_threads")) set(count);
}

BlasThreads::BlasThreads(int count) : lock_(section_mutex()) { set_blas_threads(count); }
BlasThreads::~BlasThreads() { set_blas_threads(thread_count()); }

}  // namespace clatter
