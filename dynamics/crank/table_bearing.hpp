// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A main bearing whose radial force is a table over the eccentricity.
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "dynamics/given/turn_table.hpp"
#include "dynamics/shaft/journal_bearing.hpp"

namespace clatter::dynamics {

/// Radial force over the eccentricity: a monotone cubic with its exact integral.
class BearingTable {
 public:
  /// Reads a table over lengths from 0, force 0, whose forces do not fall. InputError
  /// "file:line: ..." otherwise.
  BearingTable(const std::filesystem::path& path, const std::string& column);
  double largest() const { return largest_; }  // eccentricity [m]
  /// Energy [J], force [N], stiffness [N/m] at an eccentricity [m].
  Motion<double> at(double eccentricity) const { return table_.at(eccentricity); }

 private:
  BearingTable(std::pair<TurnTable, double> table)
      : table_(std::move(table.first)), largest_(table.second) {}
  TurnTable table_;  // force for speed, eccentricity for time: its angle is the energy
  double largest_;
};

/// A bearing with the force -F(e) e/|e| - damping times velocity on the journal, without friction.
class TableBearing : public ShaftBearing {
 public:
  /// @param damping [N s/m].
  TableBearing(std::string name, std::unique_ptr<Port> journal, std::unique_ptr<Port> housing,
               const ShaftAxes& axes, const Eigen::Vector3d& offset, BearingTable table,
               double damping)
      : ShaftBearing(std::move(name), std::move(journal), std::move(housing), axes, offset, {}),
        table_(std::move(table)),
        damping_(damping) {}

 protected:
  /// StepRefused beyond the end of the table.
  PairForce force(double time, const PairMotion& motion) const override;

 private:
  BearingTable table_;
  double damping_;
};

}  // namespace clatter::dynamics
