#include "motions/frames/frame_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

std::string where_it_ends(const std::string& file, const FramesHeld& held) {
  const std::string bytes = held.end > 0 ? fmt::format(" (after {} bytes)", held.end) : "";
  const char* const line_end =
      held.lacks_line_end ? "; its last number may be cut off, expected a line end after it" : "";
  if (held.whole == 0)
    return fmt::format("{}: the file ends inside frame 0{} and holds no whole frame{}", file, bytes,
                       line_end);
  return fmt::format("{}: the file ends inside frame {}{}; the last whole frame is {}{}", file, held.whole,
                     bytes, held.whole - 1, line_end);
}

}  // namespace

DamagedFrame::DamagedFrame(const std::string& file, std::size_t frame, std::uint64_t byte,
                           const std::string& what)
    : InputError(fmt::format("{}: frame {}, byte {}: {}", file, frame, byte, what)), frame_(frame) {}

FrameRange parse_frame_range(std::string_view text) {
  const auto refuse = [&](std::string_view why) {
    return InputError(
        frames_argument(),
        fmt::format("{} in {}, expected FIRST:LAST:STRIDE (whole numbers from 0, each may be left out)", why,
                    in_quotes(text)));
  };
  std::vector<std::string_view> parts;
  for (std::string_view rest = text;;) {
    const std::size_t colon = rest.find(':');
    parts.push_back(rest.substr(0, colon));
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (parts.size() == 1) throw refuse("no colon");
  if (parts.size() > 3) throw refuse("too many colons");
  const auto number = [&](std::size_t i) -> std::optional<std::size_t> {
    if (i >= parts.size() || parts[i].empty()) return std::nullopt;
    const auto value = parse_count(parts[i]);
    if (!value) throw refuse(fmt::format("{} is no whole number", in_quotes(parts[i])));
    return value;
  };
  const FrameRange range{number(0).value_or(0), number(1), number(2).value_or(1)};
  if (range.stride == 0) throw refuse("a stride of 0");
  if (range.last && *range.last <= range.first) throw refuse("no frame");
  return range;
}

std::string warning_of(const DamagedFrame& damage) {
  return fmt::format("{}; frames up to {} are read ({})", damage.what(), damage.frame() - 1,
                     "--until-damage"_arg);
}

FramesAsked select_frames(const std::string& file, const FrameRange& range, const FramesHeld& held,
                          bool until_damage, std::vector<std::string>& warnings) {
  if (range.stride == 0) throw InputError(frames_argument(), "the stride must be at least 1");
  if (range.last && *range.last <= range.first)
    throw InputError(frames_argument(), fmt::format("no frame lies in {}:{}", range.first, *range.last));
  if (held.open) {
    const std::size_t end = range.last.value_or(std::numeric_limits<std::size_t>::max());
    return {range.first, range.stride, 1 + (end - 1 - range.first) / range.stride};
  }
  const std::size_t last = range.last.value_or(held.whole);
  const bool meets_damage = held.damage && (!range.last || last > held.whole);
  if (meets_damage) {
    if (held.whole == 0 || !until_damage) throw DamagedFrame(*held.damage);
    warnings.push_back(warning_of(*held.damage));
  }
  if (held.ends_inside) {
    const std::string message = where_it_ends(file, held);
    if (held.whole == 0) throw InputError(message);
    warnings.push_back(message);
  }
  if (held.whole == 0) throw InputError(fmt::format("{}: the file holds no frame", file));
  if (held.whole == 1 && !held.ends_inside && !held.damage)
    return {0, 1, 1, false, true};  // a file of a single frame ignores the range
  if (range.first >= held.whole)
    throw InputError(frames_argument(), fmt::format("frame {} is asked for, {} holds {}", range.first, file,
                                                    counted(held.whole, "frame")));
  if (last > held.whole && !(held.damage && until_damage))
    throw InputError(frames_argument(), fmt::format("frames up to {} are asked for, {} holds {}", last - 1,
                                                    file, counted(held.whole, "frame")));
  const std::size_t end = std::min(last, held.whole);
  const FramesAsked frames{range.first, range.stride, 1 + (end - 1 - range.first) / range.stride,
                           held.ends_inside || meets_damage};
  const std::size_t final = frames[frames.count - 1];
  if (const std::size_t behind = end - 1 - final; behind > 0)
    warnings.push_back(fmt::format("{}: a stride of {} ends at frame {}; {} after it {} left out", file,
                                   range.stride, final, counted(behind, "frame"),
                                   behind == 1 ? "is" : "are"));
  return frames;
}

}  // namespace kds
