#include "experiments/program/live_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "experiments/output/text.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/live/live_address.h"

namespace kds {

namespace fs = std::filesystem;

const OptionList<LiveOutput>& live_output_options() {
  using O = LiveOutput;
  static const OptionList<O> list{
      {of_output(real_option({"--every", "SECONDS",
                              "with a running simulation: write the results so far to --out at most every "
                              "SECONDS, and in at most 5% of the time. Files of other options appear at the "
                              "end (default: 60)"},
                             &O::every, {0, 1e9})),
       of_output(flag_option("--continue",
                             "with a running simulation: if --out holds results with the same settings, "
                             "keep them and write those of this run to DIR/part2, DIR/part3 ... (default: "
                             "a DIR that holds files is refused)",
                             &O::continues))}};
  return list;
}

void check_live_output(const LiveOutput& live, const InputOptions& input, const Destinations& destinations) {
  std::error_code error;
  if (is_live(input) && destinations.out && !live.continues) {
    if (destinations.replace && fs::exists(*destinations.out / "part2", error))
      throw InputError("--replace",
                       fmt::format("{} has parts of several runs; expected another directory, or "
                                   "--continue, which adds a part",
                                   destinations.out->string()));
    if (!destinations.replace && fs::is_directory(*destinations.out, error) &&
        !fs::is_empty(*destinations.out, error))
      throw InputError("--out",
                       fmt::format("{} holds files; --continue keeps them and adds a part, --replace "
                                   "replaces an earlier result",
                                   destinations.out->string()));
  }
  const std::string_view option = live.continues ? "--continue" : live.every ? "--every" : "";
  if (option.empty()) return;
  if (!is_live(input))
    throw InputError(option, fmt::format("is for a running simulation; expected its address, {}, as an input",
                                         live_example));
  if (!destinations.out) throw InputError(option, "writes to a directory; expected --out DIR as well");
  if (live.continues && destinations.replace)
    throw InputError("--continue", "keeps the results in --out; run it without --replace");
}

void refuse_if_live(const InputOptions& input, bool is_given, std::string_view option,
                    std::string_view reason) {
  if (is_given && is_live(input)) throw InputError(option, std::string(reason));
}

std::function<void()> waiting_note(ProgressBar& bar, const InputOptions& input) {
  return [&bar, names = file_names(input)] { print_note(bar, names + " does not listen yet; trying again"); };
}

void warn_of_threads(std::optional<std::size_t> threads,
                     const std::function<void(const std::string&)>& warn) {
  if (threads.value_or(1) > 1)
    warn(fmt::format("{} {}: the run is not cut and takes one thread, because its frames come one by one",
                     "--threads"_arg, *threads));
}

std::optional<std::string> start_part(std::string_view file, const Json& settings,
                                      Destinations& destinations) {
  const fs::path first = *destinations.out, result = first / file;
  std::error_code error;
  if (!fs::exists(result, error)) return std::nullopt;
  check_no_writer(first, "--continue");
  std::ifstream stream(result, std::ios::binary);
  const Json earlier =
      parse_json(std::string{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()});
  const Json* const known = earlier.find("settings");
  if (known == nullptr)
    throw InputError("--continue",
                     fmt::format("{} has no settings; give another directory", result.string()));
  for (const auto& [name, value] : *settings.members()) {
    if (name == "until") continue;  // tells only when a part ends
    const Json* const before = known->find(name);
    if (before == nullptr || line_of(*before) != line_of(value))
      throw InputError(
          "--continue",
          fmt::format("{} has {} {}, and this run {}; expected the same settings, or another directory",
                      result.string(), name, before ? line_of(*before).value_or("?") : "unset",
                      line_of(value).value_or("?")));
  }
  std::size_t part = 2;
  while (fs::exists(first / fmt::format("part{}", part), error)) ++part;
  destinations.out = first / fmt::format("part{}", part);
  return fmt::format("{} holds earlier results; this is part {}, in {}", first.string(), part,
                     destinations.out->string());
}

void add_live(Json& json, const LiveRun& live) {
  json["complete"] = live.is_complete;
  json["live"] = {{"received", live.state.received},
                  {"taken", live.state.taken},
                  {"seconds", live.seconds},
                  {"seconds_waited", live.state.seconds_waited},
                  {"seconds_full", live.state.seconds_full}};
}

int end_of_live_run(ProgressBar& bar, const LiveRun& live, bool is_cut) {
  print_note(bar,
             fmt::format("waited {:.1f} s for the simulation in {:.1f} s; the simulation may have waited "
                         "{:.1f} s for kds{}",
                         live.state.seconds_waited, live.seconds, live.state.seconds_full,
                         live.state.seconds_full > 0
                             ? ", or dropped frames meanwhile, as LAMMPS does; times by --dt are then wrong"
                             : ""));
  return is_cut ? 1 : 0;
}

LiveRun LiveClock::run(bool is_complete, const std::optional<LiveState>& now) const {
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
  LiveState state = now.value_or(LiveState{});
  state.seconds_waited -= before_.seconds_waited;
  state.seconds_full -= before_.seconds_full;
  return {is_complete, seconds.count(), state};
}

std::string LiveProgress::state(std::size_t frame, std::uint64_t count, std::string_view counted,
                                std::optional<std::uint64_t> contacts) const {
  const FrameStamp first = scene_.stamp(0), now = scene_.stamp(frame);
  const bool timed = first.picoseconds && now.picoseconds;
  const double length = timed ? *now.picoseconds - *first.picoseconds : static_cast<double>(frame);
  std::string text = timed ? fmt::format("{:.6g} ps, ", *now.picoseconds) : "";
  if (length > 0)
    text += fmt::format("{} {}/{}, ", short_decimal(static_cast<double>(count) / length), counted,
                        timed ? "ps" : "step");
  if (contacts) text += fmt::format("{} contacts now, ", with_thousands(*contacts));
  const LiveState live = scene_.live().value_or(LiveState{});
  return text + (live.received > live.taken ? kds::counted(live.received - live.taken, "frame") + " behind"
                                            : "kds waits");
}

}  // namespace kds
