// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad/gmsh_side_depths.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <GProp_GProps.hxx>
#include <IntCurvesFace_ShapeIntersector.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_Lin.hxx>
#include <limits>

#include "mesh/cad/gmsh_call.hpp"
#include "mesh/cad/gmsh_shape.hpp"

namespace clatter::mesh {
namespace {

constexpr double kTolerance = 1e-7;  // of positions, OpenCASCADE's own
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array<int, 3> kGrids = {8, 24, 80};  // per direction; finer where a face is a sliver
                                                    // of its surface

Eigen::Vector3d vector_of(const gp_XYZ& x) { return {x.X(), x.Y(), x.Z()}; }

/// The point and its outward normal, of zero length at poles.
struct Sample {
  gp_Pnt point;
  gp_Vec outward;
};

Sample sample_of(const TopoDS_Face& face, const BRepAdaptor_Surface& surface, double u, double v) {
  Sample sample;
  gp_Vec du, dv;
  surface.D1(u, v, sample.point, du, dv);
  sample.outward = du.Crossed(dv);
  if (face.Orientation() == TopAbs_REVERSED) sample.outward.Reverse();
  return sample;
}

void add_samples(const TopoDS_Face& face, IntCurvesFace_ShapeIntersector& solid, int grid,
                 FaceDepths& out) {
  const BRepAdaptor_Surface surface(face);
  const BRepTopAdaptor_FClass2d inside(face, kTolerance);
  double u0, u1, v0, v1;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  for (int i = 0; i < grid; ++i)
    for (int j = 0; j < grid; ++j) {
      const double u = u0 + (u1 - u0) * (i + 0.5) / grid, v = v0 + (v1 - v0) * (j + 0.5) / grid;
      if (inside.Perform(gp_Pnt2d(u, v)) != TopAbs_IN) continue;
      const Sample sample = sample_of(face, surface, u, v);
      if (!(sample.outward.Magnitude() > 0.0)) continue;
      const gp_Dir outward(sample.outward);
      solid.Perform(gp_Lin(sample.point, outward.Reversed()), 10.0 * kTolerance, 1e100);
      double depth = kInfinity;
      for (int k = 1; k <= solid.NbPnt(); ++k) depth = std::min(depth, solid.WParameter(k));
      out.points.push_back(vector_of(sample.point.XYZ()));
      out.outward.push_back(vector_of(outward.XYZ()));
      out.depth.push_back(depth);
    }
}

FaceDepths depths_of(const TopoDS_Face& face, IntCurvesFace_ShapeIntersector& solid) {
  FaceDepths out;
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  out.area = properties.Mass();
  out.centre = vector_of(properties.CentreOfMass().XYZ());
  for (const int grid : kGrids) {
    add_samples(face, solid, grid, out);
    if (!out.points.empty()) break;
  }
  return out;
}

/// OpenCASCADE's faces have no numbers of Gmsh: area and centre tell which is which.
int tag_of(const FaceDepths& found, const std::vector<FaceFacts>& faces, double size) {
  const auto distance = [&](const FaceFacts& face) {
    return (face.centre - found.centre).norm() / size +
           std::abs(face.area - found.area) / (size * size);
  };
  return std::ranges::min_element(faces, {}, distance)->tag;
}

}  // namespace

std::vector<FaceDepths> depths_behind_faces(GmshSession& session) {
  return gmsh_call("thickness of the sheet", [&] {
    std::vector<FaceDepths> all;
    const std::vector<FaceFacts> faces = session.boundary_faces();
    const double size = size_of_part(faces);
    const TopoDS_Shape shape = shape_of_session(session);
    try {
      for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) {
        IntCurvesFace_ShapeIntersector solid;
        solid.Load(solids.Current(), kTolerance);
        for (TopExp_Explorer of(solids.Current(), TopAbs_FACE); of.More(); of.Next()) {
          all.push_back(depths_of(TopoDS::Face(of.Current()), solid));
          all.back().face = tag_of(all.back(), faces, size);
        }
      }
    } catch (const Standard_Failure& failure) {
      throw NumericsError(
          fmt::format("thickness of the sheet: OpenCASCADE: {}", failure.GetMessageString()));
    }
    std::ranges::sort(all, {}, &FaceDepths::face);
    return all;
  });
}

}  // namespace clatter::mesh
