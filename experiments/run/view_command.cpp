#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option_values.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/replay_labels.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_scene.h"
#include "experiments/view/view_results.h"
#include "motions/base/input_error.h"
#include "structures/session/kinetic_run.h"

namespace kds {

namespace {

constexpr CommandSpec kViewCommand{
    "kds view",
    "Writes a run as a page that shows it in any browser, without a network: beads, spheres, edges and "
    "contacts at any time, and each event at its exact time.",
    {},
    {},
    "kds view villin.dcd --topology villin.pdb --frames 0:200 -o replay.html\n"
    "kds view models.pdb --structures contacts --radius 3 -o contacts.html\n"
    "kds view models.pdb --vtk paraview --script frame.pml --at 10",
};

constexpr double kMegabyte = 1e6;

struct ViewOptions {
  RunOptions run;
  std::optional<std::filesystem::path> page, vtk, script;
  std::optional<double> quantum;
  double most_megabytes = 64;
  std::optional<std::size_t> at;
  bool quiet = false, replace = false;
};

const OptionList<ViewOptions>& view_options() {
  using O = ViewOptions;
  static const auto list =
      OptionList<O>()
          .with(&O::run, motion_and_structure_options())
          .with({
              path_option({"-o", "FILE", "write the page to FILE (required without --vtk and --script)"},
                          &O::page),
              real_option({"--quantum", "STEP",
                           "round the positions that are shown to multiples of STEP; events stay exact "
                           "(default: 0.02 angstrom; without a unit, a hundredth of the least radius)"},
                          &O::quantum, {0, 1e300, true}),
              real_option(
                  {"--max-mb", "MB",
                   "largest page in megabytes; above, the run, and so --vtk too, takes every 2nd, 3rd ... "
                   "frame (default: 64)"},
                  &O::most_megabytes, {0, 1e6, true}),
              path_option(
                  {"--vtk", "DIR",
                   "write replay.pvd and VTK files of all frames to DIR, for ParaView (default: none)"},
                  &O::vtk),
              replace_option(&O::replace),
              path_option({"--script", "FILE",
                           "write beads, spheres and edges at a frame to FILE: for PyMOL if its name ends in "
                           ".pml, for ChimeraX if in .bild (default: none)"},
                          &O::script),
              whole_option(
                  {"--at", "FRAME", "frame of --script, by its number in the file (default: the first)"},
                  &O::at, 0, UINT64_MAX),
              flag_option("--quiet", "print no result and no progress bar", &O::quiet),
          });
  return list;
}

ViewOptions parse_view_options(const Arguments& arguments) {
  ViewOptions options;
  const ParsedArguments parsed =
      read_arguments(with_inputs(kViewCommand, true), view_options(), arguments, options);
  take_inputs(parsed, kViewCommand.name, options.run);
  if (!options.page && !options.vtk && !options.script)
    throw InputError("kds view writes nothing; expected -o FILE, --vtk DIR or --script FILE");
  if (options.script) check_script_ending(*options.script);
  for (const char* const option : {"--quantum", "--max-mb"})
    if (parsed.has(option) && !options.page)
      throw InputError(fmt::format("{}: applies to the page, expected -o FILE as well", option));
  if (options.at && !options.script)
    throw InputError("--at: names the frame of --script, which is not given");
  return options;
}

void check_before_view(const ViewOptions& options) {
  check_inputs_exist(options.run);
  TakenPaths paths;
  paths.read(options.run);
  if (options.page) paths.write("-o", *options.page);
  if (options.script) paths.write("--script", *options.script);
  if (options.vtk) {
    paths.write_into("--vtk", *options.vtk);
    check_directory(*options.vtk, "--vtk", options.replace);
  }
  if (options.replace && !options.vtk)
    throw InputError("--replace: replaces a directory of results, expected --vtk DIR as well");
  if (options.page) ensure_writable_file(*options.page, "-o");
  if (options.script) ensure_writable_file(*options.script, "--script");
}

std::string counts_of(const Scene& scene, std::size_t frames, const ReplayRecorder& recorder) {
  const auto number_of = [](std::size_t count, const char* noun) {
    return fmt::format("{} {}{}", with_thousands(count), noun, count == 1 ? "" : "s");
  };
  std::string text = number_of(scene.bead_count(), "bead") + ", " + number_of(frames, "frame");
  for (const ReplayRecorder::Structure& structure : recorder.structures())
    text += ", " + number_of(structure.events.count(), "event") + " of " + structure.name;
  return text + "\n";
}

/// Names the outputs that have the frames of the run: the page and, if asked for, those of other viewers.
std::string outputs_of(const ViewOptions& options) {
  if (options.vtk && options.script) return "the page, the files of --vtk and --script";
  if (options.vtk) return "the page and the files of --vtk";
  return options.script ? "the page and the file of --script" : "the page";
}

/// Runs every stride-th frame and writes the files. Returns what to print. Throws ReplayTooLarge if the page
/// has too many bytes; the number of frames is then in `frames`.
std::string write_view(const ViewOptions& options, std::size_t stride, std::size_t& frames,
                       ProgressBar& bar) {
  const auto warn = [&bar](const std::string& warning) { print_warning(bar, warning); };
  RunOptions run_options = options.run;
  run_options.reading.frames.stride *= stride;
  HeldWarnings warnings;
  bool lone_frame = false;
  const Scene scene = load_scene(run_options, warnings.hold(), &lone_frame);
  frames = scene.frame_count();
  const auto run = open_run(run_options, scene, AuditMode::none);
  if (!options.quiet) watch_exact_work(run->simulator(), scene, warn);
  ReplayLabels labels = replay_labels(options.run, "view");
  labels.stride = stride;
  labels.lone_frame = lone_frame;
  ViewRequest request{options.page, options.quantum, {}, options.vtk, options.script,
                      options.at,   options.replace};
  request.most_bytes = static_cast<std::uint64_t>(options.most_megabytes * kMegabyte);
  ViewResults view(request, labels, scene, *run);
  run_steps(*run, run_options, [&](std::size_t frame) {
    if (frame == 0 || !lone_frame) view.add_frame(frame);
    bar.update(frame, 0, scene.step_count());
  });
  view.finish();
  warnings.release(warn);  // none of a run that is given up because its page is too large
  commit_together({view.files(), view.vtk_files()});
  std::string text = counts_of(scene, lone_frame ? 1 : frames, view.recorder());
  if (options.page)
    text += fmt::format("replay {} ({:.1f} MB): open it in a browser\n", options.page->string(),
                        static_cast<double>(view.page_bytes()) / kMegabyte);
  if (options.vtk) text += fmt::format("ParaView {}\n", (*options.vtk / "replay.pvd").string());
  if (options.script) text += fmt::format("script {}\n", options.script->string());
  return text;
}

}  // namespace

int view_command(const Arguments& arguments) {
  const ViewOptions options = parse_view_options(arguments);
  check_before_view(options);
  ProgressBar bar(!options.quiet, "step");
  std::size_t all_frames = 0;
  for (std::size_t stride = 1;;) {
    std::size_t frames = 0;
    try {
      const std::string text = write_view(options, stride, frames, bar);
      bar.erase();
      if (stride > 1)
        print_warning(
            bar,
            fmt::format("--max-mb {}: the run, and with it {}, takes one in {} of the {} frames, so "
                        "its steps are longer; a larger --max-mb takes all",
                        options.most_megabytes, outputs_of(options), stride, with_thousands(all_frames)));
      if (!options.quiet) print_to_stdout(text);
      return 0;
    } catch (const ReplayTooLarge& large) {
      if (stride == 1) all_frames = frames;
      const double megabytes = static_cast<double>(large.expected) / kMegabyte;
      if (frames <= 2)
        throw InputError(
            fmt::format("--max-mb {}: the page of the fewest frames has {:.1f} MB; expected at "
                        "least --max-mb {}",
                        options.most_megabytes, megabytes, std::ceil(megabytes)));
      const auto wanted = static_cast<std::size_t>(
          std::ceil(static_cast<double>(stride) * std::min(megabytes / options.most_megabytes, 1e9)));
      stride = std::min(std::max(stride + 1, wanted), all_frames - 1);
    }
  }
}

}  // namespace kds
