#pragma once
// Writes how often each structure changed, frame by frame, during the run. Other programs can plot the file.

#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <string_view>

#include "motions/frames/frame_reader.h"

namespace kds {

/// Writes the header `frame,structure,events,cumulative`, then one line per frame and structure. Only
/// external events count. A line with frame k (its number in the file) covers the time from frame k to the
/// next frame of the run. If the file has times, the column `picoseconds` follows with the time of frame k.
class EventsCsv {
 public:
  /// Writes the header.
  EventsCsv(std::ostream& stream, bool timed);
  void add(const FrameStamp& frame, std::string_view structure, std::uint64_t events);

 private:
  std::ostream& stream_;
  bool timed_;
  std::map<std::string, std::uint64_t, std::less<>> cumulative_;  ///< per structure
};

}  // namespace kds
