#include "motions/readers/dcd_layout.h"

#include <fmt/format.h>

#include <algorithm>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

class HeaderReader {
 public:
  explicit HeaderReader(InputFile& input) : file_(input.name()), input_(input) {
    const InputFile::Length length = input.length();
    layout.file_size = length.bytes;
    layout.cut = length.cut;
  }

  void tell_byte_order_and_markers() {
    std::array<char, 12> start{};
    (void)input_.read_at(0, start.data(), std::min<std::uint64_t>(start.size(), layout.file_size));
    input_.seek(0);
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

  // Reads one record and checks its markers.
  std::vector<char> record(const char* what, std::uint64_t most) {
    std::vector<char> marker(layout.marker_size);
    read(marker, what);
    const std::uint64_t size = layout.marker(marker.data());
    if (size > layout.file_size - position())
      throw InputError(
          fmt::format("{}: the file ends inside its {} (a record of {} bytes) and holds no frame", file_,
                      what, layout.with_sign(size)));
    if (size > most)
      throw InputError(fmt::format("{}: the record of the {} holds {} bytes, expected at most {}", file_,
                                   what, size, most));
    std::vector<char> bytes(size);
    read(bytes, what);
    read(marker, what);
    if (layout.marker(marker.data()) != size)
      throw InputError(fmt::format("{}: the record of the {} begins with size {} and ends with {}", file_,
                                   what, size, layout.with_sign(layout.marker(marker.data()))));
    return bytes;
  }

  // Reads the title: the number of its lines, then the lines. Some programs write more lines than the markers
  // say, and then the number of lines tells the size.
  std::vector<char> title() {
    const std::uint64_t begin = position(), text = begin + layout.marker_size;
    std::array<char, 8> start{}, count{}, end{};
    if (input_.read_at(begin, start.data(), layout.marker_size) && input_.read_at(text, count.data(), 4)) {
      const std::uint64_t told = layout.marker(start.data());
      const std::uint64_t size = 4 + std::uint64_t{80} * layout.number<std::uint32_t>(count.data());
      const auto ends_at = [&](std::uint64_t bytes, std::uint64_t marker) {
        return bytes <= most_title && input_.read_at(text + bytes, end.data(), layout.marker_size) &&
               layout.marker(end.data()) == marker;
      };
      if (!ends_at(told, told) && (ends_at(size, told) || ends_at(size, size))) {
        layout.title_note =
            fmt::format("the record of the title tells {} bytes and holds {}; its {} tell the size",
                        layout.with_sign(told), size, counted((size - 4) / 80, "line"));
        std::vector<char> bytes(size);
        static_cast<void>(input_.read_at(text, bytes.data(), size));
        input_.seek(text + size + layout.marker_size);
        return bytes;
      }
    }
    input_.seek(begin);
    return record("title", most_title);
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

  std::uint64_t position() const { return input_.offset(); }

  DcdLayout layout;
  static constexpr std::uint64_t header_bytes = 84;
  static constexpr std::uint64_t most_title = std::uint64_t{1} << 20U;  // lines have 80 characters

 private:
  void read(std::vector<char>& bytes, const char* what) {
    if (bytes.size() > layout.file_size - position() ||
        !input_.read_at(position(), bytes.data(), bytes.size()))
      throw InputError(fmt::format("{}: the file ends inside its {} and holds no frame", file_, what));
  }

  const std::string& file_;
  InputFile& input_;
};

// Returns the free atoms. In the file they are numbered from 1, in ascending order.
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

// Rounds to the precision of a float: 0.02 instead of 0.0199999996.
DcdLayout::Times times_of(std::int32_t first, std::int32_t steps, double picoseconds) {
  const double step = *parse_double(fmt::format("{:.6g}", picoseconds));
  return {step * (static_cast<double>(first) / steps), step};
}

bool is_time(double picoseconds) { return picoseconds >= 1e-6 && picoseconds <= 1e9; }  // false for NaN

// Reads the times of a LAMMPS file. LAMMPS writes the length of a step in the unit of its run without naming
// the unit: femtoseconds (units real, steps of about 1), picoseconds (metal, about 0.001), reduced units (lj,
// about 0.005) or another.
void read_lammps_times(std::int32_t first, std::int32_t steps, double length, DcdLayout& layout) {
  if (first < 0 || steps < 1 || !(length > 0)) return;
  const double picoseconds = steps * length * 1e-3;
  if (length >= 0.2 && length <= 20 && is_time(picoseconds)) {
    layout.times = times_of(first, steps, picoseconds);
    layout.times_note = fmt::format(
        "LAMMPS does not write its unit of time; its step of {:.6g} is taken for femtoseconds "
        "(units real)",
        length);
  } else {
    layout.times_note = fmt::format(
        "LAMMPS does not write its unit of time, and its step of {:.6g} does not show it; frames have "
        "numbers and no times",
        length);
  }
}

// Reads the times from the header, which holds the number of frame 0's step, the steps between frames and the
// length of a step in CHARMM's unit (AKMA). Programs that do not know the times write zeros or ones.
void read_times(const HeaderReader& reader, const std::vector<char>& header, DcdLayout& layout) {
  constexpr double akma = 0.04888821;  // picoseconds
  const std::int32_t first = reader.integer(header, 2), steps = reader.integer(header, 3);
  const char* const field = header.data() + std::size_t{4} * 10;
  const bool by_xplor = reader.integer(header, 20) == 0;
  const double length = by_xplor ? reader.layout.number<double>(field)
                                 : static_cast<double>(reader.layout.number<float>(field));
  if (layout.title.find("LAMMPS") != std::string::npos) {
    read_lammps_times(first, steps, length, layout);
    return;
  }
  if (first < 0 || steps < 1 || (steps == 1 && length == 1)) return;
  const double picoseconds = steps * length * akma;
  if (is_time(picoseconds)) layout.times = times_of(first, steps, picoseconds);
}

}  // namespace

FramesHeld DcdLayout::frames_held() const {
  std::uint64_t left = file_size - frames_begin;
  if (left < frame_size(0)) return {0, cut || left > 0};
  left -= frame_size(0);
  return {static_cast<std::size_t>(1 + left / frame_size(1)), cut || left % frame_size(1) != 0};
}

DcdLayout read_dcd_layout(InputFile& input) {
  const std::string& file = input.name();
  HeaderReader reader(input);
  DcdLayout& layout = reader.layout;
  reader.tell_byte_order_and_markers();

  // The 20 numbers after CORD, counted from 1 with CORD as 0.
  const std::vector<char> header = reader.record_of("header", HeaderReader::header_bytes);
  layout.frames_claimed = reader.integer(header, 1);
  const std::int64_t fixed = reader.integer(header, 9);
  if (reader.integer(header, 20) != 0) {  // 0 means X-PLOR wrote the file, which has no flags here
    layout.has_cell = reader.integer(header, 11) != 0;
    layout.has_fourth = reader.integer(header, 12) != 0;
  }
  layout.version = reader.integer(header, 20);
  const std::vector<char> title = reader.title();
  if (title.size() > 4) layout.title.assign(title.begin() + 4, title.end());  // after the number of lines
  read_times(reader, header, layout);

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
