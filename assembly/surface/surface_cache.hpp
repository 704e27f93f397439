// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Integrals over the surfaces of a mesh, computed once each.
#include <map>
#include <string>

#include "assembly/surface/surface_integral.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

class SurfaceCache {
 public:
  explicit SurfaceCache(const mesh::Mesh& mesh) : mesh_(mesh) {}

  /// Integrals over the surface of that name; InputError when there is none.
  const SurfaceIntegrals& at(const std::string& name) {
    auto found = integrals_.find(name);
    if (found == integrals_.end())
      found = integrals_.emplace(name, integrate_surface(mesh_.nodes, mesh_.surface(name))).first;
    return found->second;
  }

 private:
  const mesh::Mesh& mesh_;
  std::map<std::string, SurfaceIntegrals> integrals_;
};

}  // namespace clatter::assembly
