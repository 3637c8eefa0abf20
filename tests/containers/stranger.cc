// Strangers at the fleet's network, for the scenarios:
//   stranger listen SECONDS [KEYS NAME_KEY]   joins as an operator would, asks for routes, and says
//                                             whether DDS let it join and how many messages it
//                                             heard
//   stranger sniff INTERFACE FILE             writes all that passes there, until SIGTERM
#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "services/exchange/topics.h"
#include "tests/support/strangers/sniffer.h"
#include "tests/support/strangers/stranger.h"

namespace {

using trailcast::test::Sniffer;
using trailcast::test::Stranger;

volatile std::sig_atomic_t g_end = 0;

int Listen(const std::vector<std::string>& words) {
  trailcast::dds::DdsOptions options;
  if (words.size() == 4) options.keys = Stranger::AtTheirWord(words[2], words[3]);
  const auto joined = Stranger::Join(options, trailcast::exchange::OperatorTopics());
  if (!joined) {
    std::printf("joined=no\nreason=%s\n", joined.error().message.c_str());
    return 0;
  }
  const auto heard = Stranger::HeardBy(**joined, std::chrono::seconds(std::stoi(words[1])));
  std::printf("joined=yes\nheard=%zu\n", heard);
  return 0;
}

int Sniff(const std::string& interface, const std::string& file) {
  std::signal(SIGTERM, [](int) { g_end = 1; });
  Sniffer sniffer(interface);
  std::puts("listening");
  std::fflush(stdout);
  while (g_end == 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  std::ofstream(file, std::ios::binary) << sniffer.Stop();
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() >= 2 && words[0] == "listen") return Listen(words);
  if (words.size() == 3 && words[0] == "sniff") return Sniff(words[1], words[2]);
  std::fputs("stranger listen SECONDS [KEYS NAME_KEY] | stranger sniff INTERFACE FILE\n", stderr);
  return 2;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "stranger: %s\n", problem.what());
  return 1;
}
