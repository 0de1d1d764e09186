#pragma once
// The commands of the program. Each takes the arguments behind its name and returns the exit code. Each
// throws InputError if the arguments or the input are at fault, and HelpRequest for --help. kds_main.cpp
// lists them by name.

#include "experiments/program/command_line.h"

namespace kds {

/// `kds bench`. A missed goal is no error.
int bench_command(const Arguments& arguments);
/// `kds collide`: which beads collide in every frame of a trajectory, by each method.
int collide_command(const Arguments& arguments);
/// `kds compare`: how often structures change, by stride, motion and input.
int compare_command(const Arguments& arguments);
/// `kds generate`: writes a model necklace.
int generate_command(const Arguments& arguments);
/// `kds info`: describes trajectories. Violated conditions are no error.
int info_command(const Arguments& arguments);
/// `kds missed`: which share of the contacts is missed if only frames are examined.
int missed_command(const Arguments& arguments);
/// `kds questions`: measurements of what the paper leaves open.
int questions_command(const Arguments& arguments);
/// `kds replay`: returns 0 if the run gives the log's fingerprint again, else 1.
int replay_command(const Arguments& arguments);
/// `kds reproduce`: the paper's tables, measured again.
int reproduce_command(const Arguments& arguments);
/// `kds run`: runs kinetic structures and reports their events.
int run_command(const Arguments& arguments);
/// `kds stability`: compares the kernels where arithmetic is hardest. Throws std::runtime_error if a row does
/// not hold.
int stability_command(const Arguments& arguments);
/// `kds theorems`: what the paper's theorems bound, measured over sizes.
int theorems_command(const Arguments& arguments);
/// `kds trade`: the speed and the errors of each lever on the user's own trajectory.
int trade_command(const Arguments& arguments);
/// `kds update`: compares techniques that bring the power diagram from frame to frame.
int update_command(const Arguments& arguments);

}  // namespace kds
