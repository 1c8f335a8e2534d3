#include "identify/experiments/experiment.hpp"

#include <algorithm>

namespace dualdamp::identify {

namespace {

class Alike final : public Neighbours {
 public:
  explicit Alike(const Experiment& experiment) : experiment_(experiment) {}
  [[nodiscard]] bool predict(const sim::Model& model, const RecordValues& of_record,
                             Eigen::VectorXd& outputs) const override {
    return experiment_.predict(model, of_record, outputs);
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

std::vector<std::string> Experiment::objections(const sim::Model& /*model*/,
                                                const RecordValues& /*of_record*/) const {
  return {};
}

std::unique_ptr<Neighbours> Experiment::neighbours(const sim::Model& model, const RecordValues& of_record,
                                                   const Neighbours* /*near*/, Eigen::VectorXd& outputs) const {
  if (!predict(model, of_record, outputs)) return nullptr;
  return std::make_unique<Alike>(*this);
}

FitParameter parameter_of_record(const Experiment& experiment, std::size_t index, RecordParameter which,
                                 bool is_alone) {
  static constexpr std::array<const char*, record_parameter_count> units = {"m",   "m/s",   "m", "s",
                                                                            "m/s", "m/s^2", "m"};
  const auto at = static_cast<std::size_t>(which);
  return {.name = std::string(record_parameter_names[at]) +
                  (is_alone ? std::string() : "[" + std::to_string(index) + "]"),
          .unit = units[at],
          .owner = Owner::record,
          .index = index,
          .record_parameter = which,
          .stated = experiment.record_start[at]};
}

std::vector<RecordParameter> sought_of_record(const Experiment& experiment, bool feels_place) {
  std::vector<RecordParameter> sought = experiment.record_free;
  for (const RecordParameter each : experiment.record_of_place)
    if (feels_place && std::ranges::find(sought, each) == sought.end()) sought.push_back(each);
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
