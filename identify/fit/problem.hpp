#pragma once
/// A fit as a problem of least squares: the outputs of all experiments over one set of parameters.
///
///   r_i = (output_i(p) - measured_i)/s_i,   s_i: noise of the signal
///
/// The coordinate of a parameter is its logarithm, if zero is an open end of its range; its distance above another
/// parameter, if it must be at least that one; else its value in units of its size. A force at a speed far from
/// those of the data is sought as the force at a speed of the data (`ForceAtSpeed`). Derivatives are central
/// differences of the motion, whose events the engines find anew. Steady states for a difference are found by
/// Newton's method from the orbit of the unchanged model.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "identify/experiments/experiment.hpp"
#include "identify/experiments/rig.hpp"

namespace dualdamp::identify {

/// The coordinate of a parameter in the search.
struct SearchCoordinate {
  bool logarithmic = false;
  double size = 1.0;  ///< one unit of the coordinate; a factor e if it is a logarithm
  double low = 0.0;   ///< in coordinates
  double high = 0.0;

  [[nodiscard]] bool is_low_end(double q) const { return q <= low + near_end * std::max(1.0, std::abs(low)); }
  [[nodiscard]] bool is_high_end(double q) const { return q >= high - near_end * std::max(1.0, std::abs(high)); }
  [[nodiscard]] bool is_end(double q) const { return is_low_end(q) || is_high_end(q); }

 private:
  static constexpr double near_end = 1e-6;
};

/// Accuracy of the motions, and step of the differences in each coordinate.
struct Accuracy {
  double tolerance = 0.0;  ///< of the smooth engine, unless that of the rig is looser; 0: that of the rig
  double step = 1e-4;
  bool is_one_sided = false;  ///< differences of half the motions: the first steps need only their direction
};

/// Rows [begin, end) of one signal of one experiment.
struct SignalRows {
  std::size_t experiment = 0;
  std::size_t signal = 0;
  Eigen::Index begin = 0;
  Eigen::Index end = 0;

  [[nodiscard]] Eigen::Index size() const { return end - begin; }
};

/// The motions at the last point of a search. Those at its next points are found from them: so the steady states of
/// smooth laws take a tenth of the time that they take otherwise.
class LastMotions {
  friend class FitProblem;
  std::vector<std::unique_ptr<Neighbours>> neighbours_;  ///< of each experiment; empty: there was no point yet
};

/// Of each parameter, the absolute value that is stated; 1 if that is zero or unknown.
[[nodiscard]] std::vector<double> sizes_of_stated(const std::vector<FitParameter>& parameters);

class FitProblem {
 public:
  /// `sizes`: of each parameter, > 0, in its unit. `known`: values of the records' own parameters that are not
  /// sought; empty: those of the experiments, `record_start`. The other arguments must outlive this.
  FitProblem(const Rig& rig, const std::vector<FitParameter>& parameters, const Experiments& experiments,
             const std::vector<double>& sizes, std::vector<RecordValues> known = {});

  // `this` must outlive the problems returned by roughly(), first_part(), tied(), balanced() and holding().

  /// The same with less accurate motions of fewer samples.
  [[nodiscard]] FitProblem roughly(const Accuracy& accuracy) const;
  /// With only the first share of each motion, 0 < share <= 1. Nothing if there is no motion.
  [[nodiscard]] std::optional<FitProblem> first_part(double share) const;
  /// With models tied to the measured motions; nothing if there is no motion.
  [[nodiscard]] std::optional<FitProblem> tied(double strength) const;
  /// With the motion of steady states held as it was measured; nothing if there are no steady states.
  [[nodiscard]] std::optional<FitProblem> balanced() const;

  /// With one parameter held where a search begins: its derivatives are zero.
  [[nodiscard]] FitProblem holding(std::size_t number) const;

  /// Begins to count the work of the motions (`Experiment::work`), also those of the problems made from this one.
  /// Beyond `most` there are no motions any more, and a single motion ends there.
  void limit(long most) const;
  [[nodiscard]] bool is_exhausted() const { return work() > limit_->most; }
  /// Work since then.
  [[nodiscard]] long spent() const { return work() - limit_->begun; }
  /// Allows this share of the limit beyond it.
  void extend(double share) const;

