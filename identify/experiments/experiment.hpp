#pragma once
/// An experiment of a fit: the readings of a record, and the prediction of these readings by a model of the rig.
///
///   steady states  amplitudes, and phases where they were measured, at each level and frequency
///   decay          extremes, and their times where they were measured
///   history        those of x, v and a that were measured, sample by sample, from the first state of the record,
///                  under the drive of the model or its own
///   loop           the force that moves the mass along the measured motion, m a + c v + k x + F(x, v)
///
/// The engine of the laws computes a motion, from event to event. Measured signals are not differentiated, except
/// for a loop that needs a velocity or an acceleration that was not measured. There, all terms of the equation,
/// m a, c v, k x, F and the force, pass the same filter.
///
/// Errors: `predict` returns false if the model has no such motion. Cost: that of the motion or the steady states.

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "identify/experiments/rig.hpp"
#include "identify/records/signals.hpp"

namespace dualdamp::identify {

/// A second quantity at each reading of a signal, for tables and charts.
struct Companion {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

/// One measured quantity of a record.
struct Signal {
  std::string name;  ///< x, v, a, phase, t, force
  std::string unit;
  std::vector<double> measured;
  std::vector<double> at;  ///< abscissa of each reading
  std::string at_name;     ///< t, Y, omega, number
  std::string at_unit;
  /// Y of steady states over several frequencies, if it varies too; x of a loop, if it was measured; else empty.
  Companion companion;
  /// Standard deviation of the noise: stated, or estimated from the roughness of the signal; 0: not known.
  double noise = 0.0;
  bool is_stated = false;
  /// The readings are samples; the errors of neighbours may be correlated.
  bool is_sampled = false;
  /// All noise of the signal has passed this filter; `noise` is that behind it.
  std::optional<ZeroPhaseFilter> filter;
  /// Samples beside a jump of the signal. They have no weight: a small change of the model moves them across the
  /// jump.
  std::vector<std::size_t> unsure;
  /// Of a loop: samples at which the mass sticks. Under a law with rigid friction they have no weight: the friction
  /// is whatever holds the mass, within the bounds of the law.
  std::vector<std::size_t> stuck;
};

/// Sizes of a measured motion: largest displacement from the mean, and largest speed [m, m/s].
struct MotionSize {
  double length = 0.0;
  double speed = 0.0;
};

enum class ExperimentKind { steady_states, decay, history, loop };

/// Predicts models that differ little from a given one: for derivatives, and for the next point of a search.
class Neighbours {
 public:
  Neighbours() = default;
  virtual ~Neighbours() = default;
  Neighbours(const Neighbours&) = delete;
  Neighbours& operator=(const Neighbours&) = delete;
  /// `share`: the outputs may be off by this part of their distance from those of the known model.
  [[nodiscard]] virtual bool predict(const sim::Model& model, const RecordValues& of_record, double share,
                                     Eigen::VectorXd& outputs) const = 0;
  /// Whether models near this one take less time with these neighbours than without them.
  [[nodiscard]] virtual bool is_worth_using() const { return false; }
};

class Experiment {
 public:
  Experiment() = default;
  virtual ~Experiment() = default;
  Experiment& operator=(const Experiment&) = delete;

  ExperimentKind kind = ExperimentKind::history;
  std::string label;  ///< name of its file, and its label in it
  std::vector<Signal> signals;
  /// Of a history: its own drive, in place of that of the model. It begins with the record.
  std::optional<sim::Excitation> drive;
  std::optional<MotionSize> motion;          ///< of a loop: the force alone is compared, and does not show it
  RecordValues record_start{};               ///< start values, from the record or known
  std::vector<RecordParameter> record_free;  ///< parameters that are sought unless they are known
  std::vector<RecordParameter>
      record_of_place;  ///< also sought unless they are known, if a force depends on the position
  std::vector<RecordParameter> record_others;  ///< parameters that may be sought as well
  bool is_force_driven = false;                ///< of steady states: the levels are amplitudes of a force
  std::vector<std::string> derived;  ///< of a loop: signals it needs that are derivatives of measured ones
  bool knows_load = false;           ///< `travel` is known: the caller stated the first state
  std::vector<std::pair<RecordParameter, std::string>> remarks;  ///< why parameters of `record_of_place` are sought
  /// Work of all predictions so far, those of parts of the record included: in units of `sim::Engine::work`, of
  /// steady states without the answers of smooth laws; of a loop, in steps of its law.
  std::shared_ptr<std::atomic<long>> work = std::make_shared<std::atomic<long>>(0);

