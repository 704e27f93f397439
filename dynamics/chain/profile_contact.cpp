// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/chain/profile_contact.hpp"
#include "dynamics/chain/plane_vector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

using Matrix36 = Eigen::Matrix<double, 3, 6>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Instead of a gap: no contact.
constexpr int kNone = -1;
constexpr double kNoSlip = std::numeric_limits<double>::quiet_NaN();

std::vector<int> joined(const std::vector<int>& links, const Port& port) {
  std::vector<int> all = links;
  all.insert(all.end(), port.coordinates().begin(), port.coordinates().end());
  return all;
}

}  // namespace

ProfileContact::ProfileContact(std::string name, const std::vector<int>& links,
                               const ChainMake& make, std::shared_ptr<const Profile> profile,
                               const LinkOutlines& outlines, const MattressLaw& law,
                               ProfileCarrier carrier, ToothCount teeth)
    : ForceElement(joined(links, *carrier.port)),
      name_(std::move(name)),
      links_(make.links()),
      kinds_(make.kinds),
      profile_(std::move(profile)),
      carrier_(std::move(carrier)),
      teeth_(std::move(teeth)),
      friction_(law.friction),
      slip_(make.kinds.size(), kNoSlip),
      creep_(law.slip_speed, make.kinds.size()) {
  const char* const what[] = {"_force_x", "_force_y", "_depth", "_contacts"};
  for (size_t k = 0; k < recorded_.size(); ++k) {
    recorded_[k] = name_ + what[k];
    std::replace(recorded_[k].begin(), recorded_[k].end(), ' ', '_');
  }
  for (const LinkKind kind : kinds_) {
    std::vector<MattressContact>& contacts = contacts_.emplace_back();
    for (const LinkOutline& one : kind == LinkKind::kInner ? outlines.inner : outlines.outer) {
      contacts.emplace_back(*profile_, one, law);
      size_ = std::max({size_, std::abs(one.from) + one.radius, std::abs(one.to) + one.radius});
    }
    hints_.emplace_back(contacts.size());
  }
  clear_.resize(kinds_.size());
  find_reach();
  const int ports = carrier_.port->size();
  std::vector<int> port;
  for (int k = 0; k < ports; ++k) port.push_back(3 * links_ + k);
  for (int j = 0; j < links_; ++j) {
    std::vector<int>& group = groups_.emplace_back(std::vector{3 * j, 3 * j + 1, 3 * j + 2});
    group.insert(group.end(), port.begin(), port.end());
  }
  if (ports > 0) groups_.push_back(port);
  gap_.assign(kinds_.size(), kNone);
}

/// A circle around the profile: that of its box, or about the origin where it repeats there.
void ProfileContact::find_reach() {
  middle_.setZero();
  reach_ = profile_->reach() + size_;
  if (profile_->repeats() > 1) return;
  constexpr int kPoints = 1000;
  Vector2d least = profile_->at(0.0).position, most = least;
  const double between = profile_->length() / kPoints;
  for (int i = 0; i <= kPoints; ++i) {
    const Vector2d point = profile_->at(i * between).position;
    least = least.cwiseMin(point);
    most = most.cwiseMax(point);
  }
  middle_ = 0.5 * (least + most);
  reach_ = 0.5 * (most - least).norm() + between + size_;
}

void ProfileContact::move(double time, const VectorXd& y, const VectorXd& v, Motion& motion) const {
  Port& port = *carrier_.port;
  const PlaneAxes& plane = carrier_.plane;
  y_port_ = y.tail(port.size());
  v_port_ = v.tail(port.size());
  port.motion(time, y_port_, v_port_, at_);
  const Vector3d &e = plane.first, &f = plane.second, normal = e.cross(f);
  const auto flat = [&](const Vector3d& a) { return Vector2d(a.dot(e), a.dot(f)); };
  motion.position = flat(at_.position - plane.origin);
  motion.velocity = flat(at_.velocity);
  motion.spin = at_.spin.dot(normal);
  const Vector3d axis =
      at_.rotation * (std::cos(carrier_.angle) * e + std::sin(carrier_.angle) * f);
  const Vector2d direction = flat(axis).normalized();
  motion.cosine = direction.x();
  motion.sine = direction.y();
  motion.angle = std::atan2(motion.sine, motion.cosine);
  const Vector2d arm = middle_ - carrier_.origin;
  motion.middle = motion.position + motion.cosine * arm + motion.sine * across(arm);
  const auto planar = [&](const Matrix6X& six, Planar& three) {
    three.resize(3, six.cols());
    three.row(0).noalias() = e.transpose() * six.topRows<3>();
    three.row(1).noalias() = f.transpose() * six.topRows<3>();
    three.row(2).noalias() = normal.transpose() * six.bottomRows<3>();
  };
  motion.driven << flat(at_.driven.head<3>()), at_.driven.tail<3>().dot(normal);
  planar(at_.by_y, motion.by_y);
  planar(at_.rate_by_y, motion.rate_by_y);
  planar(at_.rate_by_v, motion.rate_by_v);
  planar(at_.work, motion.work);
}

