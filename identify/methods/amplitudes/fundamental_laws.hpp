#pragma once
/// Friction laws by what an x-Y test measures: the fundamental Phi of their force on x = X cos(theta), V = w X.
///
///   Phi(V, X) = sum_j C_j phi_j(V, X; shape)
///
/// Each law is linear in up to three coefficients and has at most one shape parameter. Speeds and amplitudes are
/// divided by their largest values. Source of the fundamentals: closed forms of (4/pi) int_0^(pi/2) f(V sin t) sin
/// t dt, and for a law of position (4/(pi X)) int_0^X F(s) ds.

#include <array>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

namespace dualdamp::identify {

/// Fundamental of a Coulomb friction of 1.
inline constexpr double coulomb_share = 4.0 / std::numbers::pi;

/// A coefficient [N . (s/m)^speed_power . m^-length_power] of a law.
struct LawCoefficient {
  std::string_view name;
  std::string_view unit;
  int speed_power = 0;
  int length_power = 0;
  bool signed_value = false;  ///< else it is not negative
};

/// A parameter in which the fundamental is not linear, searched from `low` to `high`.
struct LawShape {
  std::string_view name;
  std::string_view unit;
  double low = 0.0;
  double high = 0.0;
  bool is_speed = false;     ///< over the largest speed; else a pure number
  bool is_exponent = false;  ///< of the last coefficient's speed
};

struct FundamentalLaw {
  static constexpr std::size_t most_coefficients = 3;
  using Terms = std::array<double, most_coefficients>;

  /// phi_j and their derivatives.
  struct Fundamentals {
    Terms value{};
    Terms slope{};     ///< X dphi_j/dX along V = w X
    Terms by_shape{};  ///< dphi_j/dshape
  };

  std::string_view name;
  std::vector<LawCoefficient> coefficients;
  std::optional<LawShape> shape;
  Fundamentals (*fundamentals)(double V, double X, double shape) = nullptr;
  /// Forces at speed v > 0; nullptr for laws that are not of velocity.
  Terms (*forces)(double v, double shape) = nullptr;
  /// At one frequency its curve equals that of an earlier law in the list, or of a law with fewer parameters.
  bool alias_at_one_frequency = false;
  /// It differs from Coulomb and viscous friction by one parameter, which is 0 for these.
  bool one_more = false;

  [[nodiscard]] std::size_t parameters() const { return coefficients.size() + (shape ? 1 : 0); }
};

/// coulomb_viscous first.
[[nodiscard]] const std::vector<FundamentalLaw>& fundamental_laws();

/// Dawson's integral exp(-x^2) int_0^x exp(t^2) dt, to rounding (rybicki1989).
[[nodiscard]] double dawson(double x);

struct ValueAndSlope {
  double value = 0.0;
  double slope = 0.0;
};

/// Fundamental of v/(1 + |v|/v0) at V = a v0, divided by v0, and its derivative by a; a > 0 (to 1e-9 or better near
/// a = 1).
[[nodiscard]] ValueAndSlope saturating_fundamental(double a);

}  // namespace dualdamp::identify
