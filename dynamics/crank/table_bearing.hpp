// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A main bearing whose radial force is a table over the eccentricity.
#include <memory>
#include <string>
#include <utility>

#include "dynamics/given/rising_table.hpp"
#include "dynamics/shaft/journal_bearing.hpp"

namespace clatter::dynamics {

/// A bearing with the force -F(e) e/|e| - damping times velocity on the journal, without friction.
class TableBearing : public ShaftBearing {
 public:
  /// @param damping [N s/m].
  TableBearing(std::string name, std::unique_ptr<Port> journal, std::unique_ptr<Port> housing,
               const ShaftAxes& axes, const Eigen::Vector3d& offset, RisingTable table,
               double damping)
      : ShaftBearing(std::move(name), std::move(journal), std::move(housing), axes, offset, {}),
        table_(std::move(table)),
        damping_(damping) {}

 protected:
  /// StepRefused beyond the end of the table.
  PairForce force(double time, const PairMotion& motion) const override;

 private:
  RisingTable table_;
  double damping_;
};

}  // namespace clatter::dynamics