  /// Input amplitude [m or N] and frequency [rad/s] of each steady state; empty for other kinds.
  [[nodiscard]] virtual std::vector<std::pair<double, double>> levels() const { return {}; }

  /// Number of readings of all signals.
  [[nodiscard]] Eigen::Index size() const;

  /// Predicted readings, signal after signal. False: the model has no such motion.
  [[nodiscard]] virtual bool predict(const sim::Model& model, const RecordValues& of_record,
                                     Eigen::VectorXd& outputs) const = 0;
  /// The record up to this share of its duration, 0 < share <= 1. Null if the record is no motion in time.
  [[nodiscard]] virtual std::unique_ptr<Experiment> first_part(double share) const;
  /// The record with fewer samples. Null if it has no more samples than a search needs.
  [[nodiscard]] virtual std::unique_ptr<Experiment> thinned() const;
  /// The record with models tied to its motion (`tie.hpp`). Null if the record is no motion in time.
  [[nodiscard]] virtual std::unique_ptr<Experiment> tied(double strength) const;
  /// Steady states with their motion held as it was measured (`balanced_states.hpp`). Null for other kinds.
  [[nodiscard]] virtual std::unique_ptr<Experiment> balanced() const;
  /// What the readings say against `model` although they have no weight; a sentence each.
  [[nodiscard]] virtual std::vector<std::string> objections(const sim::Model& model,
                                                            const RecordValues& of_record) const;
  /// Predicts `model`, and returns what predicts models near it. Null: the model has no such motion. `near`:
  /// neighbours of a model beside it, or null. By default, each model is predicted independently.
  [[nodiscard]] virtual std::unique_ptr<Neighbours> neighbours(const sim::Model& model,
                                                               const RecordValues& of_record,
                                                               const Neighbours* near,
                                                               Eigen::VectorXd& outputs) const;

 protected:
  Experiment(const Experiment&) = default;  ///< for parts of a record
};

using Experiments = std::vector<std::unique_ptr<Experiment>>;

/// What drives the motion of a record: its own drive, or else that of the rig.
[[nodiscard]] inline const sim::Excitation& drive_of(const Experiment& experiment, const Rig& rig) {
  return experiment.drive ? *experiment.drive : rig.known.excitation;
}

/// A parameter of a single record. `is_alone`: there is one record only, so the name needs no number.
[[nodiscard]] FitParameter parameter_of_record(const Experiment& experiment, std::size_t index,
                                               RecordParameter which, bool is_alone);

/// The parameters of a record that are sought unless they are known. `feels_position`: that of the rig.
[[nodiscard]] std::vector<RecordParameter> sought_of_record(const Experiment& experiment, bool feels_position);

/// What the caller states about a record.
struct ExperimentOptions {
  std::string name;  ///< of the file
  bool loop = false;
  bool has_mass = false;       ///< the force of a loop also accelerates a mass
  double frequency = unknown;  ///< of pairs without a frequency [rad/s]
  bool force_driven = false;   ///< Y is the amplitude of a force [N]
  double sigma_x = 0.0;        ///< stated noise of x, amplitudes or extremes [m]; 0: none
  double sigma_v = 0.0, sigma_a = 0.0, sigma_force = 0.0, sigma_phase = 0.0;
  /// The own drives of the histories, in their order; empty, or nothing for a history: that of the model.
  std::vector<std::optional<sim::Excitation>> drives = {};
};

/// One experiment for the pairs or the decay of a record, or one for each history. `fault`: why parts of the record
/// have none, each with the name of its history; empty if all have one.
[[nodiscard]] Experiments experiments_of(const Record& record, const ExperimentOptions& options,
                                         std::string& fault);

/// One experiment from a part of a record. Null, with a fault, if the part cannot be used.
[[nodiscard]] std::unique_ptr<Experiment> steady_states(const PairRecord& record, const ExperimentOptions& options,
                                                        std::string& fault);
[[nodiscard]] std::unique_ptr<Experiment> free_vibration(const DecayRecord& record,
                                                         const ExperimentOptions& options, std::string& fault);
[[nodiscard]] std::unique_ptr<Experiment> motion(const History& history, const ExperimentOptions& options,
                                                 std::string& fault);
[[nodiscard]] std::unique_ptr<Experiment> friction_loop(const History& history, const ExperimentOptions& options,
                                                        std::string& fault);

}  // namespace dualdamp::identify
