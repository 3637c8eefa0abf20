#include "services/console/album.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "services/image/files.h"

namespace trailcast::console {
namespace {

constexpr std::size_t kMostVisits = 50;
constexpr int kEarlierQuality = 85;

Result<image::GrayImage> Decoded(const Album::Jpeg& jpeg, const fleet::KnownPhoto& known) {
  return image::DecodeGray(*jpeg, "photo " + known.photo.id);
}

}  // namespace

// Servers may have pages of different sizes, so that some of what they have is asked for twice.
// A robot that did not hear that a server keeps its photo may have handed it to another one, too.
Result<Album::Gathered> Album::Gather(const photos::PhotoQuery& query, std::size_t enough) {
  Gathered gathered;
  std::map<std::string, fleet::KnownPhoto> found;
  std::map<AgentId, std::size_t> counts;
  std::uint32_t first = 0;
  do {
    auto answers = desk_.AskAll(ToText(query), first);
    if (!answers && answers.error().code == ErrorCode::kConflict) {
      return Fail(ErrorCode::kUnavailable, "{}", answers.error().message);
    }
    if (!answers) return tl::unexpected(answers.error());
    gathered.silent.insert(answers->silent.begin(), answers->silent.end());
    std::uint32_t next = 0;
    for (const exchange::NetworkReply& reply : answers->replies) {
      for (fleet::KnownPhoto& known : fleet::PhotosIn(reply.server, reply.lines)) {
        const std::string id = known.photo.id;
        if (found.try_emplace(id, std::move(known)).second) ++counts[reply.server];
      }
      if (reply.next <= first) continue;
      const bool is_enough = counts[reply.server] >= enough || reply.next >= kMostListed;
      gathered.more = gathered.more || is_enough;
      if (!is_enough) next = next == 0 ? reply.next : std::min(next, reply.next);
    }
    first = next;
  } while (first > 0);
  for (auto& [id, known] : found) gathered.photos.push_back(std::move(known));
  std::sort(gathered.photos.begin(), gathered.photos.end(), [](const auto& a, const auto& b) {
    return std::pair(a.photo.taken_unix_ms, a.photo.id) >
           std::pair(b.photo.taken_unix_ms, b.photo.id);
  });
  return gathered;
}

Result<Album::Page> Album::List(const photos::PhotoQuery& query, std::uint32_t first,
                                std::size_t most) {
  if (first >= kMostListed) {
    return Fail(ErrorCode::kInvalidArgument,
                "only the last {} photos are listed: ask for those of a robot, a route, a place or "
                "a mission",
                kMostListed);
  }
  auto gathered = Gather(query, first + most);
  if (!gathered) return tl::unexpected(gathered.error());
  std::vector<fleet::KnownPhoto>& all = gathered->photos;
  const std::size_t begin = std::min<std::size_t>(first, all.size());
  const std::size_t end = std::min(begin + most, all.size());
  Page page{.silent = {gathered->silent.begin(), gathered->silent.end()}};
  if (gathered->more || end < all.size()) page.next = static_cast<std::uint32_t>(first + most);
  page.photos.assign(std::make_move_iterator(all.begin() + static_cast<std::ptrdiff_t>(begin)),
                     std::make_move_iterator(all.begin() + static_cast<std::ptrdiff_t>(end)));
  const std::scoped_lock lock(mutex_);
  for (const fleet::KnownPhoto& known : page.photos) known_.Touch(known.photo.id) = known;
  return page;
}

std::string Album::SilentText(const Page& page) {
  std::vector<std::string> names;
  for (const AgentId& server : page.silent) names.push_back(server.value());
  return fmt::format("route server{} {} {} not answer", names.size() == 1 ? "" : "s",
                     fmt::join(names, ", "), names.size() == 1 ? "does" : "do");
}

Result<fleet::KnownPhoto> Album::Find(const std::string& id) {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto* known = known_.Find(id)) return *known;
  }
  const auto page = List({.id = id}, 0);
  if (!page) return tl::unexpected(page.error());
  if (page->photos.empty() && !page->silent.empty()) {
    return Fail(ErrorCode::kUnavailable, "there is no photo {} as far as is known: {}", id,
                SilentText(*page));
  }
  if (page->photos.empty()) return Fail(ErrorCode::kNotFound, "there is no photo {}", id);
  return page->photos.front();
}

