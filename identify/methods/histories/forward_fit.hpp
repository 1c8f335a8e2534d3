#pragma once
/// The fit of a simulated motion to measured displacements: parameters, residuals and starting points. output_error
/// and the joint model of histories use it.
///
///   min sum [x_i - z - x(t_i; c, F0, x(0), v(0))]^2,   m x'' + c x' + k x + F0 sgn x' = k y + f
///
/// Mass and stiffness are fitted if they are not known, and where between two samples a drive steps. Of several
/// records each has a zero z of x; their mean is zero, as stated. Parts of one record share their zero. Cost: tens
/// of runs of the forward model (sampled_oscillator.hpp).

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "identify/models/force_parameters.hpp"
#include "identify/models/sampled_oscillator.hpp"
#include "identify/options.hpp"
#include "identify/records/usable_histories.hpp"
#include "identify/statistics/least_squares.hpp"

namespace dualdamp::identify {

/// One history with its forward model.
struct ForwardTest {
  int number = 0;
  const History* history = nullptr;
  SampledOscillator model;
  double x0 = 0.0;
  double v0 = 0.0;
  bool starts_at_rest = false;  ///< its initial velocity is zero and not fitted
  std::vector<double> places;   ///< of the steps of the drive, each within its interval
  double zero = 0.0;            ///< of x less the mean over all records [m]

  explicit ForwardTest(const NumberedHistory& item);
};

/// The parameters of the fit, each divided by a scale: c, F0, then mass and stiffness where unknown, then of each
/// test the initial state and the places of the steps of its drive, last the zeros of x of all records but the
/// first: that of the first is minus their sum.
class ForwardLayout {
 public:
  ForwardLayout(const std::vector<ForwardTest>& tests, const KnownConstants& constants,
                const ForceParameters& start);

  struct Entry {
    SampledOscillator::By by;
    double scale;
  };

  [[nodiscard]] static double length(const std::vector<ForwardTest>& tests);

  [[nodiscard]] Eigen::Index count() const { return count_; }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] const std::vector<Entry>& shared() const { return shared_; }

  [[nodiscard]] Eigen::VectorXd pack(const ForceParameters& force, const std::vector<ForwardTest>& tests) const;
  [[nodiscard]] ForceParameters force(const Eigen::VectorXd& p) const {
    ForceParameters force = known_;
    for (std::size_t i = 0; i < shared_.size(); ++i)
      value(force, shared_[i].by) = p[static_cast<Eigen::Index>(i)] * shared_[i].scale;
    return force;
  }

  /// Zero of x of test t less the mean over all records [m].
  [[nodiscard]] double zero(const Eigen::VectorXd& p, std::size_t t) const {
    const Eigen::VectorXd zeros = p.tail(count_of_zeros());
    return length_ * (records_[t] == 0 ? -zeros.sum() : zeros[records_[t] - 1]);
  }
  [[nodiscard]] Eigen::Index count_of_zeros() const { return records_.back(); }

  /// The record of which each test is a part, from 0.
  [[nodiscard]] const std::vector<Eigen::Index>& records() const { return records_; }

  /// Writes to the columns of the parameters what the zeros of x change in the readings of test t [m].
  void put_zeros(std::size_t t, Eigen::Ref<Eigen::MatrixXd> columns) const {
    for (Eigen::Index i = 0; i < count_of_zeros(); ++i)
      if (records_[t] == 0 || i == records_[t] - 1)
        columns.col(count_ - count_of_zeros() + i).setConstant(records_[t] == 0 ? -length_ : length_);
  }

  /// Adds to the zeros of x of all records, one for each, what they are more than their mean [m].
  void add_zeros(Eigen::VectorXd& p, const Eigen::VectorXd& more) const {
    p.tail(count_of_zeros()) += (more.tail(count_of_zeros()).array() - more.mean()).matrix() / length_;
  }

  [[nodiscard]] SampledOscillator::Parameters parameters(const Eigen::VectorXd& p, std::size_t t,
                                                         const ForwardTest& test) const {
    const ForceParameters f = force(p);
    SampledOscillator::Parameters parameters{f.m, f.c, f.k, f.F0, p[first_[t]] * length_, 0.0};
    if (!test.starts_at_rest) parameters.v0 = p[first_[t] + 1] * speed_;
    const Eigen::VectorXd places = p.segment(first_place(t, test), static_cast<Eigen::Index>(test.places.size()));
    parameters.places = {places.begin(), places.end()};
    return parameters;
  }

  /// Moves the places of steps, and F0, to their bounds where they are beyond.
  void bound(Eigen::VectorXd& p) const { p = p.cwiseMax(low_).cwiseMin(high_); }
  [[nodiscard]] const Eigen::VectorXd& low() const { return low_; }
  [[nodiscard]] const Eigen::VectorXd& high() const { return high_; }

