#pragma once
/// The grid of a stress test, expanded: cases by number, and what they share.
///
/// A motion is one departure at one severity on one rig over one range of excitation. It serves all sensors and
/// seeds, which are the cases; a case serves all methods. Motion 0 of each rig and range is the truth itself,
/// friction that is Coulomb + viscous: there a rejection is a false alarm.
///
/// A cell is what cases differ in by rig and seed only: departure, severity, range and sensors.

#include <cstddef>
#include <cstdint>
#include <string>

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
    Departure departure{};
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
  /// A motion of the first rig, and the sensors, of a cell.
  [[nodiscard]] Case first_of_cell(std::size_t cell) const {
    return {cell / question_.sensors.size(), cell % question_.sensors.size(), 0};
  }
  /// What methods can find in it.
  [[nodiscard]] TrueParameters parameters(const Motion& motion) const;
  /// Of the random drive of a motion, which no other motion has and all its cases share.
  [[nodiscard]] std::uint64_t drive_seed(std::size_t motion) const;
  /// Of all draws of a case.
  [[nodiscard]] std::uint64_t seed(std::size_t number) const;

  [[nodiscard]] const StressTest& question() const { return question_; }

 private:
  const StressTest& question_;
  std::size_t motions_per_range_;
  std::size_t cases_per_motion_;
};

}  // namespace dualdamp::bench
