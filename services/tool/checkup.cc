#include "services/tool/checkup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/timex.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "services/base/text_file.h"

namespace trailcast::tool {
namespace {

using Grade = Finding::Grade;

constexpr std::uint64_t kMiB = 1U << 20U;
constexpr std::uint64_t kGoodBuffer_bytes = 4 * kMiB;
constexpr std::uint64_t kLowDisk_bytes = 1024 * kMiB;
constexpr std::uint64_t kFullDisk_bytes = 64 * kMiB;
constexpr double kGoodClock_s = 1.0;  // ages are given in seconds

std::vector<NetworkInterface> Interfaces() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return {};
  std::map<std::string, NetworkInterface> interfaces;
  for (const ifaddrs* each = list; each != nullptr; each = each->ifa_next) {
    // Our DDS uses IPv4 only.
    if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET) continue;
    interfaces[each->ifa_name] = {each->ifa_name, (each->ifa_flags & IFF_UP) != 0,
                                  (each->ifa_flags & IFF_MULTICAST) != 0,
                                  (each->ifa_flags & IFF_LOOPBACK) != 0};
  }
  freeifaddrs(list);
  std::vector<NetworkInterface> found;
  found.reserve(interfaces.size());
  for (auto& [name, interface] : interfaces) found.push_back(std::move(interface));
  return found;
}

std::optional<double> ClockOff() {
  timex status{};
  if (adjtimex(&status) < 0 || (status.status & STA_UNSYNC) != 0) return std::nullopt;
  return static_cast<double>(status.maxerror) * 1e-6;
}

std::optional<std::uint64_t> FreeBytes(const std::filesystem::path& folder) {
  std::error_code error;
  const auto space = std::filesystem::space(folder, error);
  return error ? std::nullopt : std::optional<std::uint64_t>(space.available);
}

std::string Size(std::uint64_t bytes) {
  if (bytes >= 1024 * kMiB) return fmt::format("{:.1f} GiB", bytes / (1024.0 * kMiB));
  return bytes >= kMiB ? fmt::format("{:.1f} MiB", bytes / static_cast<double>(kMiB))
                       : fmt::format("{} KiB", bytes / 1024);
}

std::string CycloneUri() {
  const char* const uri = std::getenv("CYCLONEDDS_URI");  // NOLINT(concurrency-mt-unsafe)
  return uri == nullptr ? "" : uri;
}

