#pragma once
/// An experiment of a fit: what a record measured, and what a model of the rig gives in its place.
///
///   steady states  amplitudes, and phases where they were measured, at each level and frequency
///   decay          extremes, and their times where they were measured
///   history        x, v and a, those that were measured, sample by sample, from the record's own state
///   loop           the force that leads the mass along the measured motion, m a + c v + k x + F(x, v)
///
/// A motion is integrated by the engine of its laws, from event to event; nothing measured is differentiated but
/// for a loop whose velocity or acceleration was not measured.
///
/// Errors: a model without such a motion has no prediction. Cost: that of the motion, or of the steady states.

#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "identify/fit/rig.hpp"

namespace dualdamp::identify {

/// One measured quantity of a record.
struct Signal {
  std::string name;  ///< x, v, a, phase, t, force
  std::string unit;
  std::vector<double> measured;
  std::vector<double> at;  ///< what it is drawn over
  std::string at_name;     ///< t, Y, omega, number
  std::string at_unit;
  /// Standard deviation of its noise, as stated, or as its own roughness tells; 0: not known.
  double noise = 0.0;
  bool is_stated = false;
  /// Neighbours may be alike: errors of samples are not taken for independent.
  bool is_sampled = false;
  /// Samples beside a jump, whose side of it the least difference of a model decides: they count for nothing.
  std::vector<std::size_t> unsure;
};

enum class ExperimentKind { steady_states, decay, history, loop };

/// Predictions of models that differ little from one: for derivatives.
class Neighbours {
 public:
  Neighbours() = default;
  virtual ~Neighbours() = default;
  Neighbours(const Neighbours&) = delete;
  Neighbours& operator=(const Neighbours&) = delete;
  [[nodiscard]] virtual bool predict(const sim::Model& model, const OwnValues& own,
                                     Eigen::VectorXd& outputs) const = 0;
};

class Experiment {
 public:
  Experiment() = default;
  virtual ~Experiment() = default;
  Experiment& operator=(const Experiment&) = delete;

  ExperimentKind kind = ExperimentKind::history;
  std::string label;  ///< name of its file, and its label in it
  std::vector<Signal> signals;
  OwnValues own_start{};        ///< as the record shows them, or as they are known
  std::vector<Own> own_free;    ///< those that are sought unless they are known
  std::vector<Own> own_others;  ///< those that may be sought too

  /// Input amplitude [m or N] and frequency [rad/s] of each steady state; empty for other kinds.
  [[nodiscard]] virtual std::vector<std::pair<double, double>> levels() const { return {}; }

  /// Samples of all signals, one after the other.
  [[nodiscard]] Eigen::Index size() const;

  /// Outputs in the order of the signals. False: the model has no such motion.
  [[nodiscard]] virtual bool predict(const sim::Model& model, const OwnValues& own,
                                     Eigen::VectorXd& outputs) const = 0;
  /// The record up to this share of its duration, 0 < share <= 1; nothing: it has no order in time that a search
  /// could follow.
  [[nodiscard]] virtual std::unique_ptr<Experiment> first_part(double share) const;
  /// Fewer samples where there are more than a search needs; nothing: it needs all.
  [[nodiscard]] virtual std::unique_ptr<Experiment> thinned() const;
  /// The record with models tied to its motion (`tie.hpp`); nothing: it is no motion.
  [[nodiscard]] virtual std::unique_ptr<Experiment> tied(double strength) const;
  /// By default they are predicted like any other.
  [[nodiscard]] virtual std::unique_ptr<Neighbours> neighbours(const sim::Model& model) const;

 protected:
  Experiment(const Experiment&) = default;  ///< for parts of it
};

/// What a record has of its own as a parameter; `is_alone`: there is no other record to tell it from.
[[nodiscard]] FitParameter own_parameter(const Experiment& experiment, std::size_t index, Own own, bool is_alone);

/// What is known beside the records.
struct ExperimentOptions {
  std::string name;  ///< of the file
  bool loop = false;
  double frequency = unknown;  ///< of pairs that state none [rad/s]
  bool force_driven = false;   ///< Y is the amplitude of a force [N]
  double sigma_x = 0.0;        ///< stated noise of x, amplitudes or extremes [m]; 0: none
  double sigma_v = 0.0, sigma_a = 0.0, sigma_force = 0.0, sigma_phase = 0.0;
};

/// One for the pairs or the decay of a record, one for each of its histories. `fault`: why there is none.
[[nodiscard]] std::vector<std::unique_ptr<Experiment>> experiments_of(const Record& record,
                                                                      const ExperimentOptions& options,
                                                                      std::string& fault);

}  // namespace dualdamp::identify
