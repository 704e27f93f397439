// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/blas_kernel.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/printf.h>
#include <strings.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

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

// Where the address space is limited, and for more than one thread too small.
bool one_thread = false;

/// Address space that a thread of OpenBLAS takes for its buffer. It tries again without end while
/// it gets none (hard case P14).
constexpr double kBufferBytes = 128.0 * 1024.0 * 1024.0 + 65536.0;

/// What a program needs at least: the buffer of one thread, and something for itself.
constexpr double kLeastBytes = 1.1 * kBufferBytes;
constexpr double kMib = 1024.0 * 1024.0;
constexpr const char* kTooSmall =
    "the limit of address space (ulimit -v) leaves %.0f MiB of memory, expected at least %.0f MiB";

/// Address space that is left below the limit of the process (ulimit -v); infinite without one.
double address_space_left() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<double>::infinity();
  char text[64] = "";
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file >= 0) {
    if (::read(file, text, sizeof text - 1) < 0) text[0] = '\0';
    ::close(file);
  }
  return static_cast<double>(limit.rlim_cur) -
         std::strtod(text, nullptr) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
}

/// Where there is no room for the buffers of all threads OpenBLAS gets one thread, by a restart,
/// and where there is none for one buffer the program ends. OpenBLAS 0.3.29 takes all buffers in
/// its constructor, and the threads of 0.3.21 begin to wait for theirs there, so this runs before
/// the constructors of all libraries, with no more than the C library.
void leave_room_for_buffers(int, char** argv, char** environment) {
  const double left = address_space_left();
  const double processors = static_cast<double>(::sysconf(_SC_NPROCESSORS_ONLN));
  if (left > 2.0 * kBufferBytes * processors ||
      dlsym(RTLD_DEFAULT, "openblas_get_corename") == nullptr)
    return;
  one_thread = true;
  if (left < kLeastBytes) {
    const char* slash = std::strrchr(argv[0], '/');
    dprintf(STDERR_FILENO, "%s: error: ", slash == nullptr ? argv[0] : slash + 1);
    dprintf(STDERR_FILENO, kTooSmall, std::max(left, 0.0) / kMib, kLeastBytes / kMib);
    dprintf(STDERR_FILENO, "\n");
    ::_exit(3);
  }
  static char single[] = "OPENBLAS_NUM_THREADS=1";
  std::vector<char*> with_single{single};
  for (char** word = environment; *word != nullptr; ++word) {
    if (std::strcmp(*word, single) == 0) return;
    with_single.push_back(*word);
  }
  with_single.push_back(nullptr);
  execve("/proc/self/exe", argv, with_single.data());
}

[[gnu::section(".preinit_array"),
  gnu::used]] void (*const before_libraries)(int, char**, char**) = leave_room_for_buffers;

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
  if (const auto set = find_symbol<void(int)>("openblas_set_num_threads"))
    set(one_thread ? 1 : count);
}

void reserve_blas_memory() {
  if (!one_thread) return;
  const double left = address_space_left();
  if (left < kLeastBytes)
    throw NumericsError(fmt::sprintf(kTooSmall, left / kMib, kLeastBytes / kMib));
  set_thread_count(1);  // a second thread of ours in BLAS would wait for a buffer of its own
  using Factor = void(const char*, const int*, double*, const int*, int*);
  if (const auto potrf = find_symbol<Factor>("dpotrf_")) {
    const int size = 1;
    double matrix = 1.0;
    int info = 0;
    potrf("L", &size, &matrix, &size, &info);
  }
}

BlasThreads::BlasThreads(int count) : lock_(section_mutex()) { set_blas_threads(count); }
BlasThreads::~BlasThreads() { set_blas_threads(thread_count()); }

}  // namespace clatter
