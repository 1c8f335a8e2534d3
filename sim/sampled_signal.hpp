#pragma once
/// A signal y(t) with values at nodes t_0 = 0 < t_1 < ... < t_N and a polynomial between neighbouring nodes.
///
///   step     y(t) = y_i from t_i on                                            jumps at the nodes
///   linear   a straight line from node to node                                 y' jumps; error h^2/8 max|y''|
///   cubic    the cubic spline with continuous y' and y'', "not a knot" at
///            the ends (deboor1978); of two nodes a line, of three a parabola   error 5 h^4/384 max|y''''| inside
///
/// The nodes may be unevenly spaced. After the last node y keeps its last value. A signal that repeats goes on with
/// the first piece instead: its last node is its first one again, and if their values differ, y jumps.
///
/// Memory: 16 bytes a node, cubic 24. Cost: the constructor is linear in the number of nodes, a piece is O(1).

#include <array>
#include <cstddef>
#include <vector>

namespace dualdamp::sim {

/// A polynomial sum_n derivatives[n] s^n/n!, where s is the time since its start.
struct PolynomialPiece {
  double duration = 0.0;                ///< s; may be infinite
  std::array<double, 4> derivatives{};  ///< at its start [unit of the signal/s^n]
};

/// The cubic with these values and slopes at both ends.
[[nodiscard]] PolynomialPiece hermite_piece(double duration, double value, double slope, double end_value,
                                            double end_slope);

/// A place between two nodes, and by how much the signal there lies above or below all nodes.
struct Overshoot {
  double t = 0.0;     ///< s
  double size = 0.0;  ///< in the unit of the signal; 0: nowhere
};

enum class Interpolation { step, linear, cubic };

class SampledSignal {
 public:
  /// Throws InputError for fewer than two nodes, times and values of different number, a number that is not finite,
  /// or times that do not increase from 0.
  SampledSignal(std::vector<double> times, std::vector<double> values, Interpolation interpolation,
                bool repeats = false);

  /// Piece n, counted from 0 through all repeats; begin(): the time at which it begins [s].
  [[nodiscard]] PolynomialPiece piece(long n) const;
  [[nodiscard]] double begin(long n) const;

  [[nodiscard]] Interpolation interpolation() const { return interpolation_; }
  [[nodiscard]] bool repeats() const { return repeats_; }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }    ///< s
  [[nodiscard]] const std::vector<double>& values() const { return values_; }  ///< m or N
  [[nodiscard]] double length() const { return times_.back(); }                ///< s
  /// Largest |y| of the nodes.
  [[nodiscard]] double size() const { return size_; }
  /// y at the first node minus y at the last one: the jump of a signal that repeats.
  [[nodiscard]] double gap() const { return values_.front() - values_.back(); }
  /// Whether y itself jumps somewhere.
  [[nodiscard]] bool jumps() const { return interpolation_ == Interpolation::step || (repeats_ && gap() != 0.0); }

  /// The largest one. A cubic spline swings far beyond its nodes where two of them are much closer to each other
  /// than the others.
  [[nodiscard]] Overshoot largest_overshoot() const;

  /// This signal times a factor.
  [[nodiscard]] SampledSignal scaled(double factor) const;

 private:
  [[nodiscard]] std::size_t pieces() const { return times_.size() - 1; }
  [[nodiscard]] double width(std::size_t i) const { return times_[i + 1] - times_[i]; }
  [[nodiscard]] double chord(std::size_t i) const { return (values_[i + 1] - values_[i]) / width(i); }
  void build_spline();

  std::vector<double> times_;
  std::vector<double> values_;
  std::vector<double> slopes_;  ///< of the spline at the nodes; else none
  Interpolation interpolation_;
  bool repeats_;
  double size_ = 0.0;
};

}  // namespace dualdamp::sim
