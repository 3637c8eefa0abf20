#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "services/dds/dds_exchange.h"
#include "services/security/member_keys.h"
#include "services/security/src/files.h"
#include "services/security/src/signing.h"

namespace trailcast::test {

// This is a stranger at the network of a fleet with DDS Security, with keys or without, whose
// program makes none of the checks that the fleet's programs make before they join.
class Stranger {
 public:
  using Clock = std::chrono::steady_clock;

  // Reads keys as they claim to be. Throws for a folder that is no member's.
  static security::MemberKeys AtTheirWord(const std::filesystem::path& folder,
                                          const std::filesystem::path& name_key) {
    security::MemberKeys keys;
    keys.folder = folder;
    keys.name_key = security::ReadSmallFile(name_key).value();
    const auto facts =
        security::ReadCertificate(security::ReadSmallFile(folder / "identity.pem").value());
    keys.member = security::ParseCommonName(facts->common_name).value();
    keys.expires = facts->validity.until;
    keys.revoked.text = security::ReadSmallFile(folder / "revoked.pem").value();
    return keys;
  }

  // The network's tag and interface, and the keys, if there are any, are the caller's.
  static Result<std::unique_ptr<exchange::RouteExchange>> Join(dds::DdsOptions network,
                                                               const exchange::TopicUse& use) {
    network.self = AgentId("stranger");
    network.close_timeout = std::chrono::milliseconds(0);
    return dds::OpenDdsExchange(network, use);
  }

  // Returns the messages that reach a stranger within this time, whether or not they can be
  // understood. A notice that a member is gone is no message of that member.
  static std::size_t HeardBy(exchange::RouteExchange& stranger, std::chrono::seconds patience,
                             const std::string& name = "stranger") {
    std::size_t heard = 0;
    auto ask_at = Clock::now();
    for (const auto deadline = ask_at + patience; Clock::now() < deadline;) {
      if (Clock::now() >= ask_at) {
        (void)stranger.Publish(exchange::CatalogRequest{.client = AgentId(name), .request = 1});
        ask_at = Clock::now() + std::chrono::milliseconds(200);
      }
      for (const exchange::Message& message : stranger.Take(std::chrono::milliseconds(200))) {
        if (!std::holds_alternative<exchange::AgentGone>(message)) ++heard;
      }
    }
    return heard + stranger.dropped();
  }
};

}  // namespace trailcast::test
