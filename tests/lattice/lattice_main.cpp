// Runs random lattice scenes in one process: kds_lattice_scenes [SCENES] [FIRST SEED]. Prints the first
// failure of each seed. Exits with 1 if any scene fails.

#include <cstdio>
#include <cstdlib>

#include "tests/lattice/run_lattice_scenes.h"

int main(int count, char** arguments) {
  const std::uint64_t scenes = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 10000;
  auto seed = static_cast<std::uint32_t>(count > 2 ? std::strtoul(arguments[2], nullptr, 10) : 1);
  kds::test::LatticeCounts counts;
  int failures = 0;
  for (; counts.scenes < scenes; ++seed) {
    if (const auto failure = run_lattice_scenes(seed, counts)) {
      std::printf("%s\n", failure->c_str());
      ++failures;
    }
  }
  std::printf(
      "%llu scenes, %llu events, %llu scenes with a rebuild, %llu with edits, %llu refused as flat, %d seeds "
      "failed\n",
      static_cast<unsigned long long>(counts.scenes), static_cast<unsigned long long>(counts.events),
      static_cast<unsigned long long>(counts.rebuilt), static_cast<unsigned long long>(counts.edited),
      static_cast<unsigned long long>(counts.refused), failures);
  return failures == 0 ? 0 : 1;
}
