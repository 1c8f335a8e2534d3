#pragma once
/// Writes the entries of a ledger from the tests of a joint model (`relaxation_tests.hpp`): it charges departures
/// to assumptions, and says of each assumption why it holds, is violated or is untested.

#include <array>
#include <string>

#include "identify/ledger/estimate/relative_changes.hpp"
#include "identify/ledger/estimate/stated_shares.hpp"
#include "identify/ledger/joint_model.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/ledger/relaxation_tests.hpp"

namespace dualdamp::identify {

class LedgerWriter {
 public:
  /// The arguments must outlive this.
  LedgerWriter(const JointModel& model, const RelaxationTests& tests, const KnownConstants& stated,
               const StatedShares& shares, const LedgerOptions& options)
      : model_(model),
        tests_(tests),
        stated_(stated),
        shares_(shares),
        options_(options),
        scale_(model, tests.freedom) {}

  /// Charges the departures to assumptions, then states for each other assumption whether it holds or is untested.
  void write(Ledger& ledger);
  /// States for each assumption that holds how large a departure must be to be seen. A test that would see only
  /// huge departures does not count as a test, nor does one of few states that would miss 10 %.
  void add_sight(Ledger& ledger) const;
  /// Where the model misses the record, no assumption is known to hold.
  void withdraw(const Misfit& misfit, Ledger& ledger) const;

 private:
  /// What is judged of a departure as a whole.
  struct Judgement {
    bool is_as_stated = false;   ///< the stated uncertainties allow it
    bool drift_matters = false;  ///< terms of speed have few forms: the drift shows what another form would move
  };

  [[nodiscard]] Assumption assumption_of(const RelaxationTest& test) const;
  void set(const RelaxationTest& test, LedgerEntry& entry) const;
  [[nodiscard]] double unevenness(const RelaxationTest& test) const;
  [[nodiscard]] bool is_uneven(const RelaxationTest& test) const;
  [[nodiscard]] bool matters(const RelaxationTest& test) const;
  [[nodiscard]] Judgement judge(const FoundDeparture& departure) const;
  [[nodiscard]] bool harms(const Judgement& judgement, const RelaxationTest& test) const;
  void charge(const FoundDeparture& departure, Ledger& ledger) const;
  [[nodiscard]] std::string reason_of(const FoundDeparture& departure, const Judgement& judgement,
                                      const RelaxationTest& test) const;
  [[nodiscard]] std::string size_of_unevenness(const RelaxationTest& test) const;
  [[nodiscard]] std::string wanted_constants(const FoundDeparture& departure) const;
  [[nodiscard]] std::string constants_of_joint(const FoundDeparture& departure) const;
  void join_constants(const FoundDeparture& seen, Ledger& ledger) const;
  [[nodiscard]] bool is_as_stated(const RelaxationTest& test) const;
  [[nodiscard]] std::string alternatives(const FoundDeparture& departure, const RelaxationTest& own) const;
  [[nodiscard]] std::string other_forms(const FoundDeparture& departure, const RelaxationTest& own) const;
  void record_as_held(const RelaxationTest& test, Ledger& ledger);
  void charge_unexplained(Ledger& ledger) const;
  [[nodiscard]] std::string harmless() const;
  [[nodiscard]] static std::string about_drive(const Ledger& ledger);
  [[nodiscard]] bool is_taken_from_record(Assumption assumption) const;
  void explain(const Ledger& ledger, LedgerEntry& entry) const;

  const JointModel& model_;
  const RelaxationTests& tests_;
  const KnownConstants& stated_;
  const StatedShares& shares_;
  const LedgerOptions& options_;
  RelativeChanges scale_;
  std::array<double, assumption_count> blind_ = [] {
    std::array<double, assumption_count> none{};
    none.fill(unknown);
    return none;
  }();
};

}  // namespace dualdamp::identify
