#include "bench/score/case_answer.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::bench {

namespace {

constexpr double level = 0.05;
constexpr auto nothing = std::numeric_limits<float>::quiet_NaN();

/// Whether the method stands by its answer: what it says counts, else its p-value.
bool stands_by(const CaseAnswer& answer) {
  if (!answer.is_given()) return false;
  if (answer.usable != CaseAnswer::Usable::missing) return answer.usable == CaseAnswer::Usable::yes;
  return !(answer.p_value < level);
}

/// Confidence: usable answers in [0, 1], others in [-2, -1], no answer -3.
double confidence_of(const CaseAnswer& answer, bool stands) {
  if (!answer.is_given()) return -3.0;
  const double p = std::isnan(answer.p_value) ? 1.0 : std::clamp(answer.p_value, 0.0, 1.0);
  return stands ? p : p - 2.0;
}

ParameterMark parameter_mark(double value, const identify::Interval& interval, bool stands, double truth) {
  ParameterMark mark{.error = nothing, .score = nothing};
  if (std::isnan(truth)) return mark;
  if (std::isfinite(value)) mark.error = static_cast<float>(value / truth - 1.0);
  mark.has_interval = stands && std::isfinite(interval[0]) && std::isfinite(interval[1]);
  mark.covers = mark.has_interval && interval[0] <= truth && truth <= interval[1];
  mark.score =
      static_cast<float>(mark.has_interval ? interval_score(interval[0], interval[1], truth) : ignorance_score);
  return mark;
}

float loss_of(const ParameterMark& zeta, const ParameterMark& F0) {
  float loss = 0.0F;
  for (const ParameterMark* mark : {&zeta, &F0})
    if (!std::isnan(mark->error)) loss = std::max(loss, std::abs(mark->error));
  return std::min(loss, 1.0F);
}

}  // namespace

bool CaseAnswer::is_given() const { return std::isfinite(zeta) && std::isfinite(F0); }

double interval_score(double low, double high, double truth) {
  constexpr double penalty = 2.0 / level;
  const double outside = std::max(low - truth, 0.0) + std::max(truth - high, 0.0);
  return std::min(((high - low) + penalty * outside) / truth, worst_score);
}

Mark mark_of(const CaseAnswer& answer, const TrueParameters& truth) {
  Mark mark;
  mark.given = answer.is_given();
  const bool stands = stands_by(answer);
  mark.zeta = parameter_mark(answer.zeta, answer.zeta95, stands, truth.zeta);
  mark.F0 = parameter_mark(answer.F0, answer.F095, stands, truth.F0);
  if (!truth.is_given())
    mark.loss = nothing;
  else if (mark.given)
    mark.loss = loss_of(mark.zeta, mark.F0);
  mark.rejected = !stands;
  mark.confidence = static_cast<float>(confidence_of(answer, stands));
  return mark;
}

}  // namespace dualdamp::bench
