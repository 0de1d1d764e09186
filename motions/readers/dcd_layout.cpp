#include "motions/readers/dcd_layout.h"

#include <fmt/format.h>

#include <algorithm>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

class HeaderReader {
 public:
  HeaderReader(const std::string& file, std::ifstream& stream) : file_(file), stream_(stream) {
    stream_.seekg(0, std::ios::end);
    layout.file_size = static_cast<std::uint64_t>(std::max<std::streamoff>(stream_.tellg(), 0));
    stream_.seekg(0);
  }

  void tell_byte_order_and_markers() {
    std::array<char, 12> start{};
    stream_.read(start.data(), start.size());
    stream_.clear();
    stream_.seekg(0);
    for (const std::size_t marker_size : {4U, 8U})
      for (const bool swapped : {false, true}) {
        layout.marker_size = marker_size;
        layout.swapped = swapped;
        const std::string_view magic(start.data() + marker_size, 4);
        if (layout.marker(start.data()) != header_bytes) continue;
        if (magic == "CORD") return;
        if (magic == "VELD")
          throw InputError(fmt::format("{}: this DCD file holds velocities, expected coordinates", file_));
      }
    throw InputError(fmt::format("{}: this is no DCD file (it does not begin with an {}-byte record CORD)",
                                 file_, header_bytes));
  }

  // One record, its markers checked.
  std::vector<char> record(const char* what, std::uint64_t most) {
    std::vector<char> marker(layout.marker_size);
    read(marker, what);
    const std::uint64_t size = layout.marker(marker.data());
    if (size > layout.file_size - position())
      throw InputError(fmt::format(
          "{}: the file ends inside its {} (a record of {} bytes) and holds no frame", file_, what, size));
    if (size > most)
      throw InputError(fmt::format("{}: the record of the {} holds {} bytes, expected at most {}", file_,
                                   what, size, most));
    std::vector<char> bytes(size);
    read(bytes, what);
    read(marker, what);
    if (layout.marker(marker.data()) != size)
      throw InputError(fmt::format("{}: the record of the {} begins with size {} and ends with {}", file_,
                                   what, size, layout.marker(marker.data())));
    return bytes;
  }

  std::vector<char> record_of(const char* what, std::uint64_t size) {
    std::vector<char> bytes = record(what, std::max(size, most_title));
    if (bytes.size() != size)
      throw InputError(fmt::format("{}: the record of the {} holds {} bytes, expected {}", file_, what,
                                   bytes.size(), size));
    return bytes;
  }

  std::int32_t integer(const std::vector<char>& bytes, std::size_t k) const {
    return layout.number<std::int32_t>(bytes.data() + 4 * k);
  }

  std::uint64_t position() const { return static_cast<std::uint64_t>(stream_.tellg()); }

  DcdLayout layout;
  static constexpr std::uint64_t header_bytes = 84;
  static constexpr std::uint64_t most_title = std::uint64_t{1} << 20U;  // lines of 80 characters

 private:
  void read(std::vector<char>& bytes, const char* what) {
    stream_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream_)
      throw InputError(fmt::format("{}: the file ends inside its {} and holds no frame", file_, what));
  }

  const std::string& file_;
  std::ifstream& stream_;
};

// Atoms are numbered from 1 in the file, in ascending order.
std::vector<std::uint32_t> free_atoms(const std::string& file, const HeaderReader& reader,
                                      const std::vector<char>& bytes) {
  std::vector<std::uint32_t> atoms;
  std::int64_t before = 0;
  for (std::size_t i = 0; i < bytes.size() / 4; ++i) {
    const std::int64_t atom = reader.integer(bytes, i);
    if (atom <= before || static_cast<std::uint64_t>(atom) > reader.layout.atom_count)
      throw InputError(
          fmt::format("{}: the list of free atoms names atom {} after {}, expected ascending numbers "
                      "up to {}",
                      file, atom, before, reader.layout.atom_count));
    atoms.push_back(static_cast<std::uint32_t>(atom - 1));
    before = atom;
  }
  return atoms;
}

// The header holds the number of frame 0's step, the steps between frames and the length of a step in the
// unit of CHARMM (AKMA). Programs that do not know the times leave zeros or ones there.
std::optional<DcdLayout::Times> frame_times(const HeaderReader& reader, const std::vector<char>& header) {
  constexpr double akma = 0.04888821;  // picoseconds
  const std::int32_t first = reader.integer(header, 2), steps = reader.integer(header, 3);
  const char* const place = header.data() + std::size_t{4} * 10;
  const bool by_xplor = reader.integer(header, 20) == 0;
  const double length = by_xplor ? reader.layout.number<double>(place)
                                 : static_cast<double>(reader.layout.number<float>(place));
  if (first < 0 || steps < 1 || (steps == 1 && length == 1)) return std::nullopt;
  const double picoseconds = steps * length * akma;
  if (!(picoseconds >= 1e-6 && picoseconds <= 1e9)) return std::nullopt;  // NaN neither
  // As many digits as a float has: 0.02 and not 0.0199999996.
  const double step = *parse_double(fmt::format("{:.6g}", picoseconds));
  return DcdLayout::Times{step * (static_cast<double>(first) / steps), step};
}

}  // namespace

FramesHeld DcdLayout::frames_held() const {
  std::uint64_t left = file_size - frames_begin;
  if (left < frame_size(0)) return {0, left > 0};
  left -= frame_size(0);
  return {static_cast<std::size_t>(1 + left / frame_size(1)), left % frame_size(1) != 0};
}

DcdLayout read_dcd_layout(const std::string& file, std::ifstream& stream) {
  HeaderReader reader(file, stream);
  DcdLayout& layout = reader.layout;
  reader.tell_byte_order_and_markers();

  // The 20 numbers behind CORD, counted from 1 with CORD as 0.
  const std::vector<char> header = reader.record_of("header", HeaderReader::header_bytes);
  layout.frames_claimed = reader.integer(header, 1);
  const std::int64_t fixed = reader.integer(header, 9);
  if (reader.integer(header, 20) != 0) {  // written by X-PLOR where 0: no flags there
    layout.has_cell = reader.integer(header, 11) != 0;
    layout.has_fourth = reader.integer(header, 12) != 0;
  }
  layout.times = frame_times(reader, header);
  (void)reader.record("title", HeaderReader::most_title);

  const std::int64_t atoms = reader.integer(reader.record_of("number of atoms", 4), 0);
  if (atoms <= 0)
    throw InputError(fmt::format("{}: the header says {} atoms, expected at least 1", file, atoms));
  layout.atom_count = static_cast<std::uint64_t>(atoms);
  if (fixed < 0 || fixed >= atoms)
    throw InputError(fmt::format("{}: the header says {} of {} atoms are fixed, expected some free ones",
                                 file, fixed, atoms));
  if (fixed > 0) {
    const auto bytes = reader.record_of("list of free atoms", 4 * static_cast<std::uint64_t>(atoms - fixed));
    layout.free_atoms = free_atoms(file, reader, bytes);
  }
  layout.frames_begin = reader.position();
  return layout;
}

}  // namespace kds
