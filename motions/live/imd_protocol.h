#pragma once
// The protocol by which a running simulation sends its frames: IMD (interactive molecular dynamics), versions
// 2 (LAMMPS, GROMACS, NAMD, VMD) and 3.
//
// A packet is a header of two integers of 32 bits, type and length, the most significant byte first, and
// numbers in the byte order of the simulation's machine. The first packet, the handshake, has the version in
// place of the length and in the machine's byte order, which tells that order.
//
// | type | length | numbers |
// |---|---|---|
// | 0 disconnect | any | |
// | 1 energies | 1 | int32 step, nine floats |
// | 2 coordinates | atoms | three floats an atom, in angstrom |
// | 4 handshake | version | |
// | 10 session info | 7 | a byte each, nonzero for yes |
// | 12 time | 1 | double length of a step, double time in picoseconds, int64 step |
// | 13 cell | 1 | three vectors of three floats, in angstrom |
// | 14 velocities | atoms | three floats an atom, in angstrom per picosecond |
// | 15 forces | atoms | three floats an atom |
//
// The bytes of session info say whether time, energies, cells and coordinates are sent, whether coordinates
// are wrapped into the cell, and whether velocities and forces are sent.
//
// Version 2 has the types 0 to 4; a frame is a packet of coordinates, in GROMACS after one of energies, whose
// steps are one more than those of the coordinates. Version 3 sends session info after the
// handshake, and then for each frame the packets it announced, in the order 12, 1, 13, 2, 14, 15. A frame is
// complete after the last of these. All other types (go 3, kill 5, forces of the user 6, pause 7, rate 8,
// error 9, resume 11, wait 16) are packets that only kds may send; a simulation that sends them is refused.
//
// A simulation ends by a disconnect or by closing the connection, both between frames. LAMMPS and GROMACS
// send no disconnect: the operating system closes the connection when they end or are killed. So a simulation
// that is killed between two frames cannot be told from one that has ended.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "motions/live/byte_source.h"

namespace kds {

enum class ImdPacket : std::int32_t {
  disconnect = 0,
  energies = 1,
  coordinates = 2,
  go = 3,
  handshake = 4,
  rate = 8,
  session_info = 10,
  time = 12,
  cell = 13,
  velocities = 14,
  forces = 15,
};

/// Returns the header of a packet. A packet that kds sends has nothing else.
[[nodiscard]] std::array<char, 8> imd_header(ImdPacket type, std::int32_t length);

/// A frame as a simulation sends it.
struct LiveFrame {
  std::optional<double> picoseconds;  ///< finite
  std::optional<std::int64_t> step;
  std::optional<std::array<float, 9>> cell;  ///< three vectors, as they are sent
  std::vector<float> positions;              ///< x, y, z of each chosen atom; may be infinite or NaN
  std::vector<float> velocities;             ///< likewise; empty if they are not sent or not asked for
};

/// Reads the packets of one connection. Memory is taken for at most twice the bytes that have arrived, 100
/// kB, and the chosen atoms: a length that a simulation claims is not believed. Throws InputError in one
/// line, which names the simulation and the frame, if a packet is not what the protocol allows, or if the
/// source is broken or ends inside a frame. Do not read on after that.
class ImdProtocol {
 public:
  /// `name` is for messages. The source must outlive this object.
  ImdProtocol(std::string name, ByteSource& source) : name_(std::move(name)), source_(source) {}

  /// Reads the handshake and, in version 3, the session info. Throws InputError if the version is another.
  void read_handshake();
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool sends_cells() const { return sends(ImdPacket::cell); }
  [[nodiscard]] bool sends_times() const { return sends(ImdPacket::time); }

  /// Reads up to the coordinates of frame 0 and returns the number of atoms, which all frames must have.
  /// Throws InputError if the simulation ends before, or if the number is not from 1 to `most_atoms`.
  [[nodiscard]] std::size_t read_atom_count();
  /// Says which atoms frames are made of, in their order. Without a call frames have all atoms. Call before
  /// `next`.
  void choose(std::span<const std::size_t> atoms);
  /// Velocities are skipped unless they are asked for before `next`.
  void ask_velocities() { velocities_asked_ = true; }

  /// Reads the next frame. Returns false if the simulation has ended.
  [[nodiscard]] bool next(LiveFrame& frame);

  static constexpr std::size_t most_atoms = 50'000'000;

 private:
  struct Header {
    std::int32_t type = 0, length = 0;
    [[nodiscard]] bool is(ImdPacket packet) const { return type == static_cast<std::int32_t>(packet); }
  };

  [[nodiscard]] bool sends(ImdPacket packet) const {
    return (sent_ >> static_cast<unsigned>(packet) & 1U) != 0;
  }
  /// Reads a frame up to the header of its coordinates. Returns false if the simulation has ended.
  [[nodiscard]] bool begin();
  /// Reads the packets of version 3 before the coordinates; `header` is the first one's, then that of the
  /// coordinates.
  void read_before_coordinates(Header& header);
  /// Checks the number of atoms of a packet with three numbers an atom.
  void check_atoms(const Header& header);
  /// Reads three numbers of each atom, and keeps those of the chosen atoms. Skips all if `kept` is null.
  void read_atoms(std::vector<float>* kept);
  /// Returns the next header, nothing if the simulation has ended before its first byte. `is_first`: of a
  /// frame.
  [[nodiscard]] std::optional<Header> next_header(bool is_first);
  /// Reads the next header inside a frame, which must be of this type.
  [[nodiscard]] Header expect_header(ImdPacket packet);
  void check_type(const Header& header, ImdPacket packet) const;
  void check_length(const Header& header, std::int32_t length) const;
  [[nodiscard]] std::size_t read_some(std::span<char> to);
  void read_whole(std::span<char> to);
  /// Reads a number in the simulation's byte order.
  template <class Number>
  [[nodiscard]] Number read_number();
  [[noreturn]] void refuse(const std::string& what) const;

  std::string name_;
  ByteSource& source_;
  std::int32_t version_ = 0;
  std::uint32_t sent_ = 0;  ///< a bit for each type of packet that a frame has
  bool swapped_ = false;    ///< the simulation's byte order is not this machine's
  std::size_t frame_ = 0;   ///< number of the frame that is read
  std::size_t atoms_ = 0;   ///< in a frame; 0: not known yet
  bool begun_ = false;      ///< the frame is read up to its coordinates
  LiveFrame partial_;       ///< that frame
  bool all_ = true;         ///< all atoms are chosen
  bool velocities_asked_ = false;
  std::vector<std::pair<std::size_t, std::size_t>> chosen_;  ///< atom and its place in frames, by atom
  std::vector<char> piece_;
};

}  // namespace kds