  /// The parameters on which test t depends, with the column and the scale of each.
  struct Column {
    SampledOscillator::By by;
    Eigen::Index column;
    double scale;
  };
  [[nodiscard]] std::vector<Column> columns(std::size_t t, const ForwardTest& test) const {
    std::vector<Column> list;
    for (std::size_t i = 0; i < shared_.size(); ++i)
      list.push_back({shared_[i].by, static_cast<Eigen::Index>(i), shared_[i].scale});
    list.push_back({SampledOscillator::By::position, first_[t], length_});
    if (!test.starts_at_rest) list.push_back({SampledOscillator::By::velocity, first_[t] + 1, speed_});
    for (std::size_t i = 0; i < test.places.size(); ++i)
      list.push_back({SampledOscillator::By::place, first_place(t, test) + static_cast<Eigen::Index>(i), 1.0});
    return list;
  }

  static double& value(ForceParameters& force, SampledOscillator::By by) {
    return by == SampledOscillator::By::damping    ? force.c
           : by == SampledOscillator::By::friction ? force.F0
           : by == SampledOscillator::By::mass     ? force.m
                                                   : force.k;
  }
  static double value(const ForceParameters& force, SampledOscillator::By by) {
    ForceParameters copy = force;
    return value(copy, by);
  }

 private:
  [[nodiscard]] Eigen::Index first_place(std::size_t t, const ForwardTest& test) const {
    return first_[t] + (test.starts_at_rest ? 1 : 2);
  }

  std::vector<Entry> shared_;
  std::vector<Eigen::Index> first_;
  std::vector<Eigen::Index> records_;
  Eigen::VectorXd low_, high_;
  Eigen::Index count_ = 0;
  double length_ = 1.0;
  double speed_ = 1.0;
  ForceParameters known_;
};

/// Residuals of all tests [in units of the layout's length], and their derivatives.
class ForwardResiduals {
 public:
  ForwardResiduals(std::vector<ForwardTest>& tests, const ForwardLayout& layout) : tests_(tests), layout_(layout) {
    for (const ForwardTest& test : tests_) {
      blocks_.push_back(count_);
      count_ += static_cast<Eigen::Index>(test.history->x.size());
    }
  }

  [[nodiscard]] Eigen::Index count() const { return count_; }
  [[nodiscard]] const std::vector<Eigen::Index>& blocks() const { return blocks_; }

  bool evaluate(const Eigen::VectorXd& p, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) const;

 private:
  std::vector<ForwardTest>& tests_;
  const ForwardLayout& layout_;
  std::vector<Eigen::Index> blocks_;
  Eigen::Index count_ = 0;
};

/// A fit with the data it refers to.
class ForwardFit {
 public:
  /// `problem` says why there is no fit; empty when there is one. Histories that cannot be used, and those in which
  /// the mass does not move, go to the exclusions of `estimate`.
  ForwardFit(const Record& record, const KnownConstants& constants, const RegressionOptions& options,
             Estimate& estimate);
  ~ForwardFit() = default;
  ForwardFit(const ForwardFit&) = delete;
  ForwardFit& operator=(const ForwardFit&) = delete;

  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] const std::vector<ForwardTest>& tests() const { return tests_; }
  [[nodiscard]] std::vector<ForwardTest>& tests() { return tests_; }
  [[nodiscard]] const ForwardLayout& layout() const { return *layout_; }
  [[nodiscard]] const ForwardResiduals& residuals() const { return *residuals_; }
  [[nodiscard]] const LeastSquaresFit& found() const { return found_; }

  /// Starting point for another fit of the same tests, of full length or with a constant known; sets their initial
  /// states.
  [[nodiscard]] Eigen::VectorXd as_start(const ForwardLayout& layout, std::vector<ForwardTest>& tests) const;

 private:
  /// Layout and residuals of the tests as they are, and the fit's bounds. `start` sets the scales.
  LeastSquaresProblem set_up(const KnownConstants& constants, const ForceParameters& start);
  /// A driven mass that hardly moves at first is at rest, or near a turn: its speed stays free if the data need it.
  void free_speeds(const KnownConstants& constants);
  void search(const Record& record, const KnownConstants& constants, const RegressionOptions& options);
  /// Descends from more of the starting points where there are several minima: in a motion of few half swings, and
  /// where the fit ended without Coulomb friction.
  void search_further(LeastSquaresProblem problem, const std::vector<Eigen::VectorXd>& starts);

  /// Starting points with several friction forces, each with the damping that brings it nearest, from the initial
  /// states of a fit.
  [[nodiscard]] std::vector<Eigen::VectorXd> starts_beside(const Eigen::VectorXd& found) const;

  std::string problem_;
  std::vector<ForwardTest> tests_;
  std::unique_ptr<ForwardLayout> layout_;
  std::unique_ptr<ForwardResiduals> residuals_;
  LeastSquaresFit found_;
};

}  // namespace dualdamp::identify
