#include "motions/readers/xtc_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/xdr.h"

namespace kds {

namespace {

__extension__ using XtcWide = unsigned __int128;

constexpr std::int32_t xtc_magic = 1995, xtc_magic_long = 2023;
constexpr std::size_t xtc_most_plain = 9;  // atoms whose coordinates are not packed

// Sizes of differences, from index 9 of the table on. The cube of a size has as many bits as its index says.
constexpr std::size_t xtc_first_small = 9;
constexpr std::array<std::uint32_t, 64> xtc_small_sizes{
    8,       10,      12,      16,      20,      25,      32,       40,       50,      64,      80,
    101,     128,     161,     203,     256,     322,     406,      512,      645,     812,     1024,
    1290,    1625,    2048,    2580,    3250,    4096,    5060,     6501,     8192,    10321,   13003,
    16384,   20642,   26007,   32768,   41285,   52015,   65536,    82570,    104031,  131072,  165140,
    208063,  262144,  330280,  416127,  524287,  660561,  832255,   1048576,  1321122, 1664510, 2097152,
    2642245, 3329021, 4194304, 5284491, 6658042, 8388607, 10568983, 13316085, 16777216};
constexpr std::size_t xtc_end_small = xtc_first_small + xtc_small_sizes.size();

// Divides by a constant with one multiplication. The inverse is too small by less than 1, so the estimate of
// the quotient is too small by at most 1.
class XtcDivisor {
 public:
  constexpr explicit XtcDivisor(std::uint32_t divisor)
      : divisor_(divisor), inverse_(std::numeric_limits<std::uint64_t>::max() / divisor) {}

  // Replaces the number by its quotient, and returns the remainder.
  std::uint32_t divide(std::uint64_t& number) const {
    auto quotient = static_cast<std::uint64_t>((static_cast<XtcWide>(number) * inverse_) >> 64U);
    std::uint64_t rest = number - quotient * divisor_;
    if (rest >= divisor_) {
      rest -= divisor_;
      ++quotient;
    }
    number = quotient;
    return static_cast<std::uint32_t>(rest);
  }
  std::uint32_t divide(XtcWide& number) const {
    const auto rest = static_cast<std::uint32_t>(number % divisor_);
    number /= divisor_;
    return rest;
  }

 private:
  std::uint64_t divisor_, inverse_;
};

// Three numbers that are packed into one of `bits` bits.
struct XtcRadix {
  unsigned bits;
  XtcDivisor y, z;
};

const std::vector<XtcRadix>& xtc_small_radices() {
  static const std::vector<XtcRadix> all = [] {
    std::vector<XtcRadix> radices;
    for (const std::uint32_t size : xtc_small_sizes)
      radices.push_back(
          {static_cast<unsigned>(xtc_first_small + radices.size()), XtcDivisor(size), XtcDivisor(size)});
    return radices;
  }();
  return all;
}

struct XtcHeader {
  std::uint64_t begin = 0;  // where the frame begins in the file
  std::size_t size = 0;     // the header's size
  std::size_t atoms = 0;
  float time = 0;
  CellRead cell;
  std::uint64_t data = 0;  // bytes of the coordinates
  float precision = 0;
  std::array<std::int32_t, 3> least{};   // the least of all coordinates
  std::array<std::uint32_t, 3> sizes{};  // one more than the difference of the largest and the least
  std::size_t small = 0;                 // index in the table of sizes, at the first atom

  static constexpr std::size_t most_size = 96;
  [[nodiscard]] std::uint64_t end() const { return begin + size + (data + 3) / 4 * 4; }
};

// The packed coordinates of one frame.
class XtcBits {
 public:
  XtcBits(InputFile& input, std::vector<char>& bytes) : input_(input), bytes_(bytes) {}

  // Goes to the frame's coordinates. Reads their bytes at once if all atoms are wanted, else block by block.
  void open(const XtcHeader& header, bool all) {
    header_ = &header;
    offset_ = loaded_ = 0;
    block_ = all ? header.data : std::uint64_t{1} << 16U;
    if (bytes_.size() < header.data + most_group) bytes_.resize(header.data + most_group);
  }

  // Reads the bits of the next group. Bits past the end of the coordinates are any bits, but never past the
  // end of the memory. Returns false if the group before used such bits.
  [[nodiscard]] bool begin_group() {
    if (offset_ > 8 * header_->data) return false;
    while (loaded_ < header_->data && offset_ / 8 + most_group > loaded_) {
      const std::uint64_t more = std::min(block_, header_->data - loaded_);
      if (!input_.read_at(header_->begin + header_->size + loaded_, bytes_.data() + loaded_, more))
        throw InputError(fmt::format("{}: cannot read the file at byte {}", input_.name(),
                                     header_->begin + header_->size + loaded_));
      loaded_ += more;
      block_ *= 2;
    }
    return true;
  }

