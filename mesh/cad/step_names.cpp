// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad/step_names.hpp"

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <StepShape_FaceSurface.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>

#include "core/base/error.hpp"
#include "core/base/whole_file.hpp"

namespace clatter::mesh {
namespace {

bool is_name(const std::string& text) { return !text.empty() && text != "NONE"; }

/// Whether any ADVANCED_FACE( 'name', ... has one: most files do not, and need not be read again.
bool names_any_face(const std::string& text) {
  const std::string entity = "ADVANCED_FACE";
  for (size_t at = text.find(entity); at != std::string::npos; at = text.find(entity, at + 1)) {
    const size_t quote = text.find_first_not_of(" \t\r\n(", at + entity.size());
    if (quote == std::string::npos || text[quote] != '\'') continue;
    const size_t end = text.find('\'', quote + 1);
    if (end != std::string::npos && is_name(text.substr(quote + 1, end - quote - 1))) return true;
  }
  return false;
}

/// Names by the faces that they were transferred to.
std::map<const TopoDS_TShape*, std::string> names_of(const STEPControl_Reader& reader) {
  std::map<const TopoDS_TShape*, std::string> names;
  const Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  const Handle(Transfer_TransientProcess) process =
      reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(model->Value(i));
    if (face.IsNull() || face->Name().IsNull()) continue;
    const std::string name = face->Name()->ToCString();
    const Handle(Transfer_Binder) binder = process->Find(face);
    if (!is_name(name) || binder.IsNull()) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(binder);
    if (!shape.IsNull()) names[shape.TShape().get()] = name;
  }
  return names;
}

}  // namespace

std::vector<NamedFace> named_faces_of_step(const std::filesystem::path& path,
                                           const std::string& unit) {
  std::vector<NamedFace> found;
  if (!names_any_face(read_whole_file(path))) return found;
  try {
    STEPControl_Reader reader;
    Interface_Static::SetCVal("xstep.cascade.unit", unit.c_str());
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return found;  // Gmsh says why
    reader.TransferRoots();
    const auto names = names_of(reader);
    for (TopExp_Explorer face(reader.OneShape(), TopAbs_FACE); face.More(); face.Next()) {
      const auto name = names.find(face.Current().TShape().get());
      if (name == names.end()) continue;
      GProp_GProps surface;
      BRepGProp::SurfaceProperties(face.Current(), surface);
      const gp_Pnt centre = surface.CentreOfMass();
      const gp_Mat inertia = surface.MatrixOfInertia();  // about the centre
      found.push_back({name->second,
                       surface.Mass(),
                       {centre.X(), centre.Y(), centre.Z()},
                       inertia.Value(1, 1) + inertia.Value(2, 2) + inertia.Value(3, 3)});
    }
  } catch (const Standard_Failure& failure) {
    throw NumericsError(path.string() + ": names of its faces: OpenCASCADE: " +
                        (failure.GetMessageString() ? failure.GetMessageString() : "failed"));
  }
  return found;
}

}  // namespace clatter::mesh
