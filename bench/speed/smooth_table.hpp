#pragma once
/// The smooth engine compared with CVODE at equal error.

namespace dualdamp::bench::speed {

/// Times one forcing period of every smooth case at an error of 1e-8 or less, both with the fastest of their
/// settings that reach this error, and prints the table; then the targets of the smooth engine.
void print_smooth_table(int batches);

}  // namespace dualdamp::bench::speed
