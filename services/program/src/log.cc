#include <fmt/chrono.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "services/program/command_line.h"
#include "services/program/json.h"

namespace trailcast::program {
namespace {

std::string_view View(spdlog::string_view_t text) { return {text.data(), text.size()}; }

// Writes one JSON object a line, for programs that gather logs.
class JsonLines final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
    const auto milliseconds =
        std::chrono::floor<std::chrono::milliseconds>(message.time.time_since_epoch());
    const auto seconds = std::chrono::floor<std::chrono::seconds>(milliseconds);
    const auto time = fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                                  fmt::gmtime(std::chrono::system_clock::time_point(seconds)),
                                  (milliseconds - seconds).count());
    line.append(OneLine({{"time", time},
                         {"level", View(spdlog::level::to_string_view(message.level))},
                         {"name", View(message.logger_name)},
                         {"text", View(message.payload)}}) +
                "\n");
  }
  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<JsonLines>();
  }
};

}  // namespace

void SetUpLog(const CommonOptions& options) {
  auto logger = spdlog::stderr_color_mt(options.name);
  if (options.log_format == "json") {
    logger->set_formatter(std::make_unique<JsonLines>());
  } else {
    logger->set_pattern("%H:%M:%S.%e %^%-5l%$ %n: %v");
  }
  logger->set_level(spdlog::level::from_str(options.log_level));
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace trailcast::program
