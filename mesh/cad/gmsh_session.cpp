// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad/gmsh_session.hpp"

#include <algorithm>
#include <atomic>
#include <set>

#include "mesh/cad/gmsh_call.hpp"
#include "mesh/cad/gmsh_elements.hpp"
#include "mesh/cad/gmsh_sizes.hpp"
#include "mesh/cad/skin_crossing.hpp"

#ifdef __SANITIZE_ADDRESS__
// OpenCASCADE's STEP reader keeps some memory until the process ends; it cannot be freed here.
extern "C" const char* __lsan_default_suppressions() { return "leak:libTK\nleak:libgmsh\n"; }
#endif

namespace clatter::mesh {
namespace {

std::atomic<bool> session_lives = false;

void set_options() {
  const std::vector<std::pair<const char*, double>> options = {
      {"General.Terminal", is_child()},  // its progress is reported if it crashes
      {"General.NumThreads", 1},
      {"Mesh.MaxNumThreads1D", 1},
      {"Mesh.MaxNumThreads2D", 1},
      {"Mesh.MaxNumThreads3D", 1},
      {"Mesh.Algorithm3D", 1},  // Delaunay: the reproducible one (G7)
      {"Mesh.Optimize", 1},
      {"Mesh.ElementOrder", 1},
      {"Mesh.SecondOrderLinear", 0},
      {"Mesh.HighOrderOptimize", 0},  // called explicitly, only if needed
      {"Mesh.RandomSeed", 1},
  };
  for (const auto& [name, value] : options) gmsh::option::setNumber(name, value);
}

}  // namespace

GmshSession::GmshSession(const std::string& model_name) {
  if (session_lives.exchange(true)) {
    throw std::logic_error("a Gmsh session is already open; Gmsh has one global state");
  }
  try {
    gmsh_call("gmsh", [&] {
      gmsh::initialize(0, nullptr, false);
      set_options();
      gmsh::model::add(model_name);
    });
  } catch (...) {
    session_lives = false;
    throw;
  }
}

GmshSession::~GmshSession() {
  try {
    gmsh::model::mesh::removeSizeCallback();
    gmsh::finalize();
  } catch (...) {  // nothing to clean up
  }
  session_lives = false;
}

std::string GmshSession::library_version() {
  return fmt::format("{}.{}", GMSH_API_VERSION_MAJOR, GMSH_API_VERSION_MINOR);
}

std::string GmshSession::running_version() const {
  return gmsh_call("gmsh: version", [] {
    std::string version;
    gmsh::option::getString("General.Version", version);
    return version;
  });
}

void GmshSession::generate(const SizeSettings& settings) {
  order_ = 1;
  try {
    gmsh_call("gmsh: meshing", [&] {
      synchronize();
      gmsh::model::mesh::clear();
      set_sizes(settings);
      gmsh::model::mesh::generate(3);
    });
  } catch (const NumericsError& error) {
    throw NumericsError(error.what() + reason_of_failure());
  }
}

RawMesh GmshSession::generate_skin(const SizeSettings& settings, int order) {
  return gmsh_call("gmsh: meshing faces", [&] {
    synchronize();
    gmsh::model::mesh::clear();
    set_sizes(settings);
    gmsh::model::mesh::generate(2);
    if (order == 2) gmsh::model::mesh::setOrder(2);
    order_ = order;
    return extract_skin();
  });
}

RawMesh GmshSession::extract_skin() const {
  const int type = order_ == 2 ? kTri6 : kTri3, columns = order_ == 2 ? 6 : 3;
  RawMesh mesh;
  NodeNumbers numbers;
  gmsh::vectorpair faces;
  gmsh::model::getEntities(faces, 2);
  for (const auto& [dim, tag] : faces) numbers.use(element_nodes(type, tag));
  numbers.close();
  for (const auto& [dim, tag] : faces)
    mesh.face_cells[tag] = table_of(element_nodes(type, tag), columns, numbers);
  mesh.nodes = coordinates_of(numbers);
  mesh.node_tags = numbers.tags();
  return mesh;
}

// Faces intersect where chords leave no wall between them.
std::string GmshSession::reason_of_failure() const {
  const RawMesh skin = gmsh_call("gmsh: reading the faces", [&] { return extract_skin(); });
  const std::string crossings = describe_crossings(find_crossings(skin.nodes, skin.face_cells));
  return crossings.empty() ? "" : fmt::format("; intersecting faces: {}", crossings);
}

void GmshSession::replace_cells(const RawMesh& raw) {
  gmsh_call("gmsh: replacing cells", [&] {
    gmsh::vectorpair solids;
    gmsh::model::getEntities(solids, 3);
    gmsh::model::mesh::clear(solids);
    std::vector<size_t> existing;
    std::vector<double> xyz, parameters;
    gmsh::model::mesh::getNodes(existing, xyz, parameters, -1, -1, false, false);
    std::set<size_t> known(existing.begin(), existing.end());
    std::vector<size_t> tags = raw.node_tags;
    size_t next = std::max(tags.back(), known.empty() ? 0 : *known.rbegin());
    while (tags.size() < static_cast<size_t>(raw.nodes.rows())) tags.push_back(++next);
    for (const auto& [solid, cells] : raw.cells) {
      std::vector<size_t> inner, corners;
      std::vector<double> coordinates;
      for (Eigen::Index i = 0; i < cells.size(); ++i) {
        const int32_t row = cells.data()[i];
        const size_t tag = tags[row];
        corners.push_back(tag);
        if (!known.insert(tag).second) continue;
        inner.push_back(tag);
        for (int d = 0; d < 3; ++d) coordinates.push_back(raw.nodes(row, d));
      }
      gmsh::model::mesh::addNodes(3, solid, inner, coordinates);
      gmsh::model::mesh::addElementsByType(solid, kTet4, {}, corners);
    }
  });
}

void GmshSession::make_quadratic() {
  gmsh_call("gmsh: second order", [&] {
    gmsh::model::mesh::setOrder(2);
    order_ = 2;
  });
}

bool GmshSession::optimise_curved_cells() {
  try {
    gmsh_call("gmsh: HighOrder", [] { gmsh::model::mesh::optimize("HighOrder"); });
    return true;
  } catch (const NumericsError&) {
    return false;
  }
}

void GmshSession::repair_curved_cells() {
  gmsh_call("gmsh: HighOrderElastic", [] { gmsh::model::mesh::optimize("HighOrderElastic"); });
}

RawMesh GmshSession::extract() const {
  return gmsh_call("gmsh: reading the mesh", [&] {
    RawMesh mesh;
    NodeNumbers numbers;
    gmsh::vectorpair solids, faces;
    gmsh::model::getEntities(solids, 3);
    gmsh::model::getEntities(faces, 2);
    std::map<Solid, std::vector<size_t>> cells;
    for (const auto& [dim, tag] : solids) {
      cells[tag] = element_nodes(order_ == 2 ? kTet10 : kTet4, tag);
      if (cells[tag].empty()) {
        throw NumericsError(fmt::format("gmsh: solid {} got no cells", tag));
      }
      numbers.use(cells[tag]);
    }
    numbers.close();
    for (const auto& [tag, nodes] : cells)
      mesh.cells[tag] = table_of(nodes, order_ == 2 ? 10 : 4, numbers);
    for (const auto& [dim, tag] : faces) {
      const int type = order_ == 2 ? kTri6 : kTri3;
      mesh.face_cells[tag] = table_of(element_nodes(type, tag), order_ == 2 ? 6 : 3, numbers);
    }
    mesh.nodes = coordinates_of(numbers);
    mesh.node_tags = numbers.tags();
    return mesh;
  });
}

}  // namespace clatter::mesh
