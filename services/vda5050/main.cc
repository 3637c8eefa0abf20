#include <spdlog/spdlog.h>

#include <cstdio>
#include <optional>
#include <string>

#include "services/base/number.h"
#include "services/base/text_file.h"
#include "services/fleet/operator_peer.h"
#include "services/program/command_line.h"
#include "services/program/stop_signal.h"
#include "services/vda5050/gateway.h"

namespace {

namespace program = trailcast::program;
namespace vda5050 = trailcast::vda5050;

constexpr const char* kFooter = R"(Examples:
  trailcast-vda5050 --vouch-for-emergency-stops --broker localhost:1883
  trailcast-vda5050 --vouch-for-emergency-stops --broker broker.site:8883 --tls-ca ca.pem \
      --user robots --password-file broker-password --manufacturer acme
  trailcast-vda5050 --vouch-for-emergency-stops --vda-version 2.1 --battery-if-untold 100
  mosquitto_sub -v -t 'vda5050/v3/#'       # what it tells; of 2.1: uagv/v2/#

Each robot that takes missions ('trailcast-agent serve') is a vehicle there, serialNumber its name. Nodes of an
order are places' names, or ROUTE:METRES, as hall:2.5; 'trailcast network' lists names, junctions
and ends. Edges may have any ids. What is released is driven, and a pause or cancelOrder is what
'trailcast pause' and 'trailcast cancel' are. None of it is an emergency stop: a robot that is out
of reach drives on to the end of what is released.
The state has fields that robots tell nothing of. --vouch-for-emergency-stops has it say of all that
no emergency stop is pressed, no protective field violated, and none is charging but those that a
route server has sent to a dock: whoever gives it vouches that a fleet manager need not know. Run
one gateway for a fleet.
Exit status: 0 stopped by a signal, 1 failed, 2 wrong usage.)";

struct GatewayOptions {
  std::string broker = "localhost:1883";
  std::string version = "3.0";
  std::string password_file;
  std::optional<int> battery;
  bool vouches = false;
  vda5050::Gateway::Options gateway;
};

// HOST:PORT, HOST, or [ADDRESS]:PORT.
trailcast::Result<void> TakeBroker(const std::string& text, vda5050::BrokerOptions& broker) {
  const bool is_bracketed = text.starts_with('[');
  const auto end = is_bracketed ? text.find(']') : text.rfind(':');
  const auto colon = is_bracketed && end != std::string::npos ? end + 1 : end;
  std::string host = text.substr(0, std::min(end, text.size()));
  if (is_bracketed) host.erase(0, 1);
  int port = broker.tls_ca.empty() ? 1883 : 8883;
  if (colon < text.size()) {
    const auto number = trailcast::ParseNumber<int>(std::string_view(text).substr(colon + 1));
    port = number && text[colon] == ':' ? *number : 0;
  }
  if (host.empty() || port < 1 || port > 65535) {
    return trailcast::Fail(trailcast::ErrorCode::kInvalidArgument,
                           "--broker {}: HOST:PORT is expected, as localhost:1883", text);
  }
  broker.host = host;
  broker.port = port;
  return {};
}

// Returns what is wrong with them, or an empty text.
std::string WrongIn(const GatewayOptions& options) {
  const vda5050::BrokerOptions& broker = options.gateway.broker;
  if (!options.vouches) {
    return "the standard's state must say whether an emergency stop is pressed, which robots do "
           "not tell: --vouch-for-emergency-stops says that none is ('trailcast-vda5050 --help')";
  }
  if (!vda5050::IsTopicWord(options.gateway.manufacturer)) {
    return "--manufacturer: 1 to 64 of A-Z a-z 0-9 _ . : - are expected";
  }
  if (!options.password_file.empty() && broker.user.empty()) {
    return "--password-file needs --user";
  }
  if (broker.tls_certificate.empty() != broker.tls_key.empty()) {
    return "--tls-certificate and --tls-key go together";
  }
  if (broker.tls_ca.empty() && !broker.tls_key.empty()) return "--tls-key needs --tls-ca";
  return "";
}

trailcast::Result<void> TakeOptions(GatewayOptions& options) {
  vda5050::Gateway::Options& gateway = options.gateway;
  gateway.version = options.version == "2.1" ? vda5050::Version::k2_1 : vda5050::Version::k3_0;
  if (options.battery) gateway.battery = static_cast<std::uint8_t>(*options.battery);
  if (!options.password_file.empty()) {
    auto text = trailcast::ReadTextFile(options.password_file);
    if (!text) return tl::unexpected(text.error());
    while (text->ends_with('\n') || text->ends_with('\r')) text->pop_back();
    gateway.broker.password = *std::move(text);
  }
  return TakeBroker(options.broker, gateway.broker);
}

