// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Node orders of the cells, their faces and edges, and the node orders of other programs.
//
// We use Gmsh's order: the corners, then one mid-side node per edge. The mid-side node of edge e is
// node `corners + e`, with the edges in this order:
//
//   tet      0-1 1-2 0-2 0-3 2-3 1-3
//   hex      0-1 0-3 0-4 1-2 1-5 2-3 2-6 3-7 4-5 4-7 5-6 6-7
//   wedge    0-1 0-2 0-3 1-2 1-4 2-5 3-4 3-5 4-5
//   pyramid  0-1 0-3 0-4 1-2 1-4 2-3 2-4 3-4
//
//   tet4, tet10                                    hex8, hex20
//                3                                      3----13----2
//              ,/|`\                                    |\         |\         corners (-1 or 1):
//            ,/  |  `\                                  | 15       | 14         0 (-,-,-) 1 (+,-,-)
//          ,7    '.   `8                                9  \       11 \         2 (+,+,-) 3 (-,+,-)
//        ,/       9     `\                              |   7----19+---6        4 (-,-,+) 5 (+,-,+)
//      ,/         |       `\                            |   |      |   |        6 (+,+,+) 7 (-,+,+)
//     0-------6---'.--------2                           0---+-8----1   |
//      `\.         |      ,/                             \  17      \  18
//         `\.      |    ,5                               10 |        12|
//            `4.   '. ,/                                   \|         \|
//               `\. |/                                      4----16----5
//                  `1
//     0 (0,0,0) 1 (1,0,0) 2 (0,1,0) 3 (0,0,1)
//
//   wedge6, wedge15                                pyramid5, pyramid13
//                3                                                4
//              ,/|`\                                            ,/|\                              .
//            12  |  13                                        ,/ .'|\                             .
//          ,/    |    `\                                    ,/   | | \                            .
//         4------14-----5                                 ,/    .' | `.
//         |      8      |                               ,7      |  12  \                          .
//         |      |      |                             ,/       .'   |   \                         .
//         10     |      11                          ,/         9    |    11
//         |      0      |                          0--------6-.'----3    `.
//         |    ,/ `\    |                           `\        |      `\    \                      .
//         |  ,6     `7  |                             `5     .'        10   \                     .
//         |,/         `\|                               `\   |           `\  \                    .
//         1------9------2                                 `\.'             `\`
//     0 (0,0,-1) 1 (1,0,-1) 2 (0,1,-1)                       1--------8-------2
//     3 (0,0,1)  4 (1,0,1)  5 (0,1,1)                 0 (-1,-1,0) 1 (1,-1,0) 2 (1,1,0)
//                                                     3 (-1,1,0)  4 (0,0,1)
//
// A cell is positive when its map has det J > 0; for a tet, det(x1 - x0, x2 - x0, x3 - x0) > 0.
//
// Other programs have the same corner order and other orders of the mid-side nodes. Exceptions:
// VTK's wedge has reversed orientation, its triangle 0-1-2 points outward, its corners are ours
// 0 2 1 3 5 4 (measured: VTK 9.1), and so have all of MED's cells: tet 0 2 1 3, hex
// 0 3 2 1 4 7 6 5, pyramid 0 3 2 1 4.
// With p = to_vtk, to_abaqus, to_nastran or to_med of the type, a_other[i] = a_gmsh[p[i]]. Example
// (tet10, the first three): p = (0 1 2 3 4 5 6 7 9 8), so a_gmsh = (10 11 12 13 14 15 16 17 18 19)
// gives a_vtk = (10 11 12 13 14 15 16 17 19 18). Their edges, in the order of their mid-side nodes:
//
//   tet      all      0-1 1-2 2-0 0-3 1-3 2-3             (of their corners)
//   hex      VTK, Abaqus, MED  0-1 1-2 2-3 3-0  4-5 5-6 6-7 7-4  0-4 1-5 2-6 3-7
//            Nastran           0-1 1-2 2-3 3-0  0-4 1-5 2-6 3-7  4-5 5-6 6-7 7-4
//   wedge    VTK, Abaqus, MED  0-1 1-2 2-0  3-4 4-5 5-3  0-3 1-4 2-5
//            Nastran           0-1 1-2 2-0  0-3 1-4 2-5  3-4 4-5 5-3
//   pyramid  all      0-1 1-2 2-3 3-0  0-4 1-4 2-4 3-4
//
// CalculiX uses the order of Abaqus. Example (hex20): a_gmsh = (0 1 ... 19) gives
// a_vtk = (0 1 2 3 4 5 6 7 8 11 13 9 16 18 19 17 10 12 14 15) and
// a_nastran = (0 1 2 3 4 5 6 7 8 11 13 9 10 12 14 15 16 18 19 17).
//
// Faces: corners 0, 1, ..., then the mid-side nodes of 0-1, 1-2, ...; all programs agree on them.
// The normal (x1 - x0) x (x2 - x0) points out of the solid.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace clatter::mesh {