ProfileContact::Motion ProfileContact::motion_at(double time, const VectorXd& y,
                                                 const VectorXd& v) const {
  const std::vector<int>& own = carrier_.port->coordinates();
  Motion motion;
  move(time, gather(y, own), gather(v, own), motion);
  return motion;
}

Vector3d ProfileContact::place(double time, const VectorXd& y, const VectorXd& v) const {
  const Motion motion = motion_at(time, y, v);
  const Vector2d arm = -carrier_.origin;
  const Vector2d origin = motion.position + motion.cosine * arm + motion.sine * across(arm);
  return {origin.x(), origin.y(), motion.angle};
}

double ProfileContact::spin(double time, const VectorXd& y, const VectorXd& v) const {
  return motion_at(time, y, v).spin;
}

ProfileContact::Relative ProfileContact::relative(int link, const Motion& motion, const VectorXd& y,
                                                  const VectorXd& v) const {
  const auto back = [&](const Vector2d& a) -> Vector2d {
    return {motion.cosine * a.x() + motion.sine * a.y(),
            -motion.sine * a.x() + motion.cosine * a.y()};
  };
  Relative at;
  at.position = back(y.segment<2>(3 * link) - motion.position);
  at.velocity = back(v.segment<2>(3 * link) - motion.velocity) - motion.spin * across(at.position);
  at.spin = v(3 * link + 2) - motion.spin;
  return at;
}

/// Of a link in the axes of the profile's part.
PlanarPose ProfileContact::pose_of(const Motion& motion, const Relative& at, double angle) const {
  const double c = std::cos(angle), s = std::sin(angle);
  return {at.position + carrier_.origin, c * motion.cosine + s * motion.sine,
          s * motion.cosine - c * motion.sine};
}

/// A link that cannot touch, by its distance from the profile's middle or by how little it has
/// moved since it was clear of the profile.
bool ProfileContact::is_far(int link, const Motion& motion, const VectorXd& y) {
  const auto index = static_cast<size_t>(link);
  const Vector2d from = y.segment<2>(3 * link) - motion.middle;
  if (from.squaredNorm() > reach_ * reach_) {
    gap_[index] = kNone;
    return true;
  }
  const Clear& clear = clear_[index];
  if (!(clear.distance > 0.0)) return false;
  const Vector2d arm = y.segment<2>(3 * link) - motion.position;
  const Vector2d at(motion.cosine * arm.x() + motion.sine * arm.y(),
                    -motion.sine * arm.x() + motion.cosine * arm.y());
  const double turned = std::abs(y(3 * link + 2) - motion.angle - clear.angle);
  const double left = clear.distance - size_ * turned;
  if (!(left > 0.0 && (at - clear.position).squaredNorm() < left * left)) return false;
  gap_[index] = kNone;
  return true;
}

/// The tooth gap of a link's rear pin, by the gap nearest to a bush that touches.
int ProfileContact::gap_of(const PlanarPose& pose, const LinkOutline& bush) const {
  const int count = profile_->repeats();
  const Vector2d pin = pose.position + bush.from * Vector2d(pose.cosine, pose.sine);
  const double turns = std::atan2(pin.y(), pin.x()) / (2.0 * std::numbers::pi);
  const int gap =
      static_cast<int>(std::lround(turns * count)) - (bush.from > 0.0 ? teeth_.turn() : 0);
  return (gap + 2 * count) % count;
}

/// The sum of the contacts of a link; false where it touches nothing.
bool ProfileContact::touch(int link, const Motion& motion, const Relative& at, double angle,
                           bool with_tangent, MattressForce& sum) {
  const auto index = static_cast<size_t>(link);
  const PlanarPose pose = pose_of(motion, at, angle);
  gap_[index] = kNone;
  bool touches = false;
  MattressForce one;
  size_t deepest = 0;
  double distance = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < contacts_[index].size(); ++i) {
    contacts_[index][i].evaluate(pose, {at.velocity, at.spin}, with_tangent, hints_[index][i], one);
    if (one.too_deep)
      throw StepRefused(name_ + ": a link is too deep in the profile",
                        fmt::format("link {}", link + 1));
    distance = std::min(distance, -one.depth);
    if (!(one.depth > 0.0)) continue;
    if (!touches) {
      sum = one;
      deepest = i;
    } else {
      if (one.depth > sum.depth) deepest = i;
      sum.wrench += one.wrench;
      sum.stored += one.stored;
      sum.lost += one.lost;
      sum.load += one.load;
      sum.slide += one.slide;
      sum.depth = std::max(sum.depth, one.depth);
      if (with_tangent) {
        sum.by_pose += one.by_pose;
        sum.by_rate += one.by_rate;
      }
    }
    touches = true;
  }
  if (touches) gap_[index] = gap_of(pose, contacts_[index][deepest].outline());
  clear_[index] = {at.position, angle - motion.angle, distance};
  return touches;
}

