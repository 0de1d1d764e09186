// The corpus of the fuzzer of kernels, and the minimizer on a structure whose audits fail.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "kds/simulator.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/fuzz/kernel_targets.h"
#include "tests/fuzz/minimize.h"
#include "tests/laws/law_run.h"
#include "tests/support/property_runs.h"
#include "tests/support/rounds.h"

namespace kds::fuzz_kernels_test {
namespace {

using namespace test;

/// Calls visit(target, bytes) for each file of the corpus.
template <class Visit>
void each_input(const Visit& visit) {
  for (const FuzzTarget& target : fuzz_targets()) {
    const std::filesystem::directory_iterator folder(data_file("../tests/fuzz/scenes/") +
                                                     std::string(target.name));
    std::vector<std::filesystem::path> files;
    for (const auto& file : folder) files.push_back(file.path());
    EXPECT_GT(files.size(), 5U) << target.name;
    std::ranges::sort(files);
    for (const auto& file : files) {
      SCOPED_TRACE(file);
      const std::string bytes = content_of(file);
      ASSERT_TRUE(bytes.size() > 0 && bytes.size() <= 400);
      visit(target, bytes);
    }
  }
}

TEST(FuzzKernels, CorpusHasNoFault) {
  each_input([](const FuzzTarget& target, const std::string& bytes) {
    const SmallScene scene = target.scene_of(bytes);
    EXPECT_EQ(target.fault_of(scene), std::nullopt) << scene.structure.title();
  });
}

// Changes bytes at random as libFuzzer does, but with every compiler, and blind to the branches that are
// taken.
TEST(FuzzKernels, ChangedInputsHaveNoFault) {
  std::mt19937_64 random(from_environment("KDS_FUZZ_SEED", 1));
  const std::uint64_t changes = rounds(from_environment("KDS_FUZZ_ROUNDS", 4));
  each_input([&](const FuzzTarget& target, const std::string& bytes) {
    for (std::uint64_t i = 0; i < changes; ++i) {
      std::string changed = bytes;
      for (std::uint64_t count = 1 + random() % 4; count > 0; --count)
        changed[random() % changed.size()] = static_cast<char>(random());
      const SmallScene scene = target.scene_of(changed);
      const auto fault = target.fault_of(scene);
      if (!fault) continue;
      const std::string name = fmt::format("{}-changed", target.name);
      std::ofstream(name, std::ios::binary) << changed;
      FAIL() << scene.structure.title() << ": " << *fault << "; kds_minimize " << target.name << " small "
             << name;
    }
  });
}

// Files that are written of a scene must have the run of the scene itself.
TEST(FuzzKernels, TheProgramRunsWhatIsWritten) {
  const ScratchDirectory scratch;
  int runs = 0;
  each_input([&](const FuzzTarget& target, const std::string& bytes) {
    if (target.name != "kernels") return;
    const SmallScene small = target.scene_of(bytes);
    std::vector<std::string> arguments = write_scene(small, (scratch / "scene").string());
    arguments.insert(arguments.end(), {"--json", "-"});
    Outcome outcome;
    note_ending(outcome, [&] {
      outcome =
          run_scene(make_scene(small), small.structure, Kernel::filtered, AuditMode::none, false, most_work);
    });
    if (!outcome.is_decided()) return;
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, outcome.ending == "done" ? 0 : 2) << run.err << outcome.ending;
    if (run.code != 0) return;
    ++runs;
    EXPECT_EQ(nlohmann::json::parse(run.out)["fingerprint"], fmt::format("{:016x}", outcome.fingerprint));
  });
  EXPECT_GT(runs, 5);
}

/// A structure that does nothing. Its audit fails if a bead is before one of a lower number along the first
/// axis, and was not so at the start of the step.
class Seeded final : public KineticStructure {
 public:
  template <int Dimension>
  Seeded(Simulator& simulator, const MotionRef<Dimension>& motion)
      : balls_([motion](const Dyadic& u) { return balls_at(motion.curves(), u); }) {
    static_cast<void>(simulator.add(*this));
  }
  [[nodiscard]] std::string_view name() const override { return "seeded"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override { return {}; }
  void build() override {}
  void start_step() override {}
  void fail(unsigned, std::uint32_t) override {}
  void apply(const Change&) override {}
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override {
    const ExactBalls start = balls_(Dyadic(0.0)), now = balls_(time);
    for (BeadId a = 0; a < now.centers.size(); ++a)
      for (BeadId b = a + 1; b < now.centers.size(); ++b)
        if (start.centers[a][0] < start.centers[b][0] && now.centers[b][0] < now.centers[a][0])
          return "two beads have changed their order";
    return std::nullopt;
  }

 private:
  std::function<ExactBalls(const Dyadic&)> balls_;
};

bool seeded_audit_fails(const SmallScene& small) {
  try {
    const Scene scene = make_scene(small);
    KineticRun run(scene, {{"sorted"}, Kernel::filtered, AuditMode::events});
    static_cast<void>(run.add<Seeded>());
    run.run();
  } catch (const InputError&) {
    return false;
  } catch (const AuditError&) {
    return true;
  }
  return false;
}

TEST(Minimizer, KeepsOnlyWhatTheFaultNeeds) {
  const ScratchDirectory scratch;
  std::mt19937 random(57);
  int instances = 0, frames = 0;
  while (instances < 10 || frames < 10) {
    std::string bytes(200, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    const SmallScene scene = find_target("kernels")->scene_of(bytes);
    if (!seeded_audit_fails(scene)) continue;
    ++(scene.of_frames ? frames : instances);
    const SmallScene small = minimized(scene, seeded_audit_fails);
    EXPECT_TRUE(seeded_audit_fails(small));
    EXPECT_EQ(small.beads.size(), 2U);
    EXPECT_EQ(small.place_count(), 2U);
    EXPECT_EQ(small.columns(), small.of_frames ? 3U : 1U);
    for (const auto& bead : small.beads)
      for (const auto& place : bead.places)
        for (std::size_t axis = 0; axis < place.size(); ++axis)
          EXPECT_TRUE(axis == 0 ? std::abs(place[axis]) <= 2 : place[axis] == 0) << place[axis];
    static_cast<void>(write_scene(small, (scratch / "small").string()));
    const SmallScene read = read_scene(scratch / (small.of_frames ? "small.0.xyz" : "small.txt"), 0);
    EXPECT_TRUE(seeded_audit_fails(read));
  }
}

TEST(Minimizer, RefusesWhatItDoesNotKnow) {
  const std::string instance = data_file("kinetic/d2_n20_linear.txt");
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"flips out FILE", "expected kernels, audits, contacts or crossings"},
           {"audits out", "then PREFIX INPUT or PREFIX FILE STRUCTURE"},
           {"audits out " + instance + " shells", "no structure 'shells'; expected one of: sorted, box"},
           {"audits out " + instance + " sorted wide", "expected a number as RADIUS, found 'wide'"},
           {"crossings out " + instance + " sorted", "crossings takes inputs of kds_fuzz_kernels only"},
           {"audits out missing.txt sorted", "missing.txt"}}) {
    const ProgramRun run = run_shell(KDS_MINIMIZE " " + arguments);
    EXPECT_EQ(run.code, 2) << arguments;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
  }
  const ProgramRun sound = run_shell(KDS_MINIMIZE " audits out " + instance + " sorted");
  EXPECT_EQ(sound.code, 1) << sound.err;
  EXPECT_EQ(sound.out, "no fault within the limit of exact work\n");
}

}  // namespace
}  // namespace kds::fuzz_kernels_test
