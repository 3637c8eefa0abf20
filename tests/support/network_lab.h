#pragma once

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

namespace trailcast::test {

// This is a radio network on one machine: a bridge is the air, and each host on it has an interface
// eth0. Every host is a network namespace without a name, held by a process that dies with this
// one, so that nothing is left behind however the test ends, and tests may run in parallel. The air
// is the namespace of the thread that makes the lab, which stays there.
class NetworkLab {
 public:
  using Words = std::vector<std::string>;

  // Returns what prevents a lab here. It is empty if nothing does.
  static std::string Obstacle() {
    if (geteuid() != 0) return "networks are staged by root only";
    if (Child([] { return unshare(CLONE_NEWNET) == 0 ? 0 : 1; }) != 0) {
      return "the kernel gives no network namespaces here";
    }
    for (const Words& words : {Words{"ip", "-V"}, Words{"tc", "-V"}, Words{"nsenter", "-V"}}) {
      if (!Runs(words)) return words.front() + " is not installed (packages iproute2, util-linux)";
    }
    return "";
  }

  NetworkLab() {
    if (unshare(CLONE_NEWNET) != 0) throw std::runtime_error("no network namespace");
    Run({"ip", "link", "set", "lo", "up"});
    Run({"ip", "link", "add", "air", "type", "bridge", "mcast_snooping", "0"});
    Run({"ip", "address", "add", "10.77.0.254/24", "dev", "air"});
    Run({"ip", "link", "set", "air", "up"});
  }
  NetworkLab(const NetworkLab&) = delete;
  NetworkLab& operator=(const NetworkLab&) = delete;
  ~NetworkLab() {
    for (const auto& [number, pid] : hosts_) {
      kill(pid, SIGKILL);
      waitpid(pid, nullptr, 0);
    }
  }

  // Adds a host with the address 10.77.0.`number`.
  void AddHost(int number) {
    AddHostWithoutAddress(number);
    GiveAddress(number, number);
  }
  // Adds a host whose eth0 is up, as on a network that has yet to assign an address.
  void AddHostWithoutAddress(int number) {
    hosts_[number] = HoldNamespace();
    Run(At(number, {"ip", "link", "set", "lo", "up"}));
    MakeInterface(number);
  }

  // Adds the address 10.77.0.`address`.
  void GiveAddress(int number, int address) {
    Run(At(number, {"ip", "address", "add", Address(address), "dev", "eth0"}));
  }
  void TakeAddress(int number, int address) {
    Run(At(number, {"ip", "address", "delete", Address(address), "dev", "eth0"}));
  }
  // Removes the interface, like a radio that is unplugged: the host has no eth0 until it is made
  // anew, without an address.
  void DeleteInterface(int number) { Run({"ip", "link", "delete", Port(number)}); }
  void MakeInterface(int number) {
    Run({"ip", "link", "add", Port(number), "type", "veth", "peer", "name", "eth0", "netns",
         std::to_string(hosts_.at(number))});
    Run({"ip", "link", "set", Port(number), "master", "air", "up"});
    Run(At(number, {"ip", "link", "set", "eth0", "up"}));
  }

  // Returns the command line that runs `words` at the host.
  [[nodiscard]] Words At(int number, const Words& words) const {
    Words all{"/usr/bin/nsenter", "--target", std::to_string(hosts_.at(number)), "--net", "--"};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }

  // Takes the host out of range: its frames are lost in both directions, and its interface does not
  // notice.
  void Cut(int number) { Run({"ip", "link", "set", Port(number), "nomaster"}); }
  void Join(int number) { Run({"ip", "link", "set", Port(number), "master", "air"}); }

  // Stops multicast between the hosts that there are.
  void ForbidMulticast() {
    for (const auto& [number, pid] : hosts_) {
      Run({"ip", "link", "set", Port(number), "type", "bridge_slave", "mcast_flood", "off"});
    }
  }

  // Limits how fast the host sends: "20mbit".
  void Limit(int number, const std::string& rate) {
    Run(At(number, {"tc", "qdisc", "replace", "dev", "eth0", "root", "tbf", "rate", rate, "burst",
                    "32kb", "latency", "200ms"}));
  }

  // Drops this share of the packets that the host receives. It needs iptables.
  void Lose(int number, double share) {
    Run(At(number, {"iptables", "-t", "raw", "-F", "PREROUTING"}));
    if (share <= 0.0) return;
    Run(At(number, {"iptables", "-t", "raw", "-A", "PREROUTING", "-p", "udp", "-m", "statistic",
                    "--mode", "random", "--probability", std::to_string(share), "-j", "DROP"}));
  }

  // Sets for how long the host's kernel keeps the pieces of a packet of which some have not come.
  void KeepPiecesFor(int number, int seconds) {
    Run(At(number,
           {"sh", "-c", "echo " + std::to_string(seconds) + " >/proc/sys/net/ipv4/ipfrag_time"}));
  }

  // Returns the number of bytes that the host has sent.
  [[nodiscard]] std::uint64_t Sent(int number) const {
    std::ifstream file("/proc/" + std::to_string(hosts_.at(number)) + "/net/dev");
    for (std::string line; std::getline(file, line);) {
      const auto colon = line.find("eth0:");
      if (colon == std::string::npos) continue;
      std::istringstream numbers(line.substr(colon + 5));
      std::vector<std::uint64_t> columns(16);
      for (std::uint64_t& column : columns) numbers >> column;
      return columns[8];
    }
    throw std::runtime_error("the host has no eth0");
  }

 private:
  static std::string Port(int number) { return "port" + std::to_string(number); }
  static std::string Address(int address) { return "10.77.0." + std::to_string(address) + "/24"; }

  // Returns the exit status of `run` in a child process.
  template <typename Function>
  static int Child(const Function& run) {
    const pid_t pid = fork();
    if (pid == 0) _exit(run());
    int status = -1;
    waitpid(pid, &status, 0);
    return status;
  }

  // Starts a process, which is in a namespace of its own when this returns.
  static pid_t HoldNamespace() {
    int ready[2];
    if (pipe2(ready, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    const pid_t pid = fork();
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      const char made = unshare(CLONE_NEWNET) == 0 ? 1 : 0;
      if (write(ready[1], &made, 1) != 1 || made == 0) _exit(1);
      while (true) pause();
    }
    close(ready[1]);
    char made = 0;
    const bool told = pid > 0 && read(ready[0], &made, 1) == 1;
    close(ready[0]);
    if (!told || made == 0) throw std::runtime_error("no network namespace");
    return pid;
  }

  static bool Runs(Words words) {
    words.insert(words.begin(), "/usr/bin/env");
    const TempDir folder;
    Process process(words, folder / "log");
    return process.Wait() == 0;
  }
  static void Run(Words words) {
    words.insert(words.begin(), "/usr/bin/env");
    const TempDir folder;
    Process process(words, folder / "log");
    if (process.Wait() == 0) return;
    std::string line;
    for (const std::string& word : words) line += word + " ";
    throw std::runtime_error(line + "failed: " + process.output());
  }

  std::map<int, pid_t> hosts_;
};

}  // namespace trailcast::test
