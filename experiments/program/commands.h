#pragma once
// The commands of the program. Each takes the arguments that follow its name and returns the exit code. Each
// throws InputError if the arguments or the input are at fault, and HelpRequest for --help. kds_main.cpp
// lists the commands by name.

#include <span>
#include <string_view>

#include "experiments/program/command_line.h"

namespace kds {

struct Command {
  std::string_view name, summary;
  int (*run)(const Arguments&);
};

/// Returns all commands, in the order of `kds --help`.
[[nodiscard]] std::span<const Command> all_commands();
/// Runs the program with these arguments. Turns each error into a one-line message and an exit code.
[[nodiscard]] int run_arguments(const Arguments& arguments);

/// `kds ccd`: answers queries of continuous collision. Returns 1 if a file's own answers are others.
int ccd_command(const Arguments& arguments);
/// `kds collide`: reports which beads collide in every frame of a trajectory, by each method.
int collide_command(const Arguments& arguments);
/// `kds compare`: reports how often structures change, by stride, motion and input.
int compare_command(const Arguments& arguments);
/// `kds contacts`: reports the exact lifetimes of contacts, and what frames alone would show.
int contacts_command(const Arguments& arguments);
/// `kds generate`: writes a model necklace.
int generate_command(const Arguments& arguments);
/// `kds info`: describes trajectories. A violated condition is not an error.
int info_command(const Arguments& arguments);
/// `kds missed`: reports the share of the contacts that is missed if only the frames are examined.
int missed_command(const Arguments& arguments);
/// `kds replay`: runs a logged run again. Returns 0 if the run reproduces the log's fingerprint, else 1.
int replay_command(const Arguments& arguments);
/// `kds run`: runs kinetic structures and reports their events.
int run_command(const Arguments& arguments);
/// `kds stability`: compares the kernels on inputs for which the arithmetic is hardest. Throws
/// std::runtime_error if a row does not hold.
int stability_command(const Arguments& arguments);
/// `kds surface`: measures areas and volumes of the union of balls.
int surface_command(const Arguments& arguments);
/// `kds voids`: follows the voids of the union of balls.
int voids_command(const Arguments& arguments);
/// `kds sweep`: runs commands over many inputs and settings. Returns 75 if a signal or --time-budget ended
/// it.
int sweep_command(const Arguments& arguments);
/// `kds trade`: measures the speed and the errors of each lever on the user's own trajectory.
int trade_command(const Arguments& arguments);
/// `kds update`: compares techniques that update the power diagram from frame to frame.
int update_command(const Arguments& arguments);
/// `kds view`: writes a page that shows a run in a browser.
int view_command(const Arguments& arguments);

}  // namespace kds
