#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trailcast::http {

// Writes a program's metrics in Prometheus's text format, version 0.0.4
// (https://prometheus.io/docs/instrumenting/exposition_formats/).
class MetricsText {
 public:
  static constexpr const char* kType = "text/plain; version=0.0.4; charset=utf-8";
  using Labels = std::vector<std::pair<std::string_view, std::string_view>>;

  // Begins a metric, whose samples follow. `type` is "gauge" or "counter"; the name gets
  // "trailcast_" before it.
  void Begin(std::string_view name, std::string_view type, std::string_view help);
  // Adds a sample of the metric begun last. Labels' values may be any UTF-8.
  void Add(double value, const Labels& labels = {});
  // Adds a metric with one sample and no labels.
  template <typename Number>
  void Add(std::string_view name, std::string_view type, std::string_view help, Number value) {
    Begin(name, type, help);
    Add(static_cast<double>(value));
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string name_;
  std::string text_;
};

}  // namespace trailcast::http
