#include "services/vda5050/charging_watch.h"

#include "services/fleet/draw.h"
#include "services/network/words.h"

namespace trailcast::vda5050 {

std::optional<exchange::NetworkRequest> ChargingWatch::Due(Time now) {
  if (now < ask_at_) return std::nullopt;
  ask_at_ = now + kAskEvery;
  request_ = fleet::DrawNumber();
  return exchange::NetworkRequest{
      .client = self_, .request = request_, .words = std::string(network::kAsksCharging)};
}

void ChargingWatch::Hear(const exchange::NetworkReply& reply, Time now) {
  if (reply.client != self_ || reply.request != request_ || !reply.error.empty()) return;
  Told& told = told_.Touch(reply.server);
  told = {.at = now};
  for (const std::string& line : reply.lines) {
    const auto charging = network::ParseListed(line).charging;
    if (charging && charging->text.starts_with(network::kChargesAt)) {
      told.words[charging->robot] = charging->text;
    }
  }
}

std::string ChargingWatch::WordsOf(const std::string& robot, Time now) const {
  for (const auto& [server, told] : told_) {
    const auto found = told.words.find(robot);
    if (found != told.words.end() && now - told.at <= kCountsFor) return found->second;
  }
  return "";
}

}  // namespace trailcast::vda5050
