#include "tests/fuzz/kernel_targets.h"

#include <algorithm>
#include <cmath>

#include "kds/event_log.h"
#include "motions/base/input_error.h"
#include "tests/laws/law_run.h"
#include "tests/support/judges/contact_events.h"
#include "tests/support/judges/crossings.h"

namespace kds::test {

namespace {

/// Runs the scene plainly, then with this kernel and these audits, and compares both runs.
std::optional<std::string> compare(const SmallScene& small, Kernel kernel, AuditMode audits) {
  const Scene scene = make_scene(small);
  const LawStructure& row = small.structure;
  if (scene.bead_count() > row.most_beads || !is_accepted(scene, row)) return std::nullopt;
  const Outcome plain = run_scene(scene, row, Kernel::filtered, AuditMode::none, false, most_work);
  if (plain.failed) return plain.ending;
  const Outcome other = run_scene(scene, row, kernel, audits, true, most_work);
  if (other.failed) return other.ending;
  if (!plain.is_decided() || !other.is_decided()) return std::nullopt;
  return difference(other, plain);
}

std::optional<std::string> fault_of_contacts(const SmallScene& small) {
  const Scene scene = make_scene(small);
  std::vector<Space> steps(small.place_count() - 1, Space(small.beads.size()));
  for (std::size_t step = 0; step < steps.size(); ++step)
    for (BeadId b = 0; b < small.beads.size(); ++b)
      for (int k = 0; k < 2; ++k) {
        for (int axis = 0; axis < 3; ++axis)
          steps[step].set_coordinate(
              b, k, axis,
              small.beads[b].places[step + static_cast<std::size_t>(k)][static_cast<std::size_t>(axis)]);
        steps[step].set_radius(b, k, small.beads[b].radius);
      }
  KineticRun run(scene, {{"contacts"}});
  run.limit_work(most_work);
  History history;
  run.listen(history);
  const auto pairs = [&] {
    const auto layers = run.running(0).replay_elements(false);
    std::vector<BeadPair> found;
    for (const ReplayElement& pair : layers[0]) found.push_back({pair[0], pair[1]});
    std::sort(found.begin(), found.end());
    return found;
  };
  run.build();
  const std::vector<BeadPair> at_start = pairs();
  run.run();
  return contact_history_fault(steps, {scene.necklaces()}, history, at_start, pairs());
}

std::optional<std::string> fault_of_crossings(const SmallScene& small) {
  const Scene scene = make_scene(small);
  WholeFrames frames(small.place_count());
  for (const auto& bead : small.beads)
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const auto& place = bead.places[k];
      frames[k].push_back(
          {static_cast<int>(place[0]), static_cast<int>(place[1]), static_cast<int>(place[2])});
    }
  KineticRun run(scene, {{"crossings"}});
  run.limit_work(most_work);
  EventLog log;
  run.listen(log);
  run.run();
  return crossings_fault(frames, scene.bonds(), log.events);
}

}  // namespace

const std::vector<FuzzTarget>& fuzz_targets() {
  static const std::vector<FuzzTarget> targets{
      {"kernels", Values::wild, "",
       [](const SmallScene& small) { return compare(small, Kernel::exact, AuditMode::none); }},
      {"audits", Values::mild, "",
       [](const SmallScene& small) { return compare(small, Kernel::filtered, AuditMode::events); }},
      {"contacts", Values::mild, "contacts", fault_of_contacts},
      {"crossings", Values::whole, "crossings", fault_of_crossings},
  };
  return targets;
}

std::optional<std::string> FuzzTarget::fault_of(const SmallScene& scene) const {
  try {
    return judge(scene);
  } catch (const InputError&) {  // input beyond a stated limit
    return std::nullopt;
  } catch (const WorkLimitReached&) {
    return std::nullopt;
  } catch (const std::exception& error) {
    return error.what();
  }
}

const FuzzTarget* find_target(std::string_view name) {
  const auto found = std::ranges::find(fuzz_targets(), name, &FuzzTarget::name);
  return found == fuzz_targets().end() ? nullptr : &*found;
}

}  // namespace kds::test