  // Returns the next bits, at most 56.
  std::uint64_t read(unsigned bits) {
    const auto word = xdr_number<std::uint64_t>(bytes_.data() + offset_ / 8) << (offset_ % 8);
    offset_ += bits;
    return bits == 0 ? 0 : word >> (64 - bits);
  }

  // Returns three packed numbers. Only the first can exceed its size, and only if the bits are damaged.
  std::array<std::uint64_t, 3> read(const XtcRadix& radix) {
    if (radix.bits <= 64) return unpack(read_whole(radix.bits), radix);
    const XtcWide low = read_whole(64);
    return unpack(low | static_cast<XtcWide>(read(radix.bits - 64)) << 64U, radix);
  }

  [[nodiscard]] std::uint64_t bytes_used() const { return (offset_ + 7) / 8; }

 private:
  // A group has at most 11 atoms of 96 bits each and 6 bits more; a read looks at 8 bytes.
  static constexpr std::uint64_t most_group = 160;

  // Returns a number of at most 64 bits: whole bytes with the lowest first, then the remaining 1 to 8 bits.
  std::uint64_t read_whole(unsigned bits) {
    const unsigned lower = (bits - 1) / 8 * 8;
    std::uint64_t number = 0;
    if (lower > 0) number = __builtin_bswap64(read(lower) << (64 - lower));
    return number | read(bits - lower) << lower;
  }

  template <class Number>
  static std::array<std::uint64_t, 3> unpack(Number number, const XtcRadix& radix) {
    const std::uint32_t z = radix.z.divide(number);
    const std::uint32_t y = radix.y.divide(number);
    return {static_cast<std::uint64_t>(number), y, z};
  }

  InputFile& input_;
  std::vector<char>& bytes_;
  const XtcHeader* header_ = nullptr;
  std::uint64_t offset_ = 0;  // in bits
  std::uint64_t loaded_ = 0;  // bytes
  std::uint64_t block_ = 0;   // bytes to read next
};

// The coordinates of one frame, in nanometres.
class XtcCoordinates {
 public:
  explicit XtcCoordinates(InputFile& input) : input_(input), bits_(input, bytes_) {}

  // Decodes the first `wanted` atoms.
  void decode(std::size_t frame, const XtcHeader& header, std::size_t wanted) {
    const std::size_t room = 3 * (wanted + most_run + 1);
    if (floats_.size() < room) floats_.resize(room);
    if (header.atoms <= xtc_most_plain) {
      read_plain(header);
      return;
    }
    const std::string fault = unpack(header, wanted);
    if (!fault.empty()) throw DamagedFrame(input_.name(), frame, header.begin + header.size, fault);
  }

  // The coordinates of the i-th atom.
  [[nodiscard]] const float* operator[](std::size_t i) const { return floats_.data() + 3 * i; }

 private:
  using Offset = std::array<std::uint32_t, 3>;  // from the least coordinates, modulo 2^32
  static constexpr std::size_t most_run = 10;   // atoms

  void read_plain(const XtcHeader& header) {
    std::array<char, 12 * xtc_most_plain> bytes;
    if (!input_.read_at(header.begin + header.size, bytes.data(), header.data))
      throw InputError(
          fmt::format("{}: cannot read the file at byte {}", input_.name(), header.begin + header.size));
    for (std::size_t i = 0; i < header.data / 4; ++i) floats_[i] = xdr_number<float>(bytes.data() + 4 * i);
  }

  // Returns a description of the damage, empty if there is none.
  std::string unpack(const XtcHeader& header, std::size_t wanted) {
    const auto [sx, sy, sz] = header.sizes;
    const bool together = (sx | sy | sz) <= 0xFFFFFF;
    const XtcRadix whole{together ? bit_width(XtcWide{sx} * sy * sz) : 0, XtcDivisor(sy), XtcDivisor(sz)};
    const std::vector<XtcRadix>& radices = xtc_small_radices();
    const float inverse = 1.0F / header.precision;
    float* to = floats_.data();
    bool outside = false;
    const auto put = [&](const Offset& offset) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        outside |= offset[axis] >= header.sizes[axis];
        const auto integer =
            static_cast<std::int32_t>(static_cast<std::uint32_t>(header.least[axis]) + offset[axis]);
        *to++ = static_cast<float>(integer) * inverse;
      }
    };

