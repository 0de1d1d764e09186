#pragma once
// Writes XTC and TRR files for tests, from the description of the formats and without code of the readers.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kds::test {

/// Big-endian numbers, one after the other.
class BigEndian {
 public:
  BigEndian& add(std::uint64_t value, int bytes) {
    while (bytes-- > 0) text_ += static_cast<char>(value >> (8 * bytes) & 0xFF);
    return *this;
  }
  BigEndian& integer(std::int32_t value) { return add(static_cast<std::uint32_t>(value), 4); }
  BigEndian& real(double value, int bytes = 4) {
    return bytes == 4 ? add(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4)
                      : add(std::bit_cast<std::uint64_t>(value), 8);
  }
  BigEndian& text(std::string_view text) {
    text_ += text;
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return text_; }

 private:
  std::string text_;
};

using Box = std::array<double, 9>;  // three vectors, nm

/// Writes XTC frames from integer coordinates.
struct XtcMaker {
  __extension__ using Wide = unsigned __int128;
  using Atom = std::array<std::int32_t, 3>;

  std::int32_t magic = 1995;
  float precision = 1000;
  Box box{3, 0, 0, 0, 4, 0, 0, 0, 5};
  double first_time = 0, time_step = 0.2;
  std::size_t most_run = 8;  ///< atoms after the first one of a group, 0 to 9
  std::size_t small = 15;    ///< place of the size of differences in the table
  bool change_small = true;  ///< alternates between `small` and the next place
  std::vector<std::vector<Atom>> frames;

  [[nodiscard]] std::string bytes() const {
    std::string all;
    for (std::size_t k = 0; k < frames.size(); ++k) all += frame_bytes(k);
    return all;
  }

  [[nodiscard]] std::string frame_bytes(std::size_t k) const {
    const std::vector<Atom>& atoms = frames[k];
    const auto count = static_cast<std::int32_t>(atoms.size());
    BigEndian out;
    out.integer(magic).integer(count).integer(static_cast<std::int32_t>(k));
    out.real(first_time + static_cast<double>(k) * time_step);
    for (const double number : box) out.real(number);
    out.integer(count);
    if (count <= 9) {
      for (const Atom& atom : atoms)
        for (const std::int32_t x : atom)
          out.real(static_cast<double>(static_cast<float>(x) * (1.0F / precision)));
      return out.bytes();
    }
    Atom least = atoms[0], most = atoms[0];
    for (const Atom& atom : atoms)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        least[axis] = std::min(least[axis], atom[axis]);
        most[axis] = std::max(most[axis], atom[axis]);
      }
    const std::string data = pack(atoms, least, most);
    out.real(static_cast<double>(precision));
    for (const std::int32_t x : least) out.integer(x);
    for (const std::int32_t x : most) out.integer(x);
    out.integer(static_cast<std::int32_t>(small)).add(data.size(), magic == 2023 ? 8 : 4).text(data);
    return out.text(std::string((4 - data.size() % 4) % 4, '\0')).bytes();
  }

 private:
  static std::int64_t size_at(std::size_t place) {
    if (place % 3 == 0) return std::int64_t{1} << (place / 3);  // but for 51, 69 and above
    constexpr std::array<std::int64_t, 12> between{10, 12, 20, 25, 40, 50, 80, 101, 161, 203, 322, 406};
    return between.at(2 * (place / 3 - 3) + place % 3 - 1);
  }

  static unsigned bits_of(Wide number) {
    unsigned bits = 0;
    for (; number != 0; number >>= 1U) ++bits;
    return bits;
  }

  static void put(std::vector<bool>& out, std::uint64_t value, unsigned bits) {
    while (bits-- > 0) out.push_back((value >> bits & 1U) != 0);
  }
  // Whole bytes with the lowest first, then what remains.
  static void put_packed(std::vector<bool>& out, Wide value, unsigned bits) {
    for (; bits > 8; bits -= 8, value >>= 8U) put(out, static_cast<std::uint64_t>(value & 0xFFU), 8);
    put(out, static_cast<std::uint64_t>(value), bits);
  }

  static bool is_near(const Atom& one, const Atom& before, std::int64_t size) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t difference = std::int64_t{one[axis]} - before[axis] + size / 2;
      if (difference < 0 || difference >= size) return false;
    }
    return true;
  }

  [[nodiscard]] std::string pack(const std::vector<Atom>& atoms, const Atom& least, const Atom& most) const {
    std::array<std::uint64_t, 3> sizes{};
    bool wide = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sizes[axis] = static_cast<std::uint64_t>(std::int64_t{most[axis]} - least[axis] + 1);
      wide |= sizes[axis] > 0xFFFFFF;
    }
    std::vector<bool> out;
    std::size_t last_run = 0, place = small;
    for (std::size_t i = 0; i < atoms.size();) {
      // The atoms of the group in the order of the file: the first two are exchanged.
      std::vector<Atom> group{atoms[i]};
      const std::int64_t size = size_at(place);
      if (most_run > 0 && i + 1 < atoms.size() && is_near(atoms[i], atoms[i + 1], size)) {
        group = {atoms[i + 1], atoms[i]};
        while (group.size() <= most_run && i + group.size() < atoms.size() &&
               is_near(atoms[i + group.size()], group.back(), size))
          group.push_back(atoms[i + group.size()]);
      }
      std::array<std::uint64_t, 3> offset{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        offset[axis] = static_cast<std::uint64_t>(std::int64_t{group[0][axis]} - least[axis]);
        if (wide) put(out, offset[axis], bits_of(sizes[axis]));
      }
      if (!wide)
        put_packed(out, (Wide{offset[0]} * sizes[1] + offset[1]) * sizes[2] + offset[2],
                   bits_of(Wide{sizes[0]} * sizes[1] * sizes[2]));
      const std::size_t run = group.size() - 1;
      const std::size_t next = !change_small ? place : place == small ? small + 1 : small;
      const bool told = run != last_run || next != place;
      put(out, told ? 1 : 0, 1);
      if (told) put(out, 3 * run + (next + 1 - place), 5);
      for (std::size_t j = 1; j < group.size(); ++j) {
        Wide packed = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
          packed = packed * static_cast<std::uint64_t>(size) +
                   static_cast<std::uint64_t>(std::int64_t{group[j][axis]} - group[j - 1][axis] + size / 2);
        put_packed(out, packed, static_cast<unsigned>(place));
      }
      last_run = run;
      place = next;
      i += group.size();
    }
    std::string bytes((out.size() + 7) / 8, '\0');
    for (std::size_t bit = 0; bit < out.size(); ++bit)
      if (out[bit]) bytes[bit / 8] = static_cast<char>(bytes[bit / 8] | 128 >> bit % 8);
    return bytes;
  }
};

