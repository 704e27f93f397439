// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad_alone.hpp"

#include "mesh/geometry/bare_cad.hpp"
#include "mesh/part/list_faces.hpp"

namespace clatter::mesh {

Config config_of_cad(const std::filesystem::path& source, double element_size_mm) {
  const std::filesystem::path here =
      "part.mesh.toml";  // paths in a text are relative to the working folder
  return Config::parse(cad_description(source, here, element_size_mm), source.string());
}

double default_element_size_mm(const std::filesystem::path& source, const ChildLimits& limits) {
  const PartFile part = part_keys().read(config_of_cad(source, 0.0));
  return default_element_size(list_faces_in_child(part, source.string(), false, limits).list);
}

}  // namespace clatter::mesh
