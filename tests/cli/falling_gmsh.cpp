// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded before Gmsh (LD_PRELOAD): its mesher fails in the way that CLATTER_TEST_GMSH names;
// with the prefix "curved-" only where elements follow the curvature, with "frontal-" only with the
// frontal algorithm, with "large-" only with cells above 6.5. Otherwise the call is passed on to
// Gmsh.
#include <dlfcn.h>
#include <gmsh.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace {

double option(const char* name) {
  double value = 0.0;
  gmsh::option::getNumber(name, value);
  return value;
}

void throw_text() { throw std::string("Wrong topology"); }
// As a callback of OpenCASCADE that must not throw.
void throw_where_nobody_catches() noexcept { throw_text(); }

void fall(const std::string& way) {
  if (way == "abort") std::abort();
  if (way == "terminate") throw_where_nobody_catches();
  if (way == "exit") std::exit(0);
  if (way == "throw") throw 42;
  while (way == "hang") ::sleep(1);
  std::vector<std::vector<char>> eaten;
  while (way == "eat") eaten.emplace_back(std::size_t{1} << 22, 'x');
}

bool falls_here(std::string& way) {
  const auto when = [&](const std::string& prefix, bool holds) {
    if (!way.starts_with(prefix)) return true;
    way.erase(0, prefix.size());
    return holds;
  };
  return when("large-", option("Mesh.MeshSizeMax") > 6.5) &&
         when("curved-", option("Mesh.MeshSizeFromCurvature") > 0.0) &&
         when("frontal-", option("Mesh.Algorithm") == 6.0);
}

}  // namespace

// The function that clatter-mesh calls; the mangled name is Gmsh's.
void gmsh::model::mesh::generate(const int dim) {
  const char* chosen = std::getenv("CLATTER_TEST_GMSH");
  std::string way = chosen == nullptr ? "" : chosen;
  if (falls_here(way)) fall(way);
  const auto next =
      reinterpret_cast<void (*)(int)>(::dlsym(RTLD_NEXT, "_ZN4gmsh5model4mesh8generateEi"));
  next(dim);
}
