#pragma once
// Follows the contacts of all pairs for `kds contacts`: exactly, and as counted at samples.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/program/contact_options.h"
#include "experiments/program/input_options.h"
#include "experiments/program/live_output.h"
#include "experiments/run/count_crossings.h"
#include "motions/base/bead_groups.h"
#include "motions/scene/scene.h"
#include "structures/contacts/contact_elements.h"
#include "structures/contacts/contact_intervals.h"
#include "structures/contacts/contact_lifetimes.h"
#include "structures/contacts/frame_contacts.h"

namespace kds {

struct ContactsTask : InputOptions {
  /// One or two. A contact begins within the first (inner) distance and ends outside the last (outer) one.
  ContactDistances distances;
  std::optional<BeadId> apart;       ///< empty if not given
  double gap = 0;                    ///< in picoseconds if the frames have times, otherwise in frames
  std::optional<ContactElement> by;  ///< empty if not given
  std::vector<std::size_t> strides;  ///< ascending; empty for the default
  std::size_t intermittency = 1;     ///< samples that an absence may have, for the frame-based figures
  FrameMotion motion = FrameMotion::linear;
  bool certify = false;
  std::optional<std::size_t> threads;  ///< empty for all cores

  [[nodiscard]] bool has_two_cutoffs() const { return distances.lengths.size() == 2; }
};

inline constexpr BeadId default_contacts_apart = 3;

/// Returns the strides that examine at least two of the frames: the given ones, or 1, 2, 4 ... 64. Throws
/// InputError if a given stride examines one frame only.
[[nodiscard]] std::vector<std::size_t> strides_that_fit(const std::vector<std::size_t>& given,
                                                        std::size_t frames, const InputOptions& input);

/// An interval as it is stored for the files of results.
struct IntervalRecord {
  std::uint32_t first = 0, second = 0;                ///< elements
  double begin_frame = 0, end_frame = 0;              ///< in frames of the file, with a fraction
  double begin_picoseconds = 0, end_picoseconds = 0;  ///< 0 if the frames have no times
  double length = 0;                                  ///< in units of the clock
  double begin = 0, end = 0;                          ///< in steps; whole only if exactly at a frame
  bool open_at_start = false, open_at_end = false;
};

[[nodiscard]] IntervalRecord record_of(const ContactInterval& interval);

/// The mean number of contacts in bins of neighbouring steps. If the number of steps is not known in advance,
/// the width of bins doubles when there are too many.
class ContactCourse {
 public:
  static constexpr std::size_t most_bins = 300;

  /// `steps` is the number of steps, or empty if it is not known yet.
  explicit ContactCourse(std::optional<std::size_t> steps);
  /// Adds the next frame of the run, counted from 0.
  void add_frame(std::size_t frame, const Scene& scene);
  /// Adds a contact. Times count steps.
  void add(double begin, double end);
  /// Sets the number of steps. Call it before contacts are added that are open at the last frame.
  void end(std::size_t steps) { steps_ = steps; }
  /// Returns the mean of each bin, after `end` if the number of steps was not known. The last bin may have
  /// fewer steps than others.
  [[nodiscard]] std::vector<double> means() const;
  /// Returns the first frame of each bin. The list may end with the last frame of the run, which begins no
  /// bin.
  [[nodiscard]] const std::vector<FrameStamp>& first_frames() const { return first_frames_; }

 private:
  void double_width();

  std::optional<std::size_t> steps_;
  std::size_t width_;
  std::vector<FrameStamp> first_frames_;
  // For each bin: the time in it of contacts that begin or end in it; and how many contacts begin to cover
  // whole bins there, minus those that stop covering them.
  std::vector<double> partial_, begun_;
};

struct ContactsReport {
  /// `step_count` is empty if the number of steps is not known yet.
  explicit ContactsReport(std::optional<std::size_t> step_count) : course(step_count) {}

  ContactElement by = ContactElement::bead;
  ContactElements elements;
  BeadId apart = default_contacts_apart;
  bool has_two_cutoffs = false;
  ContactClock clock = ContactClock::frames;
  double run_length = 0;  ///< in units of the clock
  std::size_t steps = 0;
  std::size_t first_frame = 0, last_frame = 0;
  std::uint64_t pairs_asked = 0;  ///< pairs of elements that could be in contact
  ContactLifetimes lifetimes;
  std::optional<FrameContacts> frames;
  std::vector<IntervalRecord> intervals;  ///< in the order of their ends
  ContactCourse course;
  std::optional<CrossingCounts> crossings;  ///< of bonds, if the scene has any
  std::optional<LiveRun> live;              ///< only if the input is a running simulation

  [[nodiscard]] bool has_times() const { return clock == ContactClock::picoseconds; }
  [[nodiscard]] std::string unit() const { return has_times() ? "ps" : "frames"; }
  [[nodiscard]] std::string one_unit() const { return has_times() ? "ps" : "frame"; }
};

/// A radius for each bead: two balls meet while their beads are within the inner or the outer cutoff.
struct CutoffRadii {
  std::vector<double> inner;
  std::vector<double> outer;  ///< empty unless there are two cutoffs
};
/// Returns the radii for the task's cutoffs.
[[nodiscard]] CutoffRadii radii_of(const ContactsTask& task, const Scene& scene);

/// Follows the contacts by the rule of the task once more, with other radii or groups. `report` comes from
/// follow_contacts. `sink` receives intervals in the order of ContactIntervals. `inner_sink`, if not null,
/// receives intervals within the inner cutoff, without any gap.
void follow_again(const ContactsTask& task, const Scene& scene, const ContactsReport& report,
                  const CutoffRadii& radii, const BeadGroups& groups, const ContactIntervals::Sink& sink,
                  const ContactIntervals::Sink& inner_sink,
                  const std::function<void(std::size_t frame)>& at_frame);

/// Follows the contacts over all frames of the scene. Throws InputError for faults of the input. `progress`
/// gets the total 0 if the number of steps is unknown.
[[nodiscard]] std::unique_ptr<ContactsReport> follow_contacts(
    const ContactsTask& task, const Scene& scene,
    const std::function<void(std::size_t done, std::size_t total)>& progress,
    const LiveHooks<ContactsReport>& hooks = {});

}  // namespace kds
