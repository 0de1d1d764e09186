#pragma once
// The contact map: the share of the time that each pair is in contact.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/events/event_files.h"
#include "kds/event_log.h"

namespace kds {

struct PairOccupancy {
  std::size_t first = 0, second = 0;  ///< beads, residues or chains; `first` is the smaller
  double occupancy = 0;               ///< share of the time in contact, 0 to 1
};

/// Measures how long the pairs of beads of the structure `contacts` are in contact, counted in frames of the
/// file. Call `add_built` once when the structures have been built. Memory grows with the number of pairs.
class ContactOccupancy final : public ContactsCsv {
 public:
  /// Returns the pairs that are ever in contact, ascending. A pair that only touches has occupancy 0. The run
  /// leads from frame `first` to frame `last`; these are numbers in the file, `first` is the smaller.
  [[nodiscard]] std::vector<PairOccupancy> pairs(double first, double last) const;
  [[nodiscard]] bool prints_time_of(const Event& event) const override { return is_of_contact(event); }

 private:
  void add(const Event& event, std::string_view kind) override;

  std::map<std::pair<BeadId, BeadId>, double> lengths_;  // sums over a pair's contacts that have ended
  std::map<std::pair<BeadId, BeadId>, double> open_;     // frames at which the others began
};

/// Returns the map of these pairs as SVG. `names` are shown under the pointer, and at the ticks if they are
/// short enough. `label` says what they name, such as residue. Squares are blocks that show the largest
/// occupancy within if there are more names than `most_names`, or too many pairs.
[[nodiscard]] std::string contact_map(const std::string& label, const std::vector<std::string>& names,
                                      const std::vector<PairOccupancy>& pairs, std::size_t most_names);

}  // namespace kds
