#pragma once
// What one run found out: the numbers behind the table, summary.json, events.csv and the plots.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/events/closest_approach.h"
#include "experiments/events/displacements.h"
#include "experiments/events/event_bins.h"
#include "experiments/events/event_places.h"
#include "experiments/program/timing.h"
#include "experiments/run/certify_stride.h"
#include "motions/frames/frame_reader.h"

namespace kds {

using NamedCounts = std::vector<std::pair<std::string, std::uint64_t>>;  ///< in the order to print

struct StructureReport {
  std::string name;                ///< sorted, wrapped, power
  std::uint64_t events_total = 0;  ///< external events
  NamedCounts events_by_kind;      ///< external kinds first, then internal ones, which the total leaves out
  std::optional<std::uint64_t> contacts_at_start, contacts_at_end;  ///< pairs of beads
  std::vector<std::string> internal_kinds;                          ///< which of these are internal
  EventCourse course;                                               ///< external events, step by step
  std::uint64_t created = 0, never_failing = 0, cancelled = 0, failed = 0, touched = 0, peak = 0,
                per_bead_max = 0;
  NamedCounts stages;  ///< how many certificates each stage of the cascade settled
  double seconds = 0;  ///< on this structure and its certificates after the first build
  double build_seconds = 0;
  double static_seconds = 0;             ///< building the same structure statically at every frame (CGAL)
  Spread of_seconds, of_static_seconds;  ///< both of the rounds, of which they are the medians
  Spread of_ratio;                       ///< the first by the second, round by round; 0 where that is 0
  std::uint64_t rebuilds = 0;
  std::uint64_t audits_run = 0, audits_failed = 0;
  PlacesOfEvents places;  ///< where these are looked at, else empty

  /// "overtake (internal)"; of other kinds their names.
  [[nodiscard]] std::string label_of(const std::string& kind) const;
};

struct RunReport {
  std::vector<std::string> files;
  std::uint64_t beads = 0, frames = 0;
  std::optional<FrameStamp> first_frame, last_frame;  ///< where they are in the file, and times
  int dimension = 3;
  double radius_min = 0, radius_max = 0;
  std::vector<std::pair<std::string, std::string>>
      settings;  ///< motion, kernel, audit, select, chain, frames, radius, ...
  std::vector<StructureReport> structures;
  std::size_t rounds = 1;                   ///< that times are of
  double engine_seconds = 0;                ///< queue and clock
  double listeners_seconds = 0;             ///< writing and counting events
  NamedCounts comparisons;                  ///< of failure times whose brackets overlap, by what settled them
  std::uint64_t exact_work = 0;             ///< limb operations of exact arithmetic
  std::uint64_t fingerprint = 0;            ///< printed as 16 hex digits
  std::optional<StrideCertificate> stride;  ///< of --certify
  std::optional<ClosestApproach> approach;  ///< where the run has the closest pair, not with `fast`
  /// The least distance there: with --certify, or with --tolerance where no frame is left out.
  std::optional<DistanceRange> approach_in_all_frames;
  std::string command_line;             ///< that asks for the same run, without outputs
  Displacements displacement;           ///< where it is looked at, else empty
  std::vector<std::string> bead_names;  ///< where they are looked at, else empty; empty ones where unknown
};

}  // namespace kds
