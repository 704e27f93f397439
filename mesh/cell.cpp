#include "mesh/cell.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace clatter::mesh {
namespace {

constexpr std::array<int, 4> kTet4ToVtk = {0, 1, 2, 3};
constexpr std::array<int, 10> kTet10ToVtk = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

const std::array<CellTraits, 2> kTraits = {{
    {"tet4", 4, 3, 1, 10, 4, "C3D4", kTet4ToVtk},
    {"tet10", 10, 6, 2, 24, 11, "C3D10", kTet10ToVtk},
}};

}  // namespace

const CellTraits& traits(CellType type) { return kTraits[static_cast<size_t>(type)]; }

CellType cell_type_named(std::string_view name, const std::string& where) {
  if (name == "tet4") return CellType::kTet4;
  if (name == "tet10") return CellType::kTet10;
  throw InputError(fmt::format("{}: found cell type '{}', expected tet4 or tet10", where, name));
}

}  // namespace clatter::mesh
