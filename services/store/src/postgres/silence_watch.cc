#include "services/store/src/postgres/silence_watch.h"

#include <sys/socket.h>

namespace trailcast::store {

SilenceWatch::SilenceWatch(std::chrono::milliseconds patience)
    : patience_(patience), thread_([this] { Run(); }) {}

SilenceWatch::~SilenceWatch() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void SilenceWatch::Run() {
  std::unique_lock lock(mutex_);
  while (!over_) {
    if (!watched_) {
      changed_.wait(lock);
    } else if (changed_.wait_until(lock, watched_->until) == std::cv_status::timeout && watched_ &&
               std::chrono::steady_clock::now() >= watched_->until) {
      // The owner closes the socket, so that nobody meets another file under its number.
      shutdown(watched_->socket, SHUT_RDWR);
      watched_.reset();
    }
  }
}

SilenceWatch::Guard::Guard(SilenceWatch& watch, int socket) : watch_(watch) {
  {
    const std::lock_guard lock(watch_.mutex_);
    watch_.watched_ = {socket, std::chrono::steady_clock::now() + watch_.patience_};
  }
  watch_.changed_.notify_one();
}

SilenceWatch::Guard::~Guard() {
  const std::lock_guard lock(watch_.mutex_);
  watch_.watched_.reset();
}

}  // namespace trailcast::store
