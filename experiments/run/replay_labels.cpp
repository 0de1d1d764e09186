#include "experiments/run/replay_labels.h"

#include <filesystem>
#include <string_view>

#include "experiments/output/text.h"
#include "motions/base/input_file.h"
#include "motions/readers/instance.h"
#include "motions/readers/reader_registry.h"

namespace kds {

namespace {

/// Returns whether a LAMMPS dump says that its units are `lj`.
bool names_reduced_units(const std::filesystem::path& path) {
  constexpr std::size_t most_lines = 12;  // the atoms of the first frame begin before
  LineReader lines(path);
  std::string_view line;
  bool units = false;
  while (lines.number() < most_lines && lines.next(line)) {
    if (units) return line == name_of(LammpsUnits::lj);
    units = line.starts_with("ITEM: UNITS");
  }
  return false;
}

}  // namespace

bool in_angstrom(const InputOptions& options) {
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    if (is_instance_file(options.inputs[i])) return false;
    const ReadOptions reading = reading_of(options, i);
    const ReaderSpec* const reader = reader_registry().find(options.inputs[i], reading.format);
    if (reader == nullptr) continue;
    if (reader->name == "xyz") return false;
    if (reader->name != "lammps") continue;
    if (reading.units ? *reading.units == LammpsUnits::lj : names_reduced_units(options.inputs[i]))
      return false;
  }
  return true;
}

ReplayLabels replay_labels(const RunOptions& options, const std::string& command) {
  ReplayLabels labels;
  labels.title = file_names(options);
  labels.command = "kds " + command + " " + shell_words(repeating_arguments(options));
  for (const auto& input : options.inputs) labels.inputs.push_back(input.filename().string());
  labels.in_angstrom = in_angstrom(options);
  return labels;
}

}  // namespace kds
