#include "identify/fit/parallel_elements.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "friction_models/laws/iwan.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

std::optional<std::size_t> find_path(const std::vector<FitParameter>& parameters, std::size_t law,
                                     const std::string& path) {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].owner == Owner::law && parameters[i].index == law && parameters[i].path == path) return i;
  return std::nullopt;
}

bool have_equal_ranges(const std::vector<FitParameter>& parameters, const std::vector<std::size_t>& these) {
  return std::ranges::all_of(these, [&](std::size_t i) {
    const friction::Range& first = parameters[these.front()].range;
    return parameters[i].range.low == first.low && parameters[i].range.high == first.high;
  });
}

/// The force of loops as a sum of columns; the first `free` of them may be negative.
struct LinearLoop {
  Eigen::MatrixXd products;  ///< of the columns with each other
  Eigen::VectorXd with;      ///< of the columns with the measured force
  Eigen::Index free = 0;
};

/// Numbers of columns among those that must be positive, with their coefficients.
using Chosen = std::vector<std::pair<Eigen::Index, double>>;

/// The columns that leave least of the force, among which all that may be negative.
class BestColumns {
 public:
  explicit BestColumns(const LinearLoop& loop) : loop_(loop), set_(static_cast<std::size_t>(loop.free)) {
    std::iota(set_.begin(), set_.end(), Eigen::Index{0});
  }

  /// Adds the best columns one by one, then exchanges each as long as that helps. False: there are not so many.
  bool choose(std::size_t count) {
    while (set_.size() < static_cast<std::size_t>(loop_.free) + count) {
      set_.push_back(-1);
      if (!exchange(set_.size() - 1)) return false;
    }
    constexpr int most_rounds = 20;
    bool is_better = true;
    for (int round = 0; round < most_rounds && is_better; ++round) {
      is_better = false;
      for (auto k = static_cast<std::size_t>(loop_.free); k < set_.size(); ++k) is_better |= exchange(k);
    }
    return true;
  }

  /// Numbers and coefficients of the columns that were chosen, in ascending order.
  [[nodiscard]] Chosen chosen() const { return chosen(set_); }

  /// The choices in which one column after the other is replaced by two beside it, as far as their coefficients are
  /// positive.
  [[nodiscard]] std::vector<Chosen> split() const {
    constexpr Eigen::Index beside = 2;
    std::vector<Chosen> all;
    for (auto k = static_cast<std::size_t>(loop_.free); k < set_.size(); ++k) {
      std::vector<Eigen::Index> both = set_;
      both[k] -= beside;
      both.push_back(set_[k] + beside);
      const bool is_inside = both[k] >= loop_.free && both.back() < loop_.with.size();
      const bool is_new = std::ranges::count(both, both[k]) == 1 && std::ranges::count(both, both.back()) == 1;
      if (is_inside && is_new && gain(both) > 0.0) all.push_back(chosen(both));
    }
    return all;
  }

 private:
  [[nodiscard]] Chosen chosen(const std::vector<Eigen::Index>& set) const {
    const Eigen::VectorXd factors = solution(set);
    Chosen list;
    for (auto k = static_cast<std::size_t>(loop_.free); k < set.size(); ++k)
      list.emplace_back(set[k] - loop_.free, factors[static_cast<Eigen::Index>(k)]);
    std::ranges::sort(list);
    return list;
  }

  [[nodiscard]] Eigen::VectorXd solution(const std::vector<Eigen::Index>& set) const {
    return DefiniteMatrix(loop_.products(set, set)).solve(loop_.with(set));
  }

  /// What the best factors take away of the sum of squares; -1 if a stiffness is not positive.
  [[nodiscard]] double gain(const std::vector<Eigen::Index>& set) const {
    const Eigen::VectorXd factors = solution(set);
    const auto free = loop_.free;
    if (!factors.allFinite() || !(factors.tail(factors.size() - free).array() > 0.0).all()) return -1.0;
    return factors.dot(loop_.with(set));
  }

  bool exchange(std::size_t k) {
    std::vector<Eigen::Index> trial = set_;
    double best = set_[k] < 0 ? -0.5 : gain(set_);
    bool is_better = false;
    for (Eigen::Index column = loop_.free; column < loop_.with.size(); ++column) {
      if (std::ranges::find(set_, column) != set_.end()) continue;
      trial[k] = column;
      if (const double found = gain(trial); found > best) best = found, set_[k] = column, is_better = true;
    }
    return is_better;
  }

  const LinearLoop& loop_;
  std::vector<Eigen::Index> set_;
};