  /// Sets which parameters act in steps (`steps.hpp`): their derivatives are zero. All others if nothing is set.
  void set_stepped(std::vector<bool> stepped) { stepped_ = std::move(stepped); }
  [[nodiscard]] const std::vector<bool>& stepped() const { return stepped_; }
  [[nodiscard]] bool is_stepped(Eigen::Index i) const {
    const auto at = static_cast<std::size_t>(i);
    return at < stepped_.size() && stepped_[at];
  }
  [[nodiscard]] bool has_stepped() const;
  [[nodiscard]] bool has_loops_only() const;
  [[nodiscard]] bool has_steady_states() const;

  [[nodiscard]] Eigen::Index rows() const { return rows_; }
  /// Of each experiment, the values of its own parameters that are not sought.
  [[nodiscard]] const std::vector<RecordValues>& known() const { return known_; }
  [[nodiscard]] const std::vector<SignalRows>& signals() const { return signals_; }
  [[nodiscard]] const std::vector<SearchCoordinate>& coordinates() const { return coordinates_; }
  /// The parameter that parameter `i` must not be below.
  [[nodiscard]] const std::optional<std::size_t>& above(Eigen::Index i) const {
    return parameters_[static_cast<std::size_t>(i)].above;
  }
  [[nodiscard]] const Signal& signal(const SignalRows& rows) const;
  [[nodiscard]] const Experiment& experiment(const SignalRows& rows) const {
    return *experiments_[rows.experiment];
  }

  /// Values of the parameters from coordinates, and back. A value beyond a bound is moved to the bound.
  [[nodiscard]] Eigen::VectorXd values(const Eigen::VectorXd& q) const;
  [[nodiscard]] Eigen::VectorXd coordinates(const Eigen::VectorXd& values) const;
  /// d(values)/d(coordinates).
  [[nodiscard]] Eigen::MatrixXd slope(const Eigen::VectorXd& q) const;

  /// Predicted readings, not divided by the noise. False: the rig has no such motion, or a law refuses the values.
  [[nodiscard]] bool outputs(const Eigen::VectorXd& q, Eigen::VectorXd& result,
                             const LastMotions* last = nullptr) const;
  /// Outputs and their derivatives by the coordinates. `seeks`: a coordinate without an effect near `q` gets a
  /// difference over a wider step, so that a search can leave the place. Else jumps of an acceleration within a
  /// step are left out. `last`, if given, then holds the motions at `q`.
  [[nodiscard]] bool derivatives(const Eigen::VectorXd& q, Eigen::VectorXd& result, Eigen::MatrixXd& jacobian,
                                 bool seeks = false, LastMotions* last = nullptr) const;

  [[nodiscard]] const Eigen::VectorXd& measured() const { return measured_; }
  /// 1 for each reading that counts, 0 for one that does not.
  [[nodiscard]] const Eigen::VectorXd& counted() const { return counted_; }
  /// Number of readings of a signal that count.
  [[nodiscard]] double count(const SignalRows& rows) const {
    return counted_.segment(rows.begin, rows.size()).sum();
  }
  /// Outputs minus readings; 0 for a reading that does not count.
  [[nodiscard]] Eigen::VectorXd misses(const Eigen::VectorXd& outputs) const {
    return (outputs - measured_).cwiseProduct(counted_);
  }
  /// The misses of a signal at the readings that count.
  [[nodiscard]] Eigen::VectorXd counted(const Eigen::VectorXd& misses, const SignalRows& rows) const;
  /// Root mean square of the misses of a signal, over the readings that count.
  [[nodiscard]] double rms(const Eigen::VectorXd& misses, const SignalRows& rows) const;
  /// The values of each experiment's own parameters.
  [[nodiscard]] std::vector<RecordValues> of_records(const Eigen::VectorXd& values) const;

