#pragma once
// How often each structure changed, frame by frame, for other programs to plot; written while the run goes
// on.

#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <string_view>

#include "motions/frames/frame_reader.h"

namespace kds {

/// Header `frame,structure,events,cumulative`, then one line per frame and structure. Frame k, by its number
/// in the file, stands for the time from there to the next frame of the run; events are external ones. Where
/// the file has times, `picoseconds` follows: of frame k.
class EventsCsv {
 public:
  /// Writes the header.
  EventsCsv(std::ostream& stream, bool timed);
  void add(const FrameStamp& frame, std::string_view structure, std::uint64_t events);

 private:
  std::ostream& stream_;
  bool timed_;
  std::map<std::string, std::uint64_t, std::less<>> cumulative_;  ///< of each structure
};

}  // namespace kds
