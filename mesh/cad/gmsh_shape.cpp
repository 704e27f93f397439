// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad/gmsh_shape.hpp"

#include <unistd.h>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <filesystem>
#include <fstream>

#include "mesh/cad/gmsh_call.hpp"

namespace clatter::mesh {

TopoDS_Shape shape_of_session(GmshSession& session) {
  std::string name =
      (std::filesystem::temp_directory_path() / "clatter-shape-XXXXXX.brep").string();
  const int file = ::mkstemps(name.data(), 5);
  if (file < 0) throw FileError(fmt::format("{}: cannot be created", name));
  ::close(file);
  TopoDS_Shape shape;
  try {
    session.write_cad(name, "mm");
    std::ifstream stream(name);
    BRep_Builder builder;
    BRepTools::Read(shape, stream, builder);
  } catch (...) {
    std::filesystem::remove(name);
    throw;
  }
  std::filesystem::remove(name);
  if (shape.IsNull()) throw NumericsError("the shape cannot be read back");
  return shape;
}

}  // namespace clatter::mesh
