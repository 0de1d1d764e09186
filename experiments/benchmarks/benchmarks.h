#pragma once
// The benchmarks of the program kds_benchmarks, a file each.

namespace kds::bench {

void add_engine_benchmarks();
void add_certificate_benchmarks();
void add_tolerance_benchmarks();

}  // namespace kds::bench
