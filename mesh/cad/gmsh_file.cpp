// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad/gmsh_call.hpp"
#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh {
namespace {

MshElements elements_of(int type, int dim) {
  MshElements elements;
  int order = 0, corners = 0;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(type, elements.kind, elements.dim, order,
                                          elements.nodes_each, local, corners);
  elements.dim = dim;
  elements.gmsh_type = type;
  return elements;
}

void add_entity(int dim, int tag, MshContents& contents) {
  std::vector<int> groups, types;
  gmsh::model::getPhysicalGroupsForEntity(dim, tag, groups);
  for (int& group : groups) group = std::abs(group);  // the sign is an orientation
  std::vector<std::vector<size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dim, tag);
  for (size_t t = 0; t < types.size(); ++t) {
    MshElements elements = elements_of(types[t], dim);
    elements.groups = groups;
    elements.tags = std::move(tags[t]);
    elements.nodes = std::move(nodes[t]);
    contents.elements.push_back(std::move(elements));
  }
}

// Gmsh's log of one call: it outlives sessions.
class Log {
 public:
  Log() { gmsh::logger::start(); }
  ~Log() { gmsh::logger::stop(); }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  std::vector<std::string> lines() const {
    std::vector<std::string> all;
    gmsh::logger::get(all);
    return all;
  }
};

}  // namespace

MshContents GmshSession::import_msh(const std::filesystem::path& path) {
  return gmsh_call<InputError>(path.string(), [&] {
    MshContents contents;
    const Log log;
    gmsh::merge(path.string());
    for (const std::string& line : log.lines()) {
      if (line.starts_with("Error"))
        throw InputError(fmt::format("{}: Gmsh: {}", path.string(), line));
      if (line.starts_with("Warning")) contents.warnings.push_back(line);
    }
    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(contents.node_tags, contents.coordinates, parameters, -1, -1, false,
                                false);
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities);
    for (const auto& [dim, tag] : entities) add_entity(dim, tag, contents);
    return contents;
  });
}

}  // namespace clatter::mesh
