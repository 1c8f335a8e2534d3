#pragma once
/// The ledger of assumptions of one record: for each assumption, whether the record can test it, by which test, and
/// how much zeta and F0 change when it is relaxed.
///
/// One joint model of the record (amplitude_model.hpp, decay_model.hpp, history_model.hpp) is relaxed in one way
/// after another; all tests share one family level (relaxation_tests.hpp). A departure is charged to the assumption
/// whose relaxation explains it best, and to those that explain it as well. It violates each of them whose
/// relaxation changes zeta or F0 by `least_change` or more. A smaller change is reported and violates nothing.
///
/// If a test still rejects after all departures are found, and its relaxation would change zeta or F0 by
/// `least_change`, its assumption is violated too, and there is no joint estimate. Exception: if friction over
/// speed or displacement is among the departures, the assumption of such a test becomes untested, unless it is
/// about friction itself.
///
/// Constants and gains with a stated uncertainty violate nothing as long as errors of at most 2.6 times the
/// uncertainty (1 %) explain the departure. The departure is reported, and stays relaxed in the joint estimate.
///
/// A term of friction is nearly seen if a test of its own rejects at 25 % while the family of tests does not
/// reject. It is not charged: the intervals of the joint estimate are extended to cover the estimate with that term
/// free.
///
/// An assumption whose tests would see only a departure that moves zeta or F0 by more than 30 % is untested.
///
/// Cost: that of the joint model; a history of 20,000 samples takes 0.2 s.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "identify/assumption.hpp"
#include "identify/estimate.hpp"
#include "identify/ledger/estimate/largest_friction.hpp"
#include "identify/options.hpp"
#include "identify/record.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"

