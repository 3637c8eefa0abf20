#include "services/http/metrics_text.h"

#include <fmt/format.h>

namespace trailcast::http {
namespace {

std::string Escaped(std::string_view value) {
  std::string text;
  for (const char c : value) {
    if (c == '\\' || c == '"') text += '\\';
    if (c == '\n') {
      text += "\\n";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

void MetricsText::Begin(std::string_view name, std::string_view type, std::string_view help) {
  name_ = fmt::format("trailcast_{}", name);
  text_ += fmt::format("# HELP {0} {2}\n# TYPE {0} {1}\n", name_, type, help);
}

void MetricsText::Add(double value, const Labels& labels) {
  text_ += name_;
  char before = '{';
  for (const auto& [label, is] : labels) {
    text_ += fmt::format("{}{}=\"{}\"", before, label, Escaped(is));
    before = ',';
  }
  text_ += fmt::format("{} {}\n", labels.empty() ? "" : "}", value);
}

}  // namespace trailcast::http
