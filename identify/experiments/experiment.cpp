#include "identify/experiments/experiment.hpp"

#include <algorithm>

namespace dualdamp::identify {

namespace {

class Alike final : public Neighbours {
 public:
  explicit Alike(const Experiment& experiment) : experiment_(experiment) {}
  [[nodiscard]] bool predict(const sim::Model& model, const OwnValues& own,
                             Eigen::VectorXd& outputs) const override {
    return experiment_.predict(model, own, outputs);
  }

 private:
  const Experiment& experiment_;
};

}  // namespace

Eigen::Index Experiment::size() const {
  Eigen::Index count = 0;
  for (const Signal& signal : signals) count += static_cast<Eigen::Index>(signal.measured.size());
  return count;
}

std::unique_ptr<Experiment> Experiment::first_part(double /*share*/) const { return nullptr; }

std::unique_ptr<Experiment> Experiment::thinned() const { return nullptr; }

std::unique_ptr<Experiment> Experiment::tied(double /*strength*/) const { return nullptr; }

std::vector<std::string> Experiment::objections(const sim::Model& /*model*/, const OwnValues& /*own*/) const {
  return {};
}

std::unique_ptr<Neighbours> Experiment::neighbours(const sim::Model& model, const OwnValues& own,
                                                   const Neighbours* /*near*/, Eigen::VectorXd& outputs) const {
  if (!predict(model, own, outputs)) return nullptr;
  return std::make_unique<Alike>(*this);
}

FitParameter own_parameter(const Experiment& experiment, std::size_t index, Own own, bool is_alone) {
  static constexpr std::array<const char*, own_count> units = {"m", "m/s", "m", "s", "m/s", "m/s^2", "m"};
  const auto at = static_cast<std::size_t>(own);
  return {.name = std::string(own_names[at]) + (is_alone ? std::string() : "[" + std::to_string(index) + "]"),
          .unit = units[at],
          .owner = Owner::record,
          .index = index,
          .own = own,
          .stated = experiment.own_start[at]};
}

std::vector<Own> sought_own(const Experiment& experiment, bool feels_place) {
  std::vector<Own> sought = experiment.own_free;
  for (const Own own : experiment.own_of_place)
    if (feels_place && std::ranges::find(sought, own) == sought.end()) sought.push_back(own);
  return sought;
}

std::vector<std::unique_ptr<Experiment>> experiments_of(const Record& record, const ExperimentOptions& options,
                                                        std::string& fault) {
  std::vector<std::unique_ptr<Experiment>> found;
  const auto add = [&](std::unique_ptr<Experiment> experiment, const std::string& part) {
    if (experiment == nullptr) return;
    experiment->label = options.name + (part.empty() ? "" : ", " + part);
    found.push_back(std::move(experiment));
  };
  if (options.loop && record.histories.empty()) {
    fault = "a loop needs the columns t, force, and x or v";
    return found;
  }
  if (record.pairs) add(steady_states(*record.pairs, options, fault), "");
  if (record.decay) add(free_vibration(*record.decay, options, fault), "");
  for (std::size_t h = 0; h < record.histories.size(); ++h) {
    const History& history = record.histories[h];
    std::unique_ptr<Experiment> made =
        options.loop ? friction_loop(history, options, fault) : motion(history, options, fault);
    if (made != nullptr && !options.loop && h < options.drives.size()) made->drive = options.drives[h];
    add(std::move(made), history.sweep);
  }
  if (found.empty() && fault.empty()) fault = "the record is empty";
  return found;
}

}  // namespace dualdamp::identify