void AddOptions(CLI::App& app, GatewayOptions& options) {
  vda5050::BrokerOptions& broker = options.gateway.broker;
  vda5050::Body& body = options.gateway.body;
  app.add_option("--broker", options.broker, "MQTT broker, as HOST:PORT")
      ->envname("TRAILCAST_BROKER");
  app.add_option("--vda-version", options.version, "Version of VDA 5050: 3.0 or 2.1")
      ->check(CLI::IsMember({"3.0", "2.1"}))
      ->envname("TRAILCAST_VDA_VERSION");
  app.add_option("--manufacturer", options.gateway.manufacturer,
                 "Manufacturer of all robots, in topics and messages")
      ->envname("TRAILCAST_MANUFACTURER");
  app.add_flag("--vouch-for-emergency-stops", options.vouches,
               "Has the state say that no emergency stop is pressed, which robots do not tell; "
               "needed")
      ->envname("TRAILCAST_VOUCH_FOR_EMERGENCY_STOPS");
  app.add_option("--battery-if-untold", options.battery,
                 "Percent that the state tells of robots that tell no battery, 100 for those that "
                 "are powered for good; without it they are left out")
      ->check(CLI::Range(0, 100))
      ->envname("TRAILCAST_BATTERY_IF_UNTOLD");
  app.add_option("--user", broker.user, "User at the broker")->envname("TRAILCAST_BROKER_USER");
  app.add_option("--password-file", options.password_file, "File with that user's password")
      ->check(CLI::ExistingFile)
      ->envname("TRAILCAST_BROKER_PASSWORD_FILE");
  app.add_option("--tls-ca", broker.tls_ca,
                 "PEM file: speaks TLS to a broker whose certificate is from this authority")
      ->check(CLI::ExistingFile)
      ->envname("TRAILCAST_BROKER_CA");
  app.add_option("--tls-certificate", broker.tls_certificate,
                 "PEM file: this program's own certificate for the broker")
      ->check(CLI::ExistingFile)
      ->envname("TRAILCAST_BROKER_CERTIFICATE");
  app.add_option("--tls-key", broker.tls_key, "PEM file: that certificate's key")
      ->check(CLI::ExistingFile)
      ->envname("TRAILCAST_BROKER_KEY");
  const char* factsheet = "Factsheet";
  app.add_option("--series", body.series, "seriesName")->group(factsheet);
  app.add_option("--body-speed", body.most_speed_mps, "Most speed in m/s")->group(factsheet);
  app.add_option("--body-acceleration", body.most_acceleration, "Most acceleration in m/s^2")
      ->group(factsheet);
  app.add_option("--body-length", body.length_m, "Metres")->group(factsheet);
  app.add_option("--body-width", body.width_m, "Metres")->group(factsheet);
  app.add_option("--body-height", body.height_m, "Metres")->group(factsheet);
}

int Run(int argc, char** argv) {
  CLI::App app("Robots as vehicles of VDA 5050, for other people's fleet managers, over MQTT.",
               "trailcast-vda5050");
  app.footer(kFooter);
  program::CommonOptions common;
  common.name = "vda5050";
  common.discovery = "mesh";  // in a star it would not hear what robots say of themselves
  program::AddCommonOptions(app, common);
  GatewayOptions options;
  AddOptions(app, options);
  if (const auto ended = program::Parse(app, argc, argv)) return *ended;
  std::string wrong = WrongIn(options);
  if (const auto taken = wrong.empty() ? TakeOptions(options) : trailcast::Result<void>(); !taken) {
    wrong = taken.error().message;
  }
  if (!wrong.empty()) {
    std::fprintf(stderr, "trailcast-vda5050: %s\n", wrong.c_str());
    return program::kExitUsage;
  }
  program::SetUpLog(common);
  const program::StopSignal stop;
  auto peer = trailcast::fleet::JoinAsOperator(common, vda5050::GatewayTopics());
  if (!peer) return program::Complain(app, peer.error());
  vda5050::Gateway gateway(peer->self, std::move(peer->exchange), options.gateway);
  spdlog::info("vda5050: version {}, broker {}:{}", options.version, options.gateway.broker.host,
               options.gateway.broker.port);
  const auto served = gateway.Serve([] { return program::StopSignal::requested(); });
  return served ? program::kExitOk : program::Complain(app, served.error());
}

}  // namespace

int main(int argc, char** argv) {
  return program::RunMain("trailcast-vda5050", [&] { return Run(argc, argv); });
}
