#include "experiments/run/replay_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "experiments/program/warnings.h"
#include "experiments/run/event_log_file.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/parse_run_options.h"
#include "experiments/run/report_of_session.h"
#include "kds/audit.h"
#include "motions/base/input_error.h"
#include "structures/session/session.h"

namespace kds {

namespace {

Change change_of(const EventLog::Entry& entry, const KineticStructure& structure, const std::string& where) {
  const auto kinds = structure.kinds();
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const EventKind& k) { return k.name == entry.kind; });
  if (kind == kinds.end())
    throw InputError(fmt::format("{}: {} has no events of kind '{}'", where, entry.structure, entry.kind));
  Change change{
      static_cast<std::uint8_t>(kind - kinds.begin()), static_cast<std::uint8_t>(entry.ids.size()), {}};
  if (entry.ids.size() > change.ids.size()) throw InputError(fmt::format("{}: too many beads", where));
  std::copy(entry.ids.begin(), entry.ids.end(), change.ids.begin());
  return change;
}

RunOptions options_of(const EventLog& log, const std::filesystem::path& path) {
  const std::string where = path.string() + ":2: the run's arguments: ";
  try {
    return parse_run_options(log.arguments);
  } catch (const InputError& error) {
    throw InputError(where + error.what());
  } catch (const HelpRequest&) {
    throw InputError(where + "they ask for help, not for a run");
  }
}

}  // namespace

ReplayReport replay_log(const std::filesystem::path& path, const Progress& progress,
                        const std::function<void(const std::string&)>& warn) {
  const EventLog log = read_event_log(path);
  const RunOptions options = options_of(log, path);
  HeldWarnings warnings;
  const Scene scene = load_scene(options, warnings.hold());
  if (scene.bead_count() != log.beads || scene.step_count() != log.steps) {
    throw InputError(fmt::format("{}: the inputs have {} beads and {} steps, the log tells of {} and {}",
                                 path.string(), scene.bead_count(), scene.step_count(), log.beads,
                                 log.steps));
  }
  // Only the changes are made again: no certificate, no failure time. Frames are audited, unless the run
  // itself promised nothing.
  const AuditMode audits = options.kernel == Kernel::fast ? AuditMode::none : AuditMode::frames;
  const auto session = open_session(options, scene, audits);
  session->load(0);
  Simulator& simulator = session->simulator();
  const auto& structures = session->structures();

  std::vector<std::vector<Simulator::Replayed>> steps(scene.step_count());
  for (const EventLog::Entry& entry : log.entries) {
    const std::string where = fmt::format("{}:{}", path.string(), entry.line);
    const auto structure = std::find_if(structures.begin(), structures.end(),
                                        [&](auto* s) { return s->name() == entry.structure; });
    if (structure == structures.end())
      throw InputError(fmt::format("{}: the run had no structure '{}'", where, entry.structure));
    if (entry.step >= steps.size())
      throw InputError(fmt::format("{}: step {} of {}", where, entry.step, steps.size()));
    auto& step = steps[entry.step];
    if (!step.empty() && entry.upper < step.back().lower)
      throw InputError(fmt::format("{}: before the event above it", where));
    step.push_back({static_cast<std::size_t>(structure - structures.begin()), entry.lower, entry.upper,
                    change_of(entry, **structure, where), where});
  }

  simulator.build_for_replay();
  warnings.release(warn);
  for (std::size_t step = 0; step < steps.size(); ++step) {
    session->load(step);
    try {
      simulator.replay_step(steps[step]);
    } catch (const std::logic_error& reason) {  // changes that do not fit
      throw InputError(reason.what());
    } catch (const AuditError& error) {
      throw InputError(
          fmt::format("{}: its events do not lead to the right structures: {}", path.string(), error.what()));
    }
    progress(step + 1, steps.size());
  }
  return {report_of(*session, scene, options), log.fingerprint, log.entries.size()};
}

}  // namespace kds
