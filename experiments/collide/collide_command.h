#pragma once
// The options of `kds collide` and their parser.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/program/input_options.h"
#include "motions/base/bead.h"

namespace kds {

enum class WhichPairs : std::uint8_t { all, within, between };
/// The names of the enumerators in order.
inline constexpr std::array<std::string_view, 3> which_pairs_names{"all", "within", "between"};
[[nodiscard]] constexpr std::string_view name_of(WhichPairs pairs) {
  return which_pairs_names[static_cast<std::size_t>(pairs)];
}

struct CollideOptions : InputOptions {
  std::vector<std::string> methods;  ///< in the order of all methods
  bool all_methods = true;           ///< true unless the user named methods
  WhichPairs pairs = WhichPairs::all;
  BeadId apart = 2;
  double within = 0;       ///< pairs with at most this distance are reported
  std::size_t rounds = 3;  ///< timed repetitions of each method in each frame
  Destinations destinations;
};

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] CollideOptions parse_collide_options(const Arguments& arguments);

class CollideFrames;  // compare_detectors.h
struct CollideTask;
/// Returns the methods and pairs that the options ask for. Throws InputError if they ask for pairs between
/// necklaces and there is only one.
[[nodiscard]] CollideTask collide_task(const CollideOptions& options, const CollideFrames& frames);

}  // namespace kds
