// A library that is preloaded into the program and acts as a host with another rounding mode, or one that
// flushes subnormal numbers to zero. The environment variable KDS_HOST selects the environment (an index into
// host_environments). At exit the library checks that the environment is still set.

#include <unistd.h>

#include <cstdlib>

#include "tests/support/inputs/host_environment.h"

namespace {

const kds::test::HostEnvironment* host() {
  const char* place = std::getenv("KDS_HOST");
  return place == nullptr ? nullptr : &kds::test::host_environments.at(std::strtoul(place, nullptr, 10));
}

[[gnu::constructor]] void at_start() {
  if (host() != nullptr) kds::test::set(*host());
}

[[gnu::destructor]] void at_end() {
  if (host() != nullptr && !kds::test::is_set(*host())) ::_exit(99);
}

}  // namespace