std::string NamesOf(const std::vector<NetworkInterface>& interfaces) {
  std::vector<std::string> names;
  names.reserve(interfaces.size());
  for (const NetworkInterface& each : interfaces) names.push_back(each.name);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

Finding JudgeReceiveBuffer(std::optional<std::uint64_t> most_bytes) {
  if (!most_bytes) return {Grade::kWarning, "receive buffers: their bound cannot be read", ""};
  const std::string what = fmt::format("receive buffers: at most {}", Size(*most_bytes));
  if (*most_bytes >= kGoodBuffer_bytes) return {Grade::kGood, what, ""};
  return {Grade::kWarning, what,
          fmt::format("bursts of segments lose packets and are sent again; as root: "
                      "sysctl -w net.core.rmem_max={} (for good: a file in /etc/sysctl.d)",
                      kGoodBuffer_bytes)};
}

Finding JudgePacketPieces(const std::optional<PacketPieces>& pieces) {
  if (!pieces) return {Grade::kWarning, "packets in pieces: their memory cannot be read", ""};
  const std::string what = fmt::format("packets in pieces: {} of memory, for {} s",
                                       Size(pieces->most_bytes), pieces->kept_s);
  if (pieces->ample()) return {Grade::kGood, what, ""};
  return {
      Grade::kWarning, what,
      fmt::format("where packets are lost, pictures of ROS 2 robots on other computers stop coming "
                  "once it is full; as root: {}",
                  pieces->more())};
}

Finding JudgeNetwork(const std::vector<NetworkInterface>& interfaces, const std::string& wanted) {
  const auto found =
      std::find_if(interfaces.begin(), interfaces.end(), [&](const NetworkInterface& each) {
        return wanted.empty() ? each.up && !each.loopback : each.name == wanted;
      });
  if (found == interfaces.end() && !wanted.empty()) {
    return {Grade::kBad,
            fmt::format("network: there is no interface '{}' with an IPv4 address", wanted),
            fmt::format("--network-interface takes one of: {}", NamesOf(interfaces))};
  }
  if (found == interfaces.end()) {
    return {Grade::kWarning, "network: nothing but the loopback interface is up",
            "only processes on this machine will meet, with --network-interface lo"};
  }
  if (!found->up) {
    return {Grade::kBad, fmt::format("network: interface '{}' is down", found->name),
            fmt::format("as root: ip link set {} up", found->name)};
  }
  // Cyclone assumes that the loopback can multicast, whatever its flag says.
  if (!found->multicast && !found->loopback) {
    return {Grade::kBad, fmt::format("network: interface '{}' has no multicast", found->name),
            "robots find each other by multicast; as root: ip link set " + found->name +
                " multicast on"};
  }
  return {Grade::kGood, fmt::format("network: interface '{}' is up, with multicast", found->name),
          ""};
}

Finding JudgeClock(std::optional<double> off_s) {
  if (off_s && *off_s <= kGoodClock_s) {
    return {Grade::kGood, fmt::format("clock: right to {:.2f} s", *off_s), ""};
  }
  return {Grade::kWarning,
          off_s ? fmt::format("clock: it may be off by {:.1f} s", *off_s)
                : std::string("clock: nothing keeps it right"),
          "the newest of two routes with one name is told by it; run systemd-timesyncd or chrony"};
}

Finding JudgeCycloneUri(const std::string& uri) {
  for (std::size_t from = 0; from < uri.size();) {
    if (uri[from] == '<') break;  // XML may hold commas, and files rarely follow it
    const std::size_t comma = std::min(uri.find(',', from), uri.size());
    std::string file = uri.substr(from, comma - from);
    if (file.starts_with("file://")) file.erase(0, 7);
    std::error_code error;
    if (!file.empty() && !std::filesystem::is_regular_file(file, error)) {
      return {Grade::kBad,
              fmt::format("settings of DDS: CYCLONEDDS_URI names {}, no such file", file),
              "no program will join the network: mend the path, or unset CYCLONEDDS_URI"};
    }
    from = comma + 1;
  }
  return {Grade::kGood, uri.empty() ? "settings of DDS: Cyclone's own" : "settings of DDS: " + uri,
          ""};
}

Finding JudgeDisk(const std::filesystem::path& folder, std::optional<std::uint64_t> free_bytes) {
  if (!free_bytes) {
    return {Grade::kBad, fmt::format("disk: there is no folder {}", folder.string()),
            "create it, or say with --folder where routes are to be kept"};
  }
  const std::string what = fmt::format("disk: {} free in {}", Size(*free_bytes), folder.string());
  if (*free_bytes >= kLowDisk_bytes) return {Grade::kGood, what, ""};
  return {*free_bytes < kFullDisk_bytes ? Grade::kBad : Grade::kWarning, what,
          "a metre of route takes 2 to 5 kB; a full disk refuses segments, which scouts then keep"};
}

std::vector<Finding> ExamineMachine(const std::filesystem::path& folder,
                                    const std::string& network_interface) {
  return {JudgeReceiveBuffer(ReadNumber("/proc/sys/net/core/rmem_max")),
          JudgePacketPieces(ReadPacketPieces()),
          JudgeNetwork(Interfaces(), network_interface),
          JudgeClock(ClockOff()),
          JudgeCycloneUri(CycloneUri()),
          JudgeDisk(folder, FreeBytes(folder))};
}

std::string CheckupText(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    const char* grade = finding.grade == Grade::kGood      ? "ok  "
                        : finding.grade == Grade::kWarning ? "warn"
                                                           : "BAD ";
    text += fmt::format("{}  {}\n", grade, finding.what);
    if (!finding.advice.empty()) text += fmt::format("      {}\n", finding.advice);
  }
  return text;
}

}  // namespace trailcast::tool
