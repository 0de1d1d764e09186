#include "experiments/program/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "experiments/output/text.h"

namespace kds {
namespace {

constexpr std::size_t kWidth = 32;
constexpr auto kPause = std::chrono::milliseconds(100);

}  // namespace

ProgressBar::ProgressBar(bool wanted, std::FILE* stream)
    : stream_(wanted && ::isatty(::fileno(stream)) != 0 ? stream : nullptr) {}

void ProgressBar::update(std::size_t done, std::size_t total) {
  const Clock::time_point now = Clock::now();
  if (stream_ == nullptr || total == 0 || now - drawn_ < kPause) return;
  drawn_ = now;
  visible_ = true;
  const double part = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
  const auto filled = static_cast<std::size_t>(part * kWidth);
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::string line =
      fmt::format("\r[{}{}] step {} of {}, {:.0f} s\033[K", std::string(filled, '#'),
                  std::string(kWidth - filled, '.'), with_thousands(done), with_thousands(total), seconds);
  std::fputs(line.c_str(), stream_);
  std::fflush(stream_);
}

void ProgressBar::erase() {
  if (!visible_) return;
  std::fputs("\r\033[K", stream_);
  std::fflush(stream_);
  visible_ = false;
}

}  // namespace kds