void ProfileContact::add_forces(int link, const Motion& motion, const Relative& at,
                                const MattressForce& contact, Response& response) {
  const Vector2d local = contact.wrench.head<2>();
  const Vector2d force(motion.cosine * local.x() - motion.sine * local.y(),
                       motion.sine * local.x() + motion.cosine * local.y());
  response.force.segment<2>(3 * link) += force;
  response.force(3 * link + 2) += contact.wrench(2);
  const double arm = at.position.x() * local.y() - at.position.y() * local.x();
  const Vector3d reaction(-force.x(), -force.y(), -contact.wrench(2) - arm);
  response.force.tail(carrier_.port->size()).noalias() += motion.work.transpose() * reaction;
  last_.force -= force;
  last_.input -= reaction.dot(motion.driven);
  last_.depth = std::max(last_.depth, contact.depth);
  last_.stored += contact.stored;
  last_.lost += contact.lost;
  ++last_.contacts;
}

/// Of all links: any of them may make contact in a later step, which takes no memory.
void ProfileContact::make_blocks(Response& response) const {
  response.blocks.clear();
  for (const std::vector<int>& group : groups_) {
    const auto n = static_cast<Eigen::Index>(group.size());
    response.blocks.push_back({false, MatrixXd::Zero(n, n)});
  }
}

void ProfileContact::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                              bool with_tangent, Response& response) {
  response.force.setZero(y.size());
  if (response.blocks.size() != groups_.size()) make_blocks(response);
  last_ = {};
  move(stage.time, y, v, motion_);
  MattressForce contact;
  for (int j = 0; j < links_; ++j) {
    TangentBlock& block = response.blocks[j];
    slip_[j] = kNoSlip;
    if (with_tangent) block.active = false;
    if (is_far(j, motion_, y)) continue;
    const Relative at = relative(j, motion_, y, v);
    const bool touches = touch(j, motion_, at, y(3 * j + 2), with_tangent, contact);
    if (with_tangent) block.active = touches;
    if (!touches) continue;
    slip_[j] = contact.load > 0.0 ? contact.slide / contact.load : kNoSlip;
    add_forces(j, motion_, at, contact, response);
    if (with_tangent) fill_tangent(motion_, at, contact, stage.kappa, block);
  }
  const int ports = carrier_.port->size();
  if (!with_tangent || ports == 0) return;
  // The reaction's lever on the body turns with the body.
  TangentBlock& own = response.blocks.back();
  own.active = last_.contacts > 0;
  own.values.setZero(ports, ports);
  Vector6 wrench;
  const PlaneAxes& plane = carrier_.plane;
  wrench << last_.force.x() * plane.first + last_.force.y() * plane.second, Vector3d::Zero();
  carrier_.port->add_curvature(y_port_, wrench, own.values);
}

void ProfileContact::find_gaps(double time, const VectorXd& y, const VectorXd& v,
                               std::span<double> gaps) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  move(time, y, v, motion_);
  MattressForce contact;
  auto gap = gaps.begin();
  for (int j = 0; j < links_; ++j) {
    const auto index = static_cast<size_t>(j);
    const double beyond = (y.segment<2>(3 * j) - motion_.middle).norm() - reach_;
    const Relative at = relative(j, motion_, y, v);
    const PlanarPose pose = pose_of(motion_, at, y(3 * j + 2));
    for (size_t i = 0; i < contacts_[index].size(); ++i, ++gap) {
      *gap = beyond;
      if (beyond > 0.0) continue;
      contacts_[index][i].evaluate(pose, {at.velocity, at.spin}, false, hints_[index][i], contact);
      *gap = contact.depth > 0.0 ? -contact.depth : std::clamp(-contact.depth, kLeast, reach_);
    }
  }
}

int ProfileContact::outlines() const {
  size_t sum = 0;
  for (const auto& contacts : contacts_) sum += contacts.size();
  return static_cast<int>(sum);
}