 private:
  using All = std::vector<std::unique_ptr<Neighbours>>;
  /// One column of the derivatives, by differences over `step`. False: there is no motion on either side.
  [[nodiscard]] bool column(const Eigen::VectorXd& q, const Eigen::VectorXd& middle, const All& neighbours,
                            Eigen::Index i, double step, bool seeks, Eigen::VectorXd& slope) const;
  /// The motions at `q` and what finds those near it; nothing: there are none.
  [[nodiscard]] std::optional<All> neighbours(const Eigen::VectorXd& q, const LastMotions* last,
                                              Eigen::VectorXd& result) const;
  /// Predicts the outputs of one experiment; false if the model has no such motion.
  using Predictor = std::function<bool(std::size_t experiment, const sim::Model& model,
                                       const RecordValues& of_record, Eigen::VectorXd& part)>;
  /// The outputs of all experiments at `q`, side by side. False if one has none.
  [[nodiscard]] bool predict_each(const Eigen::VectorXd& q, Eigen::VectorXd& result,
                                  const Predictor& predict) const;
  /// What finds the motions of an experiment from the last ones; nullptr: nothing does so in less time.
  [[nodiscard]] static const Neighbours* start_for(const LastMotions* last, std::size_t experiment);
  void mend_jumps(const Eigen::VectorXd& below, const Eigen::VectorXd& above, Eigen::VectorXd& slope) const;
  [[nodiscard]] std::optional<sim::Model> model_at(const Eigen::VectorXd& values) const;
  FitProblem(const FitProblem& whole, Experiments parts);
  /// The same with what `part_of` makes from the experiments; nothing if it makes nothing from any of them.
  using PartOf = std::function<std::unique_ptr<Experiment>(const Experiment&)>;
  [[nodiscard]] std::optional<FitProblem> with_parts(const PartOf& part_of) const;
  void number_rows();
  [[nodiscard]] long work() const;
  /// The answer of `motions` of experiment `e`, of which none runs past the limit of the work. False beyond it, or
  /// if a law or an engine refuses the values.
  [[nodiscard]] bool within_limit(std::size_t e, const std::function<bool()>& motions) const;
  const Rig& rig_;
  bool holds_mass_ = false;  ///< a law of it can make the mass stick
  Accuracy accuracy_{};
  const std::vector<FitParameter>& parameters_;
  Experiments parts_;  ///< experiments that this problem owns
  std::vector<const Experiment*> experiments_;
  std::vector<SearchCoordinate> coordinates_;
  std::vector<bool> stepped_;        ///< of each parameter; empty: none
  std::vector<double> units_;        ///< of each parameter, `over_force_sought` at the sizes
  std::vector<RecordValues> known_;  ///< of each experiment
  std::vector<SignalRows> signals_;
  std::vector<Eigen::Index> begins_;  ///< of each experiment
  Eigen::VectorXd measured_;
  Eigen::VectorXd counted_;
  Eigen::Index rows_ = 0;
  /// Of `work`, from `begun` to `most`; of all problems made from one.
  struct Limit {
    long begun = 0;
    long most = std::numeric_limits<long>::max();
  };
  std::shared_ptr<Limit> limit_ = std::make_shared<Limit>();
};

/// A problem with all that it refers to.
struct FitTask {
  /// `known`: as in `FitProblem`. The rig and the experiments must outlive this.
  FitTask(const Rig& of_rig, const Experiments& records, std::vector<FitParameter> sought,
          std::vector<double> sizes_of_sought, std::vector<RecordValues> known)
      : rig(of_rig),
        experiments(records),
        parameters(std::move(sought)),
        sizes(std::move(sizes_of_sought)),
        problem(rig, parameters, experiments, sizes, std::move(known)) {}
  FitTask(const FitTask&) = delete;
  FitTask& operator=(const FitTask&) = delete;
  FitTask(FitTask&&) = delete;
  FitTask& operator=(FitTask&&) = delete;
  ~FitTask() = default;

  const Rig& rig;
  const Experiments& experiments;
  std::vector<FitParameter> parameters;
  std::vector<double> sizes;
  FitProblem problem;
};

}  // namespace dualdamp::identify
