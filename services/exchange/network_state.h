#pragma once

#include <cstdint>
#include <string>

namespace trailcast::exchange {

// This is the state of an exchange's network connection.
struct NetworkState {
  std::string trouble{};    // why no peer can be reached at present; empty if nothing prevents it
  std::uint64_t joins = 0;  // times it has joined; more than one where the network changed
};

}  // namespace trailcast::exchange
