#pragma once

#include <httplib.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace trailcast::http {

// So many threads, and so many connections that wait for one; who comes beyond that waits in the
// system's own short queue.
class Workers final : public httplib::TaskQueue {
 public:
  Workers(std::size_t threads, std::size_t most_waiting);
  ~Workers() override { shutdown(); }

  void enqueue(std::function<void()> connection) override;
  // What waits is answered first: its sockets are to be closed.
  void shutdown() override;

 private:
  void Work();

  const std::size_t most_waiting_;
  std::mutex mutex_;  // guards the next two
  std::deque<std::function<void()>> waiting_;
  bool over_ = false;
  std::condition_variable comes_;
  std::condition_variable goes_;
  std::vector<std::thread> threads_;
};

}  // namespace trailcast::http
