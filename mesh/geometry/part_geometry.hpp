// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The geometry of a part as built or imported: solids by region, surfaces by position.
#include <optional>
#include <string>
#include <vector>

#include "mesh/cad/gmsh_session.hpp"
#include "mesh/face/select.hpp"

namespace clatter::mesh {

struct RegionSolids {
  std::string name;
  Solids solids;
};

/// A solid of a CAD file as it was read, for comparison with its mesh.
struct CadSolid {
  std::string name;           // in the file; may be empty
  size_t number = 0, of = 0;  // index among the file's solids, from 1
  Eigen::Vector3d centre;     // of mass, in the part's unit
  double volume = 0.0;        // by OpenCASCADE, as read, in the part's unit cubed
  double joined = 0.0;        // the same of its parts after the solids were joined
  Solids pieces = {};         // each a region of the part
  double slack = 0.0;         // change of the volume that joining near faces explains
};

enum class SheetCells { kQuadrilaterals, kTriangles, kQuadratic };

/// A point of a face with the normal that points out of the solid whose face it was.
struct OutwardPoint {
  int face = 0;
  Eigen::Vector3d at, normal;
};

/// Faces that are meshed as shells; nothing else is left in the session.
struct SheetFaces {
  std::string region;
  double thickness = 0.0, offset = 0.0;  // offset: from the faces to the middle, outward
  SheetCells cells = SheetCells::kQuadrilaterals;
  std::vector<int> faces;             // tags, ascending
  std::vector<OutwardPoint> outward;  // that tell the outward side; none: that of most cells
};

struct PartGeometry {
  std::vector<RegionSolids> regions = {};
  std::vector<NamedSurface> surfaces = {};
  std::vector<CadSolid> cad_solids = {};  // of a file with several; empty elsewhere
  double volume_tolerance =
      1e-6;  // of a CAD solid against its mesh, in addition to the chord error; relative
  std::string unit = "mm";               // of its lengths, for messages
  std::optional<SheetFaces> sheet = {};  // instead of regions
  std::vector<NamedSurface> edges = {};  // of a sheet: node sets on the edges of its faces
};

/// A coordinate that no part reaches, for boxes that are open to one side.
inline constexpr double kFar = 1e9;

/// The faces in the plane normal . x = height, as far as they lie in a box.
NamedSurface in_plane(const std::string& name, const Eigen::Vector3d& normal, double height,
                      const BoxFilter& box = {Eigen::Vector3d::Constant(-kFar),
                                              Eigen::Vector3d::Constant(kFar)});

/// The only solid of a list; NumericsError for more: a boolean of connected shapes has failed.
Solid require_one(const Solids& solids, const std::string& what);

}  // namespace clatter::mesh
