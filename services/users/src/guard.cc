#include "services/users/guard.h"

#include <algorithm>
#include <exception>
#include <future>
#include <optional>

#include "services/base/give_way.h"

namespace trailcast::users {
namespace {

using std::chrono::milliseconds;

constexpr Throttle::Pace kAddressPace{.free = 5, .longest = milliseconds(15 * 60 * 1000)};
constexpr Throttle::Pace kNamePace{.free = 5};

// Works on a thread of its own, because a robot's stop must not wait for a stranger's password. The
// thread gives way, but keeps a tenth of what another that takes all it can get has; at the lowest
// priority it would keep a seventieth. It returns nothing if there was no thread or no memory for
// it.
std::optional<bool> BesideOthers(const std::function<bool()>& matches) {
  try {
    return std::async(std::launch::async,
                      [&] {
                        constexpr int kATenth = 10;
                        GiveWay(kATenth);
                        return matches();
                      })
        .get();
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

Result<std::unique_ptr<Guard>> Guard::Open(const std::filesystem::path& file, Complain complain,
                                           Parts parts) {
  auto users = LoadUsers(file);
  if (!users) return tl::unexpected(users.error());
  if (users->empty()) {
    return Fail(ErrorCode::kNotFound, "there are no users in {}", file.string());
  }
  return std::unique_ptr<Guard>(
      new Guard(file, *std::move(users), std::move(complain), std::move(parts)));
}

Guard::Guard(const std::filesystem::path& file, Users users, Complain complain, Parts parts)
    : file_(file),
      complain_(std::move(complain)),
      parts_(std::move(parts)),
      users_(file, std::move(users)),
      of_address_(kAddressPace),
      of_name_(kNamePace) {}

std::variant<std::string, Turned> Guard::LogIn(const std::string& name, const std::string& password,
                                               const std::string& address) {
  std::unique_lock lock(mutex_);
  if (const auto turned = MustWait(name, address)) return *turned;
  if (waiting_ >= kMostWaiting) return Turned{.why = Turned::Why::kBusy};
  ++waiting_;
  hashed_.wait(lock, [this] { return !hashes_; });
  --waiting_;
  // Others who came at the same time may have failed meanwhile.
  if (const auto turned = MustWait(name, address)) {
    hashed_.notify_one();
    return *turned;
  }
  const Users& users = Known(parts_.clock());
  const auto found = users.find(name);
  const std::string kept = found == users.end() ? "" : found->second.password;
  hashes_ = true;
  lock.unlock();
  const std::optional<bool> matches =
      password.size() > kLongestPassword ? false : BesideOthers([&] {
        return parts_.matches(password, kept.empty() ? NobodysHash() : kept);
      });
  lock.lock();
  hashes_ = false;
  hashed_.notify_one();
  if (!matches) return Turned{.why = Turned::Why::kBusy};
  const auto now = parts_.clock();
  if (!*matches || kept.empty()) {
    of_address_.Fail(address, now);
    if (known_.Find({name, address}) == nullptr) of_name_.Fail(name, now);
    return Turned{};
  }
  of_name_.Forgive(name);
  known_.Touch({name, address}) = true;
  return sessions_.Open({.user = name, .stamp = kept}, now);
}

std::optional<Turned> Guard::MustWait(const std::string& name, const std::string& address) {
  const auto now = parts_.clock();
  auto wait = of_address_.Wait(address, now);
  if (known_.Find({name, address}) == nullptr) wait = std::max(wait, of_name_.Wait(name, now));
  if (wait == milliseconds{0}) return std::nullopt;
  return Turned{.why = Turned::Why::kTooOften, .wait = wait};
}

void Guard::LogOut(const std::string& session) {
  const std::scoped_lock lock(mutex_);
  sessions_.Close(session);
}

std::optional<Who> Guard::WhoIn(const std::string& session) {
  const std::scoped_lock lock(mutex_);
  const auto now = parts_.clock();
  const auto open = sessions_.Use(session, now);
  if (!open) return std::nullopt;
  const Users& users = Known(now);
  const auto found = users.find(open->user);
  if (found != users.end() && found->second.password == open->stamp) {
    return Who{.name = open->user, .role = found->second.role};
  }
  sessions_.Close(session);
  return std::nullopt;
}

std::optional<Who> Guard::WhoseToken(const std::string& token) {
  const std::string digest = DigestOf(token);
  const std::scoped_lock lock(mutex_);
  for (const auto& [name, user] : Known(parts_.clock())) {
    if (user.token == digest) return Who{.name = name, .role = user.role};
  }
  return std::nullopt;
}

}  // namespace trailcast::users
