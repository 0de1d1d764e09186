#pragma once
// --events: a file of every event, which the library writes (event_writers.h).

#include "experiments/program/command_line.h"

namespace kds {

inline constexpr OptionSpec kEventsOption{
    "--events", "FILE",
    "write every event there, with its beads and residues: as CSV, or as JSON lines where its name ends in "
    ".jsonl (default: none)"};

}  // namespace kds
