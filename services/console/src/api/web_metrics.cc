#include "services/console/src/api/answers.h"
#include "services/console/web.h"
#include "services/http/metrics_text.h"

namespace trailcast::console {

void Web::ServeMetrics() {
  server_.Get("/metrics", [this](const httplib::Request&, httplib::Response& response) {
    auto text = desk_.Measure();
    if (!text) return Refuse(response, text.error());
    commands_.Measure(*text);
    text->Add("console_streams", "gauge", "Pages that look.", streams_.load());
    text->Add("console_streams_refused_total", "counter", "Pages that were one too many.",
              streams_refused_.load());
    text->Add("console_stream_bytes_total", "counter", "Bytes that pages were told.",
              stream_bytes_.load());
    response.set_header("Cache-Control", "no-store");
    response.set_content(text->text(), http::MetricsText::kType);
  });
}

}  // namespace trailcast::console
