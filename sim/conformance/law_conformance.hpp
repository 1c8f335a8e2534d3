#pragma once
/// The law contract as a test that every friction law must pass: for this project's own tests and for laws from
/// outside (`dualdamp laws NAME --check`).
///
///     CHECK(nonconformities(law_case("coulomb", {{"kinetic", 2.0}})) == std::vector<std::string>{});
///
/// The mass moves along random paths: strokes with smooth speed, reversals, stops, releases. For every step the
/// test demands
///   * guards on the right side after a mode change, reached within `friction::max_repeats` jumps;
///   * a finite force that is the same at a second call, and a static limit >= 0;
///   * for a law that is not affine: finite rates, the same from every function; no kink at v = 0 while the
///     direction is frozen, where |v| is sign(direction) v; a dissipation >= 0, if the law states one and is
///     declared passive;
///   * affine form = force, guards and limit, at the start of a step and, by `advance`, at its end;
///   * `advance` over two halves = `advance` over the whole, with the rates as its derivative;
///   * forms and jumps affine in the states, and jumps also in position and speed, on one branch: the driver
///     differentiates them by displacement (not for jumps of a random law, whose motions are not periodic);
///   * work against the law >= 0 from its unstretched start on, if declared passive;
///   * the mirrored force on the mirrored path, if declared odd;
///   * the same forces on the same path a second time;
///   * if the case has `scaled`: a factor on the force limits acts like force limits multiplied by that factor.
/// A parameter must be refused, with range and value, if it is missing, unknown, not finite or out of range.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::sim {

struct LawCase {
  friction::Law law;
  const std::vector<friction::Parameter>* parameters = nullptr;  ///< null: not examined
  friction::ParameterValues values{};                            ///< as a user gives them
  double stroke = 0.1;       ///< m; strokes up to this length must reach all modes
  double stroke_time = 0.5;  ///< s
  bool odd = true;
  bool passive = true;
  bool random = false;
  std::function<friction::Law(double factor)> scaled{};  ///< the law with all its limits multiplied
};

/// The case of a law of the registry with these values and its defaults; odd, passive and random as declared, with
/// the limits that its entry names. Errors: std::invalid_argument if there is no such law, if its values are
/// refused, or if they make several laws in parallel.
[[nodiscard]] LawCase law_case(std::string_view name, const friction::ParameterValues& values);

/// One sentence for each kind of fault; empty if the law conforms.
[[nodiscard]] std::vector<std::string> nonconformities(const LawCase& law_case);

}  // namespace dualdamp::sim
