// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Forces on a body that are recorded, so that their effect can be computed alone
// (response_file.hpp).
#include <memory>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "dynamics/integrate/integrator.hpp"
#include "dynamics/run/model.hpp"
#include "dynamics/run/uniform_samples.hpp"

namespace clatter::dynamics {

/// The sum of the forces on one body of some elements and loads, sampled.
///
/// Impulses are summed with the method's own weights, dt sum b_i f_i over its stages, as the
/// integrator does. A sample is their mean over one sampling interval around its instant, so that
/// no impact is lost; the first and last sample have half an interval. Instantaneous impulses of
/// rigid impacts are not forces and are left out.
class ForceRecord {
 public:
  /// `model` and `file` outlive the record. InputError when no force on the body has such a name.
  ForceRecord(Model& model, const LoadedBodies& bodies, const ForceRecordSpec& spec,
              const Tableau& method, H5File& file, double begin, double end, double step);
  ForceRecord(const ForceRecord&) = delete;
  ForceRecord& operator=(const ForceRecord&) = delete;

  /// The span begins. A cycle that continues from a checkpoint does not know the elements' forces
  /// there: its first step takes those of its first stage.
  void start(double time);
  /// A stage of the method, as a StageObserver gets them.
  void stage(int index, const StageState& state);
  void accept(double dt);
  /// Writes what is left.
  void finish() { samples_.finish(); }
  /// What a checkpoint within the span keeps besides what the file has.
  void archive(Archive& archive);
  /// Numbers in memory.
  int64_t held() const { return samples_.held(); }

 private:
  /// An element's coordinates on the body: places in its force, and rows of P of the body.
  struct Part {
    int element;
    std::vector<int> place, row;
  };
  void find(const ForceRecordSpec& spec);
  void write(const SampleBlock& block);
  Eigen::VectorXd force(double time) const;

  const Model& model_;
  const Tableau& method_;
  H5File& file_;
  int body_;
  std::string dataset_;
  Eigen::MatrixXd to_reduced_;  // r x N: forces on q of unit modal forces
  std::vector<Part> parts_;
  std::vector<int> loads_;
  std::vector<Eigen::VectorXd> stages_;  // modal forces
  double time_ = 0.0;
  StageState before_, now_;  // v: sum of the impulses, a: force
  UniformSamples samples_;
};

/// All records of a run; also passes the stages on to another observer.
class ForceRecords : public StageObserver {
 public:
  explicit ForceRecords(StageObserver& next) : next_(next) {}
  void add(std::unique_ptr<ForceRecord> record) { records_.push_back(std::move(record)); }
  void stage(int index, const StageState& state) override;
  void accept(double dt) override;
  void start(double time);
  void finish();
  void archive(Archive& archive);
  int64_t held() const;

 private:
  StageObserver& next_;
  std::vector<std::unique_ptr<ForceRecord>> records_;
};

}  // namespace clatter::dynamics
