#include "experiments/run/run_steps.h"

#include <fmt/format.h>

#include <string_view>

#include "experiments/output/text.h"
#include "experiments/run/parse_run_options.h"
#include "kds/audit.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

// Names what the last of the work that is allowed was spent on.
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

// Structures count steps from 0: messages say which frames of the file these are.
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
  // A refusal that is possible only when no step follows is about the last step.
  in_step(run, run.scene().step_count() - 1, options, [&] { run.finish(); });
}

}  // namespace kds
