#pragma once
/// A fit as a problem of least squares: the outputs of all experiments over one set of parameters.
///
///   r_i = (output_i(p) - measured_i)/s_i,   s_i: noise of the signal
///
/// Derivatives by the coordinates (`SearchSpace`) are central differences of the motion, whose events the engines
/// find anew. Steady states for a difference are found by Newton's method from the orbit of the unchanged model.

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "identify/experiments/experiment.hpp"
#include "identify/experiments/rig.hpp"
#include "identify/fit/fit_readings.hpp"
#include "identify/fit/search_space.hpp"

namespace dualdamp::identify {

/// Accuracy of the motions, and step of the differences in each coordinate.
struct Accuracy {
  double tolerance = 0.0;  ///< of the smooth engine, unless that of the rig is looser; 0: that of the rig
  double step = 1e-4;
  bool is_one_sided = false;  ///< differences of half the motions: the first steps need only their direction
};

/// The motions at the last point of a search. Those at its next points are found from them: so the steady states of
/// smooth laws take a tenth of the time that they take otherwise.
class LastMotions {
  friend class FitProblem;
  std::vector<std::shared_ptr<const Neighbours>>
      neighbours_;  ///< of each experiment; empty: there was no point yet
};

class FitProblem {
 public:
  /// `sizes`: of each parameter, > 0, in its unit. `known`: values of the records' own parameters that are not
  /// sought; empty: those of the experiments, `record_start`. The other arguments must outlive this.
  FitProblem(const Rig& rig, const std::vector<FitParameter>& parameters, const Experiments& experiments,
             const std::vector<double>& sizes, std::vector<RecordValues> known = {});

  // `this` must outlive the problems returned by roughly(), first_part(), tied(), balanced() and holding().

  /// The problem with less accurate motions of fewer samples.
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
  /// Beyond `most` there are no motions any more, and a single motion ends there. `spent`: work that counts as
  /// done.
  void limit(long most, long spent = 0) const;
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

  [[nodiscard]] const SearchSpace& space() const { return space_; }
  [[nodiscard]] const FitReadings& readings() const { return readings_; }
  /// Of each experiment, the values of its own parameters that are not sought.
  [[nodiscard]] const std::vector<RecordValues>& known() const { return known_; }

  /// Predicted readings, not divided by the noise. False: the rig has no such motion, or a law refuses the values.
  [[nodiscard]] bool outputs(const Eigen::VectorXd& q, Eigen::VectorXd& result,
                             const LastMotions* last = nullptr) const;
  /// Outputs and their derivatives by the coordinates. `seeks`: for a step of a search. A coordinate without an
  /// effect near `q` gets a difference over a wider step, so that a search can leave the place; elsewhere one-sided
  /// differences suffice, which take half of the motions, unless a signal jumps. Without `seeks` jumps of an
  /// acceleration within a step are left out. `last`, if given, then holds the motions at `q`.
  [[nodiscard]] bool derivatives(const Eigen::VectorXd& q, Eigen::VectorXd& result, Eigen::MatrixXd& jacobian,
                                 bool seeks = false, LastMotions* last = nullptr) const;

  /// The values of each experiment's own parameters.
  [[nodiscard]] std::vector<RecordValues> of_records(const Eigen::VectorXd& values) const;

 private:
  using All = std::vector<std::shared_ptr<const Neighbours>>;
  /// How a column of the derivatives is computed.
  struct Difference {
    double step = 0.0;
    bool seeks = false;  ///< jumps of an acceleration within the step are not left out
    bool is_one_sided = false;
  };
  /// One column of the derivatives. False: there is no motion on either side.
  [[nodiscard]] bool column(const Eigen::VectorXd& q, const Eigen::VectorXd& middle, const All& neighbours,
                            Eigen::Index i, const Difference& difference, Eigen::VectorXd& slope) const;
  /// Whether a signal jumps at events.
  [[nodiscard]] bool has_jumps() const;
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
  /// The problem with what `part_of` makes from its experiments; nothing if it makes nothing from any of them.
  using PartOf = std::function<std::unique_ptr<Experiment>(const Experiment&)>;
  [[nodiscard]] std::optional<FitProblem> with_parts(const PartOf& part_of) const;
  [[nodiscard]] long work() const;
  /// The answer of `motions` of experiment `e`, of which none runs past the limit of the work. False beyond it, or
  /// if a law or an engine refuses the values.
  [[nodiscard]] bool within_limit(std::size_t e, const std::function<bool()>& motions) const;
  const Rig& rig_;
  bool holds_mass_ = false;  ///< a law of it can make the mass stick
  Accuracy accuracy_{};
  Experiments parts_;  ///< experiments that this problem owns
  SearchSpace space_;
  FitReadings readings_;
  std::vector<bool> stepped_;        ///< of each parameter; empty: none
  std::vector<RecordValues> known_;  ///< of each experiment
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
