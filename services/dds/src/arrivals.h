#pragma once

#include <dds/dds.h>

#include <map>
#include <string>

#include "services/dds/src/entities.h"
#include "services/exchange/messages.h"

namespace trailcast::dds {

// Tells from where and over which interface samples come, by the addresses at which participants
// say they listen.
class Arrivals {
 public:
  // `participant` is in the form of ParticipantText.
  void See(const std::string& participant, const std::string& address);
  void Lose(const std::string& participant);
  // Forgets everything, for an exchange that joins again.
  void Forget();
  // Says whether a participant is present that listens at `address`, "10.0.0.7:7410".
  [[nodiscard]] bool IsPresent(const std::string& address) const;
  // Returns the arrival of a sample that `reader` has just taken. It has no address until its
  // participant was seen.
  [[nodiscard]] exchange::Arrival Of(const Reader& reader, const dds_sample_info_t& sample);

 private:
  struct Way {
    std::string address;
    std::string network;
  };
  std::map<std::string, Way> seen_;
  std::map<dds_instance_handle_t, std::string> writers_;  // their participants, for writers that
                                                          // were seen
};

// Returns the network interface over which this machine sends to an address, "10.0.0.7:41830":
// "wlan0". It is empty if there is no route there, or it is no IPv4 address.
[[nodiscard]] std::string NetworkTowards(const std::string& address);

}  // namespace trailcast::dds
