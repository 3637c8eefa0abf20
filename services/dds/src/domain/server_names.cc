#include "services/dds/src/domain/server_names.h"

#include <arpa/inet.h>
#include <fmt/ranges.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <memory>
#include <thread>
#include <utility>

namespace trailcast::dds {
namespace {

Result<Addresses> AddressesOf(const std::string& name) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (const int failed = getaddrinfo(name.c_str(), nullptr, &hints, &found); failed != 0) {
    return Fail(ErrorCode::kUnavailable, "the server address '{}' leads nowhere: {}", name,
                gai_strerror(failed));
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> all(found, &freeaddrinfo);
  Addresses addresses;
  for (const addrinfo* one = all.get(); one != nullptr; one = one->ai_next) {
    char text[INET_ADDRSTRLEN] = "";
    const auto* in = reinterpret_cast<const sockaddr_in*>(one->ai_addr);
    inet_ntop(AF_INET, &in->sin_addr, text, sizeof(text));
    addresses.insert(text);
  }
  return addresses;
}

bool IsAddress(const std::string& name) {
  in_addr address{};
  return inet_pton(AF_INET, name.c_str(), &address) == 1;
}

}  // namespace

std::future<Result<Addresses>> AskTheSystem(const std::string& name) {
  std::packaged_task<Result<Addresses>()> ask([name] { return AddressesOf(name); });
  auto answer = ask.get_future();
  std::thread(std::move(ask)).detach();
  return answer;
}

ServerNames::ServerNames(const std::vector<std::string>& names, LookUp look_up)
    : look_up_(std::move(look_up)) {
  for (const std::string& name : names) {
    servers_.push_back({.name = name});
    if (IsAddress(name)) servers_.back().addresses = {name};
  }
}

Result<void> ServerNames::FindAll() {
  for (Server& server : servers_) {
    if (server.addresses.empty() && !server.answer.valid()) server.answer = look_up_(server.name);
  }
  Result<void> all;
  for (Server& server : servers_) {
    if (!server.addresses.empty()) continue;
    auto found = server.answer.get();
    if (found) {
      server.addresses = *std::move(found);
    } else if (all) {
      all = tl::unexpected(found.error());
    }
  }
  return all;
}

std::vector<std::string> ServerNames::addresses() const {
  std::vector<std::string> all;
  for (const Server& server : servers_) {
    all.insert(all.end(), server.addresses.begin(), server.addresses.end());
  }
  return all;
}

std::string ServerNames::Look(const std::function<bool(const std::string&)>& hears, Time now) {
  std::string changes;
  for (Server& server : servers_) {
    if (IsAddress(server.name)) continue;
    if (std::any_of(server.addresses.begin(), server.addresses.end(), hears)) {
      server.missed_since.reset();
      server.patience = kMissed;
      continue;
    }
    if (!server.missed_since) server.missed_since = now;
    if (!server.answer.valid()) {
      if (now - *server.missed_since >= server.patience) server.answer = look_up_(server.name);
      continue;
    }
    if (server.answer.wait_for(std::chrono::seconds(0)) != std::future_status::ready) continue;
    server.missed_since = now;
    server.patience = std::min<Clock::duration>(2 * server.patience, kAtMost);
    if (const std::string change = TakeAnswer(server); !change.empty()) {
      changes += (changes.empty() ? "" : "; ") + change;
    }
  }
  return changes;
}

// An answer that has some of the known addresses only says nothing new: all of them are called.
std::string ServerNames::TakeAnswer(Server& server) const {
  auto found = server.answer.get();
  if (!found || std::includes(server.addresses.begin(), server.addresses.end(), found->begin(),
                              found->end())) {
    return "";
  }
  const Addresses before = std::exchange(server.addresses, *std::move(found));
  std::string change = fmt::format("the server address '{}' leads to {} now", server.name,
                                   fmt::join(server.addresses, ", "));
  if (!before.empty()) change += fmt::format(" instead of {}", fmt::join(before, ", "));
  return change;
}

}  // namespace trailcast::dds
