// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/other_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "core/base/error.hpp"

namespace clatter::mesh::deck {
namespace {

struct Format {
  std::string_view extension, what, way_out;
};

constexpr std::string_view kExport = "export the mesh as .bdf, .inp, .cdb, .unv, .med or .msh";

constexpr Format kFormats[] = {
    {".k", "an LS-DYNA keyword deck", kExport},
    {".key", "an LS-DYNA keyword deck", kExport},
    {".rad", "a Radioss starter deck", kExport},
    {".pch", "a Nastran punch file (DMIG matrices or results)",
     "INCLUDE it in a .bdf deck where it holds bulk data; for K and M see clatter-assembly"},
    {".op2", "a Nastran result file", "give the .bdf deck"},
    {".op4", "a Nastran matrix file", "K and M of another program go to clatter-assembly"},
    {".f06", "a Nastran print file", "give the .bdf deck"},
    {".h3d", "a HyperView result file", "give the .fem or .bdf deck"},
    {".odb", "an Abaqus result file", "give the .inp deck"},
    {".cae", "an Abaqus/CAE model", "write the .inp deck from it (Job, Write Input)"},
    {".frd", "a CalculiX result file", "give the .inp deck"},
    {".fbd", "a CalculiX GraphiX session", "give the .inp deck"},
    {".rst", "an ANSYS result file", "write a .cdb (CDWRITE, DB)"},
    {".db", "an ANSYS database", "write a .cdb (CDWRITE, DB)"},
    {".mechdb", "an ANSYS Mechanical database", "write a .cdb (CDWRITE, DB) or .inp"},
    {".ans", "an ANSYS archive by another name", "rename it to .cdb"},
    {".hm", "a HyperMesh model", kExport},
    {".ansa", "an ANSA model", kExport},
    {".neu", "a FEMAP or Gambit neutral file", kExport},
    {".vtk", "a VTK file", kExport},
    {".vtu", "a VTK file", kExport},
    {".stl", "a triangulated surface without solids",
     "give the CAD file (.step, .brep, .iges) or a mesh of solids"},
    {".obj", "a triangulated surface without solids",
     "give the CAD file (.step, .brep, .iges) or a mesh of solids"},
    {".x_t", "a Parasolid file", "export it as .step"},
    {".x_b", "a Parasolid file", "export it as .step"},
    {".sldprt", "a SolidWorks part", "export it as .step"},
    {".prt", "a part of NX or Creo", "export it as .step"},
    {".catpart", "a CATIA part", "export it as .step"},
};

}  // namespace

void refuse_other_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats)
    if (format.extension == extension)
      throw InputError(fmt::format("{}: is {}, which clatter does not read; {}", path.string(),
                                   format.what, format.way_out));
}

}  // namespace clatter::mesh::deck