/// Writes TRR frames.
struct TrrMaker {
  using Atom = std::array<double, 3>;  // nm

  int real = 4;  ///< bytes of a number, 4 or 8
  bool has_box = true, has_tensors = false, has_velocities = false, has_forces = false;
  std::vector<bool> without_positions;  ///< by frame; empty: all frames have them
  Box box{3, 0, 0, 0, 4, 0, 0, 0, 5};
  double time_step = 0.3;
  std::vector<std::vector<Atom>> frames;

  [[nodiscard]] std::string bytes() const {
    std::string all;
    for (std::size_t k = 0; k < frames.size(); ++k) all += frame_bytes(k);
    return all;
  }

  [[nodiscard]] std::string frame_bytes(std::size_t k) const {
    const std::vector<Atom>& atoms = frames[k];
    const auto count = static_cast<std::int32_t>(atoms.size());
    const bool has_positions = without_positions.empty() || !without_positions[k];
    const auto size = [&](bool has, std::int32_t numbers) { return has ? numbers * real : 0; };
    BigEndian out;
    out.integer(1993).integer(13).integer(12).text("GMX_trn_file");
    for (const std::int32_t number : {0, 0, size(has_box, 9), size(has_tensors, 9), size(has_tensors, 9), 0,
                                      0, size(has_positions, 3 * count), size(has_velocities, 3 * count),
                                      size(has_forces, 3 * count), count, static_cast<std::int32_t>(k), 0})
      out.integer(number);
    out.real(static_cast<double>(k) * time_step, real).real(0, real);
    if (has_box)
      for (const double number : box) out.real(number, real);
    for (int i = 0; has_tensors && i < 18; ++i) out.real(i, real);
    for (const double factor :
         {has_positions ? 1.0 : 0.0, has_velocities ? 2.0 : 0.0, has_forces ? 3.0 : 0.0})
      for (const Atom& atom : atoms)
        for (const double x : atom)
          if (factor > 0) out.real(factor * x, real);
    return out.bytes();
  }
};

}  // namespace kds::test
