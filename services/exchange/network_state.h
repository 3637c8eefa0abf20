#pragma once

#include <cstdint>
#include <string>

namespace trailcast::exchange {

// How an exchange is on its network.
struct NetworkState {
  std::string trouble{};    // why nobody can be met at present; empty: nothing keeps it from that
  std::uint64_t joins = 0;  // how often it has joined: more than once where the network changed
};

}  // namespace trailcast::exchange
