// SPDX-License-Identifier: GPL-3.0-or-later
#include "film_march.hpp"
#include "core/dense/solve.hpp"

#include <cmath>

namespace clatter::film {
namespace {

const double kGamma = 2.0 - std::sqrt(2.0);
const double kDiagonal = 0.5 * kGamma;
const double kWeight = 0.25 * std::sqrt(2.0);

}  // namespace

PadGrid strip(double begin, double end, int cells) {
  return PadGrid::uniform(0.0, 1.0, 1, begin, end, cells, 1.0);
}

Edges strip_edges(const Edge& first, const Edge& last) {
  return {Edge::wall(), Edge::wall(), first, last};
}

Eigen::ArrayXd along(const PadGrid& grid, const std::function<double(double)>& gap) {
  Eigen::ArrayXd h(grid.size());
  for (int i = 0; i < grid.n_angle(); ++i)
    for (int j = 0; j < grid.n_axial(); ++j) h[grid.cell(i, j)] = gap(grid.axial(j));
  return h;
}

FilmCells smooth(const Eigen::ArrayXd& h) {
  FilmCells cells;
  cells.set_smooth(h);
  return cells;
}

double load(const Reynolds& film) { return (film.pressure() * film.grid().area()).sum(); }

double order(double coarse_error, double fine_error) {
  return std::log2(std::abs(coarse_error / fine_error));
}

FilmMarch::FilmMarch(Reynolds& film, GivenGap gap, const FilmStage& conditions, double begin,
                     const Eigen::ArrayXd& fill)
    : film_(film), gap_(std::move(gap)), conditions_(conditions), time_(begin), oil_(film) {
  oil_.start(fill * gap_.at(begin));
  const double kappa = 1e-6;
  stage(0, gap_.at(begin) + kappa * gap_.rate(begin + kappa), kappa, {});
  oil_.accept_step();
  time_ += kappa;
  running_ = true;
}

void FilmMarch::stage(int index, const Eigen::ArrayXd& h, double kappa,
                      const std::vector<double>& weights) {
  cells_.set_smooth(h);
  FilmStage inner = conditions_;
  inner.kappa = kappa;
  if (running_) inner.profile_before = &oil_.profile();
  film_.solve(cells_, oil_.before(film_, weights), inner);
  oil_.finish_stage(film_, index, kappa, weights);
}

void FilmMarch::implicit_euler(double dt) {
  time_ += dt;
  stage(1, gap_.at(time_), dt, {});
  oil_.accept_step();
}

void FilmMarch::step(const dynamics::Tableau& A, double dt) {
  const double kappa = A.d * dt, w_10 = A.a_10 * dt, w_20 = A.a_20 * dt, w_21 = A.a_21 * dt;
  const Eigen::ArrayXd h = gap_.at(time_), rate_0 = gap_.rate(time_),
                       rate_1 = gap_.rate(time_ + A.c_1 * dt), rate_2 = gap_.rate(time_ + dt);
  stage(1, h + w_10 * rate_0 + kappa * rate_1, kappa, {w_10});
  stage(2, h + w_20 * rate_0 + w_21 * rate_1 + kappa * rate_2, kappa, {w_20, w_21});
  oil_.accept_step();
  time_ += dt;
}

Flight::Flight(dynamics::ForceElement& element, Eigen::VectorXd body_mass, Eigen::VectorXd y0,
               Eigen::VectorXd v0)
    : mass(std::move(body_mass)), y(std::move(y0)), v(std::move(v0)), element_(element) {
  a_.setZero(y.size());
  force.setZero(y.size());
}

void Flight::restore(const Flight& earlier) {
  y = earlier.y;
  v = earlier.v;
  a_ = earlier.a_;
  force = earlier.force;
  time = earlier.time;
  refused = earlier.refused;
}

void Flight::start() {
  const double kappa = 1e-12;
  element_.begin_step(time);
  Eigen::VectorXd y_new, a_new;
  const dynamics::Stage first{time, kappa, 0, {}};
  if (!solve_stage(first, y, v, y_new, a_new)) throw std::runtime_error("start refused");
  element_.finish_stage(first);
  element_.accept_step(time);
  a_ = a_new;
}

bool Flight::solve_stage(const dynamics::Stage& stage, const Eigen::VectorXd& y_before,
                         const Eigen::VectorXd& v_before, Eigen::VectorXd& y_new,
                         Eigen::VectorXd& a_new) {
  const double kappa = stage.kappa;
  y_new = y_before + kappa * v_before;
  const Eigen::VectorXd compliance = kappa * kappa * mass.cwiseInverse();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Eigen::VectorXd v_new = (y_new - y_before) / kappa;
    try {
      element_.evaluate(stage, y_new, v_new, true, response_);
    } catch (const dynamics::StepRefused&) {
      return false;
    }
    const Eigen::VectorXd residual =
        y_new - y_before - kappa * v_before - compliance.cwiseProduct(response_.force);
    const Eigen::MatrixXd jacobian =
        Eigen::MatrixXd::Identity(y.size(), y.size()) - compliance.asDiagonal() * response_.tangent;
    const Eigen::VectorXd change = dense::solve(jacobian, residual);
    if (change.norm() < 1e-15) {
      a_new = response_.force.cwiseQuotient(mass);
      force = response_.force;
      return true;
    }
    y_new -= change;
  }
  return false;
}

bool Flight::step(double dt) {
  const double kappa = kDiagonal * dt;
  element_.begin_step(time);
  const dynamics::Stage middle{time + kGamma * dt, kappa, 1, {kappa}};
  const dynamics::Stage last{time + dt, kappa, 2, {kWeight * dt, kWeight * dt}};
  Eigen::VectorXd y_middle, a_middle, y_last, a_last;
  const Eigen::VectorXd y_before = y + kappa * v, v_before = v + kappa * a_;
  if (!solve_stage(middle, y_before, v_before, y_middle, a_middle)) return ++refused, false;
  element_.finish_stage(middle);
  const Eigen::VectorXd v_middle = v_before + kappa * a_middle;
  if (!solve_stage(last, y + kWeight * dt * (v + v_middle), v + kWeight * dt * (a_ + a_middle),
                   y_last, a_last))
    return ++refused, false;
  element_.finish_stage(last);
  element_.accept_step(time + dt);
  v = v + kWeight * dt * (a_ + a_middle) + kappa * a_last;
  y = y_last;
  a_ = a_last;
  time += dt;
  return true;
}

}  // namespace clatter::film
