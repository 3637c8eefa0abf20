#include "services/http/src/workers.h"

#include <utility>

namespace trailcast::http {

Workers::Workers(std::size_t threads, std::size_t most_waiting) : most_waiting_(most_waiting) {
  threads_.reserve(threads);
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { Work(); });
}

void Workers::enqueue(std::function<void()> connection) {
  std::unique_lock lock(mutex_);
  goes_.wait(lock, [this] { return waiting_.size() < most_waiting_; });
  waiting_.push_back(std::move(connection));
  comes_.notify_one();
}

void Workers::shutdown() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  comes_.notify_all();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

void Workers::Work() {
  while (true) {
    std::function<void()> connection;
    {
      std::unique_lock lock(mutex_);
      comes_.wait(lock, [this] { return over_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      connection = std::move(waiting_.front());
      waiting_.pop_front();
    }
    goes_.notify_one();
    connection();
  }
}

}  // namespace trailcast::http