namespace dualdamp::identify {

enum class Standing { holds, violated, untested };

/// "holds", "violated", "untested"
[[nodiscard]] std::string_view name_of(Standing standing);

struct LedgerEntry {
  Assumption assumption = Assumption::constants;
  Standing standing = Standing::untested;
  std::string test;                   ///< what was set free; empty where nothing was tested
  std::optional<double> p_value;      ///< of the family of all tests
  std::optional<double> zeta_change;  ///< relative, when relaxed
  std::optional<double> F0_change;
  std::string reason;  ///< why it is untested, what else explains a departure, or how large a one would be seen
  /// Relative change of zeta or F0, the larger one, by a departure that is missed in one record of five; nothing
  /// where the assumption was not tested, or violated.
  std::optional<double> sight;
  /// The constants that explain a departure: "a stiffness of 1421 N/m, not the stated 1563 N/m".
  std::string wanted;
  /// A departure is seen that the stated uncertainties allow.
  bool is_as_stated = false;
  /// Of stationarity: a drift that this record cannot tell from friction over speed, which is named with it.
  bool is_like_speed = false;
  std::string fitted;  ///< the constants that the joint estimate has: "a stiffness of 1421 N/m"
};

/// The joint model misses the record by more than its noise.
struct Misfit {
  double p_value = 1.0;  ///< of the family of all tests
  double times = 1.0;    ///< rms of what the model leaves, over that of the noise
};

struct LedgerOptions {
  double least_change = 0.02;  ///< relative change of zeta or F0 that matters
  /// A departure that errors of this size explain violates nothing.
  ConstantUncertainties uncertainties = {};
  KnownDeviations deviations = {};
};

/// What was recorded, for advice.
struct Recorded {
  bool histories = false;
  bool free = false;           ///< free vibrations alone
  bool drive = false;          ///< histories with their drive
  bool states = false;         ///< steady states, or histories from which they were taken
  bool one_sensor = false;     ///< x alone
  bool second_sensor = false;  ///< v or a beside x
  bool phases = false;         ///< of states
  bool frequencies = false;    ///< states at several frequencies
  bool sweeps = false;         ///< states of several sweeps with labels
  bool times = false;          ///< of the extremes
  bool clipped = false;        ///< samples at the end of a sensor's range
};

/// The range of an estimate: what may be true beside it, for all that the record tells.
struct UnseenRange {
  ParameterIntervals ends = {};
  std::array<std::string, 2> zeta_by,
      F0_by;  ///< what moves zeta and F0 to each end; empty: the interval reaches so far
};

struct Ledger {
  std::string data;              ///< what was tested: "24 steady states with phases"; empty: nothing
  bool tests_histories = false;  ///< histories themselves, not steady states or extremes taken from them
  Recorded recorded = {};
  std::vector<LedgerEntry> entries;  ///< one for each assumption
  /// Violated assumptions of each departure, best explanation first.
  std::vector<std::vector<Assumption>> departures;
  ParameterSet plain;                                            ///< of the joint model with nothing relaxed
  core::Coordinate coordinate = core::Coordinate::displacement;  ///< for the units in sentences
  std::vector<std::string> left_out;  ///< parts of the record outside the tests' conditions, each a sentence
  std::vector<std::string> warnings;  ///< about the readings and what is stated of them, each a sentence
  /// The joint model misses the record, whatever is relaxed: no single assumption explains it.
  std::optional<Misfit> misfit = {};
  /// A reading that all others exclude, a sentence (outliers/gross_error.hpp). No estimate with it describes the
  /// rig.
  std::string gross_error = {};
  /// Steady states that need more force than their drive gives, a sentence (force_balance.hpp). No estimate with
  /// the constants as stated describes them.
  std::string force_excess = {};
  /// The zero of x differs from history to history, a sentence. No estimate with one zero for all describes the
  /// rig.
  std::string unlike_zeros = {};
  /// Every fit of the simulated motion misses half of the measured one or more, a sentence. No estimate of the
  /// histories describes the rig; steady states or extremes taken from them are tested by themselves.
  std::string missed_motion = {};
  /// The record contradicts its assumptions, and would contradict none if x were measured, or friction acted,
  /// against something else, a sentence (other_geometry.hpp). No estimate with x as stated describes the rig.
  std::string other_geometry = {};
  LargestFriction largest = {};  ///< no estimate above it is usable
  /// A test that matters still rejects beside all departures found: no joint estimate describes the record.
  bool is_unexplained = false;
  std::vector<std::string> relaxed;  ///< tests of the relaxations that the joint estimate has free
  /// Estimate of the joint model with the departures relaxed. Nothing without a model, without mass and stiffness,
  /// or beside a misfit or an unexplained rest; nor, but of histories, if a departure that matters may be one of
  /// friction over speed or displacement.
  std::optional<Estimate> joint;
  /// `joint` has the stated uncertainties in its covariance, and need not be read again with each number moved.
  bool joint_knows_uncertainties = false;
  /// The joint estimate has a term of friction over speed or displacement free, of histories whose every sample the
  /// model follows to the noise: zeta and F0 are those beside it.
  bool frees_law = false;
  /// The interval of `joint`, and beyond it what departures that no test sees may make of zeta and F0.
  std::optional<UnseenRange> unseen;

  [[nodiscard]] const LedgerEntry& entry(Assumption assumption) const {
    return entries[static_cast<std::size_t>(assumption)];
  }
  [[nodiscard]] LedgerEntry& entry(Assumption assumption) { return entries[static_cast<std::size_t>(assumption)]; }
  [[nodiscard]] bool is_violated(Assumption assumption) const {
    return entry(assumption).standing == Standing::violated;
  }
  /// Is an assumption about the law of friction violated?
  [[nodiscard]] bool violates_law() const {
    return is_violated(Assumption::friction_velocity) || is_violated(Assumption::friction_displacement);
  }
};

/// Does a departure name this assumption?
[[nodiscard]] inline bool names(const std::vector<Assumption>& departure, Assumption assumption) {
  return std::ranges::find(departure, assumption) != departure.end();
}

[[nodiscard]] Ledger ledger_of(const Record& record, const KnownConstants& constants,
                               const LedgerOptions& options = {});

/// The joint estimate with exactly these relaxations free, named as `Relaxation::test`. Nothing is tested.
[[nodiscard]] Estimate joint_fit(const Record& record, const KnownConstants& constants,
                                 const std::vector<std::string>& relaxed, const LedgerOptions& options = {});

}  // namespace dualdamp::identify