    bits_.open(header, wanted == header.atoms);
    std::size_t small = header.small, run = 0;
    for (std::size_t i = 0; i < wanted;) {
      if (!bits_.begin_group()) break;
      Offset last;
      if (together) {
        const auto [x, y, z] = bits_.read(whole);
        outside |= x >= sx;
        last = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)};
      } else {
        for (std::size_t axis = 0; axis < 3; ++axis)
          last[axis] = static_cast<std::uint32_t>(
              bits_.read(static_cast<unsigned>(std::bit_width(header.sizes[axis]))));
      }
      ++i;
      std::size_t change = 1;  // the step in the table: one back, none, one on
      if (bits_.read(1) != 0) {
        const std::uint64_t told = bits_.read(5);
        run = told / 3;
        change = told % 3;
      }
      if (run == 0) {
        put(last);
      } else {
        if (run > header.atoms - i)
          return fmt::format("expected at most {} after atom {}, found a run of {}",
                             counted(header.atoms - i, "atom"), i - 1, run);
        if (small >= xtc_end_small)
          return fmt::format("expected differences of at most {} bits, found {}", xtc_end_small - 1, small);
        const std::uint32_t size = xtc_small_sizes[small - xtc_first_small];
        const XtcRadix& radix = radices[small - xtc_first_small];
        const Offset first = last;
        for (std::size_t k = 0; k < run; ++k) {
          const auto steps = bits_.read(radix);
          outside |= steps[0] >= size;
          Offset next;
          for (std::size_t axis = 0; axis < 3; ++axis)
            next[axis] = last[axis] + static_cast<std::uint32_t>(steps[axis]) - size / 2;
          put(next);
          if (k == 0) put(first);
          last = next;
        }
        i += run;
      }
      if (outside)
        return fmt::format("expected coordinates within the bounds of the frame, found others before atom {}",
                           i);
      small += change - 1;
      if (small < xtc_first_small || small > xtc_end_small)
        return fmt::format("expected differences of {} to {} bits, found {}", xtc_first_small,
                           xtc_end_small - 1, small);
    }
    const std::uint64_t used = bits_.bytes_used();
    if (used > header.data || (wanted == header.atoms && used != header.data))
      return fmt::format("expected coordinates in {}, found them in {}{}", counted(header.data, "byte"),
                         used > header.data ? "at least " : "", used);
    return {};
  }

  static unsigned bit_width(XtcWide number) {
    const auto high = static_cast<std::uint64_t>(number >> 64U);
    return static_cast<unsigned>(high > 0 ? 64 + std::bit_width(high)
                                          : std::bit_width(static_cast<std::uint64_t>(number)));
  }

  InputFile& input_;
  std::vector<char> bytes_;
  XtcBits bits_;
  std::vector<float> floats_;
};

class XtcFrames final : public AtomFrames {
 public:
  explicit XtcFrames(const std::filesystem::path& path) : input_(path), coordinates_(input_) {
    const InputFile::Length length = input_.length();
    length_ = length.bytes;
    held_.end = length_;
    count_frames();
    held_.ends_inside |= length.cut;
  }

  [[nodiscard]] std::size_t atom_count() const override { return begins_.empty() ? 0 : atoms_; }
  [[nodiscard]] FramesHeld held() const override { return held_; }
  [[nodiscard]] bool may_have_cell() const override { return true; }

  void read(std::size_t k, std::span<const std::size_t> atoms, FrameRead& frame) override {
    const std::optional<XtcHeader> header = read_header(k, begins_.at(k));
    if (!header) throw InputError(fmt::format("{}: frame {}: the file has become shorter", input_.name(), k));
    frame.stamp = {k, xdr_time(header->time)};
    frame.cell = header->cell.cell;
    frame.cell_doubt = header->cell.doubt;
    if (!frame.asked && !frame.cell) return;
    const std::size_t wanted = atoms.empty() ? 0 : 1 + *std::ranges::max_element(atoms);
    coordinates_.decode(k, *header, wanted);
    frame.positions.resize(3, static_cast<Eigen::Index>(atoms.size()));
    double* to = frame.positions.data();
    for (const std::size_t atom : atoms) {
      const float* const from = coordinates_[atom];
      for (std::size_t axis = 0; axis < 3; ++axis) *to++ = angstrom_of_nanometres(from[axis]);
    }
  }

 private:
  void count_frames() try {
    for (std::uint64_t begin = 0; begin < length_;) {
      const std::optional<XtcHeader> header = read_header(begins_.size(), begin);
      if (!header || header->end() > length_) {
        if (header) refuse_frame_inside(*header);
        held_.ends_inside = true;
        break;
      }
      atoms_ = header->atoms;
      begins_.push_back(begin);
      begin = header->end();
    }
    held_.whole = begins_.size();
  } catch (const DamagedFrame& damage) {
    held_.whole = begins_.size();
    held_.damage = damage;
  }

