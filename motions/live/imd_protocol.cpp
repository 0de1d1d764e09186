#include "motions/live/imd_protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

// Names of the types of packets, by number.
constexpr std::array<std::string_view, 17> packet_names{
    "disconnect",    "energies", "coordinates", "go",     "handshake",    "kill",
    "user's forces", "pause",    "rate",        "error",  "session info", "resume",
    "time",          "cell",     "velocities",  "forces", "wait"};

std::string described_packet(std::int32_t type) {
  const auto place = static_cast<std::size_t>(type);
  return type >= 0 && place < packet_names.size() ? fmt::format("{} (type {})", packet_names[place], type)
                                                  : fmt::format("type {}", type);
}

std::int32_t big_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return static_cast<std::int32_t>(value);
}

// The packets of a frame of version 3 that are not three numbers an atom, in their order.
constexpr std::array frame_heads{ImdPacket::time, ImdPacket::energies, ImdPacket::cell};
constexpr std::size_t energies_size = 40;

}  // namespace

std::array<char, 8> imd_header(ImdPacket type, std::int32_t length) {
  std::array<char, 8> bytes{};
  const auto put = [&](std::size_t begin, std::int32_t number) {
    for (std::size_t i = 0; i < 4; ++i)
      bytes[begin + i] = static_cast<char>(static_cast<std::uint32_t>(number) >> (24 - 8 * i) & 0xffU);
  };
  put(0, static_cast<std::int32_t>(type));
  put(4, length);
  return bytes;
}

void ImdProtocol::refuse(const std::string& what) const {
  throw InputError(version_ == 0 ? fmt::format("{}: {}", name_, what)
                                 : fmt::format("{}: frame {}: {}", name_, frame_, what));
}

std::size_t ImdProtocol::read_some(std::span<char> to) {
  try {
    return source_.read(to);
  } catch (const BrokenConnection& broken) {
    refuse(broken.what());
  }
}

void ImdProtocol::read_whole(std::span<char> to) {
  const std::size_t size = to.size();
  while (!to.empty()) {
    const std::size_t got = read_some(to);
    if (got == 0)
      refuse(fmt::format("the connection has ended inside a packet, {} of {} bytes came", size - to.size(),
                         size));
    to = to.subspan(got);
  }
}

template <class Number>
Number ImdProtocol::read_number() {
  std::array<char, sizeof(Number)> bytes;
  read_whole(bytes);
  if (swapped_) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<Number>(bytes);
}

std::optional<ImdProtocol::Header> ImdProtocol::next_header(bool is_first) {
  if (is_first) source_.restart_patience();
  std::array<char, 8> bytes;
  const std::size_t got = read_some(bytes);
  if (got == 0) return std::nullopt;
  if (is_first) source_.restart_patience();
  read_whole(std::span(bytes).subspan(got));
  return Header{big_endian(bytes.data()), big_endian(bytes.data() + 4)};
}

ImdProtocol::Header ImdProtocol::expect_header(ImdPacket packet) {
  const std::optional<Header> header = next_header(false);
  if (!header)
    refuse(fmt::format("the connection has ended before a packet of {}",
                       packet_names[static_cast<std::size_t>(packet)]));
  check_type(*header, packet);
  return *header;
}

void ImdProtocol::check_type(const Header& header, ImdPacket packet) const {
  if (header.is(packet)) return;
  refuse(fmt::format("expected a packet of {}, found {}", packet_names[static_cast<std::size_t>(packet)],
                     described_packet(header.type)));
}

void ImdProtocol::check_length(const Header& header, std::int32_t length) const {
  if (header.length == length) return;
  refuse(fmt::format("expected a packet of {} with the length {}, found {}",
                     packet_names[static_cast<std::size_t>(header.type)], length, header.length));
}

void ImdProtocol::read_handshake() {
  source_.restart_patience();
  std::array<char, 8> bytes;
  read_whole(bytes);
  if (big_endian(bytes.data()) != static_cast<std::int32_t>(ImdPacket::handshake))
    refuse("expected the handshake of a simulation (IMD), found other bytes");
  const std::int32_t big = big_endian(bytes.data() + 4);
  std::reverse(bytes.begin() + 4, bytes.end());
  const std::int32_t little = big_endian(bytes.data() + 4);
  const bool is_big = big == 2 || big == 3;
  const std::int32_t version = is_big ? big : little;
  if (version != 2 && version != 3)
    refuse(fmt::format("expected version 2 or 3 of the protocol IMD, found {}",
                       std::min(static_cast<std::uint32_t>(big), static_cast<std::uint32_t>(little))));
  swapped_ = is_big != (std::endian::native == std::endian::big);
  if (version == 3) {
    const Header header = expect_header(ImdPacket::session_info);
    check_length(header, 7);
    std::array<char, 7> told;
    read_whole(told);
    constexpr std::array order{ImdPacket::time,        ImdPacket::energies,  ImdPacket::cell,
                               ImdPacket::coordinates, ImdPacket::handshake,  // wrapped or not
                               ImdPacket::velocities,  ImdPacket::forces};
    for (std::size_t i = 0; i < told.size(); ++i)
      if (told[i] != 0) sent_ |= 1U << static_cast<unsigned>(order[i]);
    if (!sends(ImdPacket::coordinates)) refuse("the simulation is set to send no coordinates");
  }
  version_ = version;
}

