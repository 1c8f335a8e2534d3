#pragma once
/// The grid of a stress test, expanded: cases by number, and what they share.
///
/// A motion is one departure at one severity on one rig over one range of excitation. Each set of sensors and each
/// seed makes one case of it; all methods read each case. Motion 0 of each rig and range is the truth itself,
/// Coulomb + viscous friction: there a rejection is a false alarm.
///
/// A cell holds the cases of one departure, severity, range and set of sensors; they differ by rig and seed.

#include <cstddef>
#include <cstdint>

#include "bench/stress_test.hpp"

namespace dualdamp::bench {

class Grid {
 public:
  explicit Grid(const StressTest& question);

  [[nodiscard]] std::size_t motions() const {
    return motions_per_range_ * question_.ranges.size() * question_.rigs.size();
  }
  [[nodiscard]] std::size_t cases_per_motion() const { return cases_per_motion_; }
  [[nodiscard]] std::size_t cases() const { return motions() * cases_per_motion_; }

  struct Motion {
    std::size_t rig = 0;
    std::size_t range = 0;
    std::size_t place = 0;  ///< among the motions of a rig and range
    CaseDeparture departure{};
    double severity = 0.0;
  };
  [[nodiscard]] Motion motion(std::size_t number) const;

  struct Case {
    std::size_t motion = 0;
    std::size_t sensors = 0;  ///< index into the question's
    std::size_t seed = 0;
  };
  [[nodiscard]] Case at(std::size_t number) const;

  [[nodiscard]] std::size_t cells() const {
    return motions_per_range_ * question_.ranges.size() * question_.sensors.size();
  }
  [[nodiscard]] std::size_t cell_of(const Motion& motion, std::size_t sensors) const {
    return (motion.range * motions_per_range_ + motion.place) * question_.sensors.size() + sensors;
  }
  /// The first case of a cell, with the first rig.
  [[nodiscard]] Case first_of_cell(std::size_t cell) const {
    return {cell / question_.sensors.size(), cell % question_.sensors.size(), 0};
  }
  /// The true parameters of a motion.
  [[nodiscard]] TrueParameters parameters(const Motion& motion) const;
  /// Seed of the random drive of a motion. No other motion has it, and all cases of the motion share it.
  [[nodiscard]] std::uint64_t drive_seed(std::size_t motion) const;
  /// Seed of all draws of a case.
  [[nodiscard]] std::uint64_t seed(std::size_t number) const;

  [[nodiscard]] const StressTest& question() const { return question_; }

 private:
  const StressTest& question_;
  std::size_t motions_per_range_;
  std::size_t cases_per_motion_;
};

}  // namespace dualdamp::bench
