#pragma once
// Frames of a running simulation, from an address imd://HOST:PORT (live_address.h) in place of a file. The
// protocol is IMD of version 2 or 3 (imd_protocol.h). Frames are received while the simulation makes them and
// are never kept, so they can be read once. Their numbers count received frames from 0. Version 2 has neither
// times nor cells nor velocities.
//
// Only the chosen atoms of a frame are stored. Received frames wait in a block of bounded size
// (live_receiver.h). The simulation is told "go", the rate that ReadOptions::rate asks for, and "disconnect".
//
// The reading ends when the simulation ends or is cut off, after the last frame of ReadOptions::frames or
// ReadOptions::until, when `close` is called, or when the end is requested (`request_live_end`). If the
// connection breaks, the frames before are handed out first; then `is_cut` is true.

#include <filesystem>
#include <memory>

#include "motions/live/live_address.h"
#include "motions/readers/atom_frames.h"

namespace kds {

/// Connects to the simulation. Throws InputError in one line that names the address: it has no host or port,
/// nothing listens within ReadOptions::patience, or the peer does not speak the protocol.
[[nodiscard]] std::unique_ptr<AtomFrames> open_imd(const std::filesystem::path& address,
                                                   const ReadOptions& options);

}  // namespace kds