std::size_t ImdProtocol::read_atom_count() {
  if (!begin()) refuse("the simulation has ended before the first frame");
  begun_ = true;
  return atoms_;
}

void ImdProtocol::choose(std::span<const std::size_t> atoms) {
  all_ = false;
  chosen_.clear();
  for (std::size_t place = 0; place < atoms.size(); ++place) chosen_.emplace_back(atoms[place], place);
  std::sort(chosen_.begin(), chosen_.end());
}

bool ImdProtocol::begin() {
  partial_ = {};
  std::optional<Header> header = next_header(true);
  while (header && version_ == 2 && header->is(ImdPacket::energies)) {
    check_length(*header, 1);
    partial_.step = read_number<std::int32_t>();
    std::array<char, energies_size - sizeof(std::int32_t)> skipped;
    read_whole(skipped);
    header = next_header(false);
  }
  if (!header || header->is(ImdPacket::disconnect)) return false;
  if (version_ == 3) read_before_coordinates(*header);
  check_type(*header, ImdPacket::coordinates);
  check_atoms(*header);
  return true;
}

void ImdProtocol::read_before_coordinates(Header& header) {
  bool has_header = true;
  for (const ImdPacket packet : frame_heads) {
    if (!sends(packet)) continue;
    if (!std::exchange(has_header, false)) header = expect_header(packet);
    check_type(header, packet);
    check_length(header, 1);
    if (packet == ImdPacket::time) {
      static_cast<void>(read_number<double>());  // the length of a step
      partial_.picoseconds = read_number<double>();
      partial_.step = read_number<std::int64_t>();
      if (!std::isfinite(*partial_.picoseconds))
        refuse(fmt::format("has the time {} ps, expected a finite one", *partial_.picoseconds));
    } else if (packet == ImdPacket::energies) {
      std::array<char, energies_size> skipped;
      read_whole(skipped);
    } else {
      for (float& number : partial_.cell.emplace()) number = read_number<float>();
    }
  }
  if (!has_header) header = expect_header(ImdPacket::coordinates);
}

void ImdProtocol::check_atoms(const Header& header) {
  const bool known = atoms_ > 0;
  if (!known && (header.length < 1 || static_cast<std::size_t>(header.length) > most_atoms))
    refuse(fmt::format("claims {} atoms, expected 1 to {}", header.length, most_atoms));
  if (known && (header.length < 0 || static_cast<std::size_t>(header.length) != atoms_))
    refuse(fmt::format("{} of {}, expected {} as in frame 0",
                       packet_names[static_cast<std::size_t>(header.type)],
                       header.length == 1 ? "1 atom" : fmt::format("{} atoms", header.length), atoms_));
  atoms_ = static_cast<std::size_t>(header.length);
}

void ImdProtocol::read_atoms(std::vector<float>* kept) {
  constexpr std::size_t atoms_in_piece = 4096, atom_size = 12;
  piece_.resize(atoms_in_piece * atom_size);
  auto choice = chosen_.begin();
  if (kept != nullptr) {
    kept->clear();
    if (!all_) kept->resize(3 * chosen_.size());        // at most the atoms of a topology
    if (all_ && frame_ > 0) kept->reserve(3 * atoms_);  // frame 0 had as many
  }
  for (std::size_t first = 0; first < atoms_; first += atoms_in_piece) {
    const std::size_t count = std::min(atoms_in_piece, atoms_ - first);
    read_whole(std::span(piece_).first(count * atom_size));
    if (kept == nullptr) continue;
    if (swapped_)
      for (std::size_t i = 0; i < count * atom_size; i += 4) std::reverse(&piece_[i], &piece_[i] + 4);
    if (all_) {
      const std::size_t held = kept->size();
      kept->resize(held + 3 * count);
      std::memcpy(kept->data() + held, piece_.data(), count * atom_size);
    }
    for (; choice != chosen_.end() && choice->first < first + count; ++choice)
      std::memcpy(kept->data() + 3 * choice->second, &piece_[(choice->first - first) * atom_size], atom_size);
  }
}

bool ImdProtocol::next(LiveFrame& frame) {
  if (!std::exchange(begun_, false) && !begin()) return false;
  frame.picoseconds = partial_.picoseconds;
  frame.step = partial_.step;
  frame.cell = partial_.cell;
  frame.velocities.clear();
  read_atoms(&frame.positions);
  for (const ImdPacket packet : {ImdPacket::velocities, ImdPacket::forces}) {
    if (!sends(packet)) continue;
    check_atoms(expect_header(packet));
    read_atoms(packet == ImdPacket::velocities && velocities_asked_ ? &frame.velocities : nullptr);
  }
  ++frame_;
  return true;
}

}  // namespace kds
