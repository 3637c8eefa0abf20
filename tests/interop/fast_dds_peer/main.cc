// A robot of another make: Fast DDS, and of Trailcast the IDL alone.
#include <cstdio>
#include <string>
#include <vector>

#include "commands.h"
#include "digest.h"
#include "program.h"

namespace {

using trailcast::wire::CatalogRoute;

constexpr const char* kUsage =
    "fast_dds_peer DOMAIN list               the server's routes, a line each\n"
    "fast_dds_peer DOMAIN fetch ROUTE        its segments, a line each, when all are right\n"
    "fast_dds_peer DOMAIN copy ROUTE NAME    the same segments published as a route of that name\n";

std::string StateOf(const trailcast::wire::RouteInfo& info) {
  static const std::vector<std::string> kStandings{"staged", "active", "retired", "deleted"};
  return info.state() == 0 ? "teaching" : kStandings.at(info.standing());
}

void Tell(const CatalogRoute& route) {
  const auto& info = route.info();
  std::printf("%s %s %u %s %u %.3f %llu %s %s %s\n", info.name().c_str(),
              route.key().route().c_str(), info.revision(), StateOf(info).c_str(),
              info.segment_count(), info.length_m(), static_cast<unsigned long long>(info.bytes()),
              info.scout().c_str(), peer::Hex(info.manifest_digest()).c_str(),
              info.camera().c_str());
}

int Run(const std::vector<std::string>& words) {
  if (words.size() < 2) throw std::invalid_argument(kUsage);
  peer::Bus bus(static_cast<std::uint32_t>(std::stoul(words[0])));
  if (words[1] == "list" && words.size() == 2) {
    for (const CatalogRoute& route : peer::List(bus, "")) Tell(route);
  } else if (words[1] == "fetch" && words.size() == 3) {
    for (const auto& piece : peer::Fetch(bus, words[2]).pieces) {
      std::printf("%u %zu %s\n", piece.index(), piece.bytes().size(),
                  peer::Hex(piece.digest()).c_str());
    }
  } else if (words[1] == "copy" && words.size() == 4) {
    Tell(peer::Publish(bus, peer::Fetch(bus, words[2]), words[3]));
  } else {
    throw std::invalid_argument(kUsage);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return fast_dds::StatusOf(Run, argc, argv); }