enum class CellType : int32_t {
  kTet4,
  kTet10,
  kHex8,
  kHex20,
  kWedge6,
  kWedge15,
  kPyramid5,
  kPyramid13
};
inline constexpr int kCellTypes = 8;

enum class FaceType : int32_t { kTri3, kTri6, kQuad4, kQuad8 };
inline constexpr int kFaceTypes = 4;

/// Largest number of nodes of a cell or a face.
inline constexpr int kMaxCellNodes = 20;
inline constexpr int kMaxFaceNodes = 8;

/// Properties of a face type.
struct FaceTraits {
  std::string_view name;  // "tri3", "tri6", "quad4", "quad8": as written in files
  int nodes;              // nodes per face
  int corners;            // 3 or 4
  int order;              // 1 or 2
  int gmsh_type;          // Gmsh element type
  std::string_view med_name;
};

/// One face of a cell: local node numbers, outward for a positive cell.
struct CellFace {
  FaceType type;
  std::array<int, kMaxFaceNodes> nodes;  // the first traits(type).nodes entries
};

using Edge = std::array<int, 2>;

/// Properties of a cell type.
struct CellTraits {
  std::string_view name;            // "tet4", "hex20", ...: as written in files
  int nodes;                        // nodes per cell
  int corners;                      // corner nodes
  int order;                        // polynomial degree of the shape functions along an edge
  int vtk_type;                     // VTK cell type
  int gmsh_type;                    // Gmsh element type
  std::string_view abaqus_name;     // "C3D4", ...; empty where Abaqus has none
  std::string_view nastran_name;    // "CTETRA", ...
  std::string_view med_name;        // "TE4", ...
  std::span<const int> to_vtk;      // p with a_vtk[i] = a_gmsh[p[i]]
  std::span<const int> to_abaqus;   // the same for Abaqus and CalculiX
  std::span<const int> to_nastran;  // the same for Nastran
  std::span<const int> to_med;      // the same for MED
  std::span<const Edge> edges;      // corners of the edges; mid-side node of edge e is corners + e
  std::span<const CellFace> faces;  // outward
};

const CellTraits& traits(CellType type);
const FaceTraits& traits(FaceType type);

/// Nodes of a face, or values there, to their order on the same face seen from its other side.
template <class Nodes>
void turn_over(FaceType type, Nodes&& nodes) {
  const FaceTraits& face = traits(type);
  std::swap(nodes[1], nodes[face.corners - 1]);
  for (int i = face.corners, j = face.nodes - 1; i < j; ++i, --j) std::swap(nodes[i], nodes[j]);
}

/// The type with that name; InputError, prefixed with `where`, for an unknown name.
CellType cell_type_named(std::string_view name, const std::string& where);
FaceType face_type_named(std::string_view name, const std::string& where);

/// Corners of the six edges; mid-side node of edge e is 4 + e.
inline constexpr std::array<Edge, 6> kTetEdges = {{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}};

/// The four faces of a tet10, outward: corners, then mid-side nodes. A tet4 uses the first three
/// entries of each.
inline constexpr std::array<std::array<int, 6>, 4> kTetFaces = {{
    {0, 2, 1, 6, 5, 4},
    {0, 1, 3, 4, 9, 7},
    {0, 3, 2, 7, 8, 6},
    {1, 2, 3, 5, 8, 9},
}};

/// Corners of the three edges of a triangle; mid-side node of edge e is 3 + e.
inline constexpr std::array<Edge, 3> kTriangleEdges = {{{0, 1}, {1, 2}, {2, 0}}};

}  // namespace clatter::mesh
