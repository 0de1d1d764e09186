#pragma once
// Shared by commands that follow a running simulation: results while it runs, parts, and who waited for whom.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "experiments/output/output_files.h"
#include "experiments/output/result_json.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option.h"
#include "experiments/program/progress_bar.h"
#include "motions/frames/live_state.h"
#include "motions/scene/scene.h"

namespace kds {

struct LiveOutput {
  std::optional<double> every;  ///< --every, in seconds; empty if not given
  bool continues = false;       ///< --continue
};

/// Returns the options --every and --continue.
[[nodiscard]] const OptionList<LiveOutput>& live_output_options();

/// Throws InputError if --every or --continue is given without a running simulation or without --out, if
/// --continue comes with --replace, or if --out holds files that the results of a running simulation would
/// need to replace.
void check_live_output(const LiveOutput& live, const InputOptions& input, const Destinations& destinations);

/// Throws InputError with `reason` if an input is a running simulation and `option` is given.
void refuse_if_live(const InputOptions& input, bool is_given, std::string_view option,
                    std::string_view reason);

/// Returns a function that says that the simulation does not listen yet (ReadOptions::on_wait). The bar must
/// outlive the function.
[[nodiscard]] std::function<void()> waiting_note(ProgressBar& bar, const InputOptions& input);

/// Warns if more than one thread is asked for: frames that come one by one are run on one thread.
void warn_of_threads(std::optional<std::size_t> threads, const std::function<void(const std::string&)>& warn);

/// For --continue: if --out holds a result of this command, moves `destinations.out` to its next part
/// (DIR/part2, DIR/part3 ...) and returns the line that says so. `file` is the name of the command's JSON.
/// Throws InputError if that result has other settings, or if DIR holds anything else.
[[nodiscard]] std::optional<std::string> start_part(std::string_view file, const Json& settings,
                                                    Destinations& destinations);

/// Callbacks of a command during a run over live frames. Either may be empty.
template <class Report>
struct LiveHooks {
  /// Gets a function that describes the frame just reached, for the progress bar. The function is valid
  /// until the run returns.
  std::function<void(ProgressBar::State)> describe = {};
  /// Called at each frame. `make` returns the report of a run that ends there.
  std::function<void(const std::function<Report()>& make)> at_frame = {};
};

/// Writes results while a run goes on: at most every `every` seconds, and in at most 5% of the time.
class ResultsSoFar {
 public:
  /// `every` is the value of --every. The bar must outlive this object.
  ResultsSoFar(ProgressBar& bar, std::optional<double> every) : bar_(bar), every_(every.value_or(60)) {}

  /// Returns hooks that show the run on the bar and, if results are `wanted`, pass reports to `write`.
  /// `write` returns the reason if the results cannot replace the earlier ones. The first such reason is
  /// printed, and the run goes on.
  template <class Report>
  [[nodiscard]] LiveHooks<Report> hooks(bool wanted,
                                        std::function<std::optional<std::string>(Report)> write) {
    LiveHooks<Report> hooks{[this](ProgressBar::State state) { bar_.describe(std::move(state)); }, {}};
    if (wanted)
      hooks.at_frame = [this, write = std::move(write)](const std::function<Report()>& make) {
        const Clock::time_point start = Clock::now();
        if (!next_) next_ = start + every_;
        if (start < *next_) return;
        std::optional<std::string> reason;
        try {
          reason = write(make());
        } catch (const OutputError& error) {  // the disk may have room later
          reason = error.what();
        }
        if (reason && !std::exchange(is_warned_, true))
          print_warning(bar_, *reason + "; the run goes on, and tries again later");
        const Clock::time_point end = Clock::now();
        next_ = end + std::max(every_, Seconds(20 * (end - start)));
      };
    return hooks;
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;

  ProgressBar& bar_;
  Seconds every_;
  std::optional<std::chrono::time_point<Clock, Seconds>> next_;  // none before the first frame
  bool is_warned_ = false;
};

/// State of a run over live frames.
struct LiveRun {
  bool is_complete = false;  ///< whether the run has ended
  double seconds = 0;        ///< since the run began
  LiveState state;
};

/// Adds `complete` and `live` to the JSON of a result.
void add_live(Json& json, const LiveRun& live);
/// Prints the line that says who waited for whom. Returns the exit code of the command: 1 if the connection
/// broke.
[[nodiscard]] int end_of_live_run(ProgressBar& bar, const LiveRun& live, bool is_cut);

/// Measures a run from now on: waits for the connection and the first frames do not count.
class LiveClock {
 public:
  explicit LiveClock(const std::optional<LiveState>& now) : before_(now.value_or(LiveState{})) {}
  [[nodiscard]] LiveRun run(bool is_complete, const std::optional<LiveState>& now) const;

 private:
  LiveState before_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Follows a live scene from its first step on.
class LiveProgress {
 public:
  explicit LiveProgress(const Scene& scene) : scene_(scene), clock_(scene.live()) {}

  [[nodiscard]] LiveRun run(bool is_complete) const { return clock_.run(is_complete, scene_.live()); }
  /// Returns "2.468 ps, 312 events/ps, 41 contacts now, 3 frames behind" for a frame just reached. `counted`
  /// names what `count` counts. Frames without times are counted by frames.
  [[nodiscard]] std::string state(std::size_t frame, std::uint64_t count, std::string_view counted,
                                  std::optional<std::uint64_t> contacts) const;

 private:
  const Scene& scene_;
  LiveClock clock_;
};

}  // namespace kds