  // Reads and checks a header. Returns nothing if the file ends inside the header.
  std::optional<XtcHeader> read_header(std::size_t frame, std::uint64_t begin) {
    std::array<char, XtcHeader::most_size> bytes{};
    const std::uint64_t left = length_ - begin;
    if (!input_.read_at(begin, bytes.data(), std::min<std::uint64_t>(left, bytes.size())))
      return std::nullopt;
    const auto integer = [&](std::size_t offset) { return xdr_number<std::int32_t>(bytes.data() + offset); };
    const auto check = [&](bool good, std::size_t offset, const auto& expected, const auto& found) {
      if (!good)
        throw DamagedFrame(input_.name(), frame, begin + offset,
                           fmt::format("expected {}, found {}", expected, found));
    };
    if (left < 4) return std::nullopt;
    const std::int32_t magic = integer(0);
    check(magic == xtc_magic || magic == xtc_magic_long, 0, "1995 or 2023, the numbers of XTC", magic);
    if (left < 56) return std::nullopt;
    const auto atoms = integer(4);
    check(atoms > 0, 4, "at least 1 atom", atoms);
    check(frame == 0 || static_cast<std::size_t>(atoms) == atoms_, 4, counted(atoms_, "atom"), atoms);
    check(integer(52) == atoms, 52, counted(static_cast<std::size_t>(atoms), "atom"), integer(52));
    XtcHeader header;
    header.begin = begin;
    header.atoms = static_cast<std::size_t>(atoms);
    header.time = xdr_number<float>(bytes.data() + 12);
    header.cell = xdr_box<float>(bytes.data() + 16);
    if (header.atoms <= xtc_most_plain) {
      header.size = 56;
      header.data = 12 * header.atoms;
      return header;
    }
    header.size = magic == xtc_magic ? 92 : 96;
    if (left < header.size) return std::nullopt;
    header.precision = xdr_number<float>(bytes.data() + 56);
    check(std::isfinite(header.precision) && header.precision > 0, 56, "a positive precision",
          header.precision);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      header.least[axis] = integer(60 + 4 * axis);
      const std::int64_t most = integer(72 + 4 * axis), size = most - header.least[axis] + 1;
      check(size > 0 && size < std::int64_t{1} << 32U, 72 + 4 * axis,
            fmt::format("a greatest coordinate of at least {}", header.least[axis]), most);
      header.sizes[axis] = static_cast<std::uint32_t>(size);
    }
    const std::int32_t small = integer(84);
    header.small = static_cast<std::size_t>(small);
    check(header.small >= xtc_first_small && header.small <= xtc_end_small, 84,
          fmt::format("differences of {} to {} bits", xtc_first_small, xtc_end_small - 1), small);
    const std::int64_t data = magic == xtc_magic ? integer(88) : xdr_number<std::int64_t>(bytes.data() + 88);
    header.data = static_cast<std::uint64_t>(data);
    // An atom has at least 2 bits, and at most 3 times 32 bits and 6 bits.
    const std::uint64_t fewest = (header.atoms + 3) / 4, most = 13 * header.atoms;
    check(header.data >= fewest && header.data <= most, 88,
          fmt::format("{} to {} bytes of coordinates", fewest, most), data);
    return header;
  }

  // Throws if the rest of the file has the header of another frame. The size of this frame is then wrong. If
  // the file were taken for one that ends inside its last frame, the other frames would be lost.
  void refuse_frame_inside(const XtcHeader& header) {
    constexpr std::size_t block = std::size_t{1} << 16U, magic_and_atoms = 8;
    std::array<char, magic_and_atoms> wanted;
    std::vector<char> bytes(block);
    if (!input_.read_at(header.begin, wanted.data(), wanted.size())) return;
    for (std::uint64_t offset = header.begin + header.size; offset + magic_and_atoms <= length_;
         offset += block - magic_and_atoms) {
      const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(block, length_ - offset));
      if (!input_.read_at(offset, bytes.data(), size)) return;
      for (std::size_t at = 0; at + magic_and_atoms <= size; at += 4)  // frames have multiples of 4 bytes
        if (std::memcmp(bytes.data() + at, wanted.data(), magic_and_atoms) == 0)
          throw DamagedFrame(
              input_.name(), begins_.size(), header.begin + 88,
              fmt::format("expected coordinates up to the next frame at byte {}, found a size of {}",
                          offset + at, counted(header.data, "byte")));
    }
  }

  InputFile input_;
  std::uint64_t length_ = 0;
  std::size_t atoms_ = 0;
  std::vector<std::uint64_t> begins_;  // where the frames begin
  FramesHeld held_;
  XtcCoordinates coordinates_;
};

}  // namespace

bool looks_like_xtc(std::string_view start) {
  if (start.size() < 56) return false;
  const auto integer = [&](std::size_t offset) { return xdr_number<std::int32_t>(start.data() + offset); };
  return (integer(0) == xtc_magic || integer(0) == xtc_magic_long) && integer(4) > 0 &&
         integer(4) == integer(52);
}

std::unique_ptr<AtomFrames> open_xtc(const std::filesystem::path& path, const ReadOptions&) {
  return std::make_unique<XtcFrames>(path);
}

}  // namespace kds
