#pragma once
/// A record that a planned measurement continues, and what any_law would answer to both together.
///
/// One law that the record allows is the truth, at its most probable severity. Its readings of the plan, with noise
/// by the deviations of the record, make one record with those that were measured. Plain friction is fitted to it
/// anew, so that the noise, the error of the laws and the test of each law are those that any_law would find. Any
/// other law is fitted anew at each severity by a Gauss-Newton step from its fit to the record, with the
/// derivatives of all readings there. The ranges follow from these fits as in any_law.
///
/// The noise has a fixed seed: the same record has the same answers. Severities refer to the motion in the middle
/// of the record, and are those of its fits.
///
/// Cost: readings of each law at its severities, and their derivatives, once a plan; some ten milliseconds an
/// answer.

#include <cstdint>
#include <optional>
#include <vector>

#include "identify/design/candidate.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/options.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// A record of steady states and its answer by any_law.
struct StudiedRecord {
  std::vector<Pair> states;  ///< those that the model reads, with their frequencies
  const ReadingModel& model;
  const LawStudy& study;
  const KnownConstants& constants;
  const KnownDeviations& known;
  double law_error = 0.0;
};

/// A law that takes part: the record allows it, or nearly so.
struct Rival {
  const LawFits* law = nullptr;
  bool allowed = false;  ///< otherwise it is not taken as the truth
  /// Those within reach of the record, the neighbours of the best one, and the most probable one.
  std::vector<SeverityFit> fits{};
  std::size_t probable = 0;  ///< index of the fit that is the truth
};

/// What a law predicts at the unknowns of its fit to the record, in the units of the readings.
struct Outlook {
  Eigen::VectorXd readings;
  Eigen::MatrixXd slopes;  ///< by F0, c, stiffness, cubic stiffness; or by F0, c, release, offset
};

/// Of each rival, and of each of its fits; nothing where it has no such motion.
using Outlooks = std::vector<std::vector<std::optional<Outlook>>>;

/// The laws of a study that take part in continued records.
[[nodiscard]] std::vector<Rival> rivals_of(const StudiedRecord& record);

/// All that the states of the record could have given, also their phases.
[[nodiscard]] Outlooks outlooks_of(const StudiedRecord& record, const std::vector<Rival>& rivals);

/// The record continued by candidates of the same plan, which differ only in what they read.
class ContinuedRecord {
 public:
  /// `own`: outlooks of the record.
  ContinuedRecord(const StudiedRecord& record, const std::vector<Rival>& rivals, const Outlooks& own,
                  const MeasurementPlan& plan);

  /// Whether each allowed law has such motions at that severity.
  [[nodiscard]] bool possible() const;

  /// Whether the rival is plain friction where it is the truth. Such truths have the same answers.
  [[nodiscard]] bool is_plain(std::size_t truth) const;

  /// The answer to record and candidate if the rival `truth` made the readings; `draw`: number of the noise.
  /// Nothing if plain friction has no readings like these.
  [[nodiscard]] std::optional<LawIntervals> answer(const CandidateMeasurement& candidate, std::size_t truth,
                                                   std::uint64_t draw) const;

 private:
  class Joint;

  const StudiedRecord& record_;
  const std::vector<Rival>& rivals_;
  const Outlooks& own_;
  MeasurementPlan plan_;
  Outlooks planned_;
};

}  // namespace dualdamp::identify
