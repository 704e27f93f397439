#pragma once
// Node orders of the cells, their faces and edges, and how other programs number the same cell.
//
// Order of the nodes (Gmsh), corners 0-3, then one node in the middle of each edge:
//
//                3
//              ,/|`\                     reference coordinates of the corners:
//            ,/  |  `\                     0 (0,0,0)   1 (1,0,0)   2 (0,1,0)   3 (0,0,1)
//          ,7    '.   `8
//        ,/       9     `\               middle node:  4    5    6    7    8    9
//      ,/         |       `\             of the edge: 0-1  1-2  0-2  0-3  2-3  1-3
//     0-------6---'.--------2
//      `\.         |      ,/             A cell is positive when
//         `\.      |    ,5                 det(x1 - x0, x2 - x0, x3 - x0) > 0.
//            `4.   '. ,/
//               `\. |/
//                  `1
//
// VTK, Abaqus, CalculiX and Nastran swap the last two: their node 8 lies on edge 1-3 and their
// node 9 on edge 2-3. As an equation, a_vtk[i] = a_gmsh[p[i]], p = (0 1 2 3 4 5 6 7 9 8); p is its
// own inverse. Example: a_gmsh = (10 11 12 13 14 15 16 17 18 19) gives
// a_vtk = (10 11 12 13 14 15 16 17 19 18).
//
// Triangles: corners 0-2, then the middles of 0-1, 1-2, 2-0. The normal (x1 - x0) x (x2 - x0)
// points out of the solid. VTK, Abaqus and Gmsh agree on triangles.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace clatter::mesh {

enum class CellType : int32_t { kTet4 = 0, kTet10 = 1 };

/// What is known of a cell type.
struct CellTraits {
  std::string_view name;         // "tet4", "tet10": as written in files
  int nodes;                     // nodes per cell
  int face_nodes;                // nodes per boundary triangle: 3 or 6
  int order;                     // polynomial degree of the shape functions
  int vtk_type;                  // VTK cell type
  int gmsh_type;                 // Gmsh element type
  std::string_view abaqus_name;  // "C3D4", "C3D10"
  std::span<const int> to_vtk;   // p with a_vtk[i] = a_gmsh[p[i]]; Abaqus and Nastran alike
};

const CellTraits& traits(CellType type);

/// The type with that name; InputError, beginning with `where`, for an unknown one.
CellType cell_type_named(std::string_view name, const std::string& where);

/// The four faces, outward for a positive cell: corners, then middle nodes. A tet4 uses the first
/// three entries of each.
inline constexpr std::array<std::array<int, 6>, 4> kTetFaces = {{
    {0, 2, 1, 6, 5, 4},
    {0, 1, 3, 4, 9, 7},
    {0, 3, 2, 7, 8, 6},
    {1, 2, 3, 5, 8, 9},
}};

/// Corners of the six edges; middle node of edge e is 4 + e.
inline constexpr std::array<std::array<int, 2>, 6> kTetEdges = {
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}};

/// Corners of the three edges of a triangle; middle node of edge e is 3 + e.
inline constexpr std::array<std::array<int, 2>, 3> kTriangleEdges = {{{0, 1}, {1, 2}, {2, 0}}};

}  // namespace clatter::mesh
