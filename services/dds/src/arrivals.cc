#include "services/dds/src/arrivals.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

#include "services/dds/src/domain/peers.h"
#include "services/exchange/bounds.h"

namespace trailcast::dds {
namespace {

// Returns this machine's address from which it sends there. Connecting a datagram socket sends
// nothing.
std::optional<in_addr> OwnTowards(in_addr there) {
  const int handle = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (handle < 0) return std::nullopt;
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(9);  // any port
  to.sin_addr = there;
  sockaddr_in own{};
  socklen_t size = sizeof(own);
  const bool found = connect(handle, reinterpret_cast<const sockaddr*>(&to), sizeof(to)) == 0 &&
                     getsockname(handle, reinterpret_cast<sockaddr*>(&own), &size) == 0;
  close(handle);
  return found ? std::optional(own.sin_addr) : std::nullopt;
}

}  // namespace

std::string NetworkTowards(const std::string& address) {
  in_addr there{};
  const std::string host = address.substr(0, address.find(':'));
  if (inet_pton(AF_INET, host.c_str(), &there) != 1) return "";
  const auto own = OwnTowards(there);
  ifaddrs* list = nullptr;
  if (!own || getifaddrs(&list) != 0) return "";
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(list, &freeifaddrs);
  for (const ifaddrs* one = all.get(); one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    const auto* in = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (in->sin_addr.s_addr == own->s_addr) return one->ifa_name;
  }
  return "";
}

void Arrivals::See(const std::string& participant, const std::string& address) {
  seen_[participant] = {address.substr(0, exchange::kMaxAddressBytes), NetworkTowards(address)};
}

void Arrivals::Lose(const std::string& participant) {
  seen_.erase(participant);
  std::erase_if(writers_, [&](const auto& writer) { return writer.second == participant; });
}

void Arrivals::Forget() {
  seen_.clear();
  writers_.clear();
}

bool Arrivals::IsPresent(const std::string& address) const {
  return std::any_of(seen_.begin(), seen_.end(),
                     [&](const auto& one) { return one.second.address == address; });
}

exchange::Arrival Arrivals::Of(const Reader& reader, const dds_sample_info_t& sample) {
  exchange::Arrival arrival;
  arrival.late = std::chrono::nanoseconds(dds_time() - sample.source_timestamp);
  auto writer = writers_.find(sample.publication_handle);
  if (writer == writers_.end()) {
    const auto guid = reader.ParticipantOf(sample.publication_handle);
    const std::string participant = guid ? ParticipantText(*guid) : "";
    if (!seen_.contains(participant)) return arrival;
    writer = writers_.emplace(sample.publication_handle, participant).first;
  }
  const Way& way = seen_.at(writer->second);
  arrival.address = way.address;
  arrival.network = way.network;
  return arrival;
}

}  // namespace trailcast::dds
