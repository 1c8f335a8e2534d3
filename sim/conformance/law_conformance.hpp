#pragma once
/// What every friction law must pass, whoever wrote it: the law contract as a test, for this project's own tests
/// and for laws from outside (`dualdamp laws NAME --check`).
///
///     CHECK(nonconformities(law_case("coulomb", {{"kinetic", 2.0}})) == std::vector<std::string>{});
///
/// The mass moves along random paths: strokes with smooth speed, reversals, stops, releases. Every step must have
///   * guards on the right side after a mode change, reached within 32 jumps;
///   * a finite force, the same at a second call, and a static limit >= 0;
///   * of a law that is not affine: finite rates, the same from every function; no kink at v = 0 while the
///     direction is frozen, |v| being sign(direction) v; a dissipation of its own >= 0 when declared passive;
///   * affine form = force, guards and limit, at the start of a step and, by `advance`, at its end;
///   * `advance` over two halves = `advance` over the whole, with the rates as its derivative;
///   * forms and jumps affine in the states, jumps in position and speed too, with the same branch: the driver
///     differentiates them by displacement (jumps of a random law excepted, whose motions are not periodic);
///   * work done against it >= 0 from its unstretched start on, when declared passive;
///   * the mirrored force on the mirrored path, when declared odd;
///   * the same forces on the same path a second time;
///   * the same effect of a factor on the force limits and of force limits multiplied by it, when the case says
///   how.
/// Every parameter must be refused, with range and value, when it is missing, unknown, not finite or out of range.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::sim {

struct LawCase {
  friction::Law law;
  const std::vector<friction::Parameter>* parameters = nullptr;  ///< none: not examined
  friction::ParameterValues values{};                            ///< as a user gives them
  double stroke = 0.1;                                           ///< m: strokes up to this length reach all modes
  double stroke_time = 0.5;                                      ///< s
  bool odd = true;
  bool passive = true;
  bool random = false;
  std::function<friction::Law(double factor)> scaled{};  ///< the law with all its limits multiplied
};

/// A law of the registry with these values, defaults filled in; odd, passive and random as it is declared, with the
/// limits that its entry names. Errors: std::invalid_argument where there is no such law, its values are refused,
/// or they make several laws in parallel.
[[nodiscard]] LawCase law_case(std::string_view name, const friction::ParameterValues& values);

/// One sentence for each kind of fault; empty for a law that conforms.
[[nodiscard]] std::vector<std::string> nonconformities(const LawCase& law_case);

}  // namespace dualdamp::sim
