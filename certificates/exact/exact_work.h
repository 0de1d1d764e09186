#pragma once
// How much work the exact stage does: counted in *limb operations*, which are the same on every machine. One
// is a coefficient of a polynomial gone over once, for each 64 bits of its length: evaluating n coefficients
// of 128 bits takes about 2 n of them, seeing the polynomial on a part of the step or forming it 2 n^2. It is
// a measure and no more, but no long computation goes by without it: so work can be limited and watched.
//
// The work of a thread goes to the account that is open in it (ExactWork::Open), to one without a limit if
// there is none.

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "certificates/base/certificate_type.h"

namespace kds {

class RecentFunctions;

/// The work that was allowed is done, and more is asked for.
class WorkLimitReached : public std::runtime_error {
 public:
  explicit WorkLimitReached(const std::optional<Identity>& subject)
      : std::runtime_error("the limit of exact work is reached"), subject_(subject) {}

  /// Of the certificate that was worked on, if one was.
  [[nodiscard]] const std::optional<Identity>& subject() const { return subject_; }

 private:
  std::optional<Identity> subject_;
};

class ExactWork {
 public:
  static constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

  ExactWork();
  ~ExactWork();
  ExactWork(const ExactWork&) = delete;
  ExactWork& operator=(const ExactWork&) = delete;

  /// WorkLimitReached is thrown where more than this is asked for in all.
  void set_limit(std::uint64_t most);
  /// Called again and again while work goes on, each time after so much of it. May throw.
  void set_watcher(std::function<void()> watcher, std::uint64_t every);

  [[nodiscard]] std::uint64_t done() const { return done_; }
  /// Of the certificate that is worked on, if one is.
  [[nodiscard]] std::optional<Identity> subject() const;
  /// Those of this account.
  [[nodiscard]] RecentFunctions& recent_functions() { return *recent_; }

  /// Of this thread.
  [[nodiscard]] static ExactWork& current();
  static void spend(std::uint64_t operations) { current().add(operations); }

  /// Opens an account in this thread, in place of another one, until it ends.
  class Open {
   public:
    explicit Open(ExactWork& account) : before_(current_) { current_ = &account; }
    ~Open() { current_ = before_; }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;

   private:
    ExactWork* before_;
  };

  /// While it lives, work is about this, which must live as long, if it has an identity.
  class About {
   public:
    template <class Named>
    explicit About(const Named& subject) : account_(current()), before_(account_.subject_) {
      if constexpr (requires { subject.identity(); })
        account_.subject_ = {
            &subject, [](const void* of) -> Identity { return static_cast<const Named*>(of)->identity(); }};
    }
    ~About() { account_.subject_ = before_; }
    About(const About&) = delete;
    About& operator=(const About&) = delete;

   private:
    friend class ExactWork;
    struct Subject {
      const void* of = nullptr;
      Identity (*identity)(const void*) = nullptr;
    };

    ExactWork& account_;
    Subject before_;
  };

 private:
  void add(std::uint64_t operations) {
    done_ += operations;
    if (done_ >= next_stop_) [[unlikely]]
      stop();
  }
  /// The limit is reached, or the watcher is to be called.
  void stop();
  void set_next_stop();

  static thread_local constinit inline ExactWork* current_ = nullptr;

  std::uint64_t done_ = 0;
  std::uint64_t next_stop_ = no_limit;
  std::uint64_t limit_ = no_limit, next_watch_ = no_limit, watch_every_ = 0;
  std::function<void()> watcher_;
  About::Subject subject_;
  std::unique_ptr<RecentFunctions> recent_;
};

}  // namespace kds
