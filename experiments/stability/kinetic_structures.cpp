// Makes structures subjects of `kds stability`: a few beads, one step, each kernel, with audits between all
// events.

#include <fmt/format.h>

#include <optional>
#include <set>
#include <utility>

#include "experiments/program/timing.h"
#include "experiments/stability/stability.h"
#include "experiments/stability/stability_scenes.h"
#include "kds/event.h"
#include "motions/base/input_error.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/structure_spec.h"

namespace kds {
namespace {

/// Counts all events except rebuilds.
class Counter final : public EventListener {
 public:
  void on_event(const Event& event) override { events += event.kind.counted_apart ? 0 : 1; }

  std::uint64_t events = 0;
};

/// The outcome of a run, or the reason why it failed.
struct Outcome {
  std::string refusal, failure;
  bool failed_audit = false;
  std::uint64_t events = 0;
  std::uint64_t fingerprint = 0;
  StructureStatistics statistics;
  double seconds = 0;

  [[nodiscard]] std::string in_words() const {
    if (!refusal.empty()) return "refused: " + refusal;
    if (!failure.empty()) return "failed: " + failure;
    return fmt::format("{} events, {} rebuilds, fingerprint {:016x}", events, statistics.rebuilds,
                       fingerprint);
  }
};

/// A case made of points, or of balls if it has radii.
struct Case {
  std::size_t number;
  Instance instance;
  std::vector<double> radii;
};

/// A structure with the settings of its run.
struct Settled {
  std::string structure;
  StructureSettings settings;
};

Outcome outcome_of(const Case& one, const Settled& what, Kernel kernel, AuditMode audits) {
  Outcome outcome;
  try {
    const Scene scene(one.instance, one.radii);
    KineticRun run(scene, {{what.structure}, kernel, audits, what.settings});
    Counter counter;
    run.listen(counter);
    try {
      run.finish();
    } catch (const AuditError& error) {
      outcome.failure = error.what();
      outcome.failed_audit = true;
    }
    outcome.events = counter.events;
    outcome.fingerprint = run.simulator().fingerprint();
    outcome.statistics = run.structures().front()->statistics;
    outcome.seconds =
        run.simulator().seconds_of(0) + run.simulator().seconds() + outcome.statistics.build_seconds;
  } catch (const InputError& error) {
    outcome.refusal = error.what();
  } catch (const std::exception& error) {
    outcome.failure = error.what();
  }
  return outcome;
}

std::optional<std::string> trouble_of(const Outcome& filtered, const Outcome& audited, const Outcome& exact) {
  for (const Outcome* outcome : {&audited, &filtered, &exact})
    if (!outcome->failure.empty()) return outcome->failure;
  const bool same = filtered.refusal == exact.refusal && filtered.fingerprint == exact.fingerprint &&
                    filtered.events == exact.events;
  if (!same) return fmt::format("filtered {}; exact {}", filtered.in_words(), exact.in_words());
  if (audited.refusal != exact.refusal || audited.fingerprint != exact.fingerprint)
    return fmt::format("with audits {}; without {}", audited.in_words(), exact.in_words());
  return std::nullopt;
}

/// Times of the runs that succeeded.
struct KernelTimes {
  std::vector<double> filtered, exact;
};

void add_case(StabilityRow& row, KernelTimes& times, const Settled& what, const Case& one) {
  const Outcome filtered = outcome_of(one, what, Kernel::filtered, AuditMode::none);
  const Outcome audited = outcome_of(one, what, Kernel::filtered, AuditMode::events);
  const Outcome exact = outcome_of(one, what, Kernel::exact, AuditMode::none);
  ++row.cases;
  row.audits_run += audited.statistics.audits_run;
  row.audits_failed += audited.failed_audit ? 1 : 0;
  if (const auto trouble = trouble_of(filtered, audited, exact)) {
    const bool failure = !(filtered.failure + audited.failure + exact.failure).empty();
    ++(failure ? row.failed : row.disagreements);
    note_trouble(row, one.number, *trouble,
                 instance_text(one.instance) +
                     (one.radii.empty() ? "" : fmt::format("# radii {}\n", fmt::join(one.radii, " "))));
    return;
  }
  if (!exact.refusal.empty()) {
    if (row.refused++ == 0 && row.motion.empty()) row.reason = exact.refusal;
    return;
  }
  row.events += exact.events;
  row.rebuilds += filtered.statistics.rebuilds;
  row.stages += filtered.statistics.stages;
  times.filtered.push_back(filtered.seconds);
  times.exact.push_back(exact.seconds);
}

enum class Of { points, balls };

// Only points in space have weights (motions/readers/instance.h), and the sorted list does not use them.
StabilitySubject structure_subject(const std::string& structure, Of of, int dimension, int degree,
                                   std::size_t beads, const StructureSettings& settings = {}) {
  const std::size_t cases_a_run = degree == 1 ? 50 : 100;  // one run has many certificates
  const std::string name =
      structure + (of == Of::balls ? ":balls" : "") + (settings.between == Between::chord ? ":chord" : "");
  StabilitySubject subject{name, true, dimension, degree, 0, dimension == 3 || of == Of::balls, {}};
  subject.run = [=](const Extreme& extreme, const StabilityCases& cases) {
    StabilityRow row;
    row.subject = name;
    row.extreme = extreme.name;
    row.must_refuse = extreme.refused;
    KernelTimes times;
    const std::size_t runs = (cases.cases + cases_a_run - 1) / cases_a_run;
    for (std::size_t number = 0; number < runs; ++number) {
      SceneRandom random = scene_random(cases.seed, extreme.name, number);
      BeadCurves curves = extreme.make({dimension, degree, beads}, random);
      Case one{number, curves.instance(std::string(extreme.name)), {}};
      if (of == Of::balls) {
        give_radii(curves, random);
        for (std::size_t b = 0; b < beads; ++b) one.radii.push_back(curves.radius(b, 0));
      }
      add_case(row, times, {structure, settings}, one);
    }
    row.seconds = {median_of(std::move(times.filtered)), median_of(std::move(times.exact))};
    return row;
  };
  return subject;
}

}  // namespace

std::vector<StabilitySubject> kinetic_structures() {
  std::vector<StabilitySubject> subjects;
  for (const int degree : {1, 3}) {
    subjects.push_back(structure_subject("sorted", Of::points, 1, degree, 10));
    subjects.push_back(structure_subject("hull", Of::points, 2, degree, 8));
    const std::size_t few = degree == 1 ? 8 : 6;
    for (const int dimension : {2, 3}) {
      subjects.push_back(structure_subject("box", Of::points, dimension, degree, 10));
      subjects.push_back(structure_subject("closest", Of::points, dimension, degree, few));
      subjects.push_back(structure_subject("wrapped", Of::points, dimension, degree, few));
      subjects.push_back(structure_subject("power", Of::points, dimension, degree, few));
      subjects.push_back(structure_subject("contacts", Of::balls, dimension, degree, few));
      StructureSettings diagonals;
      diagonals.directions = dimension == 2 ? 4 : 7;
      subjects.push_back(structure_subject("boxes", Of::points, dimension, degree, few, diagonals));
      subjects.push_back(structure_subject("boxes", Of::balls, dimension, degree, few, diagonals));
      // Chord cages have no events; the audits in the middle of the step test them.
      StructureSettings chord;
      chord.between = Between::chord;
      subjects.push_back(structure_subject("wrapped", Of::points, dimension, degree, few, chord));
      subjects.push_back(structure_subject("wrapped", Of::balls, dimension, degree, few, chord));
      subjects.push_back(structure_subject("layered", Of::balls, dimension, degree, few));
    }
  }
  // Curves take minutes in integer arithmetic, because their functions have degree 36.
  for (const int dimension : {2, 3})
    subjects.push_back(structure_subject("wrapped", Of::balls, dimension, 1, 6));
  // All other structures, on points in the dimensions that they accept.
  std::set<std::string> names;
  for (const StabilitySubject& subject : subjects)
    names.insert(subject.name.substr(0, subject.name.find(':')));
  for (const StructureSpec& spec : structure_registry().all())
    for (const int dimension : {1, 2, 3})
      if (!names.contains(spec.name) && !spec.refusal(Scene(BeadCurves(dimension, 1, 6).instance(spec.name))))
        for (const int degree : {1, 3})
          subjects.push_back(structure_subject(spec.name, Of::points, dimension, degree, 6));
  return subjects;
}

}  // namespace kds
