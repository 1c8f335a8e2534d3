#pragma once
/// The answer of a method or a program to one case of a stress test, and the scores of one answer.
///
/// Scores are relative to the truth theta:
///
///   interval score of a 95 % interval [l, u] = [(u - l) + 40 max(l - theta, 0) + 40 max(theta - u, 0)] / theta,
///
/// where 40 = 2/0.05: a proper score, smallest in expectation for the 2.5 and 97.5 % quantiles of what is known
/// (gneiting2007strictly). It counts as `worst_score` at most, the score of an interval at a distance of one theta.
/// Without an interval, or if the method does not stand by its answer, the score is that of the interval from 0 to
/// twice the truth.
///
///   loss = largest relative error of zeta and F0, 1 at most; 1 without an answer; NaN without a truth of either.
///
/// A method stands by an answer that it calls usable; where it does not say, by one whose p-value is not below
/// 0.05. rejected: it does not, or there is no answer. confidence orders the cases of one method: usable before not
/// usable before none, then by the p-value.

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace dualdamp::bench {

inline constexpr double not_stated = std::numeric_limits<double>::quiet_NaN();

struct CaseAnswer {
  double zeta = not_stated;
  double F0 = not_stated;                                   ///< N
  std::array<double, 2> zeta95 = {not_stated, not_stated};  ///< low, high
  std::array<double, 2> F095 = {not_stated, not_stated};    ///< N
  double p_value = not_stated;                              ///< that the assumptions of the method hold
  enum class Usable { missing, yes, no } usable = Usable::missing;

  [[nodiscard]] bool is_given() const;
};

/// The answers of one program to all cases, by their number in the grid.
struct Entry {
  std::string name;
  std::vector<CaseAnswer> answers;
};

/// The true parameters of a case; NaN where the departure leaves no single true value (`Departure`).
struct TrueParameters {
  double zeta = not_stated;
  double F0 = not_stated;  ///< N

  /// Whether there is at least one.
  [[nodiscard]] bool is_given() const { return !std::isnan(zeta) || !std::isnan(F0); }
};

inline constexpr double worst_score = 40.0;
inline constexpr double ignorance_score = 2.0;

/// One parameter of one answer.
struct ParameterMark {
  float error = 0.0F;  ///< relative; NaN: no estimate, or no truth
  float score = 0.0F;  ///< NaN: no truth
  bool has_interval = false;
  bool covers = false;
};

/// The scores of one answer.
struct Mark {
  ParameterMark zeta, F0;
  float loss = 1.0F;              ///< NaN: no truth
  float prediction_error = 1.0F;  ///< bench/prediction.hpp
  float confidence = 0.0F;
  bool rejected = true;
  bool given = false;
};

[[nodiscard]] double interval_score(double low, double high, double truth);

[[nodiscard]] Mark mark_of(const CaseAnswer& answer, const TrueParameters& truth);

}  // namespace dualdamp::bench
