#include "identify/experiments/experiment.hpp"

#include <algorithm>

namespace dualdamp::identify {

namespace {

class Alike final : public Neighbours {
 public:
  explicit Alike(const Experiment& experiment) : experiment_(experiment) {}
  [[nodiscard]] bool predict(const sim::Model& model, const RecordValues& of_record, double /*share*/,
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

std::unique_ptr<Experiment> Experiment::balanced() const { return nullptr; }

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
  return {.name = name_of(which) + (is_alone ? std::string() : "[" + std::to_string(index) + "]"),
          .unit = unit_of(which),
          .owner = Owner::record,
          .index = index,
          .record_parameter = which,
          .stated = experiment.record_start[which]};
}

std::vector<RecordParameter> sought_of_record(const Experiment& experiment, bool feels_position) {
  std::vector<RecordParameter> sought = experiment.record_free;
  for (const RecordParameter each : experiment.record_of_place)
    if (feels_position && std::ranges::find(sought, each) == sought.end()) sought.push_back(each);
  return sought;
}

Experiments experiments_of(const Record& record, const ExperimentOptions& options, std::string& fault) {
  Experiments found;
  const auto add = [&](const std::string& part, const auto& make) {
    std::string reason;
    std::unique_ptr<Experiment> made = make(reason);
    if (made == nullptr) {
      fault += (fault.empty() ? "" : "; ") + (part.empty() ? "" : part + ": ") + reason;
      return;
    }
    made->label = options.name + (part.empty() ? "" : ", " + part);
    found.push_back(std::move(made));
  };
  if (options.loop && record.histories.empty()) {
    fault = "a loop needs the columns t, force, and x or v";
    return found;
  }
  if (record.pairs) add("", [&](std::string& reason) { return steady_states(*record.pairs, options, reason); });
  if (record.decay) add("", [&](std::string& reason) { return free_vibration(*record.decay, options, reason); });
  for (std::size_t h = 0; h < record.histories.size(); ++h) {
    const History& history = record.histories[h];
    add(history.sweep, [&](std::string& reason) {
      if (options.loop) return friction_loop(history, options, reason);
      std::unique_ptr<Experiment> made = motion(history, options, reason);
      if (made != nullptr && h < options.drives.size()) made->drive = options.drives[h];
      return made;
    });
  }
  if (found.empty() && fault.empty()) fault = "the record is empty";
  return found;
}

}  // namespace dualdamp::identify
