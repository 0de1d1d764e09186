#include "experiments/run/replay_labels.h"

#include "experiments/output/text.h"

namespace kds {

ReplayLabels replay_labels(const RunOptions& options, const std::string& command) {
  ReplayLabels labels;
  labels.title = file_names(options);
  labels.command = "kds " + command + " " + shell_words(repeating_arguments(options));
  for (const auto& input : options.inputs) labels.inputs.push_back(input.filename().string());
  labels.in_angstrom = in_angstrom(options);
  return labels;
}

}  // namespace kds
