#pragma once
// Files that tests write for the readers, and checks of refusals.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "motions/base/input_error.h"

namespace kds::test {

inline std::filesystem::path data_file(std::string_view name) {
  return std::filesystem::path(KDS_DATA_DIR) / name;
}

/// Returns a path that no other running test uses.
inline std::filesystem::path temporary(const std::string& name) {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  std::string folder =
      std::string(info->test_suite_name()) + "-" + info->name() + "-" + std::to_string(getpid());
  std::replace(folder.begin(), folder.end(), '/', '-');
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / ("kds-" + folder);
  std::filesystem::create_directories(path);
  return path / name;
}

inline std::filesystem::path write_file(const std::string& name, std::string_view bytes) {
  const std::filesystem::path path = temporary(name);
  std::filesystem::remove(path);  // overwriting an existing file may wait for the disk
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The call must throw an InputError whose message is one line and contains all parts.
inline void expect_refused(const std::function<void()>& call, std::initializer_list<std::string_view> parts) {
  try {
    call();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const std::string_view part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << "expected '" << part << "' in: " << message;
    return;
  }
  ADD_FAILURE() << "expected an InputError";
}

/// The call must succeed or throw an InputError of one line. Returns whether it succeeded.
inline bool succeeds_or_refuses(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
    return false;
  }
  return true;
}

/// An atom line of a PDB file.
struct PdbAtom {
  std::string name = "CA";
  std::string residue = "ALA";
  char chain = 'A';
  int number = 1;
  double x = 0, y = 0, z = 0;
  char alternate = ' ';
  char insertion = ' ';
  bool het = false;
  std::string element = "C";
};

inline std::string pdb_line(const PdbAtom& atom) {
  char line[200];
  std::snprintf(line, sizeof line, "%-6s%5d %-4s%c%3s %c%4d%c   %8.3f%8.3f%8.3f  1.00  0.00          %2s\n",
                atom.het ? "HETATM" : "ATOM", 1, (atom.name.size() < 4 ? " " + atom.name : atom.name).c_str(),
                atom.alternate, atom.residue.c_str(), atom.chain, atom.number, atom.insertion, atom.x, atom.y,
                atom.z, atom.element.c_str());
  return line;
}

/// Returns N, CA and C of one residue along x, 1.5 apart, starting at x = 4.5 * `number`.
inline std::string pdb_residue(int number, char chain = 'A', double y = 0) {
  std::string lines;
  const double x = 4.5 * number;
  const std::string n = "N";
  lines += pdb_line({.name = n, .chain = chain, .number = number, .x = x, .y = y, .element = n});
  lines += pdb_line({.name = "CA", .chain = chain, .number = number, .x = x + 1.5, .y = y});
  lines += pdb_line({.name = "C", .chain = chain, .number = number, .x = x + 3, .y = y});
  return lines;
}

/// Writes valid and invalid DCD files of every kind.
struct DcdMaker {
  bool big_endian = false;
  std::size_t marker_size = 4;
  std::int32_t frames_claimed = -1;  ///< -1: the true number
  bool claim_as_said = false;        ///< write frames_claimed unchanged
  bool cell = false;
  std::array<double, 6> cell_values{50, 0, 50, 0, 0, 50};  ///< a, gamma, b, beta, alpha, c
  bool fourth = false;
  std::vector<std::int32_t> free_atoms;  ///< numbers from 1; empty: no atom is fixed
  std::string magic = "CORD";
  std::string title = std::string(80, 't');
  std::int32_t version = 24;  ///< 0: X-PLOR
  std::int32_t first_step = 0, steps_a_frame = 0;
  double step_length = 0;                                 ///< in the time unit of CHARMM
  std::int32_t atoms_claimed = -1;                        ///< -1: the number of atoms in frame 0
  std::vector<std::vector<std::array<float, 3>>> frames;  ///< all atoms of each frame

  template <class Number>
  void put(std::string& out, Number number) const {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), &number, sizeof number);
    if (big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
    out.append(bytes.data(), bytes.size());
  }
  std::string record(const std::string& bytes) const {
    std::string marker;
    if (marker_size == 4)
      put(marker, static_cast<std::uint32_t>(bytes.size()));
    else
      put(marker, static_cast<std::uint64_t>(bytes.size()));
    return marker + bytes + marker;
  }
  std::string header() const {
    const std::size_t atoms = frames.empty() ? 0 : frames[0].size();
    std::array<std::int32_t, 20> numbers{};
    numbers[0] = claim_as_said ? frames_claimed : static_cast<std::int32_t>(frames.size());
    numbers[1] = first_step;
    numbers[2] = steps_a_frame;
    if (version == 0) {
      std::memcpy(&numbers[9], &step_length, sizeof step_length);
      if (big_endian) std::swap(numbers[9], numbers[10]);
    } else {
      const auto length = static_cast<float>(step_length);
      std::memcpy(&numbers[9], &length, sizeof length);
    }
    numbers[8] = free_atoms.empty() ? 0 : static_cast<std::int32_t>(atoms - free_atoms.size());
    if (version != 0) {
      numbers[10] = cell ? 1 : 0;
      numbers[11] = fourth ? 1 : 0;
    }
    numbers[19] = version;
    std::string first = magic;
    for (const std::int32_t number : numbers) put(first, number);
    std::string lines;
    put(lines, std::int32_t{1});
    lines += title + std::string(80 - title.size(), ' ');
    std::string count;
    put(count, atoms_claimed >= 0 ? atoms_claimed : static_cast<std::int32_t>(atoms));
    std::string out = record(first) + record(lines) + record(count);
    if (!free_atoms.empty()) {
      std::string list;
      for (const std::int32_t atom : free_atoms) put(list, atom);
      out += record(list);
    }
    return out;
  }
  std::string frame(std::size_t k) const {
    std::string out;
    if (cell) {
      std::string block;
      for (const double value : cell_values) put(block, value);
      out += record(block);
    }
    for (std::size_t axis = 0; axis < (fourth ? 4U : 3U); ++axis) {
      std::string block;
      for (std::size_t i = 0; i < frames[k].size(); ++i) {
        const bool is_free =
            free_atoms.empty() || k == 0 ||
            std::count(free_atoms.begin(), free_atoms.end(), static_cast<std::int32_t>(i + 1)) > 0;
        if (is_free) put(block, axis < 3 ? frames[k][i][axis] : 7.0F);
      }
      out += record(block);
    }
    return out;
  }
  std::string bytes() const {
    std::string out = header();
    for (std::size_t k = 0; k < frames.size(); ++k) out += frame(k);
    return out;
  }
  /// Makes a straight chain with bonds of 1.5 that moves by 0.25 in y per frame.
  static DcdMaker chain(std::size_t atoms, std::size_t frames) {
    DcdMaker maker;
    for (std::size_t k = 0; k < frames; ++k) {
      maker.frames.emplace_back();
      for (std::size_t i = 0; i < atoms; ++i)
        maker.frames.back().push_back({1.5F * static_cast<float>(i), 0.25F * static_cast<float>(k), 0.1F});
    }
    return maker;
  }
};

}  // namespace kds::test
