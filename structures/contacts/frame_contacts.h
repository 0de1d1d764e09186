#pragma once
// The contacts that frames alone would show: at every frame, every second, every fourth, and so on,
// or at several evenly spaced times of each step.
//
// The exact intervals (contact_intervals.h) say at which of the samples a pair is in contact, ends included.
// Contacts are then counted as programs count them that see the samples only:
//
// - plain: a contact is a run of consecutive samples within the inner cutoff;
// - bridged: absences of up to `bridge` samples do not end a contact, which is called intermittency;
// - dual: a contact begins at a sample within the inner cutoff and goes on as long as all samples are within
//   the outer cutoff.
//
// Convention: a contact of n samples has a length of n times the spacing of samples, and an occupancy of n
// divided by the number of samples. Bridged samples count.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "structures/contacts/contact_intervals.h"

namespace kds {

/// Samples of a run, evenly spaced from the first frame on. The spacing is in ticks (ticks_per_frame).
struct ContactSampling {
  std::size_t spacing = ticks_per_frame;
  std::size_t samples = 0;

  [[nodiscard]] double frames_apart() const {
    return static_cast<double>(spacing) / static_cast<double>(ticks_per_frame);
  }
};

class FrameContacts {
 public:
  enum Kind : std::uint8_t { plain, bridged, dual };
  static constexpr std::size_t kinds = 3;

  /// Sums over contacts. For exact contacts, `time` is in units of the clock. For samples, it counts them.
  struct Sums {
    std::uint64_t contacts = 0;
    double time = 0;
  };
  struct Row {
    ContactSampling sampling;
    /// Exact contacts in which a sample lies, within the inner cutoff.
    std::uint64_t found = 0;
    std::array<Sums, kinds> sums;

    /// Returns the mean length in frames, or 0 without contacts. Contacts that the run cuts count as they
    /// are.
    [[nodiscard]] double length(Kind kind) const {
      const Sums& sum = sums[kind];
      return sum.contacts == 0 ? 0 : sum.time / static_cast<double>(sum.contacts) * sampling.frames_apart();
    }
    /// Returns the share of the samples in contact, as the mean of this number of pairs.
    [[nodiscard]] double occupancy(Kind kind, std::size_t pairs) const {
      const double all = static_cast<double>(sampling.samples) * static_cast<double>(pairs);
      return all > 0 ? sums[kind].time / all : 0;
    }
  };

  /// Each spacing is in ticks.
  FrameContacts(std::span<const std::size_t> spacings, std::size_t bridge);

  /// Adds an exact interval within the inner or the outer cutoff, without any gap. Intervals of one pair come
  /// in their order, and inner ones before the outer one that contains them. The listener of the inner cutoff
  /// is therefore registered first. With one cutoff, there are only inner intervals.
  void add_inner(const ContactInterval& interval);
  void add_outer(const ContactInterval& interval);
  /// Ends all contacts, after this number of steps.
  void finish(std::size_t steps);

  /// In the order of the spacings. Complete after finish().
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  /// Returns the sums of the exact contacts: `plain` within the inner cutoff, `dual` with both.
  [[nodiscard]] const Sums& exact(Kind kind) const { return exact_[kind == dual ? 1 : 0]; }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  /// Consecutive samples. Empty if there is no first one.
  struct Run {
    std::size_t first = none, last = 0;
    [[nodiscard]] bool is_empty() const { return first == none; }
  };
  /// A pair, as one row sees it.
  struct Seen {
    Run plain, bridged, outer;
    std::size_t inner = none;    // first sample of `outer` within the inner cutoff
    std::size_t pending = none;  // like `inner`, for an outer run whose end is not known yet
  };
  /// A pair. Its entries of `seen_` begin at `index`.
  struct Pair {
    std::size_t index = 0;
    bool is_inside = false;  // an inner interval belongs to the next outer one
    ContactMoment begin;     // beginning of the first such interval
  };

  [[nodiscard]] static Run samples_in(const ContactInterval& interval, std::size_t spacing);
  Pair& pair_of(const ContactInterval& interval);
  static void extend(Run& run, const Run& by, std::size_t bridge, Sums& sums);
  static void close(Run& run, Sums& sums);
  static void close_outer(Seen& seen, Sums& sums);

  std::size_t bridge_;
  std::vector<Row> rows_;
  std::array<Sums, 2> exact_;
  std::unordered_map<std::uint64_t, Pair> pairs_;
  std::vector<Seen> seen_;
};

}  // namespace kds
