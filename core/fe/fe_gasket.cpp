// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/fe_gasket.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/artefact.hpp"
#include "core/fe/fe_checks.hpp"

namespace clatter::fe {
namespace {

void require_named(const H5File& file, const std::string& group, const std::string& name) {
  const std::vector<std::string> present = file.list(group);
  if (std::find(present.begin(), present.end(), name) == present.end())
    refuse(file, group, name, fmt::format("one of: {}", fmt::join(present, ", ")));
}

std::string only_case(const H5File& file) {
  const std::vector<std::string> present = file.list("cases");
  if (present.size() != 1)
    refuse(file, "cases", fmt::format("{} of them", present.size()),
           fmt::format("pressed_case to name one of: {}", fmt::join(present, ", ")));
  return present[0];
}

}  // namespace

int GasketCurve::line(double at) const {
  const auto above = std::upper_bound(closure.begin(), closure.end(), at);
  return static_cast<int>(std::min<ptrdiff_t>(above - closure.begin(), std::ssize(closure) - 1));
}

double GasketCurve::slope(int of_line) const {
  if (of_line == 0) return 0.0;
  return (pressure[of_line] - pressure[of_line - 1]) / (closure[of_line] - closure[of_line - 1]);
}

double GasketCurve::pressure_on(int of_line, double at) const {
  if (of_line == 0) return 0.0;
  return pressure[of_line - 1] + slope(of_line) * (at - closure[of_line - 1]);
}

double GasketCurve::energy(double at) const {
  double sum = 0.0;
  const int last = line(at);
  for (int k = 1; k <= last; ++k) {
    const double to = k == last ? at : closure[k];
    sum += 0.5 * (pressure[k - 1] + pressure_on(k, to)) * (to - closure[k - 1]);
  }
  return sum;
}

void write_gaskets(H5File& file, const std::vector<FeGasket>& gaskets) {
  write_gasket_points(file, gaskets);
  for (const FeGasket& one : gaskets) {
    const std::string group = "gaskets/" + one.name + "/";
    file.write(group + "curve_closure", one.curve.closure);
    file.write(group + "curve_pressure", one.curve.pressure);
    write_sparse(file, group + "closing", one.closing, false);
    write_sparse(file, group + "closing_s", one.closing_s, false);
    file.set("gaskets/" + one.name, "stiffness", one.stiffness);
  }
}

std::vector<FeGasket> read_gaskets(const H5File& file, Eigen::Index n, Eigen::Index n_s) {
  std::vector<FeGasket> gaskets;
  for (const std::string& name : file.list("gaskets")) {
    const std::string group = "gaskets/" + name + "/";
    FeGasket one{.name = name};
    const Eigen::VectorXd closure = file.read_vector(group + "curve_closure");
    const Eigen::VectorXd pressure = file.read_vector(group + "curve_pressure");
    check_finite(file, group + "curve_closure", closure);
    check_finite(file, group + "curve_pressure", pressure);
    one.curve = {{closure.begin(), closure.end()}, {pressure.begin(), pressure.end()}};
    if (closure.size() < 2 || pressure.size() != closure.size() ||
        std::ranges::adjacent_find(one.curve.closure, std::greater_equal()) !=
            one.curve.closure.end())
      refuse(file, group + "curve_closure", fmt::format("{} numbers", closure.size()),
             "two or more that ascend, and as many pressures");
    one.stiffness = file.get_double("gaskets/" + name, "stiffness");
    one.points = file.read_rows(group + "points");
    one.area = file.read_vector(group + "area");
    one.closing = read_sparse(file, group + "closing");
    one.closing_s = read_sparse(file, group + "closing_s");
    const Eigen::Index m = one.area.size();
    check_shape(file, group + "points", one.points, m, 3);
    check_finite(file, group + "area", one.area);
    check_shape(file, group + "closing", one.closing, m, n);
    check_shape(file, group + "closing_s", one.closing_s, m, n_s);
    gaskets.push_back(std::move(one));
  }
  return gaskets;
}

void write_gasket_points(H5File& file, const std::vector<FeGasket>& gaskets) {
  for (const FeGasket& one : gaskets) {
    file.write("gaskets/" + one.name + "/points", one.points);
    file.write("gaskets/" + one.name + "/area", one.area);
  }
}

void write_gasket_state(H5File& file, const std::string& of_case, const std::string& gasket,
                        const GasketState& state) {
  const std::string group = fmt::format("cases/{}/gaskets/{}/", of_case, gasket);
  file.write(group + "closure", state.closure);
  file.write(group + "pressure", state.pressure);
}

PressedPoints read_pressed(const std::filesystem::path& path, std::string of_case,
                           const std::string& gasket) {
  const H5File file = open_artefact(path, kStaticSchema);
  if (!file.has("gaskets"))
    refuse(file, "gaskets", "none", "the state of a [[gasket]] with closure_um and pressure_mpa");
  require_named(file, "gaskets", gasket);
  if (of_case.empty()) of_case = only_case(file);
  require_named(file, "cases", of_case);
  PressedPoints out{file.read_rows("gaskets/" + gasket + "/points"),
                    file.read_vector(fmt::format("cases/{}/gaskets/{}/pressure", of_case, gasket))};
  check_shape(file, "gaskets/" + gasket + "/points", out.points, out.pressure.size(), 3);
  check_finite(file, "gaskets/" + gasket + "/points", out.points);
  check_finite(file, fmt::format("cases/{}/gaskets/{}/pressure", of_case, gasket), out.pressure);
  return out;
}

}  // namespace clatter::fe
