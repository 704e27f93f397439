// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Private to the files that call OpenCASCADE.
#include <TopoDS_Shape.hxx>

#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh {

/// All of the session's geometry. Gmsh exports its shapes only by file: it goes through a temporary
/// one.
TopoDS_Shape shape_of_session(GmshSession& session);

}  // namespace clatter::mesh
