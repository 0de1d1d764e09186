#pragma once
// The measurements of certificates and whole runs. Each is a subject of kds_benchmarks and of `kds bench`.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/bench/turns.h"

namespace kds::bench {

struct Subject {
  std::string name;   ///< such as settle/facet/linear
  std::string input;  ///< the data it runs on
  std::size_t beads;
  std::string peer;
  /// Goals: the largest permitted time of an item in nanoseconds, or its ratio to the peer's time.
  std::optional<double> most_ns, most_ratio;
  std::function<void(Turns&)> run;
};

/// `instances` is the folder of the moving-point files. Throws InputError if a file is missing.
[[nodiscard]] std::vector<Subject> certificate_subjects(const std::filesystem::path& instances);
[[nodiscard]] std::vector<Subject> slack_subjects();
/// An item is an event. The peer is one static build.
[[nodiscard]] std::vector<Subject> engine_subjects(const std::filesystem::path& instances);

}  // namespace kds::bench
