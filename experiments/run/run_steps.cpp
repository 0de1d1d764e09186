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
void with_limit(Session& session, const RunOptions& options, Work work) {
  try {
    work();
  } catch (const WorkLimitReached& limit) {
    throw InputError(
        fmt::format("--work {}: exact arithmetic takes more limb operations than that, the last on {}",
                    options.work.value_or(0), session.simulator().name_of_work(limit.subject())));
  }
}

// Structures count steps from 0: messages say which frames of the file these are.
template <class Work>
void in_step(Session& session, const Scene& scene, std::size_t step, const RunOptions& options, Work work) {
  const auto named = [&](std::string_view message) {
    return fmt::format("{} (step {} leads from frame {} to frame {})", message, step,
                       scene.frame_number(step), scene.frame_number(step + 1));
  };
  try {
    with_limit(session, options, work);
  } catch (const AuditError& error) {
    throw AuditError(fmt::format("{}\nto see it again: kds run {}", named(error.what()),
                                 shell_words(repeating_arguments(options))));
  } catch (const InputError& error) {
    throw InputError(named(error.what()));
  }
}

}  // namespace

void run_steps(Session& session, const Scene& scene, const RunOptions& options,
               const std::function<void(std::size_t frame)>& at_frame) {
  if (options.work) session.simulator().exact_work().set_limit(*options.work);
  session.load(0);
  with_limit(session, options, [&] { session.simulator().build(); });
  at_frame(0);
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    session.load(step);
    in_step(session, scene, step, options, [&] { session.simulator().run_step(); });
    at_frame(step + 1);
  }
  // What is only known when no step follows is about the last one.
  if (scene.step_count() > 0)
    in_step(session, scene, scene.step_count() - 1, options, [&] { session.simulator().finish(); });
}

}  // namespace kds
