#include "services/users/sessions.h"

#include <algorithm>
#include <utility>

#include "services/users/secret.h"

namespace trailcast::users {

std::string Sessions::Open(Session session, Time now) {
  MakeRoom(session.user, now);
  std::string token = DrawToken();
  open_[DigestOf(token)] = {.session = std::move(session), .began = now, .used = now};
  return token;
}

std::optional<Sessions::Session> Sessions::Use(const std::string& token, Time now) {
  const auto found = open_.find(DigestOf(token));
  if (found == open_.end()) return std::nullopt;
  if (IsOver(found->second, now)) {
    open_.erase(found);
    return std::nullopt;
  }
  found->second.used = now;
  return found->second.session;
}

void Sessions::Close(const std::string& token) { open_.erase(DigestOf(token)); }

bool Sessions::IsOver(const Entry& entry, Time now) const {
  return now >= entry.used + limits_.idle || now >= entry.began + limits_.longest;
}

void Sessions::MakeRoom(const std::string& user, Time now) {
  std::erase_if(open_, [&](const auto& each) { return IsOver(each.second, now); });
  const auto is_of = [&](const auto& each) { return each.second.session.user == user; };
  const auto own = std::count_if(open_.begin(), open_.end(), is_of);
  const bool own_too_many = static_cast<std::size_t>(own) >= limits_.of_one_user;
  if (!own_too_many && open_.size() < limits_.most) return;
  auto oldest = open_.end();
  for (auto each = open_.begin(); each != open_.end(); ++each) {
    if (own_too_many && !is_of(*each)) continue;
    if (oldest == open_.end() || each->second.used < oldest->second.used) oldest = each;
  }
  if (oldest != open_.end()) open_.erase(oldest);
}

}  // namespace trailcast::users
