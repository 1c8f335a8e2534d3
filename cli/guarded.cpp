#include "cli/guarded.hpp"

#include <exception>
#include <new>
#include <system_error>

#include "core/build_info.hpp"
#include "friction_models/law_fault.hpp"
#include "scenarios/output.hpp"

namespace dualdamp::cli {

using core::ExitStatus;

CommandOutput refused(ExitStatus status, const std::vector<core::Diagnostic>& problems) {
  CommandOutput output;
  output.status = status;
  output.json = scenarios::json_refusal(status, problems);
  for (const core::Diagnostic& problem : problems) output.errors += core::format(problem) + "\n";
  return output;
}

CommandOutput refused(ExitStatus status, const std::string& message) {
  return refused(status, {core::Diagnostic{{}, message, {}, {}, {}}});
}

namespace {

/// The output about a bug of the program, with the commit of the program.
CommandOutput bug(const std::string& what) {
  return refused(ExitStatus::internal_bug, "this is a bug of dualdamp " + std::string(core::build_info().version) +
                                               ": " + what +
                                               "; please report it with the scenario and the commit " +
                                               std::string(core::build_info().commit));
}

}  // namespace

CommandOutput guarded(const std::function<CommandOutput()>& work) {
  try {
    return work();
  } catch (const core::InputError& error) {
    return refused(ExitStatus::invalid_input, error.diagnostics());
  } catch (const scenarios::EarlierFiles& error) {
    return refused(ExitStatus::usage,
                   error.what() + std::string(error.may_resume() ? ": --resume goes on with them, " : ": ") +
                       "--overwrite begins anew, --out DIR keeps them apart");
  } catch (const scenarios::OutputError& error) {
    return refused(ExitStatus::usage, error.what());
  } catch (const std::bad_alloc&) {
    return refused(ExitStatus::usage, message_of_no_memory);
  } catch (const std::system_error& error) {
    return refused(ExitStatus::usage,
                   std::string("the system refused what the computation needs: ") + error.what());
  } catch (const friction::LawFault& fault) {
    return refused(ExitStatus::numerical_failure, fault.what());
  } catch (const std::exception& error) {
    return bug(error.what());
  }
}

}  // namespace dualdamp::cli
