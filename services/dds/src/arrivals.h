#pragma once

#include <dds/dds.h>

#include <map>
#include <string>

#include "services/dds/src/entities.h"
#include "services/exchange/messages.h"

namespace trailcast::dds {

// From where and over what samples come, by the addresses that participants say they listen at.
class Arrivals {
 public:
  // `participant`: as ParticipantText has it.
  void See(const std::string& participant, const std::string& address);
  void Lose(const std::string& participant);
  // After joining anew nobody has been seen yet.
  void Forget();
  // Of a sample that `reader` has just taken. Without the address until its participant was seen.
  [[nodiscard]] exchange::Arrival Of(const Reader& reader, const dds_sample_info_t& sample);

 private:
  struct Way {
    std::string address;
    std::string network;
  };
  std::map<std::string, Way> seen_;
  std::map<dds_instance_handle_t, std::string> writers_;  // whose they are, of those seen
};

// Over which network interface this machine sends to an address, "10.0.0.7:41830": "wlan0". Empty
// where no way leads there, or it is no IPv4 address.
[[nodiscard]] std::string NetworkTowards(const std::string& address);

}  // namespace trailcast::dds
