#pragma once
// What is measured about certificates and whole runs, a subject each: by kds_benchmarks, and by `kds bench`.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/bench/turns.h"

namespace kds::bench {

struct Subject {
  std::string name;   ///< as in settle/facet/linear
  std::string input;  ///< what it runs on
  std::size_t beads;
  std::string peer;
  /// What the time of an item, in nanoseconds, or its ratio to the peer's is asked to be at most.
  std::optional<double> most_ns, most_ratio;
  std::function<void(Turns&)> run;
};

/// `instances`: the folder of the moving-point files. Throws InputError where one is missing.
[[nodiscard]] std::vector<Subject> certificate_subjects(const std::filesystem::path& instances);
[[nodiscard]] std::vector<Subject> slack_subjects();
/// An item is an event; the peer builds once.
[[nodiscard]] std::vector<Subject> engine_subjects(const std::filesystem::path& instances);

}  // namespace kds::bench
