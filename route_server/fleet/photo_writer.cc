#include "route_server/fleet/photo_writer.h"

#include <chrono>
#include <utility>

#include "services/base/guarded.h"

namespace trailcast::server {
namespace {

constexpr std::chrono::hours kWriterWakesUp{1};  // unless something was handed over

}  // namespace

PhotoWriter::PhotoWriter(photos::PhotoFolder& folder)
    : folder_(folder), thread_([this] { Run(); }) {}

PhotoWriter::~PhotoWriter() {
  ending_ = true;
  handed_over_.Ring();
  thread_.join();
}

void PhotoWriter::Put(photos::Photo photo, std::vector<std::uint8_t> jpeg) {
  waiting_.insert(photo.id);
  (void)items_.TryPut({std::move(photo), std::move(jpeg)});
  handed_over_.Ring();
}

std::vector<PhotoWriter::Written> PhotoWriter::TakeWritten() {
  std::vector<Written> all;
  while (auto written = written_.TryGet()) {
    waiting_.erase(written->photo.id);
    all.push_back(*std::move(written));
  }
  return all;
}

void PhotoWriter::Run() {
  while (!ending_) {
    handed_over_.Wait(kWriterWakesUp);
    while (!ending_) {
      auto item = items_.TryGet();
      if (!item) break;
      auto gone = Guarded("the thread that writes photos",
                          [&] { return folder_.Add(item->photo, item->jpeg); });
      (void)written_.TryPut({std::move(item->photo), std::move(gone)});
    }
  }
}

}  // namespace trailcast::server