Result<std::vector<fleet::KnownPhoto>> Album::Visits(const fleet::KnownPhoto& of) {
  photos::PhotoQuery query;
  if (of.photo.place.empty()) {
    query.route = of.photo.route;
    query.spot_m = of.photo.spot_m;
  } else {
    query.place = of.photo.place;
  }
  auto page = List(query, 0);
  if (!page) return tl::unexpected(page.error());
  std::erase_if(page->photos, [&](const fleet::KnownPhoto& each) {
    return each.photo.id == of.photo.id || !AreOfOneSpot(each.photo, of.photo);
  });
  if (page->photos.size() > kMostVisits) page->photos.resize(kMostVisits);
  return std::move(page->photos);
}

Result<Album::Jpeg> Album::Picture(const fleet::KnownPhoto& known) {
  const std::string& id = known.photo.id;
  {
    const std::scoped_lock lock(mutex_);
    const auto kept = std::find_if(pictures_.begin(), pictures_.end(),
                                   [&](const auto& each) { return each.first == id; });
    if (kept != pictures_.end()) {
      std::rotate(kept, kept + 1, pictures_.end());
      return pictures_.back().second;
    }
    if (waiting_ >= kMostWaiting) {
      return Fail(ErrorCode::kUnavailable, "too many photos are fetched at once: try again");
    }
    ++waiting_;
  }
  auto fetched = desk_.Photo(known);
  const std::scoped_lock lock(mutex_);
  --waiting_;
  if (!fetched) return tl::unexpected(fetched.error());
  auto jpeg = std::make_shared<const std::vector<std::uint8_t>>(*std::move(fetched));
  bytes_ += jpeg->size();
  pictures_.emplace_back(id, jpeg);
  while (bytes_ > kMostBytes && pictures_.size() > 1) {
    bytes_ -= pictures_.front().second->size();
    pictures_.pop_front();
  }
  return jpeg;
}

Album::Compared Album::Work(const fleet::KnownPhoto& earlier, const fleet::KnownPhoto& later) {
  const auto before =
      Picture(earlier).and_then([&](const Jpeg& jpeg) { return Decoded(jpeg, earlier); });
  if (!before) return tl::unexpected(before.error());
  const auto now = Picture(later).and_then([&](const Jpeg& jpeg) { return Decoded(jpeg, later); });
  if (!now) return tl::unexpected(now.error());
  auto comparison = photos::Compare(*before, *now);
  if (!comparison) return tl::unexpected(comparison.error());
  auto jpeg = image::EncodeJpeg(comparison->earlier, kEarlierQuality);
  if (!jpeg) return tl::unexpected(jpeg.error());
  comparison->earlier = {};
  return std::make_shared<const Changes>(
      Changes{.comparison = *std::move(comparison),
              .earlier = std::make_shared<const std::vector<std::uint8_t>>(*std::move(jpeg))});
}

Album::Compared Album::Compare(const fleet::KnownPhoto& earlier, const fleet::KnownPhoto& later) {
  const std::string key = earlier.photo.id + later.photo.id;
  {
    const std::scoped_lock lock(mutex_);
    if (auto* kept = compared_.Find(key); kept != nullptr && *kept) return **kept;
    if (waiting_ >= kMostWaiting) {
      return Fail(ErrorCode::kUnavailable, "too many photos are compared at once: try again");
    }
    ++waiting_;
  }
  Compared compared = [&]() -> Compared {
    const std::scoped_lock one_at_a_time(comparing_);
    {
      const std::scoped_lock lock(mutex_);
      if (auto* kept = compared_.Find(key); kept != nullptr && *kept) return **kept;
    }
    return Work(earlier, later);
  }();
  const std::scoped_lock lock(mutex_);
  --waiting_;
  // That two do not align stays so; a server that did not answer may answer the next time.
  const bool stays = compared || compared.error().code == ErrorCode::kConflict;
  if (stays) compared_.Touch(key) = compared;
  return compared;
}

}  // namespace trailcast::console
