#include "cli/arguments.hpp"
#include "cli/interrupt.hpp"
#include "cli/isolation.hpp"

int main(int argc, char** argv) {
  const dualdamp::cli::Call call = dualdamp::cli::parse(argc, argv);
  if (call.isolation > 0.0) return dualdamp::cli::execute_isolated(call);
  dualdamp::cli::watch_for_interrupt();
  return dualdamp::cli::execute_to_its_end(call);
}
