#include "experiments/kds_main.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/command_line.h"
#include "experiments/program/commands.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option_values.h"
#include "experiments/run/run_options.h"
#include "motions/base/floating_point_scope.h"
#include "motions/base/input_error.h"
#include "motions/numbers/lanes.h"
#include "structures/session/structure_spec.h"

namespace kds {
namespace {

constexpr std::array kCommands{
    Command{"run", "run kinetic structures over trajectories and report their events", run_command},
    Command{"info", "describe trajectories; list which conditions of a proper necklace fail", info_command},
    Command{"generate", "write a model necklace", generate_command},
    Command{"view", "write a run as a page that shows it in a browser", view_command},
    Command{"replay", "repeat a logged run and compare its events", replay_command},
    Command{"update", "compare techniques that update the power diagram from frame to frame", update_command},
    Command{"compare", "compare how often structures change, by stride, motion and input", compare_command},
    Command{"collide", "find the beads that collide in each frame, by several methods", collide_command},
    Command{"contacts", "measure how long contacts last, exactly and as frames show it", contacts_command},
    Command{"missed", "measure which contacts are missed if only frames are examined", missed_command},
    Command{"surface", "measure areas and volumes of the union of balls", surface_command},
    Command{"voids", "follow the voids of the union of balls: when each opens and closes", voids_command},
    Command{"trade", "measure how much time each accuracy option saves and how large its errors are",
            trade_command},
    Command{"ccd", "decide when a point meets a triangle, or two edges each other", ccd_command},
    Command{"sweep", "run commands over many inputs and settings, on this machine or a cluster",
            sweep_command},
    Command{"stability", "compare the two kernels on hard inputs", stability_command},
};

/// Former commands that are scripts now.
constexpr std::array<std::string_view, 4> kScripts{"figures", "questions", "scale", "theorems"};

std::string program_help() {
  std::string text =
      "kds: kinetic data structures for deforming necklaces\n\n"
      "usage: kds COMMAND [ARGUMENT]...\n\n";
  const auto add = [&](std::string_view name, std::string_view help) {
    text += fmt::format("  {:<10} {}\n", name, wrapped(help, help_width(), 13));
  };
  for (const Command& command : kCommands) add(command.name, command.summary);
  text += '\n';
  add("help", "print this text, or more: kds help run (any command), kds help inputs, kds help structures");
  add("--help", "print the same: kds --help, kds run --help");
  add("--version", "print the version");
  constexpr std::string_view exit_codes =
      "0 success, 1 internal failure, failed audit, results that differ (replay, the methods "
      "of collide, stability) or a running simulation whose connection broke, 2 wrong usage or input, 75 an "
      "interrupted sweep, which the same command "
      "continues";
  return text + "\nexit codes: " + wrapped(exit_codes, help_width(), 12) + '\n';
}

// Returns a suggestion if a word is not a command but the name of a structure.
std::string suggested_run(const std::string& name) {
  std::vector<std::string_view> structures;
  for (const StructureSpec& structure : structure_registry().all()) structures.push_back(structure.name);
  const auto nearest = nearest_name(name, structures);
  return nearest ? fmt::format(", did you mean run INPUT --structures {}?", *nearest) : "";
}

const Command& command_of(const std::string& name) {
  for (const Command& command : kCommands)
    if (command.name == name) return command;
  if (std::ranges::find(kScripts, name) != kScripts.end())
    throw InputError(
        fmt::format("{0}: is a script now, experiments/paper/{0}.py; scripts/reproduce {0} builds what it "
                    "needs and runs it",
                    name));
  if (name == "reproduce")
    throw InputError(
        "reproduce: is a script now; scripts/reproduce builds the Python module and measures the paper "
        "again");
  if (name == "bench")
    throw InputError(
        "kds bench is a program of its own: kds_bench, built with -DKDS_BENCHMARKS=ON "
        "(docs/measurements.md)");
  const bool is_option = name.starts_with('-');
  std::vector<std::string_view> names{"help"};
  if (is_option) names = {"--help", "--version"};
  if (!is_option)
    for (const Command& command : kCommands) names.push_back(command.name);
  std::string advice = suggestion(name, names);
  if (advice.empty() && !is_option) advice = suggested_run(name);
  throw InputError(
      fmt::format("unknown {} '{}'{} (see kds --help)", is_option ? "option" : "command", name, advice));
}

// Handles `kds help`, `kds help COMMAND`, `kds help inputs` and `kds help structures`.
int help(const Arguments& of) {
  if (of.size() > 1)
    throw InputError(fmt::format("kds help takes one command, not {} (see kds --help)", of.size()));
  const std::string name = of.empty() ? "help" : of.front();
  if (name == "help" || name == "--help" || name == "-h") throw HelpRequest{program_help()};
  if (name == "inputs") throw HelpRequest{inputs_help()};
  if (name == "structures") throw HelpRequest{structures_table()};
  if (name.starts_with('-'))
    throw InputError(fmt::format("kds help takes a command, not the option '{}' (see kds --help)", name));
  return command_of(name).run({"--help"});
}

int run_program(const Arguments& arguments) {
  if (arguments.empty()) throw InputError("no command given (see kds --help)");
  const std::string& name = arguments.front();
  if (name == "--help" || name == "-h") throw HelpRequest{program_help()};
  if (name == "--version") throw HelpRequest{"kds " + program_version() + "\n"};
  const Arguments rest(arguments.begin() + 1, arguments.end());
  return name == "help" ? help(rest) : command_of(name).run(rest);
}

// Does not throw, since standard error may be closed.
void complain(const std::string& message) { std::fputs(fmt::format("kds: {}\n", message).c_str(), stderr); }

int run_catching_input_errors(const Arguments& arguments) {
  try {
    return run_program(arguments);
  } catch (const HelpRequest& help) {
    print_to_stdout(help.text);
    return 0;
  } catch (const InputError& error) {
    complain(one_line(error.what()));
    return 2;
  }
}

// Opens /dev/null for each closed standard stream. Otherwise the next file opened would get the stream's
// descriptor, and messages would be written into that file. Writing to /dev/null opened for reading fails
// instead. A file that exceeds the size limit then causes an error instead of ending the program.
void prepare_process() {
  for (const int stream : {0, 1, 2})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF) static_cast<void>(::open("/dev/null", O_RDONLY));
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace

std::span<const Command> all_commands() { return kCommands; }

int run_arguments(const Arguments& arguments) {
  try {
    if (const auto missing = missing_in_processor()) throw std::runtime_error(*missing);
    return run_catching_input_errors(arguments);
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& error) {
    complain(error.what());  // several lines for a failed audit: how to repeat the run
  } catch (...) {
    complain("unknown failure");
  }
  return 1;
}

int kds_main(int argc, char** argv) {
  const FloatingPointScope to_nearest;
  prepare_process();
  return run_arguments(Arguments(argv + (argc > 0 ? 1 : 0), argv + argc));
}

}  // namespace kds
