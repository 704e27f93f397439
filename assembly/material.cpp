#include "assembly/material.hpp"

#include <fmt/format.h>

namespace clatter::assembly {
namespace {

constexpr double kGiga = 1e9;

}  // namespace

Material read_material(const Config& table) {
  Material material;
  if (table.has("E") && table.has("E_gpa")) table.fail("E_gpa", "found E as well, expected one");
  material.youngs = table.has("E") ? table.number("E", Range::positive())
                                   : kGiga * table.number("E_gpa", Range::positive());
  material.poisson = table.number("nu");
  if (!(material.poisson > -1.0 && material.poisson < 0.5))
    table.fail("nu", fmt::format("found {:g}, expected -1 < nu < 0.5", material.poisson));
  material.density = table.number("rho", Range::positive());
  return material;
}

}  // namespace clatter::assembly
