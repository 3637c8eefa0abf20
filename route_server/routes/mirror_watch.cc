#include "route_server/routes/mirror_watch.h"

#include <fmt/format.h>

namespace trailcast::server {

std::vector<std::string> MirrorWatch::Look(const exchange::Mirror& mirror, Time now) {
  std::vector<std::string> lines;
  std::erase_if(told_, [&](const auto& told) { return !mirror.others().contains(told.first); });
  for (const auto& [server, other] : mirror.others()) {
    State& told = told_[server];
    State state = told;
    if (!other.there) {
      state = State::kGone;
    } else if (!other.differs_since) {
      state = State::kSame;
    } else if (told != State::kSame || now >= *other.differs_since + kMoment) {
      state = State::kOther;
    }
    if (state == told) continue;
    told = state;
    const std::string& name = server.value();
    if (state == State::kSame) {
      lines.push_back(fmt::format("'{}' holds the same routes", name));
    } else if (state == State::kOther) {
      lines.push_back(fmt::format(
          "'{}' holds other routes ({} of {} parts of them differ): each asks for what it lacks",
          name, other.differing, exchange::Mirror::kParts));
    } else {
      lines.push_back(fmt::format(
          "'{}' is out of reach: what changes meanwhile is exchanged when it is back", name));
    }
  }
  return lines;
}

std::string MirrorWatch::Behind(const exchange::Mirror& mirror, Time now) {
  std::string text;
  for (const auto& [server, other] : mirror.others()) {
    if (!other.differs_since || now < *other.differs_since + kLong) continue;
    const auto since = std::chrono::duration_cast<std::chrono::seconds>(now - *other.differs_since);
    text +=
        fmt::format("{}'{}' {} for {} s", text.empty() ? "" : ", ", server.value(),
                    other.there ? "has held other routes" : "has been out of reach", since.count());
  }
  return text;
}

}  // namespace trailcast::server
