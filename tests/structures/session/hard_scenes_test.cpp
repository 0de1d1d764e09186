// Small scenes that are difficult for exact arithmetic. Each run ends, at the latest at the work limit, and
// both kernels give the same result. By default a few dozen scenes run; with KDS_ALL_HARD_SCENES=1 in
// the environment all 500 and 1000 run.

#include "tests/support/inputs/hard_scenes.h"
#include "tests/support/rounds.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

#include "motions/base/input_error.h"
#include "structures/session/kinetic_run.h"

namespace kds::hard_scenes_test {
namespace {

using namespace test;

std::uint64_t some_of(std::uint64_t all, std::uint64_t few) {
  const char* wanted = std::getenv("KDS_ALL_HARD_SCENES");
  return wanted != nullptr && std::string_view(wanted) == "1" ? all : few;
}

constexpr std::string_view limit = "limit";

struct Outcome {
  std::string ending;  // "done", "limit", or the message of a refusal
  std::uint64_t fingerprint = 0;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};
std::ostream& operator<<(std::ostream& out, const Outcome& outcome) {
  return out << outcome.ending << " " << outcome.fingerprint;
}

Outcome run(const Scene& scene, const std::vector<std::string>& structures, Kernel kernel) {
  KineticRunOptions options;
  options.structures = structures;
  options.kernel = kernel;
  try {
    KineticRun run(scene, options);
    run.limit_work(100'000'000);
    run.finish();
    return {"done", run.simulator().fingerprint()};
  } catch (const InputError& refusal) {  // input beyond a stated limit
    return {refusal.what()};
  } catch (const WorkLimitReached&) {
    return {std::string(limit)};
  }
}

// Scenes whose events are too close together are refused, by both kernels alike.
void expect_kernels_agree(const Scene& scene, const std::vector<std::string>& structures, bool with_exact,
                          int& done) {
  const Outcome filtered = run(scene, structures, Kernel::filtered);
  if (with_exact && filtered.ending != limit) {
    const Outcome exact = run(scene, structures, Kernel::exact);
    if (exact.ending != limit) {
      EXPECT_EQ(exact, filtered);
    }
  }
  done += filtered.ending == "done" ? 1 : 0;
}

TEST(HardScenes, OfWildRange) {
  const std::uint64_t count = some_of(500, test::rounds(10U));
  int done = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("wild scene of seed " + std::to_string(seed));
    const bool with_exact = count == 500 || seed % 5 == 0;
    expect_kernels_agree(Scene(wild_instance(seed)), {"power"}, with_exact, done);
  }
  EXPECT_GT(done, static_cast<int>(count / 2));
}

TEST(HardScenes, OfBallsOnALatticeInHermiteMotion) {
  const std::uint64_t count = some_of(1000, test::rounds(25U));
  int done = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const LatticeScene lattice = lattice_scene(seed);
    SCOPED_TRACE(lattice.necklace.file);
    const Scene scene(std::span(&lattice.necklace, 1), lattice.radii, FrameMotion::hermite);
    // Integers alone take a second per scene.
    const bool with_exact = count == 1000 || seed % 5 == 0;
    expect_kernels_agree(scene, {seed % 2 == 0 ? "wrapped" : "power"}, with_exact, done);
  }
  EXPECT_EQ(done, static_cast<int>(count));
}

}  // namespace
}  // namespace kds::hard_scenes_test
