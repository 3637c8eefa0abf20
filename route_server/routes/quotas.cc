#include "route_server/routes/quotas.h"

#include <algorithm>
#include <cmath>

namespace trailcast::server {

std::size_t Quotas::Bucket::Take(std::size_t wanted, double per_s, Time now) {
  const double passed_s = filled_at ? std::chrono::duration<double>(now - *filled_at).count() : 1.0;
  holds = std::min(per_s, holds + passed_s * per_s);
  filled_at = now;
  const std::size_t taken = std::min(wanted, static_cast<std::size_t>(std::floor(holds)));
  holds -= static_cast<double>(taken);
  return taken;
}

std::size_t Quotas::TakeSegments(const AgentId& agent, std::size_t wanted, Time now) {
  if (options_.segments_per_s == 0) return wanted;
  return accounts_.Touch(agent).segments.Take(wanted, options_.segments_per_s, now);
}

Error Quotas::TooManySegments(const AgentId& agent) const {
  return {ErrorCode::kUnavailable,
          fmt::format("over quota: '{}' may have {} segments a second stored here; the others are "
                      "taken later",
                      agent.value(), options_.segments_per_s)};
}

Result<void> Quotas::TakeRequest(const AgentId& member, Time now) {
  if (options_.requests_per_s == 0) return {};
  if (accounts_.Touch(member).requests.Take(1, options_.requests_per_s, now) == 1) return {};
  return Fail(ErrorCode::kUnavailable, "over quota: '{}' may ask {} times a second; again later",
              member.value(), options_.requests_per_s);
}

Result<Quotas::Account*> Quotas::LookedAt(const AgentId& scout, Time now) {
  Account& account = accounts_.Touch(scout);
  if (!account.looked_at || now >= *account.looked_at + kLookAgain) {
    const auto stored = look_(scout);
    if (!stored) return tl::unexpected(stored.error());
    account.stored = *stored;
    account.looked_at = now;
    account.begun.clear();
  }
  return &account;
}

Result<void> Quotas::TakeBytes(const AgentId& scout, std::size_t bytes, Time now) {
  if (options_.stored_bytes == 0) return {};
  const auto account = LookedAt(scout, now);
  if (!account) return tl::unexpected(account.error());
  Stored& stored = (*account)->stored;
  if (stored.bytes + bytes > options_.stored_bytes) {
    constexpr double kMb = 1e6;
    return Fail(ErrorCode::kUnavailable,
                "over quota: routes of '{}' may take {:.1f} MB here, and take {:.1f} MB: an "
                "operator may delete some, or raise the quota",
                scout.value(), static_cast<double>(options_.stored_bytes) / kMb,
                static_cast<double>(stored.bytes) / kMb);
  }
  stored.bytes += bytes;
  return {};
}

Result<void> Quotas::TakeRoute(const AgentId& scout, const route::RouteKey& key, Time now) {
  if (options_.routes == 0) return {};
  const auto looked = LookedAt(scout, now);
  if (!looked) return tl::unexpected(looked.error());
  Account& account = **looked;
  if (account.begun.contains(key)) return {};
  const std::uint64_t has = account.stored.routes + account.begun.size();
  if (has >= options_.routes) {
    return Fail(ErrorCode::kUnavailable,
                "over quota: '{}' may have {} routes here, revisions counted, and has {}: an "
                "operator may delete some, or raise the quota",
                scout.value(), options_.routes, has);
  }
  account.begun.insert(key);
  return {};
}

}  // namespace trailcast::server