/// Forces (on the link; on the port) are W = (F, m; -F, -m - r x F), F = R f, and depend on the
/// relative position r = R^T (x - o) and angle and on their rates.
void ProfileContact::fill_tangent(const Motion& motion, const Relative& at,
                                  const MattressForce& contact, double kappa,
                                  TangentBlock& block) const {
  const double c = motion.cosine, s = motion.sine;
  Matrix3d back = Matrix3d::Identity();
  back.topLeftCorner<2, 2>() << c, s, -s, c;
  Matrix36 lead = Matrix36::Zero();  // d(r, angle)/d(link; port), and of their rates by the rates
  lead.leftCols<3>() = back;
  lead.rightCols<3>() = -back;
  lead.block<2, 1>(0, 5) = -across(at.position);
  Matrix36 drag = Matrix36::Zero();  // d(rates)/d(link; port)
  for (int k = 0; k < 2; ++k) {
    drag.block<2, 1>(0, k) = -motion.spin * across(back.block<2, 1>(0, k));
    drag.block<2, 1>(0, 3 + k) = -drag.block<2, 1>(0, k);
  }
  drag.block<2, 1>(0, 5) = -across(at.velocity);

  const Matrix36 by_pose = contact.by_pose * lead + contact.by_rate * drag,
                 by_rate = contact.by_rate * lead;
  const Vector2d f = contact.wrench.head<2>(), &r = at.position;
  const auto spread = [&](const Matrix36& local, bool turns) {
    Matrix6 all;
    Matrix36 on_link = back.transpose() * local;
    if (turns) on_link.block<2, 1>(0, 5) += back.topLeftCorner<2, 2>().transpose() * across(f);
    all.topRows<3>() = on_link;
    all.bottomRows<3>() = -on_link;
    all.row(5) -= r.x() * local.row(1) - r.y() * local.row(0);
    if (turns) all.row(5) -= f.y() * lead.row(0) - f.x() * lead.row(1);
    return all;
  };
  const Matrix6 by_y = spread(by_pose, true), by_v = spread(by_rate, false);
  const int ports = carrier_.port->size();
  MatrixXd& T = block.values;
  T.resize(3 + ports, 3 + ports);
  T.topLeftCorner<3, 3>() = by_y.topLeftCorner<3, 3>() + by_v.topLeftCorner<3, 3>() / kappa;
  if (ports == 0) return;
  const Eigen::Matrix<double, 6, 3> y_port = by_y.rightCols<3>(), v_port = by_v.rightCols<3>();
  const Matrix3d link = by_y.bottomLeftCorner<3, 3>() + by_v.bottomLeftCorner<3, 3>() / kappa;
  T.bottomLeftCorner(ports, 3).noalias() = motion.work.transpose() * link;
  auto right = T.topRightCorner(3, ports);
  right.noalias() = y_port.topRows<3>() * motion.by_y;
  right.noalias() += v_port.topRows<3>() * motion.rate_by_y;
  right.noalias() += v_port.topRows<3>() / kappa * motion.rate_by_v;
  for (int j = 0; j < ports; ++j) {
    const Vector3d change =
        y_port.bottomRows<3>() * motion.by_y.col(j) +
        v_port.bottomRows<3>() * (motion.rate_by_y.col(j) + motion.rate_by_v.col(j) / kappa);
    T.col(3 + j).tail(ports).noalias() = motion.work.transpose() * change;
  }
}

void ProfileContact::restore(const std::vector<double>& state) {
  teeth_.restore(state);
  for (auto& hints : hints_) hints.assign(hints.size(), {});
  clear_.assign(clear_.size(), {});
}

void ProfileContact::accept_step(double time) {
  accepted_ = finished_;
  if (profile_->repeats() > 1) teeth_.update(time, gap_);
  if (friction_ == 0.0) return;
  for (size_t j = 0; j < slip_.size(); ++j)
    creep_.accept_step(j, time, !std::isnan(slip_[j]), {slip_[j], 0.0});
}

std::optional<double> ProfileContact::crept() const {
  return friction_ > 0.0 ? std::optional(creep_.longest()) : std::nullopt;
}

Power ProfileContact::power(const VectorXd&, const VectorXd&) const {
  return {last_.stored, last_.lost, last_.input};
}

void ProfileContact::record(History& history) const {
  history.put(recorded_[0], "N", accepted_.force.x());
  history.put(recorded_[1], "N", accepted_.force.y());
  history.put(recorded_[2], "m", accepted_.depth);
  history.put(recorded_[3], "1", accepted_.contacts);
}

}  // namespace clatter::dynamics