/// Predicts all loops, one below the other. Nothing if a model has no motion.
std::optional<Eigen::VectorXd> predicted(const sim::Model& model, const std::vector<const Experiment*>& loops) {
  std::vector<double> all;
  for (const Experiment* loop : loops) {
    Eigen::VectorXd part;
    if (!loop->predict(model, loop->record_start, part)) return std::nullopt;
    all.insert(all.end(), part.begin(), part.end());
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

sim::Model without_rig() {
  sim::Model model;
  model.oscillator = {.mass = unknown, .stiffness = unknown, .damping = unknown};
  return model;
}

/// Slip distances of the columns, from a small part of the motion to all of it [m].
std::vector<double> slip_distances(double length) {
  constexpr double least = 3e-3;
  constexpr double most = 2.0;
  constexpr double factor = 1.2;
  std::vector<double> list;
  for (double d = least * length; d < most * length; d *= factor) list.push_back(d);
  return list;
}

/// Nothing if a motion cannot be computed.
std::optional<LinearLoop> linear_loop(const Rig& rig, const std::vector<FitParameter>& parameters,
                                      const std::vector<const Experiment*>& loops,
                                      const std::vector<double>& distances) {
  sim::Model known = rig.known;
  std::vector<sim::Model> models;
  for (const FitParameter& parameter : parameters) {
    sim::Model one = without_rig();
    const auto seek = [&](double sim::Oscillator::* member) {
      known.oscillator.*member = unknown;
      one.oscillator.*member = 1.0;
      models.push_back(one);
    };
    if (parameter.owner == Owner::mass) seek(&sim::Oscillator::mass);
    if (parameter.owner == Owner::stiffness) seek(&sim::Oscillator::stiffness);
    if (parameter.owner == Owner::damping) seek(&sim::Oscillator::damping);
  }
  LinearLoop result{.free = static_cast<Eigen::Index>(models.size())};
  for (const double distance : distances) {
    models.push_back(without_rig());
    models.back().friction.emplace_back(friction::Iwan({{1.0, distance}}));
  }
  const std::optional<Eigen::VectorXd> base = predicted(known, loops);
  if (!base) return std::nullopt;
  Eigen::MatrixXd columns(base->size(), static_cast<Eigen::Index>(models.size()));
  for (std::size_t k = 0; k < models.size(); ++k) {
    const std::optional<Eigen::VectorXd> column = predicted(models[k], loops);
    if (!column) return std::nullopt;
    columns.col(static_cast<Eigen::Index>(k)) = *column;
  }
  Eigen::VectorXd force = -*base;
  Eigen::Index row = 0;
  for (const Experiment* loop : loops)
    for (const double measured : loop->signals.front().measured) force[row++] += measured;
  result.products = gram(columns);
  result.with = columns.transpose() * force;
  return result;
}

}  // namespace

std::vector<ParallelElements> ParallelElements::of(const Rig& rig, const std::vector<FitParameter>& parameters,
                                                   const Experiments& experiments) {
  std::vector<ParallelElements> all;
  for (std::size_t l = 0; l < rig.laws.size(); ++l)
    for (const friction::Parameter& list : rig.laws[l].entry->parameters) {
      if (list.kind != friction::ParameterKind::list || !rig.laws[l].values.has(list.name)) continue;
      ParallelElements found;
      found.law_ = l;
      const std::size_t count = rig.laws[l].values.list(list.name).size();
      for (std::size_t i = 0; i < count; ++i) {
        const std::string item = std::string(list.name) + "[" + std::to_string(i) + "].";
        if (const auto k = find_path(parameters, l, item + "stiffness")) found.stiffness_.push_back(*k);
        if (const auto f = find_path(parameters, l, item + "limit")) found.limits_.push_back(*f);
        if (const auto share = find_path(parameters, l, item + "share")) {
          found.are_shares_ = true;
          found.limits_.push_back(*share);
        }
      }
      found.are_shares_ |= count == 1 && found.limits_.empty();
      if (found.stiffness_.size() != count || found.limits_.size() + (found.are_shares_ ? 1 : 0) != count) continue;
      if (!have_equal_ranges(parameters, found.stiffness_) ||
          (!found.limits_.empty() && !have_equal_ranges(parameters, found.limits_)))
        continue;
      found.kinetic_ = find_path(parameters, l, "kinetic");
      found.static_ = find_path(parameters, l, "static");
      found.look_at(rig, parameters, experiments);
      all.push_back(std::move(found));
    }
  return all;
}

void ParallelElements::look_at(const Rig& rig, const std::vector<FitParameter>& parameters,
                               const Experiments& experiments) {
  std::vector<const Experiment*> loops;
  double length = 0.0;
  for (const auto& experiment : experiments)
    if (experiment->kind == ExperimentKind::loop && experiment->motion) {
      loops.push_back(experiment.get());
      length = std::max(length, experiment->motion->length);
    }
  if (loops.empty() || rig.laws.size() > 1 || !(length > 0.0)) return;
  const std::vector<double> distances = slip_distances(length);
  const std::optional<LinearLoop> loop = linear_loop(rig, parameters, loops, distances);
  if (!loop || !loop->products.allFinite()) return;
  const std::size_t count = stiffness_.size();
  std::vector<Chosen> all;
  if (BestColumns best(*loop); best.choose(count)) all.push_back(best.chosen());
  // An element may stand for what the law has beside its elements, and another one for two of them.
  if (BestColumns fewer(*loop); count > 1 && fewer.choose(count - 1))
    for (Chosen& split : fewer.split()) all.push_back(std::move(split));
  for (const Chosen& chosen : all) {
    found_.emplace_back();
    for (const auto& [number, stiffness] : chosen)
      found_.back().push_back({stiffness, stiffness * distances[static_cast<std::size_t>(number)]});
  }
}

std::vector<ParallelElements::Element> ParallelElements::elements(const Eigen::VectorXd& values) const {
  std::vector<Element> list;
  double left = 1.0;
  for (std::size_t i = 0; i < stiffness_.size(); ++i) {
    const double limit = i < limits_.size() ? values[static_cast<Eigen::Index>(limits_[i])] : left;
    list.push_back({values[static_cast<Eigen::Index>(stiffness_[i])], limit});
    left -= limit;
  }
  return list;
}

void ParallelElements::set(const std::vector<Element>& elements, Eigen::VectorXd& values) const {
  for (std::size_t i = 0; i < stiffness_.size(); ++i)
    values[static_cast<Eigen::Index>(stiffness_[i])] = elements[i].stiffness;
  for (std::size_t i = 0; i < limits_.size(); ++i)
    values[static_cast<Eigen::Index>(limits_[i])] = elements[i].limit;
}

void ParallelElements::set_found(const std::vector<Element>& found, Eigen::VectorXd& values) const {
  if (!are_shares_) return set(found, values);
  const double level = std::accumulate(found.begin(), found.end(), 0.0,
                                       [](double sum, const Element& element) { return sum + element.limit; });
  std::vector<Element> shared = found;
  for (Element& element : shared) element.limit /= level;
  set(shared, values);
  if (!kinetic_) return;
  // The level of the data lies between those at rest and in fast motion.
  double& kinetic = values[static_cast<Eigen::Index>(*kinetic_)];
  const double ratio = static_ ? values[static_cast<Eigen::Index>(*static_)] / kinetic : 1.0;
  kinetic = level / std::sqrt(ratio);
  if (static_) values[static_cast<Eigen::Index>(*static_)] = ratio * kinetic;
}

std::size_t ParallelElements::kind(int number) const {
  return number == 0 || found_.empty() ? 0 : 1 + static_cast<std::size_t>(number - 1) % found_.size();
}

void ParallelElements::begin(Eigen::VectorXd& values, int number) const {
  if (number > 0 && !found_.empty()) return set_found(found_[kind(number) - 1], values);
  std::vector<Element> list = elements(values);
  if (are_shares_ && !(list.back().limit > 0.0)) {
    // Shares that were drawn one by one leave nothing for the last one: it gets as much as the others have in the
    // mean.
    const double sum = 1.0 - list.back().limit;
    const double whole = sum * (1.0 + 1.0 / static_cast<double>(list.size() - 1));
    for (Element& element : list) element.limit /= whole;
    list.back().limit = sum / whole / static_cast<double>(list.size() - 1);
    set(list, values);
  }
  constexpr double alike = 1e-6;
  const auto is_like_first = [&](const Element& other) {
    return std::abs(other.stiffness - list.front().stiffness) <= alike * list.front().stiffness &&
           std::abs(other.limit - list.front().limit) <= alike * list.front().limit;
  };
  if (list.size() < 2 || !std::ranges::all_of(list, is_like_first)) return;
  const double middle = 0.5 * static_cast<double>(list.size() - 1);
  for (std::size_t i = 0; i < list.size(); ++i) list[i].stiffness *= std::exp2(middle - static_cast<double>(i));
  set(list, values);
}

void ParallelElements::sort(Eigen::VectorXd& values) const {
  std::vector<Element> list = elements(values);
  std::ranges::stable_sort(list, {}, [](const Element& element) { return element.limit / element.stiffness; });
  set(list, values);
}

}  // namespace dualdamp::identify
