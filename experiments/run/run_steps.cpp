#include "experiments/run/run_steps.h"

#include <fmt/format.h>

#include <string_view>

#include "experiments/output/text.h"
#include "experiments/run/parse_run_options.h"
#include "kds/audit.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

// Runs `work`. Turns WorkLimitReached into an InputError that names the computation which used the last of
// the allowed work.
template <class Work>
void with_limit(KineticRun& run, const RunOptions& options, Work work) {
  try {
    work();
  } catch (const WorkLimitReached& limit) {
    throw InputError(
        fmt::format("--work {}: exact arithmetic takes more limb operations than that, the last on {}",
                    options.work.value_or(0), run.simulator().name_of_work(limit.subject())));
  }
}

// Runs `work`, which belongs to a step. Structures count steps from 0, so the message of an exception is
// extended by the step's frame numbers in the file.
template <class Work>
void in_step(KineticRun& run, std::size_t step, const RunOptions& options, Work work) {
  const auto named = [&](std::string_view message) {
    return fmt::format("{} (step {} leads from frame {} to frame {})", message, step,
                       run.scene().frame_number(step), run.scene().frame_number(step + 1));
  };
  try {
    with_limit(run, options, work);
  } catch (const AuditError& error) {
    throw AuditError(fmt::format("{}\nto see it again: kds run {}", named(error.what()),
                                 shell_words(repeating_arguments(options))));
  } catch (const InputError& error) {
    throw InputError(named(error.what()));
  }
}

}  // namespace

void run_steps(KineticRun& run, const RunOptions& options,
               const std::function<void(std::size_t frame)>& at_frame) {
  if (options.work) run.limit_work(*options.work);
  with_limit(run, options, [&] { run.build(); });
  at_frame(0);
  for (std::size_t step = 0; run.load_step(); ++step) {
    in_step(run, step, options, [&] { run.run_step(); });
    at_frame(step + 1);
  }
  // An error that can occur only after all steps is reported for the last step.
  in_step(run, run.scene().step_count() - 1, options, [&] { run.finish(); });
}

}  // namespace kds
