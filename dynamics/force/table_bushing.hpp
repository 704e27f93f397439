// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A joint whose force is a table over the distance of its points.
#include <memory>
#include <string>
#include <utility>

#include "dynamics/force/port_element.hpp"
#include "dynamics/force/radial_table.hpp"

namespace clatter::dynamics {

/// Force on a: -F(e) n - c(e) d', with d the distance of two points, e = |d|, n = d / e: the same
/// in all directions.
class TableBushing : public PortElement {
 public:
  TableBushing(std::string name, std::unique_ptr<Port> a, std::unique_ptr<Port> b, RadialTable law)
      : PortElement(std::move(name), std::move(a), std::move(b)), law_(std::move(law)) {}

 protected:
  PairForce force(double time, const PairMotion& motion) const override;

 private:
  RadialTable law_;
};

}  // namespace clatter::dynamics
