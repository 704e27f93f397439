// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad/gmsh_defeature.hpp"

#include <BRepAlgoAPI_Defeaturing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>

#include "mesh/cad/gmsh_call.hpp"
#include "mesh/cad/gmsh_shape.hpp"

namespace clatter::mesh {
namespace {

using Faces = TopTools_IndexedMapOfShape;

Faces faces_of(const TopoDS_Shape& shape) {
  Faces faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  return faces;
}

GProp_GProps surface_of(const TopoDS_Shape& face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return properties;
}

double width_of(const TopoDS_Shape& face) {
  GProp_GProps edges;
  BRepGProp::LinearProperties(face, edges);
  return edges.Mass() > 0.0 ? 2.0 * surface_of(face).Mass() / edges.Mass() : 0.0;
}

TopoDS_Shape without_narrow_faces(const TopoDS_Shape& shape, double below, int& narrow_faces) {
  BRepAlgoAPI_Defeaturing removal;
  removal.SetShape(shape);
  removal.SetRunParallel(false);
  removal.SetToFillHistory(false);
  const Faces faces = faces_of(shape);
  for (int f = 1; f <= faces.Extent(); ++f) {
    if (width_of(faces(f)) >= below) continue;
    removal.AddFaceToRemove(faces(f));
    ++narrow_faces;
  }
  TopoDS_Shape result = shape;
  if (narrow_faces > 0) {
    removal.Build();
    if (removal.HasErrors() || removal.Shape().IsNull())
      throw NumericsError(
          fmt::format("[cad] defeature_below: OpenCASCADE cannot remove {} faces: choose another "
                      "width or none",
                      narrow_faces));
    result = removal.Shape();
  }
  ShapeUpgrade_UnifySameDomain unite(result, true, true, false);
  unite.Build();
  return unite.Shape();
}

Eigen::Vector3d size_of(GmshSession& session) {
  const BoxFilter box = session.extent();
  return box.max - box.min;
}

}  // namespace

Defeatured defeature(GmshSession& session, const Solids& solids, double below) {
  return gmsh_call("[cad] defeature_below", [&] {
    Defeatured d;
    d.volume_before = session.volume(solids);
    d.box_before = size_of(session);
    try {
      const TopoDS_Shape shape = shape_of_session(session);
      d.faces_before = faces_of(shape).Extent();
      const TopoDS_Shape result = without_narrow_faces(shape, below, d.narrow_faces);
      if (!BRepCheck_Analyzer(result).IsValid())
        throw NumericsError(
            "[cad] defeature_below: OpenCASCADE leaves no valid solid: choose another width or "
            "none");
      const Faces faces = faces_of(result);
      d.faces_after = faces.Extent();
      for (int f = 1; f <= faces.Extent(); ++f) {
        const double width = width_of(faces(f));
        const gp_Pnt centre = surface_of(faces(f)).CentreOfMass();
        if (width < below) d.kept.push_back({width, {centre.X(), centre.Y(), centre.Z()}});
      }
      d.solids = session.replace_solids(&result);
    } catch (const Standard_Failure& failure) {
      throw NumericsError(
          fmt::format("[cad] defeature_below: OpenCASCADE: {}", failure.GetMessageString()));
    }
    d.volume_after = session.volume(d.solids);
    d.box_after = size_of(session);
    if (d.solids.size() != solids.size() ||
        std::abs(d.volume_after / d.volume_before - 1.0) > kMostRemoved)
      throw NumericsError(fmt::format(
          "[cad] defeature_below = {:g}: found volume {:.6g} in {} solids without the small faces, "
          "expected {:.6g} within {:g} % in {}: choose a smaller width",
          below, d.volume_after, d.solids.size(), d.volume_before, 100.0 * kMostRemoved,
          solids.size()));
    return d;
  });
}

}  // namespace clatter::mesh
