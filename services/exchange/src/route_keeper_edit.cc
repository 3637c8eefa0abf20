// This is how RouteKeeper carries out operators' edits.
#include <algorithm>
#include <sstream>

#include "services/base/text.h"
#include "services/exchange/bounds.h"
#include "services/exchange/route_keeper.h"

namespace trailcast::exchange {
namespace {

using route::RouteInfo;
using route::RouteKey;

// An operator who heard no answer asks again, and all servers that share a store hear it. Some
// edits would do something else the second time, so the store remembers the answer: this word and
// the reason of a refusal, or the keys of the revisions that were changed.
constexpr std::string_view kRefused = "refused ";
constexpr std::string_view kChanged = "changed";

std::string ToText(const std::vector<RouteInfo>& changed) {
  std::string text(kChanged);
  for (const RouteInfo& info : changed) {
    text += fmt::format(" {} {}", info.key.route.value(), info.key.teaching.value());
  }
  return text;
}

std::vector<RouteKey> KeysIn(const std::string& answer) {
  std::istringstream words(answer.substr(kChanged.size()));
  std::vector<RouteKey> keys;
  std::uint64_t teaching = 0;
  for (std::string route; words >> route >> teaching;) {
    keys.push_back({RouteId(route), TeachingId(teaching)});
  }
  return keys;
}

// Neither waiting nor asking again would change it.
bool IsRefusal(const Error& error) {
  return error.code == ErrorCode::kInvalidArgument || error.code == ErrorCode::kNotFound ||
         error.code == ErrorCode::kConflict;
}

}  // namespace

void RouteKeeper::HandleEdit(const RouteEditRequest& request, Time now) {
  CatalogReply reply{.server = self_, .client = request.client, .request = request.request};
  const auto answer = EditOnce(request, now);
  auto edited = answer ? TakeUpEdit(*answer, now) : tl::unexpected(answer.error());
  if (edited) {
    reply.page.total = edited->size();
    edited->resize(std::min(edited->size(), kMaxRoutesPerReply));
    reply.page.routes = std::move(*edited);
  } else {
    reply.error = PlainText(edited.error().message, kMaxLineBytes);
  }
  replies_.emplace_back(std::move(reply));
}

Result<std::string> RouteKeeper::EditOnce(const RouteEditRequest& request, Time now) {
  const std::string id = fmt::format("{}/{}", request.client.value(), request.request);
  std::string answer;
  bool is_first = false;
  const auto done = store_.Exclusively([&]() -> Result<void> {
    const auto said = store_.FindAnswer(id);
    if (!said) return tl::unexpected(said.error());
    is_first = !said->has_value();
    if (!is_first) {
      answer = **said;
      return {};
    }
    auto carried_out = Edit(request.edit);
    if (!carried_out) return tl::unexpected(carried_out.error());
    answer = std::move(*carried_out);
    return store_.RememberAnswer(id, answer);
  });
  if (!done) return tl::unexpected(done.error());
  if (is_first && answer.starts_with(kChanged)) {
    AddNote(Note::Severity::kInfo, "edit/" + id,
            fmt::format("'{}' changes {} revisions of route '{}'", request.client.value(),
                        KeysIn(answer).size(), request.edit.route),
            now);
  }
  return answer;
}

Result<std::string> RouteKeeper::Edit(const route::RouteEdit& edit) {
  const auto changed = catalog_.plan(edit);
  const auto stored = changed ? store_.PutRoutes(*changed) : tl::unexpected(changed.error());
  if (stored) return ToText(*changed);
  if (!IsRefusal(stored.error())) return tl::unexpected(stored.error());
  return std::string(kRefused) + stored.error().message;
}

Result<std::vector<RouteInfo>> RouteKeeper::TakeUpEdit(const std::string& answer, Time now) {
  if (answer.starts_with(kRefused)) {
    return Fail(ErrorCode::kConflict, "{}", answer.substr(kRefused.size()));
  }
  std::vector<RouteInfo> changed;
  for (const RouteKey& key : KeysIn(answer)) {
    auto info = store_.FindRoute(key);
    if (!info) return tl::unexpected(info.error());
    if (!*info) continue;
    TellRelabelled(**info, now);
    changed.push_back(std::move(**info));
  }
  return changed;
}

Result<void> RouteKeeper::Relabel(std::span<const RouteInfo> infos, Time now) {
  if (auto stored = store_.PutRoutes(infos); !stored) return stored;
  for (const RouteInfo& info : infos) TellRelabelled(info, now);
  return {};
}

void RouteKeeper::TellRelabelled(const RouteInfo& info, Time now) {
  KeptRoute* kept = Find(info.key, now);
  if (kept == nullptr) return;  // the store has it, and a later request announces it
  kept->MarkStored(info);
  kept->announce_due = kept->resend_due = true;
  kept->announced_at.reset();  // so that it is not held back
  kept->receipt_at.reset();
}

}  // namespace trailcast::exchange
