#include "experiments/compare/compare_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/text.h"
#include "experiments/program/option_lists.h"
#include "experiments/program/option_values.h"

namespace kds {

namespace {

constexpr std::array kCompareOptions{
    OptionSpec{"--structures", "LIST",
               "comma list of sorted, box, hull, closest, wrapped, power, contacts (default: wrapped,power)"},
    OptionSpec{"--strides", "LIST", "run over every frame, every second, ...: 1,2,4 (default: 1)"},
    OptionSpec{"--motions", "LIST",
               "how beads move between frames: comma list of linear, hermite, lifted (default: linear)"},
    OptionSpec{"--apart", "K",
               "contacts: of beads of one chain, those at least K apart along it (default: 2)"},
    OptionSpec{"--rounds", "N",
               "each run so often: times are the median, with the least and most (default: 3)"},
    OptionSpec{"--out", "DIR", "write compare.json, compare.csv and report.html there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr auto kAllCompareOptions = joined(kInputOptions, kCompareOptions);

constexpr CommandSpec kCompareCommand{
    "kds compare",
    "Compares how often structures change, by stride, motion and input: each is a run of all structures.\n\n"
    "  net changes     what is not the same at one frame and the next: nodes with another basis (wrapped),\n"
    "                  cells of one diagram and not of the other (power), pairs (contacts), ranks (sorted),\n"
    "                  ends (box), corners (hull), the pair (closest)\n"
    "  efficiency      events a net change\n"
    "  compactness     the most certificates at once; locality: the most on one bead\n"
    "  responsiveness  the seconds an event takes",
    kInputOperand,
    "necklaces, each for itself: .pdb .ent .cif .mmcif .dcd .xyz .extxyz (also .gz)",
    kAllCompareOptions,
    "kds compare villin.dcd --topology villin.pdb --strides 1,2,4,8,16,32 --out report\n"
    "kds compare 300K.dcd 400K.dcd --topology villin.pdb --structures wrapped,contacts --motions "
    "linear,hermite",
};

std::vector<FrameMotion> parse_motions(const std::string& list) {
  std::vector<FrameMotion> motions;
  for (const std::string& name : split(list, ',')) {
    motions.push_back(choice_of<FrameMotion>("--motions", name, frame_motion_names));
    if (std::count(motions.begin(), motions.end(), motions.back()) > 1)
      throw InputError(fmt::format("--motions: {} is listed twice", name));
  }
  std::sort(motions.begin(), motions.end());
  return motions;
}

}  // namespace

CompareOptions parse_compare_options(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kCompareCommand, arguments);
  CompareOptions options;
  options.input = parse_input_options(parsed, kCompareCommand.name);
  if (const auto list = parsed.value("--structures")) options.structures = parse_structures(*list);
  if (const auto list = parsed.value("--strides")) options.strides = parse_strides(*list);
  if (const auto list = parsed.value("--motions")) options.motions = parse_motions(*list);
  if (const auto apart = parsed.value("--apart")) options.apart = parse_apart(*apart);
  if (const auto text = parsed.value("--rounds"))
    options.rounds = parse_whole_number("--rounds", *text, 1, 1000);
  options.out = path_of(parsed, "--out");
  options.json = parsed.value("--json");
  options.quiet = parsed.has("--quiet");
  return options;
}

}  // namespace kds
