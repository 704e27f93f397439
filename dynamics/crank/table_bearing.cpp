// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/crank/table_bearing.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "dynamics/given/csv_table.hpp"

namespace clatter::dynamics {
namespace {

std::pair<TurnTable, double> read_bearing_table(const std::filesystem::path& path,
                                                const std::string& column) {
  CsvColumns table = read_csv(path, column);
  const auto fail = [&](size_t row, const std::string& said) {
    throw InputError(fmt::format("{}:{}: {}", path.string(), table.lines[row], said));
  };
  if (table.abscissa_unit != "m" || table.unit != "N")
    fail(0, fmt::format("found {} [{}] over {} [{}], expected a force, as [kN], over a length, as "
                        "[um]",
                        table.name, table.unit, table.abscissa_name, table.abscissa_unit));
  if (table.x.size() < 2) fail(0, "found one row, expected at least two");
  if (table.x.front() != 0.0 || table.y.front() != 0.0)
    fail(0, fmt::format("found {:g} N at {:g} m, expected a first row with 0 and 0",
                        table.y.front(), table.x.front()));
  for (size_t i = 1; i < table.y.size(); ++i)
    if (!(table.y[i] >= table.y[i - 1]))
      fail(i, fmt::format("found {:g} N after {:g} N, expected a force that does not fall",
                          table.y[i], table.y[i - 1]));
  const double largest = table.x.back();
  return {TurnTable::of_speed(std::move(table.x), table.y), largest};
}

}  // namespace

BearingTable::BearingTable(const std::filesystem::path& path, const std::string& column)
    : BearingTable(read_bearing_table(path, column)) {}

PairForce TableBearing::force(double, const PairMotion& motion) const {
  PairForce law = thrust_force(motion);
  const JournalMotion at = journal(motion);
  const double e = at.offset.norm();
  if (!(e <= table_.largest()))
    throw StepRefused(name() + ": the journal is beyond the table of the bearing",
                      fmt::format("eccentricity {:.4g} m", e));
  const Motion<double> found = table_.at(e);
  const double across = e > 0.0 ? found.velocity / e : found.acceleration;
  const Eigen::Vector2d n = e > 0.0 ? Eigen::Vector2d(at.offset / e) : Eigen::Vector2d::Zero();
  const int rows[] = {axes_.first(), axes_.second()};
  for (int i = 0; i < 2; ++i) {
    law.force(rows[i]) = -across * at.offset(i) - damping_ * at.velocity(i);
    law.by_rate(rows[i], rows[i]) = -damping_;
    for (int j = 0; j < 2; ++j)
      law.by_distance(rows[i], rows[j]) =
          -(found.acceleration - across) * n(i) * n(j) - (i == j ? across : 0.0);
  }
  law.stored += found.position;
  law.lost += damping_ * at.velocity.squaredNorm();
  return law;
}

}  // namespace clatter::dynamics
