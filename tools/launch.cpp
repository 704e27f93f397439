// SPDX-License-Identifier: GPL-3.0-or-later
// What an installation has in bin: runs the build of the same name for this processor,
//   <prefix>/libexec/clatter/x86-64-v3/clatter-dynamics   for example,
// of the highest level of the x86-64 architecture that the processor and the installation have.
// CLATTER_LEVEL=x86-64 in the environment selects one.
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace {

namespace fs = std::filesystem;

constexpr int kFileTrouble = 4;  // the exit code of all programs for files

struct Level {
  const char* name;
  bool supported;  // by this processor
};

std::array<Level, 2> levels() {
#if defined(__x86_64__)
  const bool v3 = __builtin_cpu_supports("x86-64-v3") != 0;
  return {Level{"x86-64-v3", v3}, Level{"x86-64", true}};
#else
  return {Level{"", false}, Level{"", false}};
#endif
}

}  // namespace

int main(int, char** argv) {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path builds = (self.parent_path() / CLATTER_BUILDS).lexically_normal();
  const char* wanted = std::getenv("CLATTER_LEVEL");
  for (const Level& level : levels()) {
    const fs::path program = builds / level.name / self.filename();
    const bool chosen = wanted != nullptr ? std::string(wanted) == level.name : level.supported;
    if (chosen && ::access(program.c_str(), X_OK) == 0) ::execv(program.c_str(), argv);
  }
  std::fprintf(stderr, "error: %s: found no build for %s in %s, expected x86-64-v3 or x86-64\n",
               self.filename().c_str(), wanted != nullptr ? wanted : "this processor",
               builds.c_str());
  return kFileTrouble;
}
