#pragma once
/// The grid of a stress test, expanded: cases by number, and what they share.
///
/// A motion is one law at one severity over one range of excitation. It serves all sensors and seeds, which are the
/// cases; a case serves all methods. Motion 0 of each range is the truth itself, friction that is Coulomb +
/// viscous: there a diagnostic is a false alarm.

#include <cstddef>
#include <string>

#include "bench/stress_test.hpp"

namespace dualdamp::bench {

/// Name of the truth in the place of a law.
inline constexpr const char* truth_name = "coulomb_viscous";

class Grid {
 public:
  explicit Grid(const StressTest& question);

  [[nodiscard]] std::size_t motions() const { return motions_per_range_ * question_.ranges.size(); }
  [[nodiscard]] std::size_t cases_per_motion() const { return cases_per_motion_; }
  [[nodiscard]] std::size_t cases() const { return motions() * cases_per_motion_; }

  struct Motion {
    const ExcitationRange* range = nullptr;
    const Rig* law = nullptr;  ///< nullptr: the truth
    double severity = 0.0;
    [[nodiscard]] std::string name() const { return law == nullptr ? truth_name : std::string(law->name); }
  };
  [[nodiscard]] Motion motion(std::size_t number) const;

  struct Case {
    std::size_t motion = 0;
    std::size_t sensors = 0;  ///< index into the question's
    std::size_t seed = 0;
  };
  [[nodiscard]] Case at(std::size_t number) const;

  [[nodiscard]] const StressTest& question() const { return question_; }

 private:
  const StressTest& question_;
  std::size_t motions_per_range_;
  std::size_t cases_per_motion_;
};

}  // namespace dualdamp::bench
