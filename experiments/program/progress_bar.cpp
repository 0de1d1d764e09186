#include "experiments/program/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "experiments/output/text.h"

namespace kds {

namespace {

constexpr std::size_t kWidth = 32;
constexpr auto kPause = std::chrono::milliseconds(100);

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::string progress_line(std::string_view counted, std::size_t done, double within, std::size_t total,
                          double seconds) {
  const double part = std::clamp((static_cast<double>(done) + within) / static_cast<double>(total), 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(part * kWidth);
  constexpr double soonest = 2;  // an earlier estimate would be unstable
  std::string left;
  if (seconds >= soonest && part > 0 && part < 1)
    left = fmt::format(", about {} left", duration(seconds * (1 - part) / part));
  return fmt::format("[{}{}] {} {} of {}, {}{}", std::string(filled, '#'), std::string(kWidth - filled, '.'),
                     counted, with_thousands(done), with_thousands(total), duration(seconds), left);
}

ProgressBar::ProgressBar(bool wanted, std::string_view counted, std::FILE* stream)
    : stream_(wanted && ::isatty(::fileno(stream)) != 0 ? stream : nullptr), counted_(counted) {}

void ProgressBar::update(std::size_t done, double within, std::size_t total) {
  const Clock::time_point now = Clock::now();
  if (stream_ == nullptr || (total == 0 && !state_) || now - drawn_ < kPause) return;
  drawn_ = now;
  visible_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::string line =
      total == 0 ? fmt::format("{} {}, {}, {}", counted_, with_thousands(done), state_(), duration(seconds))
                 : progress_line(counted_, done, within, total, seconds);
  std::fputs(fmt::format("\r{}\033[K", line).c_str(), stream_);
  std::fflush(stream_);
}

void ProgressBar::erase() {
  if (!visible_) return;
  std::fputs("\r\033[K", stream_);
  std::fflush(stream_);
  visible_ = false;
}

void print_note(ProgressBar& bar, const std::string& note) {
  bar.erase();
  std::fputs(fmt::format("kds: {}\n", one_line(note)).c_str(), stderr);
}

void print_warning(ProgressBar& bar, const std::string& warning) { print_note(bar, "warning: " + warning); }

}  // namespace kds
